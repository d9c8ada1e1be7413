//! pbrt scenes, version 4 and the names of version 3.
//!
//! The way of a file: `lexer` cuts bytes into tokens, `tokens` joins the tokens of all included files into one
//! stream, `params` reads the parameters behind a directive, `state` keeps what `AttributeBegin` saves, and
//! `directives` does what each directive says: transformations, shapes, lights, materials, textures and the picture, one
//! file each.
//! The scene is built while reading, as pbrt does, so a file may be larger than what it describes.
//!
//! What pbrt means is taken from its documented file format (pbrt.org, "pbrt-v4 Input File Format" and the one of
//! version 3) and from the book, Pharr, Jakob & Humphreys, "Physically Based Rendering", 2016 and 2023.

mod cameras;
mod covers;
mod curve;
mod curved;
mod directives;
mod filters;
mod import;
mod infinite;
mod layers;
mod lens;
mod lexer;
mod lights;
mod materials;
mod media;
mod meshes;
mod mitsubas;
mod ours;
mod params;
mod picture;
mod projected;
mod roughness;
mod sensor;
mod shapes;
mod spectra;
mod state;
mod subdivide;
#[cfg(test)]
mod tests;
mod textures;
mod tokens;
mod transforms;
mod words;
pub mod write;

pub(crate) use import::FORMAT;
pub use import::check;
