//! Photons, their maps, and the pictures made with them.
mod maps;
mod pictures;
mod scenes;
