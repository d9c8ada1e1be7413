//! The front door of this format.

use super::container::{self, Container};
use super::data::Buffers;
use super::findings::Findings;
use super::scene::Importer;
use super::{check as checks, document, schema};
use crate::diagnostic::{Diagnostic, Error};
use crate::files::Files;
use crate::load::{LoadOptions, SceneFormat, Target};
use std::path::Path;
use sunfleck::scene::SceneBuilder;

/// The entry in the list of scene formats.
pub(crate) const FORMAT: SceneFormat = SceneFormat {
    name: "glTF",
    extensions: &["gltf", "glb"],
    about: "glTF 2.0: meshes, materials, lights, cameras; Draco, meshopt, WebP and KTX2; most extensions of materials",
    is_mesh: true,
    load,
};

fn load(path: &Path, options: &LoadOptions, target: &mut Target) -> Result<(), Error> {
    let bytes = crate::diagnostic::read_bytes(path)?;
    let is_binary = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb"));
    let told = Findings { file: path.display().to_string(), is_strict: options.strict };
    target.input(&bytes);
    read(bytes, is_binary, &Files::beside(path, options.allow_outside), &told, target);
    Ok(())
}

/// Reads a file from memory as if no other file existed: for tests and tools that have no folder. With `strict`, all that
/// breaks the rules of the format is an error.
///
/// # Errors
/// All mistakes in it, and other files that it needs.
pub fn check(name: &str, bytes: Vec<u8>, strict: bool) -> Result<(SceneBuilder, Vec<Diagnostic>), Error> {
    let mut target = Target::new();
    let told = Findings { file: name.to_owned(), is_strict: strict };
    read(bytes, false, &Files::none(), &told, &mut target);
    target.sink.finish(())?;
    let warnings = target.sink.take_warnings();
    Ok((target.into_builder(), warnings))
}

fn read(bytes: Vec<u8>, is_named_binary: bool, files: &Files, told: &Findings, target: &mut Target) {
    let size = bytes.len();
    let Some(Container { json, data, is_binary }) = container::open(bytes, is_named_binary, told, &mut target.sink)
    else {
        return;
    };
    let Some(root) = document::parse(&json, told, &mut target.sink) else { return };
    drop(json);
    checks::version_and_extensions(&root, told, &mut target.sink);
    schema::check(&root, told, &mut target.sink);
    if !target.sink.is_ok() {
        return;
    }
    let buffers = Buffers::load(&root, data, is_binary, files, told, target);
    checks::rules(&root, (&buffers, files), told, &mut target.sink);
    if !target.sink.is_ok() {
        return;
    }
    let size = size.saturating_add(buffers.total());
    Importer::new(&root, &buffers, files, told, (target, size)).run();
}
