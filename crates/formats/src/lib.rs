//! Scene files to scenes, and images in and out.
#![forbid(unsafe_code)]

pub mod diagnostic;
pub mod scn;
