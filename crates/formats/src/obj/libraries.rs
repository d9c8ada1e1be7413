//! Finds and reads the material libraries of a mesh file.

use super::{Library, ObjFile, parse_mtl};
use crate::diagnostic::{Diagnostic, Sink, SourceFile};
use std::path::{Path, PathBuf};

/// Reads the `.mtl` files that `tree` names, relative to `folder`. What is missing is a warning. Returns the files read
/// with their bytes, for the hash of the inputs.
pub fn read_libraries(tree: &mut ObjFile, source: &SourceFile, folder: &Path, sink: &mut Sink) -> Vec<SourceFile> {
    let mut seen: Vec<PathBuf> = Vec::new();
    let mut files = Vec::new();
    for library in &tree.libraries {
        for path in library_paths(library, folder) {
            if seen.contains(&path) {
                continue;
            }
            seen.push(path.clone());
            match SourceFile::read(&path) {
                Ok(file) => {
                    tree.materials.extend(parse_mtl(&file, sink));
                    files.push(file);
                }
                Err(error) => warn_missing(library, &path, &error, source, sink),
            }
        }
    }
    let defined = tree.material_by_name();
    for (name, span) in &tree.material_names {
        if !defined.contains_key(name.as_str()) {
            sink.warn("obj::unknown-material", || {
                let known = tree.materials.iter().map(|m| m.name.as_str());
                Diagnostic::warning("obj::unknown-material", format!("no material is named `{name}`"))
                    .at(source, *span, "drawn in grey")
                    .one_of(name, known)
            });
        }
    }
    files
}

/// The whole line is one name if such a file exists; else each word is one.
fn library_paths(library: &Library, folder: &Path) -> Vec<PathBuf> {
    let names = library.names.replace('\\', "/");
    let whole = folder.join(&names);
    if whole.is_file() || !names.contains(char::is_whitespace) {
        return vec![whole];
    }
    names.split_whitespace().map(|name| folder.join(name)).collect()
}

fn warn_missing(
    library: &Library,
    path: &Path,
    error: &crate::diagnostic::Error,
    source: &SourceFile,
    sink: &mut Sink,
) {
    sink.warn("obj::missing-library", || {
        let reason = error.errors.first().map_or("cannot be read", |e| e.message.as_str());
        let message = format!("material library {}: {reason}", path.display());
        let warning = Diagnostic::warning("obj::missing-library", message);
        let warning = warning.at(source, library.span, "its materials are drawn in grey");
        let advice = error.errors.first().into_iter().flat_map(|e| &e.help).cloned();
        advice.fold(warning, Diagnostic::help)
    });
}
