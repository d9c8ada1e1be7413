//! WebP: for textures, read only.

use super::{ImageFile, ImageFormat, decode::decode};
use image::codecs::webp::WebPDecoder;
use std::io::Cursor;

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "WebP",
    extensions: &["webp"],
    about: "WebP: 8-bit sRGB, for textures",
    signatures: &[b"RIFF"],
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    decode(WebPDecoder::new(Cursor::new(bytes)).map_err(|e| e.to_string())?, bytes.len())
}
