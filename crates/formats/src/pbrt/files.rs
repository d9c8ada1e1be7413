//! Other files that a scene names.

use super::params::Found;
use super::tokens::At;
use crate::diagnostic::{Diagnostic, Error, SourceFile};
use crate::load::Target;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Where names of files start.
pub(super) struct Files {
    /// `None` if there are no other files.
    folder: Option<PathBuf>,
    allow_outside: bool,
}

impl Files {
    /// Names start at the folder of the file `main`.
    pub(super) fn beside(main: &Path, allow_outside: bool) -> Self {
        let folder = main.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Self { folder: Some(folder.to_owned()), allow_outside }
    }

    /// No file but the scene itself.
    pub(super) fn none() -> Self {
        Self { folder: None, allow_outside: false }
    }

    /// Reads a file, unpacked. Devices and pipes are none: a scene must not wait for them or fill the memory from them.
    pub(super) fn read(&self, path: &Path) -> Result<Vec<u8>, Error> {
        let is_special = std::fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir());
        if is_special || self.folder.is_none() {
            let error = Diagnostic::error("file::special", "this is no ordinary file");
            return Err(error.in_file(path.display().to_string()).into());
        }
        crate::packed::read(path)
    }

    /// The path of a file that is named at `at`: beside the main file as in pbrt, or else beside the file that names it.
    pub(super) fn find(&self, name: &str, at: &At) -> PathBuf {
        let name = name.replace('\\', "/");
        let Some(folder) = &self.folder else { return PathBuf::from(name) };
        let path = folder.join(&name);
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
            let message = format!("{} lies outside of the scene's folder", path.display());
            let error = at.tell(Diagnostic::error("pbrt::outside", message), "");
            return Err(Box::new(error.help("if the scene is to be trusted, allow it with --allow-outside")));
        }
        let bytes = self.read(&path).map_err(|e| Box::new(at.tell(first_of(e), "named here")))?;
        target.input(&bytes);
        Ok(Rc::new(SourceFile::from_bytes(path.display().to_string(), bytes)))
    }

    /// Whether there is nothing to read.
    pub(super) fn is_missing(&self, path: &Path) -> bool {
        self.folder.is_none() || !path.exists()
    }

    /// Whether a path leads out of the scene's folder, links followed.
    fn leaves(&self, path: &Path) -> bool {
        match (self.folder.as_ref().map(|f| f.canonicalize()), path.canonicalize()) {
            (Some(Ok(folder)), Ok(path)) => !path.starts_with(folder),
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
