//! What lies beside the text: in a folder of its own, which takes its name when everything is written.

use crate::diagnostic::{Diagnostic, Error};
use crate::image::{RgbImage32, Tone, file_in, write_image};
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Files that wait for the text.
pub(super) struct Files {
    path: PathBuf,
    /// The folder's last name, under which the text refers to what is in it.
    name: String,
    waiting: TempDir,
    count: usize,
}

impl Files {
    /// For a text at `path`.
    pub(super) fn beside(path: &Path) -> Result<Self, Error> {
        let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        let waiting = tempfile::Builder::new().prefix(".sunfleck-").tempdir_in(folder(path));
        let waiting = waiting.map_err(|e| cannot(path, &e))?;
        Ok(Self { path: path.to_owned(), name: format!("{stem}.files"), waiting, count: 0 })
    }

    fn next(&mut self, extension: &str) -> (PathBuf, String) {
        let file = format!("{:05}.{extension}", self.count);
        self.count += 1;
        (self.waiting.path().join(&file), format!("{}/{file}", self.name))
    }

    /// Adds a file; the name is that by which the text refers to it.
    pub(super) fn add(&mut self, extension: &str, bytes: &[u8]) -> Result<String, Error> {
        let (path, name) = self.next(extension);
        std::fs::write(&path, bytes).map_err(|e| cannot(&path, &e))?;
        Ok(name)
    }

    /// Adds a picture of linear values.
    pub(super) fn picture(&mut self, image: RgbImage32) -> Result<String, Error> {
        let (path, name) = self.next("exr");
        write_image(&path, &image.into(), Tone::Srgb)?;
        Ok(name)
    }

    /// Gives everything its place. Gives the number of files beside the text.
    pub(super) fn commit(self, text: &str) -> Result<usize, Error> {
        let Self { path, name, waiting, count } = self;
        let fail = |e: &std::io::Error| cannot(&path, e);
        let mut file = file_in(folder(&path)).map_err(|e| fail(&e))?;
        file.write_all(text.as_bytes()).map_err(|e| fail(&e))?;
        let target = folder(&path).join(name);
        // An older folder steps aside until the new one is there.
        let aside = tempfile::Builder::new().prefix(".sunfleck-").tempdir_in(folder(&path)).map_err(|e| fail(&e))?;
        if target.exists() {
            std::fs::rename(&target, aside.path().join("old")).map_err(|e| fail(&e))?;
        }
        if count > 0 {
            if let Err(e) = std::fs::rename(waiting.path(), &target) {
                let _ = std::fs::rename(aside.path().join("old"), &target);
                return Err(fail(&e));
            }
            // It has another name now.
            drop(waiting.keep());
        }
        file.persist(&path).map_err(|e| fail(&e.error))?;
        Ok(count)
    }
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn cannot(path: &Path, why: &std::io::Error) -> Error {
    Diagnostic::error("write::failed", format!("cannot be written: {why}")).in_file(path.display().to_string()).into()
}
