//! PNG: what a screen shows.

use super::{ImageFile, ImageFormat, RgbImage32, Tone, check_size, linear_from_srgb};
use image::codecs::png::{PngDecoder, PngEncoder};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, Limits};
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
    decode_srgb(decoder, bytes.len())
}

/// Decodes a picture of 8- or 16-bit sRGB values.
pub(super) fn decode_srgb(decoder: impl ImageDecoder, file_bytes: usize) -> Result<ImageFile, String> {
    let (width, height) = decoder.dimensions();
    check_size(width.into(), height.into(), decoder.total_bytes(), file_bytes)?;
    let decoded = DynamicImage::from_decoder(decoder).map_err(|e| e.to_string())?;
    let data = if decoded.color().bytes_per_pixel() / decoded.color().channel_count() > 1 {
        let linear = |v: u16| linear_from_srgb(f32::from(v) / 65_535.0);
        decoded.into_rgb16().pixels().map(|p| p.0.map(linear)).collect()
    } else {
        let table: [f32; 256] = std::array::from_fn(|v| linear_from_srgb(v as f32 / 255.0));
        decoded.into_rgb8().pixels().map(|p| p.0.map(|v| table[usize::from(v)])).collect()
    };
    Ok(RgbImage32 { width, height, data }.into())
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
