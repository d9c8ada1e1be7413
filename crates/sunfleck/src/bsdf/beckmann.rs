//! Rough surfaces whose slopes are those of a Gaussian landscape: short-tailed highlights.
//!
//! As in [`super::ggx`], `m` is a micronormal and `wo` is on the upper side.
use crate::math::{Local, erf};
use glam::{Vec2, Vec3};
use std::f32::consts::FRAC_1_PI;

/// The landscape of Beckmann & Spizzichino 1963, with Smith's masking; roughness as in [`super::ggx::Ggx`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Beckmann {
    pub(super) alpha: Vec2,
}

/// Slopes beyond this many times alpha are as good as absent (10⁻¹⁵ of them).
const REACH: f64 = 6.0;

impl Beckmann {
    /// As [`super::ggx::Ggx::d`] (Walter et al. 2007, eq. 25).
    #[inline]
    pub(super) fn d(self, m: Local) -> f32 {
        let Vec3 { x, y, z } = m.0;
        if z <= 0.0 {
            return 0.0;
        }
        let a = self.alpha;
        let cos2 = z * z;
        let slopes2 = Vec2::new(x / a.x, y / a.y).length_squared() / cos2;
        // Where the exponential is 0, the cosines below it may be, too.
        if slopes2 > 80.0 {
            return 0.0;
        }
        (-slopes2).exp() * FRAC_1_PI / (a.x * a.y * cos2 * cos2)
    }
    /// Area of the facets that face `w` as `w` sees it, `|cos θ|·(1 + Λ)`: `c (1 + erf a)/2 + s exp(−a²)/(2√π)` with the
    /// stretched sine s and a = c/s (Heitz 2014, "Understanding the Masking-Shadowing Function", eq. 68).
    #[inline]
    pub(super) fn area(self, w: Local) -> f32 {
        let c = f64::from(w.abs_cos_theta());
        let s = f64::from(Vec2::new(self.alpha.x * w.0.x, self.alpha.y * w.0.y).length());
        if c > REACH * s {
            return c as f32;
        }
        let a = c / s;
        (0.5 * (c * (1.0 + erf(a)) + s * (-a * a).exp() / std::f64::consts::PI.sqrt())) as f32
    }
    /// Draws a micronormal seen from `wo`: slopes of a landscape of roughness 1 as the stretched `wo` sees it, first along its
    /// azimuth, then across (Heitz & d'Eon 2014, "Importance Sampling Microfacet-Based BSDFs using the Distribution of
    /// Visible Normals").
    #[inline]
    pub(super) fn sample_visible(self, wo: Local, u: Vec2) -> Local {
        let a = self.alpha;
        let w = Vec3::new(a.x * wo.0.x, a.y * wo.0.y, wo.0.z).normalize();
        let sin = w.truncate().length();
        let azimuth = if sin > 0.0 { w.truncate() / sin } else { Vec2::X };
        let along = slope(f64::from(sin), f64::from(w.z), f64::from(u.x)) as f32;
        let across = slope(0.0, 1.0, f64::from(u.y)) as f32;
        let m = along * azimuth + across * azimuth.perp();
        Local(Vec3::new(a.x * m.x, a.y * m.y, 1.0).normalize())
    }
}

/// Draws x with density in proportion to `max(0, x sin + cos) exp(−x²)`, by inverting its integral.
fn slope(sin: f64, cos: f64, u: f64) -> f64 {
    let root_pi = std::f64::consts::PI.sqrt();
    let first = if cos < REACH * sin { -cos / sin } else { -REACH };
    let (edge, erf_first) = ((-first * first).exp(), erf(first));
    let below = |x: f64, gauss: f64| 0.5 * (sin * (edge - gauss) / root_pi + cos * (erf(x) - erf_first));
    let all = below(REACH, 0.0);
    let (mut low, mut high) = (first, REACH);
    let mut x = 0.5 * (first.max(-2.0) + 2.0);
    for _ in 0..40 {
        let gauss = (-x * x).exp();
        let off = below(x, gauss) - u * all;
        if off.abs() < 1e-7 * all {
            break;
        }
        (low, high) = if off > 0.0 { (low, x) } else { (x, high) };
        // Newton's step, unless it leaves what is left of the interval.
        let step = x - off * root_pi / ((x * sin + cos) * gauss);
        x = if step > low && step < high { step } else { 0.5 * (low + high) };
    }
    x
}
