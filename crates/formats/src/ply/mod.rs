//! PLY meshes ("Stanford" format): text, and binary of both byte orders, as such or packed by gzip.
//!
//! A file is a header that declares elements and their properties, and then their values (`header`). Of all that a
//! file may hold, [`parse`] keeps positions, normals and texture coordinates of `vertex`, and the polygons of `face`.
//! Counts of the header are believed only as far as the file has bytes for them.

mod header;
mod import;
mod parser;
mod place;
#[cfg(test)]
mod tests;
mod values;

pub(crate) use import::{FORMAT, shape};
pub use parser::{PlyMesh, parse};
pub(crate) use place::{drop_false_normals, place};
