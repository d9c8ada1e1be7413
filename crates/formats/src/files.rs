//! Other files that a scene names: includes, meshes, pictures.

use crate::diagnostic::{Diagnostic, Error, SourceFile};
use crate::image::{ImageFile, read_image_bytes};
use crate::load::Target;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Longer files are no links that were stored as text.
const MAX_LINK: u64 = 1024;

/// Where names of files start.
pub(crate) struct Files {
    /// `None` if there are no other files.
    folder: Option<PathBuf>,
    /// Looked into before that folder, the last one first.
    others: Vec<PathBuf>,
    allow_outside: bool,
}

impl Files {
    /// Names start at the folder of the file `main`.
    pub(crate) fn beside(main: &Path, allow_outside: bool) -> Self {
        let folder = main.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Self { folder: Some(folder.to_owned()), others: Vec::new(), allow_outside }
    }

    /// No file but the scene itself.
    pub(crate) fn none() -> Self {
        Self { folder: None, others: Vec::new(), allow_outside: false }
    }

    /// Reads a file, unpacked. Devices and pipes are none: a scene must not wait for them or fill the memory from them.
    pub(crate) fn read(&self, path: &Path) -> Result<Vec<u8>, Error> {
        let is_special = std::fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir());
        if is_special || self.folder.is_none() {
            let error = Diagnostic::error("file::special", "this is no ordinary file");
            return Err(error.in_file(path.display().to_string()).into());
        }
        match text_link(path) {
            Some(linked) => crate::packed::read(&linked),
            None => crate::packed::read(path),
        }
    }

    /// Looks into `folder` from now on, before all others. False if there is no such folder.
    pub(crate) fn look_into(&mut self, folder: PathBuf) -> bool {
        let is_there = self.folder.is_some() && folder.is_dir();
        if is_there {
            self.others.push(folder);
        }
        is_there
    }

    /// The path of a file that the file `naming` names: in one of the folders, or else beside the file that names it,
    /// or else packed by gzip.
    pub(crate) fn find(&self, name: &str, naming: &str) -> PathBuf {
        let name = name.replace('\\', "/");
        let Some(folder) = &self.folder else { return PathBuf::from(name) };
        let beside = Path::new(naming).parent();
        let all = self.others.iter().rev().chain([folder]).map(PathBuf::as_path).chain(beside);
        let found = all.map(|folder| folder.join(&name)).find(|path| path.exists());
        let path = folder.join(&name);
        let packed = folder.join(format!("{name}.gz"));
        found.or_else(|| packed.exists().then_some(packed)).or_else(|| through_text_links(&path)).unwrap_or(path)
    }

    /// Reads a file that another one includes.
    ///
    /// # Errors
    /// It is missing or cannot be read, or lies outside of the scene's folder.
    pub(crate) fn include(&self, path: &Path, target: &mut Target) -> Result<Rc<SourceFile>, Box<Diagnostic>> {
        let linked = text_link(path);
        if !self.allow_outside && (self.leaves(path) || linked.is_some_and(|linked| self.leaves(&linked))) {
            let message = format!("{} lies outside of the scene's folder", path.display());
            let error = Diagnostic::error("file::outside", message);
            return Err(Box::new(error.help("if the scene is to be trusted, allow it with --allow-outside")));
        }
        let bytes = self.read(path).map_err(|e| Box::new(first_of(e)))?;
        target.input(&bytes);
        Ok(Rc::new(SourceFile::from_bytes(path.display().to_string(), bytes)))
    }

    /// Reads a picture.
    ///
    /// # Errors
    /// As [`Files::read`], or the file is no picture.
    pub(crate) fn picture(&self, path: &Path, target: &mut Target) -> Result<ImageFile, Error> {
        let bytes = self.read(path)?;
        let picture = read_image_bytes(&path.display().to_string(), &bytes)?;
        target.input(&bytes);
        Ok(picture)
    }

    /// Whether there is nothing to read.
    pub(crate) fn is_missing(&self, path: &Path) -> bool {
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
    let found = text_link(link)?.join(path.strip_prefix(link).ok()?);
    found.exists().then_some(found)
}

/// What a short file names, if it holds nothing but a path.
fn text_link(path: &Path) -> Option<PathBuf> {
    let is_short = std::fs::metadata(path).is_ok_and(|m| m.is_file() && m.len() < MAX_LINK);
    let text = if is_short { std::fs::read_to_string(path).ok()? } else { return None };
    let is_path = !text.trim_end().is_empty() && !text.trim_end().contains(['\n', '\0']);
    let linked = path.parent()?.join(text.trim_end());
    (is_path && linked.exists()).then_some(linked)
}

/// The error of another file, to be told of where the file is named.
pub(crate) fn first_of(error: Error) -> Diagnostic {
    let mut all = error.errors.into_iter();
    let first = all.next().unwrap_or_else(|| Diagnostic::error("file::unreadable", "the file cannot be read"));
    let file = first.place.as_ref().map(|p| format!("{}: ", p.file)).unwrap_or_default();
    Diagnostic { message: file + &first.message, place: None, ..first }
}
