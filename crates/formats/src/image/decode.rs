//! From the decoders of the `image` crate to linear pictures.

use super::{ImageFile, RgbImage32, check_size, linear_from_srgb};
use image::{DynamicImage, ImageDecoder, Limits};

/// What a decoder may take besides the picture itself, in bytes.
const MAX_ALLOC: u64 = 1 << 30;

/// Decodes a picture: 8- and 16-bit values as sRGB, floats as they are.
pub(super) fn decode(mut decoder: impl ImageDecoder, file_bytes: usize) -> Result<ImageFile, String> {
    let (width, height) = decoder.dimensions();
    check_size(width.into(), height.into(), decoder.total_bytes(), file_bytes)?;
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_ALLOC);
    decoder.set_limits(limits).map_err(|e| e.to_string())?;
    let decoded = DynamicImage::from_decoder(decoder).map_err(|e| e.to_string())?;
    let has_alpha = decoded.color().has_alpha();
    let channel_bytes = decoded.color().bytes_per_pixel() / decoded.color().channel_count();
    let (data, alpha) = match channel_bytes {
        1 => eight_bits(decoded, has_alpha),
        2 => {
            let linear = |v: u16| linear_from_srgb(f32::from(v) / 65_535.0);
            split(decoded.into_rgba16().pixels().map(|p| p.0), has_alpha, linear, |a| f32::from(a) / 65_535.0)
        }
        _ => split(decoded.into_rgba32f().pixels().map(|p| p.0), has_alpha, |v| v, |a| a),
    };
    let image = RgbImage32 { width, height, data };
    Ok(ImageFile { image, alpha, is_encoded: channel_bytes <= 2, ..ImageFile::default() })
}

fn eight_bits(decoded: DynamicImage, has_alpha: bool) -> (Vec<[f32; 3]>, Vec<f32>) {
    let table: [f32; 256] = std::array::from_fn(|v| linear_from_srgb(v as f32 / 255.0));
    let linear = |v: u8| table[usize::from(v)];
    if has_alpha {
        return split(decoded.into_rgba8().pixels().map(|p| p.0), true, linear, |a| f32::from(a) / 255.0);
    }
    (decoded.into_rgb8().pixels().map(|p| p.0.map(linear)).collect(), Vec::new())
}

/// Colours and opacities of four-channel pixels.
pub(super) fn split<T: Copy>(
    pixels: impl Iterator<Item = [T; 4]> + Clone,
    has_alpha: bool,
    linear: impl Fn(T) -> f32,
    unit: impl Fn(T) -> f32,
) -> (Vec<[f32; 3]>, Vec<f32>) {
    let alpha = if has_alpha { pixels.clone().map(|p| unit(p[3])).collect() } else { Vec::new() };
    (pixels.map(|[r, g, b, _]| [linear(r), linear(g), linear(b)]).collect(), alpha)
}
