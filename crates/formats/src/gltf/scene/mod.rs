//! From the JSON and its data to surfaces, lights and a camera.
//!
//! `nodes` walks the hierarchy; what hangs at a node is made by `meshes` (with `geometry`, `draco`, `skin` and `emission`),
//! `lights` and `camera`; `materials` and `textures` say how surfaces look.

mod brushed;
mod camera;
mod draco;
mod emission;
mod geometry;
mod importer;
mod instancing;
mod lights;
mod materials;
mod meshes;
mod nodes;
mod principled;
mod skin;
mod textures;

pub(crate) use emission::pieces;

pub(super) use importer::Importer;
pub(super) use textures::uv_set;
