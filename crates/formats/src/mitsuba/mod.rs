//! Mitsuba scenes: XML of versions 0.5 and 0.6, 2 and 3.
//!
//! The way of a file: `reader` turns XML into a `document`, with includes joined, `$names` filled in and places kept;
//! `props` reads what an element says; `scene` goes over the document, and `shapes`, `bsdfs`, `textures`, `emitters` and
//! `picture` make of each element what it describes. Objects that have a name are made where they are first used.
//!
//! Names are those of version 3; names of the older versions in camel case are turned into them (`toWorld` is
//! `to_world`). What Mitsuba means is taken from the documentation of its plugins (mitsuba.readthedocs.io, and
//! Jakob, "Mitsuba Documentation", version 0.5.0, 2014).

mod bsdfs;
mod document;
mod emitters;
mod filters;
mod import;
mod indices;
mod media;
mod metals;
mod metals_table;
mod picture;
mod primitives;
mod principled;
mod props;
mod reader;
mod scene;
mod serialized;
mod shapes;
mod sky;
mod smooth;
mod spectra;
#[cfg(test)]
mod tests;
mod textures;
mod transforms;
mod words;

pub(crate) use import::FORMAT;
pub use import::check;
