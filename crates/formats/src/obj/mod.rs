//! Wavefront OBJ meshes and their MTL material libraries.
//!
//! [`parse`] reads the `.obj` text to a [`ObjFile`]: polygons become triangles, one mesh per (object, material).
//! [`read_libraries`] then reads the `.mtl` files it names. Lines, points, curves and smoothing groups carry nothing
//! that a renderer of surfaces uses; they are skipped with a warning. The crates for this format report no columns,
//! which is why this reader exists.

mod appearance;
mod faces;
mod import;
mod libraries;
mod mtl;
mod parser;
mod physical;
#[cfg(test)]
mod tests;
mod tree;
mod triangulate;

pub(crate) use import::{FORMAT, merged};
pub use libraries::read_libraries;
pub use mtl::{MtlMaterial, parse_mtl};
pub use parser::{MAX_CORNERS, parse};
pub use tree::{Corner, Library, ObjFile, ObjMesh};
pub(crate) use triangulate::Triangulator;
