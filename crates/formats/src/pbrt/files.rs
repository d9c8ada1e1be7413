//! Other files that a scene names.

use super::params::Found;
use super::tokens::At;
use crate::diagnostic::{Diagnostic, Error, SourceFile};
use crate::load::Target;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Where names of files start.
pub(super) struct Files {
    folder: PathBuf,
    allow_outside: bool,
}

impl Files {
    /// Names start at the folder of the file `main`.
    pub(super) fn beside(main: &Path, allow_outside: bool) -> Self {
        let folder = main.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Self { folder: folder.to_owned(), allow_outside }
    }

    /// The path of a file that is named at `at`: beside the main file as in pbrt, or else beside the file that names it.
    pub(super) fn find(&self, name: &str, at: &At) -> PathBuf {
        let name = name.replace('\\', "/");
        let path = self.folder.join(&name);
        if !path.exists()
            && let Some(folder) = Path::new(at.source.name()).parent()
            && folder.join(&name).exists()
        {
            return folder.join(&name);
        }
        if path.exists() { path } else { through_text_links(&path).unwrap_or(path) }
    }

    /// Reads a file of an `Include`.
    pub(super) fn include(&self, at: &At, target: &mut Target) -> Found<Rc<SourceFile>> {
        let path = self.find(&at.text(), at);
        if !self.allow_outside && self.leaves(&path) {
            let message = format!("{} lies outside of the scene's folder {}", path.display(), self.folder.display());
            let error = at.tell(Diagnostic::error("pbrt::outside", message), "");
            return Err(Box::new(error.help("if the scene is to be trusted, allow it with --allow-outside")));
        }
        let bytes = crate::packed::read(&path).map_err(|e| Box::new(at.tell(first_of(e), "named here")))?;
        target.input(&bytes);
        Ok(Rc::new(SourceFile::from_bytes(path.display().to_string(), bytes)))
    }

    /// Whether a path leads out of the scene's folder, links followed.
    fn leaves(&self, path: &Path) -> bool {
        match (self.folder.canonicalize(), path.canonicalize()) {
            (Ok(folder), Ok(path)) => !path.starts_with(folder),
            // What does not exist is told of as missing.
            _ => false,
        }
    }
}

/// Where links were stored as text, as Git does where it cannot make them: a folder is a short file that names another one.
fn through_text_links(path: &Path) -> Option<PathBuf> {
    let link = path.ancestors().skip(1).find(|p| p.is_file())?;
    let is_short = std::fs::metadata(link).is_ok_and(|m| m.len() < 1024);
    let text = if is_short { std::fs::read_to_string(link).ok()? } else { return None };
    let folder = link.parent()?.join(text.trim_end());
    let found = folder.join(path.strip_prefix(link).ok()?);
    found.exists().then_some(found)
}

/// The error of another file, to be told of where the file is named.
pub(super) fn first_of(error: Error) -> Diagnostic {
    let mut all = error.errors.into_iter();
    let first = all.next().unwrap_or_else(|| Diagnostic::error("file::unreadable", "the file cannot be read"));
    let file = first.place.as_ref().map(|p| format!("{}: ", p.file)).unwrap_or_default();
    Diagnostic { message: file + &first.message, place: None, ..first }
}
