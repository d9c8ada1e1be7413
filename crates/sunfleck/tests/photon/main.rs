//! Photons, their maps, and the pictures made with them.
mod aim;
mod bandwidth;
mod chains;
mod ledger;
mod maps;
mod pictures;
mod scenes;
