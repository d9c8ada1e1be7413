//! NRenderer's `.scn` scenes: text to a typed tree ([`parse`]), and tree to scene.
//!
//! The format is line-oriented: the first word of a line decides. Three kinds of section, `Begin Material`,
//! `Begin Model`, `Begin Light`, each closed by `End`, in any number and order; a material stands before its use.
//! NRenderer's own reader is silent about most mistakes and crashes on some; here each is a message with its place.

mod appearance;
mod import;
mod lights;
mod materials;
mod models;
mod numbers;
mod options;
mod parser;
mod properties;
#[cfg(test)]
mod tests;
mod tree;

pub(crate) use import::FORMAT;
pub use options::ScnOptions;
pub use parser::{MAX_OBJECTS, parse};
pub use tree::{
    LightKind, Plane, PropValue, ScnFile, ScnLight, ScnMaterial, ScnModel, ScnProp, ScnShape, ShapeKind, Spanned,
    Sphere, Triangle,
};

/// What a comma between two numbers means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Comma {
    /// It separates numbers, as its author meant.
    #[default]
    Separates,
    /// It ends the numbers and the missing ones are 0: what NRenderer's reader makes of it.
    EndsNumbers,
}
