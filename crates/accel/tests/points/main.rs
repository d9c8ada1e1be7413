//! The two indices over points against brute force.

mod grid;
mod nearest;
mod sets;
