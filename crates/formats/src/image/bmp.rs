//! BMP: for textures, read only.

use super::{ImageFile, ImageFormat, decode::decode};
use image::codecs::bmp::BmpDecoder;
use std::io::Cursor;

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "BMP",
    extensions: &["bmp"],
    about: "Windows bitmap: 8-bit sRGB, for textures",
    signatures: &[b"BM"],
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    decode(BmpDecoder::new(Cursor::new(bytes)).map_err(|e| e.to_string())?, bytes.len())
}
