//! Whether a picture can be written to a place, found before there is a picture.
use crate::failure::Failure;
use anyhow::{Context, ensure};
use formats::diagnostic::{Diagnostic, Error as SceneError};
use formats::image::{FORMATS, ImageFormat};
use std::path::Path;

/// The format that the name asks for, once it is sure that such a file can be put there.
pub(crate) fn check(path: &Path) -> Result<&'static ImageFormat, Failure> {
    let format = format_of(path)?;
    check_place(path).map_err(Failure::BadInput)?;
    Ok(format)
}

fn format_of(path: &Path) -> Result<&'static ImageFormat, SceneError> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let writable = || FORMATS.iter().filter(|f| f.write.is_some());
    let found = writable().find(|f| f.extensions.contains(&extension.as_str()));
    found.ok_or_else(|| {
        let message = match extension.as_str() {
            "" => "the name of the picture has no extension that tells its format".to_owned(),
            other => format!("pictures cannot be written as `{other}`"),
        };
        let names = writable().flat_map(|f| f.extensions.iter().copied());
        let error = Diagnostic::error("output::extension", message).in_file(path.display().to_string());
        error.one_of(&extension, names).into()
    })
}

/// That a file can be put there, found by putting a nameless one.
fn check_place(path: &Path) -> anyhow::Result<()> {
    let name = path.display();
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    ensure!(folder.is_dir(), "cannot write {name}: the folder {} does not exist", folder.display());
    if let Ok(meta) = path.metadata() {
        ensure!(!meta.is_dir(), "cannot write {name}: it is a folder");
        ensure!(!meta.permissions().readonly(), "cannot write {name}: it is there already, and read-only");
    }
    tempfile::tempfile_in(folder).with_context(|| format!("cannot write {name}"))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_that_cannot_be_written_are_found() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("taken.png")).unwrap();
        std::fs::write(at("locked.exr"), "").unwrap();
        let mut locked = at("locked.exr").metadata().unwrap().permissions();
        locked.set_readonly(true);
        std::fs::set_permissions(at("locked.exr"), locked).unwrap();
        for bad in ["taken.png", "locked.exr", "nowhere/a.png", "a.jpg", "a", "a.pngg"] {
            assert!(matches!(check(&at(bad)), Err(Failure::BadInput(_))), "{bad}");
        }
        assert_eq!(check(&at("A.PNG")).unwrap().name, "PNG");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "something was left behind");
    }
}
