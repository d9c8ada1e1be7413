//! PNG: what a screen shows.

use super::{ImageFile, ImageFormat, Tone, decode::decode};
use image::codecs::png::{PngDecoder, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, Limits};
use std::io::Cursor;

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "PNG",
    extensions: &["png"],
    about: "PNG: 8-bit sRGB for screens (reads 16 bits too)",
    signatures: &[b"\x89PNG\r\n\x1A\n"],
    read: Some(read),
    write: Some(write),
};

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    let decoder = PngDecoder::with_limits(Cursor::new(bytes), Limits::no_limits()).map_err(|e| e.to_string())?;
    decode(decoder, bytes.len())
}

fn write(file: &ImageFile, tone: Tone) -> Result<Vec<u8>, String> {
    let image = &file.image;
    let pixels: Vec<u8> = image.data.iter().flatten().map(|x| tone.encode(*x)).collect();
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(&pixels, image.width, image.height, ExtendedColorType::Rgb8)
        .map_err(|e| e.to_string())?;
    Ok(bytes)
}
