//! Writing a picture so that a reader never sees half of it.

use super::{FORMATS, ImageFile, ImageFormat, Tone, WriteFn};
use crate::diagnostic::{Diagnostic, Error};
use std::io::Write;
use std::path::Path;
use tempfile::NamedTempFile;

/// What a written file could not keep of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WriteReport {
    /// Pixels with a value that is not finite. PNG and HDR show them as black, or white for +∞ in PNG.
    pub non_finite_pixels: usize,
    /// Whether layers were left out because the format has none.
    pub layers_left_out: bool,
}

/// Writes a picture in the format that the extension of `path` names: to a temporary file in the same folder, then
/// moved, so that a failure leaves an older file as it was. `tone` matters to PNG only.
///
/// # Errors
/// An extension that names no format that can be written, a picture that the format cannot hold, or a file that cannot
/// be written.
pub fn write_image(path: &Path, file: &ImageFile, tone: Tone) -> Result<WriteReport, Error> {
    let name = path.display().to_string();
    let (format, write) = format_for_writing(path)?;
    check_consistent(file, &name)?;
    let bytes = write(file, tone).map_err(|reason| {
        let message = format!("cannot store the picture as {}: {reason}", format.name);
        Error::from(Diagnostic::error("image::cannot-store", message).in_file(&name))
    })?;
    replace_file(path, &bytes).map_err(|error| cannot_write(path, &error))?;
    let non_finite = |p: &&[f32; 3]| !p.iter().all(|x| x.is_finite());
    Ok(WriteReport {
        non_finite_pixels: file.image.data.iter().filter(non_finite).count(),
        layers_left_out: !file.layers.is_empty() && format.extensions[0] != "exr",
    })
}

fn format_for_writing(path: &Path) -> Result<(&'static ImageFormat, WriteFn), Error> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let named = FORMATS.iter().find(|f| f.extensions.contains(&extension.as_str()));
    if let Some((format, write)) = named.and_then(|f| Some((f, f.write?))) {
        return Ok((format, write));
    }
    let message = match (named, extension.as_str()) {
        (Some(format), _) => format!("{} files can be read, but not written", format.name),
        (None, "") => "the name has no extension that tells the format".to_owned(),
        (None, _) => format!("unknown extension `{extension}`"),
    };
    let writable = FORMATS.iter().filter(|f| f.write.is_some()).flat_map(|f| f.extensions.iter().copied());
    let error = Diagnostic::error("image::extension", message).in_file(path.display().to_string());
    Err(error.one_of(&extension, writable).into())
}

fn check_consistent(file: &ImageFile, name: &str) -> Result<(), Error> {
    let size = (file.image.width, file.image.height);
    let fits = |i: &super::RgbImage32| {
        (i.width, i.height) == size && i.data.len() as u64 == u64::from(i.width) * u64::from(i.height)
    };
    if !file.image.data.is_empty() && fits(&file.image) && file.layers.iter().all(|(_, layer)| fits(layer)) {
        return Ok(());
    }
    let message = format!("the picture ({}×{}) is empty, or its parts differ in size", size.0, size.1);
    Err(Diagnostic::error("image::cannot-store", message).in_file(name).into())
}

fn cannot_write(path: &Path, error: &std::io::Error) -> Error {
    // The full text would name the temporary file.
    let message = format!("cannot write the file: {}", error.kind());
    let diagnostic = Diagnostic::error("image::cannot-write", message).in_file(path.display().to_string());
    let folder = folder_of(path);
    if folder.is_dir() {
        return diagnostic.into();
    }
    diagnostic.help(format!("the folder {} does not exist", folder.display())).into()
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A file in a folder that gets its name when it is whole.
pub(crate) fn file_in(folder: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".sunfleck-").suffix(".part");
    // Temporary files are private by default; this one is as open as any new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

fn replace_file(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut file = file_in(folder_of(path))?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path)?;
    Ok(())
}
