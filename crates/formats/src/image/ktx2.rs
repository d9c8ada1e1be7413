//! KTX 2 with Basis Universal pictures, as the web ships them: read only.

use super::decode::split;
use super::{ImageFile, ImageFormat, RgbImage32, check_size, linear_from_srgb};
use basisu::{DecodeFlags, TargetFormat, Transcoder};

pub(super) const FORMAT: ImageFormat = ImageFormat {
    name: "KTX2",
    extensions: &["ktx2"],
    about: "KTX 2 with Basis Universal (ETC1S, UASTC) textures",
    signatures: &[b"\xABKTX 20\xBB\r\n\x1A\n"],
    read: Some(read),
    write: None,
};

/// Where the header has the width; the height follows, then depth, layers, faces and levels (KTX File Format
/// Specification 2.0, section 3).
const WIDTH: usize = 20;
/// Where the list of levels begins: offset, length, and length unpacked, of 8 bytes each.
const LEVELS: usize = 80;
/// No picture that is small enough has more levels.
const MAX_LEVELS: usize = 32;

fn read(bytes: &[u8]) -> Result<ImageFile, String> {
    let (width, height) = check_header(bytes)?;
    let texture = Transcoder::new(bytes).map_err(|e| format!("{e:?}"))?;
    let rgba = texture.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE).map_err(|e| format!("{e:?}"))?;
    let table: [f32; 256] = std::array::from_fn(|v| linear_from_srgb(v as f32 / 255.0));
    let (pixels, _) = rgba.as_chunks::<4>();
    let linear = |v: u8| table[usize::from(v)];
    let (data, alpha) = split(pixels.iter().copied(), texture.has_alpha(), linear, |a| f32::from(a) / 255.0);
    if data.len() as u64 != u64::from(width) * u64::from(height) {
        return Err("it holds fewer pixels than it says".to_owned());
    }
    let image = RgbImage32 { width, height, data };
    Ok(ImageFile { image, alpha, is_encoded: true, ..ImageFile::default() })
}

/// The size, once it and that of each level are believable.
fn check_header(bytes: &[u8]) -> Result<(u32, u32), String> {
    let u32_at = |at: usize| bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let u64_at = |at: usize| bytes.get(at..at + 8).and_then(|b| b.try_into().ok()).map(u64::from_le_bytes);
    let short = "the file ends within its header";
    let field = |i: usize| u32_at(WIDTH + 4 * i).ok_or(short);
    let (width, height) = (field(0)?, field(1)?);
    let (depth, layers, faces, levels) = (field(2)?, field(3)?, field(4)?, field(5)? as usize);
    if depth > 1 || layers > 1 || faces != 1 {
        return Err("it is no plain picture, but a volume, an array or a cube".to_owned());
    }
    if levels > MAX_LEVELS {
        return Err(format!("it is said to have {levels} levels"));
    }
    let unpacked = u64::from(width).saturating_mul(height.into()).saturating_mul(4);
    check_size(width.into(), height.into(), unpacked, bytes.len())?;
    for level in 0..levels.max(1) {
        let unpacked = u64_at(LEVELS + 24 * level + 16).ok_or(short)?;
        check_size(width.into(), height.into(), unpacked, bytes.len())?;
    }
    Ok((width, height))
}
