//! Photons, their maps, and the pictures made with them.
mod aim;
mod maps;
mod pictures;
mod scenes;
