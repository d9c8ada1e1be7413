//! Scene files to scenes, and images in and out.
#![forbid(unsafe_code)]

pub mod compare;
pub mod diagnostic;
mod files;
pub mod gltf;
pub mod image;
mod lines;
pub mod load;
pub mod mitsuba;
pub mod obj;
mod packed;
pub mod pbrt;
pub mod ply;
pub mod scn;
mod tessellate;

pub use diagnostic::{Diagnostic, Error, Severity};
pub use load::{LoadOptions, Loaded, SCENE_FORMATS, load};
