//! Pictures of the whole sphere in pbrt's two layouts.

use crate::image::RgbImage32;
use glam::{Mat3, Vec2, Vec3};
use std::f32::consts::{PI, TAU};
use sunfleck::math::warp::sphere_to_equal_area_square;
use sunfleck::texture::{ImageTexture, Wrap};

/// A longitude-latitude map, and what takes its axes to those of the light, where z is up.
///
/// Version 4 (`is_version_4`) wants square pictures in the equal-area octahedral layout; others are taken as longitude and
/// latitude, which is all that version 3 has.
///
/// # Errors
/// Why the picture is none.
pub(super) fn panorama(image: RgbImage32, is_version_4: bool) -> Result<(ImageTexture, Mat3), String> {
    let is_square = image.width == image.height;
    let (width, height) = (image.width as usize, image.height as usize);
    let pixels: Vec<Vec3> = image.data.into_iter().map(Vec3::from_array).collect();
    let texture = ImageTexture::new(width, height, pixels, Wrap::Repeat).ok_or("it is empty")?;
    // A map has longitude (atan2(z, x) + π) / 2π and y up; pbrt's has atan2(y, x) / 2π and z up.
    let light_from_map = Mat3::from_cols(-Vec3::X, Vec3::Z, -Vec3::Y);
    if !(is_version_4 && is_square) {
        return Ok((texture, light_from_map));
    }
    let (columns, rows) = (2 * width, width);
    let mut pixels = Vec::with_capacity(columns * rows);
    for y in 0..rows {
        let (sin_theta, cos_theta) = (PI * (y as f32 + 0.5) / rows as f32).sin_cos();
        for x in 0..columns {
            let (sin_phi, cos_phi) = (TAU * (x as f32 + 0.5) / columns as f32).sin_cos();
            let d = Vec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta);
            let place = sphere_to_equal_area_square(d);
            pixels.push(octahedral(&texture, place));
        }
    }
    drop(texture);
    let map = ImageTexture::new(columns, rows, pixels, Wrap::Repeat).ok_or("it is empty")?;
    Ok((map, light_from_map))
}

/// The value at a place of the square; (0, 0) is the first pixel's corner. Away from the edges it is interpolated.
fn octahedral(texture: &ImageTexture, place: Vec2) -> Vec3 {
    let half = 0.5 / texture.width() as f32;
    // Beyond the edge comes another part of it; the nearest pixel is never wrong by more than half its size.
    let inner = place.clamp(Vec2::splat(half), Vec2::splat(1.0 - half));
    texture.eval(Vec2::new(inner.x, 1.0 - inner.y))
}

/// Illuminance of a horizontal plane under the picture of a square layout, or of any: mean luminance of the upper half
/// times π.
pub(super) fn illuminance(image: &RgbImage32) -> f32 {
    let luminance = |p: &[f32; 3]| Vec3::from_array(*p).dot(Vec3::new(0.212_639, 0.715_169, 0.072_192));
    let sum: f64 = image.data.iter().map(|p| f64::from(luminance(p))).sum();
    PI * (sum / image.data.len().max(1) as f64) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_square_map_keeps_areas_and_puts_the_pole_in_the_middle() {
        assert_eq!(sphere_to_equal_area_square(Vec3::Z), Vec2::splat(0.5));
        assert!((sphere_to_equal_area_square(Vec3::X) - Vec2::new(1.0, 0.5)).length() < 1e-6);
        assert!((sphere_to_equal_area_square(Vec3::Y) - Vec2::new(0.5, 1.0)).length() < 1e-6);
        // Of directions spread evenly over the sphere, each quarter of the square gets as many.
        let mut counts = [0_u32; 16];
        let n = 100_000_u32;
        for i in 0..n {
            let z = 1.0 - 2.0 * (i as f32 + 0.5) / n as f32;
            let (sin, cos) = (i as f32 * PI * (3.0 - 5.0_f32.sqrt())).sin_cos();
            let r = (1.0 - z * z).sqrt();
            let p = sphere_to_equal_area_square(Vec3::new(r * cos, r * sin, z));
            counts[(p.x * 4.0).min(3.0) as usize + 4 * (p.y * 4.0).min(3.0) as usize] += 1;
        }
        for count in counts {
            assert!((f64::from(count) / f64::from(n) * 16.0 - 1.0).abs() < 0.02, "{counts:?}");
        }
    }

    #[test]
    fn both_layouts_put_the_light_on_the_same_side() {
        // White where x > 0, y > 0, z > 0 in the light's space.
        let inside = |d: Vec3| if d.min_element() > 0.0 { 1.0 } else { 0.0 };
        let n = 64;
        let mut square = RgbImage32::filled(n, n, [0.0; 3]);
        let mut long = RgbImage32::filled(2 * n, n, [0.0; 3]);
        for i in 0..n * n {
            let p = Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
            // The octant is the quarter of the diamond between +x and +y.
            let q = 2.0 * p - 1.0;
            let white = q.x > 0.0 && q.y > 0.0 && q.x + q.y < 1.0;
            square.data[i as usize] = [f32::from(u8::from(white)); 3];
        }
        for i in 0..2 * n * n {
            let (theta, phi) =
                (PI * ((i / (2 * n)) as f32 + 0.5) / n as f32, TAU * ((i % (2 * n)) as f32 + 0.5) / (2 * n) as f32);
            let d = Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
            long.data[i as usize] = [inside(d); 3];
        }
        for (image, is_version_4) in [(square, true), (long, false)] {
            let (map, light_from_map) = panorama(image, is_version_4).unwrap();
            let value = |d: Vec3| {
                let m = light_from_map.transpose() * d;
                map.eval(Vec2::new((m.z.atan2(m.x) + PI) / TAU, 1.0 - m.y.acos() / PI)).x
            };
            let d = Vec3::new(0.5, 0.6, 0.62).normalize();
            assert!(value(d) > 0.9, "{is_version_4}");
            for other in [Vec3::new(-1.0, 1.0, 1.0), Vec3::new(1.0, -1.0, 1.0), Vec3::new(1.0, 1.0, -1.0)] {
                assert!(value(d * other) < 0.1, "{is_version_4} {other}");
            }
        }
    }
}
