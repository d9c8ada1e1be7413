//! Portable float maps: a header of three lines and raw floats, the bottom row first.

use super::{ImageFile, ImageFormat, RgbImage32, check_size};

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "PFM",
    extensions: &["pfm"],
    about: "portable float map: linear RGB, 32-bit float, not packed",
    signatures: &[b"PF\n", b"Pf\n", b"PF\r", b"Pf\r", b"PF ", b"Pf "],
    read: Some(read),
    write: Some(|file, _| Ok(encode(&file.image))),
};

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    let mut rest = bytes;
    let channels = if word(&mut rest) == b"PF" { 3 } else { 1 };
    let mut number = |what: &str| -> Result<f64, String> {
        let text = String::from_utf8_lossy(word(&mut rest)).into_owned();
        text.parse().map_err(|_| format!("the header has no {what}"))
    };
    let (width, height) = (number("width")? as u64, number("height")? as u64);
    let scale = number("scale")?;
    if scale == 0.0 || !scale.is_finite() {
        return Err("the scale in the header is zero or not finite".to_owned());
    }
    let stored = width.saturating_mul(height).saturating_mul(4 * channels);
    check_size(width, height, stored, bytes.len())?;
    if (rest.len() as u64) < stored {
        return Err(format!("{stored} bytes of pixels expected, found {}", rest.len()));
    }
    let float: fn([u8; 4]) -> f32 = if scale < 0.0 { f32::from_le_bytes } else { f32::from_be_bytes };
    let value = |b: &[u8]| float([b[0], b[1], b[2], b[3]]);
    let pixel = |b: &[u8]| if channels == 3 { [value(b), value(&b[4..]), value(&b[8..])] } else { [value(b); 3] };
    let (pixel_bytes, width, height) = (4 * channels as usize, width as u32, height as u32);
    let rows = rest[..stored as usize].chunks_exact(pixel_bytes * width as usize).rev();
    let data = rows.flat_map(|row| row.chunks_exact(pixel_bytes).map(pixel)).collect();
    Ok(RgbImage32 { width, height, data }.into())
}

/// The next word of the header; exactly one white byte behind it is skipped, since pixels may look like blanks.
fn word<'b>(rest: &mut &'b [u8]) -> &'b [u8] {
    let text = rest.trim_ascii_start();
    let len = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    *rest = text.get(len + 1..).unwrap_or_default();
    &text[..len]
}

fn encode(image: &RgbImage32) -> Vec<u8> {
    let mut bytes = format!("PF\n{} {}\n-1.0\n", image.width, image.height).into_bytes();
    bytes.reserve(12 * image.data.len());
    for row in image.data.chunks_exact(image.width as usize).rev() {
        bytes.extend(row.iter().flatten().flat_map(|x| x.to_le_bytes()));
    }
    bytes
}
