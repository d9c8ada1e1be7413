//! TGA: for textures, read only.

use super::{ImageFile, ImageFormat, decode::decode};
use image::codecs::tga::TgaDecoder;
use std::io::Cursor;

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "TGA",
    extensions: &["tga"],
    about: "Truevision TGA: 8-bit sRGB, for textures (known by the name of the file)",
    signatures: &[],
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    decode(TgaDecoder::new(Cursor::new(bytes)).map_err(|e| e.to_string())?, bytes.len())
}
