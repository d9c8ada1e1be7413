//! Spatial indices: which surface a ray meets first, and which points lie near a point.
//!
//! The only crate of the workspace that may hold `unsafe` and SIMD intrinsics. It is given plain data and
//! closures and knows nothing of light.

mod aabb;
mod bvh;
mod memory;
mod points;
mod ray;

pub use aabb::Aabb;
pub use bvh::{Bvh, Counts, Geometry, Instance, Objects, Quality, SimdLevel};
pub use memory::concat;
pub use points::{KdTree, Neighbours, PointGrid};
pub use ray::{Hit, Ray};
