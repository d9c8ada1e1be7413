//! TIFF: for textures, read only.

use super::{ImageFile, ImageFormat, decode::decode};
use image::codecs::tiff::TiffDecoder;
use std::io::Cursor;

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "TIFF",
    extensions: &["tif", "tiff"],
    about: "TIFF: 8- and 16-bit sRGB, or linear 32-bit float; for textures",
    signatures: &[b"II*\0", b"MM\0*"],
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    decode(TiffDecoder::new(Cursor::new(bytes)).map_err(|e| e.to_string())?, bytes.len())
}
