//! Where to send light: toward what the camera needs.
//!
//! A small object in a large scene gets few photons when light starts in proportion to power alone. So a short training
//! before the first pass learns a [`Mixture`]: for each light its plain emission, which always keeps a share, and spheres
//! to send its rays to, through a cone from a lamp, through a disk across the direction from infinity. The mixture is
//! then frozen: passes stay pure functions.
//!
//! - `need`: camera paths tell where photons will be gathered, and what light may have to pass on its way there;
//! - `trial`: light paths on trial, each with what it would add to the relative error of the picture;
//! - `cluster`: spheres around the places where useful paths first meet the scene;
//! - `fit`: the weights that leave the least error;
//! - `learn`, `train`: a mixture from trials, and rounds of these; `mixture` and `target`: what is left of it all.
//!
//! All of it serves one end, light paths of densities that can be asked for: any light, any scene and any algorithm that
//! divides by them stays right, however badly a training went.
mod cluster;
mod fit;
mod learn;
mod mixture;
mod need;
mod target;
mod train;
mod trial;

pub use mixture::{Mixture, Row};
pub use target::Target;
pub use train::Training;
