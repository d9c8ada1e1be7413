//! Scene files to scenes, and images in and out.
#![forbid(unsafe_code)]

pub mod compare;
pub mod diagnostic;
pub mod image;
mod lines;
pub mod obj;
pub mod scn;
