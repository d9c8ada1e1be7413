//! Pictures in and out: linear RGB in memory, the usual files outside.
//!
//! [`FORMATS`] is the list of what can be read and written; to add a format, write one file with its two functions and
//! one line in that list. Reading goes by the first bytes of a file, writing by the extension of its name. A picture is
//! written to a temporary file beside its target and moved there when it is whole.

mod bmp;
mod decode;
mod display;
mod exr_file;
mod exr_order;
mod hdr;
mod jpeg;
mod ktx2;
mod pfm;
mod png;
mod save;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod texture_tests;
mod tga;
mod tiff;
mod webp;

pub use display::{Tone, linear_from_srgb, srgb_from_linear};
pub(crate) use save::file_in;
pub use save::{WriteReport, write_image};

use crate::diagnostic::{Diagnostic, Error, MAX_FILE_BYTES, read_bytes};
use std::path::Path;

/// A picture may have at most this many pixels.
pub const MAX_PIXELS: u64 = 1 << 28;

/// A linear RGB picture. Values are radiance, unbounded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RgbImage32 {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Pixels row by row; row 0 is on top.
    pub data: Vec<[f32; 3]>,
}

impl RgbImage32 {
    /// A picture of one colour.
    pub fn filled(width: u32, height: u32, colour: [f32; 3]) -> Self {
        Self { width, height, data: vec![colour; width as usize * height as usize] }
    }

    /// The pixel in column `x` of row `y`.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn pixel(&self, x: u32, y: u32) -> [f32; 3] {
        assert!(x < self.width && y < self.height, "no pixel ({x}, {y}) in {}×{}", self.width, self.height);
        self.data[(y as usize) * self.width as usize + x as usize]
    }
}

/// What an image file holds: a picture, and in some formats more.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImageFile {
    /// The picture itself.
    pub image: RgbImage32,
    /// Further pictures with their names, such as `albedo` or `variance`. All of the picture's size.
    pub layers: Vec<(String, RgbImage32)>,
    /// Names and values, such as the seed. Names are unique.
    pub metadata: Vec<(String, String)>,
    /// Opacity in [0, 1] by pixel; empty where the file has none. Colours are not multiplied by it.
    pub alpha: Vec<f32>,
    /// Whether the file holds 8- or 16-bit values, read as sRGB; [`Self::undo_srgb`] is for those that are no colours.
    pub is_encoded: bool,
}

impl ImageFile {
    /// The picture with the stored values as they are, for data such as roughness or normals.
    pub fn undo_srgb(mut self) -> Self {
        if self.is_encoded {
            self.image.data.iter_mut().flatten().for_each(|v| *v = srgb_from_linear(*v));
            self.is_encoded = false;
        }
        self
    }
}

impl From<RgbImage32> for ImageFile {
    fn from(image: RgbImage32) -> Self {
        Self { image, ..Self::default() }
    }
}

/// Decodes the bytes of a file; the error says what is wrong with them.
pub type ReadFn = fn(&[u8]) -> Result<ImageFile, String>;

/// Encodes a picture; the error says why it cannot be stored.
pub type WriteFn = fn(&ImageFile, Tone) -> Result<Vec<u8>, String>;

/// An image format.
#[derive(Clone, Copy, Debug)]
pub struct ImageFormat {
    /// Its usual name.
    pub name: &'static str,
    /// Extensions of file names, in lower case; the first one is the usual one.
    pub extensions: &'static [&'static str],
    /// One line for lists.
    pub about: &'static str,
    /// The first bytes of such files.
    pub signatures: &'static [&'static [u8]],
    /// Reads it, if it can be read.
    pub read: Option<ReadFn>,
    /// Writes it, if it can be written.
    pub write: Option<WriteFn>,
}

/// All image formats.
pub const FORMATS: &[ImageFormat] = &[
    exr_file::FORMAT,
    png::FORMAT,
    hdr::FORMAT,
    pfm::FORMAT,
    jpeg::FORMAT,
    webp::FORMAT,
    tiff::FORMAT,
    bmp::FORMAT,
    ktx2::FORMAT,
    tga::FORMAT,
];

/// Reads a picture as linear RGB. Grey pictures become RGB; 8- and 16-bit values are taken as sRGB.
///
/// # Errors
/// The file cannot be read, is of no known format, is damaged, or has more than [`MAX_PIXELS`] pixels.
pub fn read_image(path: &Path) -> Result<ImageFile, Error> {
    let bytes = read_bytes(path)?;
    read_image_bytes(&path.display().to_string(), &bytes)
}

/// As [`read_image`], from memory; `name` is what messages call the file.
///
/// # Errors
/// As [`read_image`].
pub fn read_image_bytes(name: &str, bytes: &[u8]) -> Result<ImageFile, Error> {
    let Some((format, read)) = format_of(name, bytes).and_then(|f| Some((f, f.read?))) else {
        let names = FORMATS.iter().filter(|f| f.read.is_some()).map(|f| f.name);
        let mut error =
            Diagnostic::error("image::unknown-format", "this is no picture of a known format").in_file(name);
        error.valid = names.map(str::to_owned).collect();
        return Err(error.into());
    };
    read(bytes).map_err(|reason| {
        let message = format!("cannot read this {} file: {reason}", format.name);
        Diagnostic::error("image::damaged", message).in_file(name).into()
    })
}

/// By the first bytes; a format that has none for itself by the name of the file.
fn format_of(name: &str, bytes: &[u8]) -> Option<&'static ImageFormat> {
    let known = |f: &&ImageFormat| f.signatures.iter().any(|s| bytes.starts_with(s));
    let extension = || name.rsplit_once('.').map(|(_, e)| e.to_lowercase());
    let named =
        |f: &&ImageFormat| f.signatures.is_empty() && extension().is_some_and(|e| f.extensions.contains(&e.as_str()));
    FORMATS.iter().find(known).or_else(|| FORMATS.iter().find(named))
}

/// Sizes up to this many bytes, unpacked, are believed whatever the file's own.
const SMALL: u64 = 1 << 26;

/// Refuses sizes that are forged or beyond reason, before memory is reserved. `stored` is what the pixels take when
/// unpacked and `bytes` the size of the file: beyond pictures of one colour no codec here packs 4096 to 1.
fn check_size(width: u64, height: u64, stored: u64, bytes: usize) -> Result<(), String> {
    let pixels = width.saturating_mul(height);
    if pixels == 0 {
        return Err(format!("its size is {width}×{height}"));
    }
    if pixels > MAX_PIXELS {
        return Err(format!("its size is {width}×{height}, more than {MAX_PIXELS} pixels"));
    }
    if stored > (bytes as u64).saturating_mul(4096).max(SMALL) || stored > 16 * MAX_FILE_BYTES {
        return Err(format!("its size is said to be {width}×{height}, but it has only {bytes} bytes"));
    }
    Ok(())
}
