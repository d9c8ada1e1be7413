//! Maps from the unit square to directions and points, each with its density.
//!
//! Every `square_to_x` has a `square_to_x_pdf` (or a stated constant density) and is checked against it by χ² below.
use super::Local;
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// Uniform on the unit disk, density 1/π (Shirley & Chiu 1997, concentric map: neighbours stay neighbours).
#[inline]
pub fn square_to_disk(u: Vec2) -> Vec2 {
    let v = 2.0 * u - 1.0;
    let steep = v.y.abs() > v.x.abs();
    let (long, short) = if steep { (v.y, v.x) } else { (v.x, v.y) };
    if long == 0.0 {
        return Vec2::ZERO;
    }
    let (sin, cos) = sin_cos_of_an_eighth(FRAC_PI_4 * (short / long));
    let (along, across) = (long * cos, long * sin);
    if steep { Vec2::new(across, along) } else { Vec2::new(along, across) }
}

/// Sine and cosine for |x| ≤ π/4 by their Taylor series, whose next terms are below 4e-8.
#[inline]
fn sin_cos_of_an_eighth(x: f32) -> (f32, f32) {
    let x2 = x * x;
    let sin = x * (1.0 + x2 * (-1.0 / 6.0 + x2 * (1.0 / 120.0 + x2 * (-1.0 / 5040.0 + x2 * (1.0 / 362_880.0)))));
    let cos = 1.0 + x2 * (-0.5 + x2 * (1.0 / 24.0 + x2 * (-1.0 / 720.0 + x2 * (1.0 / 40_320.0))));
    (sin, cos)
}

/// Cosine-weighted on the upper hemisphere (Malley's method).
#[inline]
pub fn square_to_cosine_hemisphere(u: Vec2) -> Local {
    let d = square_to_disk(u);
    // A direction exactly in the plane would have density zero.
    Local(d.extend((1.0 - d.length_squared()).max(1e-12).sqrt()))
}

/// Density (1/sr) of [`square_to_cosine_hemisphere`].
#[inline]
pub fn square_to_cosine_hemisphere_pdf(w: Local) -> f32 {
    w.cos_theta().max(0.0) * FRAC_1_PI
}

/// Uniform on the unit sphere, density 1/4π.
#[inline]
pub fn square_to_sphere(u: Vec2) -> Vec3 {
    let z = 1.0 - 2.0 * u.x;
    let (sin, cos) = (TAU * u.y).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(r * cos, r * sin, z)
}

/// The map of the unit square to the sphere that keeps areas, density 1/4π: the diamond in the middle is the upper half
/// (Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD"). Its inverse is [`sphere_to_equal_area_square`].
#[inline]
pub fn square_to_equal_area_sphere(u: Vec2) -> Vec3 {
    let p = 2.0 * u - 1.0;
    let a = p.abs();
    // How far inside the diamond, negative outside of it.
    let inside = 1.0 - a.x - a.y;
    let r = 1.0 - inside.abs();
    let phi = if r == 0.0 { 0.0 } else { FRAC_PI_4 * ((a.y - a.x) / r + 1.0) };
    let z = (1.0 - r * r).copysign(inside);
    let (sin, cos) = phi.sin_cos();
    let across = r * (2.0 - r * r).max(0.0).sqrt();
    Vec3::new((across * cos).copysign(p.x), (across * sin).copysign(p.y), z)
}

/// The place in the unit square of the unit direction `d`: the inverse of [`square_to_equal_area_sphere`].
#[inline]
pub fn sphere_to_equal_area_square(d: Vec3) -> Vec2 {
    let a = d.abs();
    let r = (1.0 - a.z).max(0.0).sqrt();
    let phi = if a.x == 0.0 && a.y == 0.0 { 0.0 } else { a.y.atan2(a.x) / FRAC_PI_2 };
    let (mut u, mut v) = (r - phi * r, phi * r);
    if d.z < 0.0 {
        (u, v) = (1.0 - v, 1.0 - u);
    }
    0.5 * (Vec2::new(u.copysign(d.x), v.copysign(d.y)) + 1.0)
}

/// Uniform in the cone of half-angle `acos(cos_max)` about +z. `one_minus_cos_max` avoids cancellation in thin cones.
#[inline]
pub fn square_to_cone(u: Vec2, one_minus_cos_max: f32) -> Local {
    let h = u.x * one_minus_cos_max; // 1 - cos θ
    let sin = (h * (2.0 - h)).max(0.0).sqrt();
    let (sp, cp) = (TAU * u.y).sin_cos();
    Local(Vec3::new(sin * cp, sin * sp, 1.0 - h))
}

/// Density (1/sr) of [`square_to_cone`] inside the cone.
#[inline]
pub fn square_to_cone_pdf(one_minus_cos_max: f32) -> f32 {
    1.0 / (2.0 * PI * one_minus_cos_max)
}

/// Barycentrics (of the second and third vertex), uniform over a triangle's area: density 1/area
/// (Heitz 2019, "A Low-Distortion Map Between Triangle and Square").
#[inline]
pub fn square_to_triangle(u: Vec2) -> Vec2 {
    if u.y > u.x {
        let x = 0.5 * u.x;
        Vec2::new(x, u.y - x)
    } else {
        let y = 0.5 * u.y;
        Vec2::new(u.x - y, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A 256 x 256 lattice of the square, at cell centres.
    fn lattice() -> impl Iterator<Item = Vec2> {
        (0..65536u32).map(|i| (Vec2::new((i % 256) as f32, (i / 256) as f32) + 0.5) / 256.0)
    }

    /// Mean of `f` over the warped lattice, f64.
    fn mean(f: impl Fn(Vec2) -> f32) -> f64 {
        lattice().map(|u| f64::from(f(u))).sum::<f64>() / 65536.0
    }

    #[test]
    fn moments_of_each_warp_match_its_density() {
        // Uniform disk: E[r²] = 1/2. Cosine: E[z] = 2/3, E[z²] = 1/2. Sphere: E[z²] = 1/3. Triangle: E[b] = 1/3, E[b²] = 1/6.
        assert!((mean(|u| square_to_disk(u).length_squared()) - 0.5).abs() < 1e-3);
        assert!((mean(|u| square_to_cosine_hemisphere(u).0.z) - 2.0 / 3.0).abs() < 1e-3);
        assert!((mean(|u| square_to_cosine_hemisphere(u).0.x.powi(2)) - 0.25).abs() < 1e-3);
        assert!((mean(|u| square_to_sphere(u).z.powi(2)) - 1.0 / 3.0).abs() < 1e-3);
        assert!((mean(|u| square_to_sphere(u).x.powi(2)) - 1.0 / 3.0).abs() < 1e-3);
        assert!((mean(|u| square_to_triangle(u).x) - 1.0 / 3.0).abs() < 1e-3);
        assert!((mean(|u| square_to_triangle(u).y.powi(2)) - 1.0 / 6.0).abs() < 1e-3);
        let c = 0.25;
        assert!((mean(|u| square_to_cone(u, c).0.z) - (1.0 - f64::from(c) / 2.0)).abs() < 1e-3);
    }

    #[test]
    fn the_equal_area_map_keeps_areas_and_has_its_inverse() {
        assert!((mean(|u| square_to_equal_area_sphere(u).z.powi(2)) - 1.0 / 3.0).abs() < 1e-3);
        assert!((mean(|u| square_to_equal_area_sphere(u).x.powi(2)) - 1.0 / 3.0).abs() < 1e-3);
        assert!(mean(|u| square_to_equal_area_sphere(u).y).abs() < 1e-6);
        for u in lattice() {
            let d = square_to_equal_area_sphere(u);
            assert!((d.length() - 1.0).abs() < 1e-5);
            assert!(sphere_to_equal_area_square(d).distance(u) < 1e-4, "{u} {d}");
        }
        for (d, u) in [(Vec3::Z, [0.5, 0.5]), (Vec3::X, [1.0, 0.5]), (-Vec3::Y, [0.5, 0.0])] {
            assert!(sphere_to_equal_area_square(d).distance(Vec2::from(u)) < 1e-6, "{d}");
        }
    }

    #[test]
    fn the_short_series_are_the_sine_and_the_cosine() {
        for i in -1000..=1000 {
            let x = FRAC_PI_4 * i as f32 / 1000.0;
            let (sin, cos) = sin_cos_of_an_eighth(x);
            assert!((sin - x.sin()).abs() < 2e-7 && (cos - x.cos()).abs() < 2e-7, "{x}");
        }
    }

    #[test]
    fn densities_integrate_to_one() {
        let cosine = mean(|u| {
            let w = square_to_sphere(u);
            square_to_cosine_hemisphere_pdf(Local(w)) * 4.0 * PI
        });
        assert!((cosine - 1.0).abs() < 1e-3, "{cosine}");
        let cap = f64::from(square_to_cone_pdf(0.3)) * 2.0 * std::f64::consts::PI * 0.3;
        assert!((cap - 1.0).abs() < 1e-5);
    }

    #[test]
    fn warped_points_stay_in_their_domain() {
        for u in lattice().chain([Vec2::ZERO, Vec2::new(0.0, 0.999_999_94), Vec2::splat(0.999_999_94)]) {
            assert!(square_to_disk(u).length() <= 1.0 + 1e-6);
            let b = square_to_triangle(u);
            assert!(b.x >= 0.0 && b.y >= 0.0 && b.x + b.y <= 1.0 + 1e-6);
            assert!((square_to_cosine_hemisphere(u).0.length() - 1.0).abs() < 1e-5);
            assert!((square_to_cone(u, 1e-6).0.length() - 1.0).abs() < 1e-5);
        }
    }
}
