//! Where two pictures differ, as colours of even steps to the eye.

use super::{CompareError, check_sizes, grey};
use crate::image::RgbImage32;
use glam::{Mat3, Vec3};

/// What a heat map shows of the relative difference d = (x − r) / √(r² + 0.01) of grey values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeatMap {
    /// d from −scale (blue) over 0 (white) to +scale (red).
    Signed,
    /// |d| from 0 (black) to scale (pale yellow).
    Absolute,
}

/// Where the picture is not finite.
const NOT_FINITE: Vec3 = Vec3::new(1.0, 0.0, 1.0);

/// Draws the difference; `scale` (above 0) is the relative difference at the end of the ramp. Magenta marks pixels that
/// are not finite. The colours are linear, as in any [`RgbImage32`].
///
/// # Errors
/// Sizes differ.
pub fn heat_map(
    image: &RgbImage32,
    reference: &RgbImage32,
    map: HeatMap,
    scale: f32,
) -> Result<RgbImage32, CompareError> {
    check_sizes(image, reference)?;
    let colour = |(x, r): (&[f32; 3], &[f32; 3])| {
        let (x, r) = (grey(*x), grey(*r));
        let d = (x - r) / (r * r + 0.01).sqrt() / scale;
        let colour = match map {
            _ if !d.is_finite() => NOT_FINITE,
            HeatMap::Signed => diverging(d.clamp(-1.0, 1.0)),
            HeatMap::Absolute => sequential(d.abs().min(1.0)),
        };
        colour.clamp(Vec3::ZERO, Vec3::ONE).to_array()
    };
    let data = image.data.iter().zip(&reference.data).map(colour).collect();
    Ok(RgbImage32 { width: image.width, height: image.height, data })
}

/// Black, violet, orange, pale yellow, with lightness rising evenly.
fn sequential(t: f32) -> Vec3 {
    let hue = (-60.0 + 170.0 * t).to_radians();
    let chroma = 0.62 * t * (1.0 - t) + 0.03 * t;
    linear_from_oklab(0.97 * t, chroma * hue.cos(), chroma * hue.sin())
}

/// Blue at −1, white at 0, red at 1, with lightness falling evenly to both ends.
fn diverging(t: f32) -> Vec3 {
    let hue = if t < 0.0 { 262.0_f32 } else { 27.0 }.to_radians();
    let chroma = 0.19 * t.abs();
    linear_from_oklab(0.98 - 0.46 * t.abs(), chroma * hue.cos(), chroma * hue.sin())
}

/// Björn Ottosson 2020, "A perceptual color space for image processing": from lightness and two opponent axes to
/// linear sRGB.
fn linear_from_oklab(l: f32, a: f32, b: f32) -> Vec3 {
    let cone_root_from_lab = Mat3::from_cols(
        Vec3::ONE,
        Vec3::new(0.396_337_78, -0.105_561_346, -0.089_484_18),
        Vec3::new(0.215_803_76, -0.063_854_17, -1.291_485_5),
    );
    let linear_from_cone = Mat3::from_cols(
        Vec3::new(4.076_741_7, -1.268_438, -0.004_196_086_3),
        Vec3::new(-3.307_711_6, 2.609_757_4, -0.703_418_6),
        Vec3::new(0.230_969_94, -0.341_319_38, 1.707_614_7),
    );
    let root = cone_root_from_lab * Vec3::new(l, a, b);
    linear_from_cone * (root * root * root)
}
