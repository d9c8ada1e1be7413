//! The front door of this format.

use super::directives::Importer;
use super::tokens::Tokens;
use crate::diagnostic::{Diagnostic, Error, SourceFile};
use crate::files::Files;
use crate::load::{LoadOptions, SceneFormat, Target};
use std::path::Path;
use std::rc::Rc;
use sunfleck::scene::SceneBuilder;

/// The entry in the list of scene formats.
pub(crate) const FORMAT: SceneFormat = SceneFormat {
    name: "pbrt",
    extensions: &["pbrt", "pbrt.gz"],
    about: "scenes of pbrt 4 and 3: shapes, lights, materials, textures, instances, the camera and the film",
    is_mesh: false,
    load,
};

fn load(path: &Path, options: &LoadOptions, target: &mut Target) -> Result<(), Error> {
    let bytes = crate::packed::read(path)?;
    read(path, bytes, options, target);
    Ok(())
}

/// Reads a scene from memory as if no other file existed: for tests and tools that have no folder.
///
/// # Errors
/// All mistakes in it, and files that it includes.
pub fn check(name: &str, bytes: Vec<u8>) -> Result<(SceneBuilder, Vec<Diagnostic>), Error> {
    let mut target = Target::new();
    let source = Rc::new(SourceFile::from_bytes(name, bytes));
    Importer::new(&mut target, Files::none(), Tokens::new(source)).run();
    target.sink.finish(())?;
    let warnings = target.sink.take_warnings();
    Ok((target.into_builder(), warnings))
}

/// Adds a scene in memory to `target`. Names of other files start at the folder of `path`.
pub(crate) fn read(path: &Path, bytes: Vec<u8>, options: &LoadOptions, target: &mut Target) {
    target.input(&bytes);
    let source = Rc::new(SourceFile::from_bytes(path.display().to_string(), bytes));
    let files = Files::beside(path, options.allow_outside);
    Importer::new(target, files, Tokens::new(source)).run();
}
