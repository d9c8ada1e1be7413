//! The front door of this format.

use super::reader::Reader;
use super::scene::Importer;
use crate::diagnostic::{Diagnostic, Error, SourceFile};
use crate::files::Files;
use crate::load::{LoadOptions, SceneFormat, Target};
use std::path::Path;
use std::rc::Rc;
use sunfleck::scene::SceneBuilder;

/// The entry in the list of scene formats.
pub(crate) const FORMAT: SceneFormat = SceneFormat {
    name: "Mitsuba",
    extensions: &["xml"],
    about: "scenes of Mitsuba 3, 2, 0.6 and 0.5: shapes, emitters, BSDFs, textures, instances, the sensor and its film",
    is_mesh: false,
    load,
};

fn load(path: &Path, options: &LoadOptions, target: &mut Target) -> Result<(), Error> {
    let source = SourceFile::read(path)?;
    target.input(source.bytes());
    read(&Rc::new(source), Files::beside(path, options.allow_outside), &options.defines, target);
    Ok(())
}

/// Reads a scene from memory as if no other file existed: for tests and tools that have no folder.
///
/// # Errors
/// All mistakes in it, and files that it includes.
pub fn check(name: &str, bytes: Vec<u8>) -> Result<(SceneBuilder, Vec<Diagnostic>), Error> {
    let mut target = Target::new();
    read(&Rc::new(SourceFile::from_bytes(name, bytes)), Files::none(), &[], &mut target);
    target.sink.finish(())?;
    let warnings = target.sink.take_warnings();
    Ok((target.into_builder(), warnings))
}

fn read(source: &Rc<SourceFile>, files: Files, defines: &[(String, String)], target: &mut Target) {
    match Reader::new(target, files, defines).read(source) {
        Ok((document, files)) => Importer::new(target, files, &document).run(),
        Err(error) => target.sink.error(*error),
    }
}
