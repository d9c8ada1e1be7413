//! Vectors, frames, rays and warps. What direction, from where, with which density?
//!
//! Everything above (shapes, lights, scattering) is written in these terms; nothing here knows of light.
mod discrete;
mod erf;
mod frame;
mod motion;
mod offset;
pub mod warp;

pub use accel::Ray;
pub use discrete::{Discrete, Discrete2d};
pub use erf::erf;
pub use frame::{Frame, Local};
pub use glam::{Affine3A, Vec2, Vec3};
pub use motion::Motion;
pub use offset::offset_origin;
