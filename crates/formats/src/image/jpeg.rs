//! JPEG: for textures, read only.

use super::{ImageFile, ImageFormat, decode::decode};
use image::codecs::jpeg::JpegDecoder;
use std::io::Cursor;

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "JPEG",
    extensions: &["jpg", "jpeg"],
    about: "JPEG: 8-bit sRGB, for textures (not written: it blurs what a comparison looks at)",
    signatures: &[b"\xFF\xD8\xFF"],
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    decode(JpegDecoder::new(Cursor::new(bytes)).map_err(|e| e.to_string())?, bytes.len())
}
