//! glTF 2.0 scenes: `.gltf` with files or data beside or inside it, and `.glb`.
//!
//! The way of a file: `container` parts JSON and data, `document` parses the JSON, `schema` compares it with the tables of
//! the specification and its extensions, `data` loads buffers and unpacks views, `check` looks for what tables cannot say,
//! and `scene` makes surfaces, lights and a camera. Messages name places in the JSON.
//!
//! What glTF means is taken from its specification (Khronos Group, "glTF 2.0 Specification") and from those of the extensions
//! in its registry. Many files in the wild break rules that no picture depends on: those are told of as errors, and read all the
//! same but with [`crate::LoadOptions::strict`].

mod check;
mod container;
mod data;
mod document;
mod findings;
mod import;
mod scene;
mod schema;
#[cfg(test)]
mod tests;

pub(crate) use import::FORMAT;
pub use import::check;
pub(crate) use scene::pieces;
