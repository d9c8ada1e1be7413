//! The front door of this format.

use super::directives::Importer;
use super::files::Files;
use super::tokens::Tokens;
use crate::diagnostic::{Error, SourceFile};
use crate::load::{LoadOptions, SceneFormat, Target};
use std::path::Path;
use std::rc::Rc;

/// The entry in the list of scene formats.
pub(crate) const FORMAT: SceneFormat = SceneFormat {
    name: "pbrt",
    extensions: &["pbrt", "pbrt.gz"],
    about: "scenes of pbrt 4 and 3: shapes, lights, materials, textures, instances, the camera and the film",
    load,
};

fn load(path: &Path, options: &LoadOptions, target: &mut Target) -> Result<(), Error> {
    let bytes = crate::packed::read(path)?;
    read(path, bytes, options, target);
    Ok(())
}

/// Adds a scene in memory to `target`. Names of other files start at the folder of `path`.
pub(crate) fn read(path: &Path, bytes: Vec<u8>, options: &LoadOptions, target: &mut Target) {
    target.input(&bytes);
    let source = Rc::new(SourceFile::from_bytes(path.display().to_string(), bytes));
    let files = Files::beside(path, options.allow_outside);
    Importer::new(target, files, Tokens::new(source)).run();
}
