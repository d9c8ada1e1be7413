//! Radiance pictures: three 8-bit mantissas with a common exponent.

use super::{ImageFile, ImageFormat, RgbImage32, Tone, check_size};
use image::codecs::hdr::{HdrDecoder, HdrEncoder};
use image::{ImageDecoder, Rgb};
use std::io::Cursor;

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "Radiance HDR",
    extensions: &["hdr", "pic", "rgbe"],
    about: "Radiance RGBE: linear RGB, about 1 % steps, no negative values",
    signatures: &[b"#?"],
    read: Some(read),
    write: Some(write),
};

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    let decoder = HdrDecoder::new(Cursor::new(bytes)).map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions();
    check_size(width.into(), height.into(), u64::from(width) * u64::from(height) * 4, bytes.len())?;
    let mut data = vec![[0.0f32; 3]; width as usize * height as usize];
    decoder.read_image(bytemuck::cast_slice_mut(&mut data)).map_err(|e| e.to_string())?;
    Ok(RgbImage32 { width, height, data }.into())
}

fn write(file: &ImageFile, _: Tone) -> Result<Vec<u8>, String> {
    let image = &file.image;
    // The largest number that the format can hold is 255/256 · 2^127.
    let storable = |x: &f32| if x.is_finite() { x.clamp(0.0, 1.6e38) } else { 0.0 };
    let pixels: Vec<Rgb<f32>> = image.data.iter().map(|p| Rgb(p.each_ref().map(storable))).collect();
    let mut bytes = Vec::new();
    let size = (image.width as usize, image.height as usize);
    HdrEncoder::new(&mut bytes).encode(&pixels, size.0, size.1).map_err(|e| e.to_string())?;
    Ok(bytes)
}
