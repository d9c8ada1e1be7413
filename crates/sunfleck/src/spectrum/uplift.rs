//! From RGB to a spectrum that looks like it: smooth, within [0, 1], and exact.
//!
//! A *colour* gets a sigmoid of a quadratic in the wavelength, fitted when it enters the scene (Jakob & Hanika 2019, "A
//! Low-Dimensional Function Space for Efficient Spectral Upsampling"; their optimiser is run per colour, some 30 µs, so there
//! is no table). A *picture's pixel* gets a convex mix of seven such spectra, those of white and of the full primaries and
//! secondaries (the decomposition of Smits 1999, "An RGB-to-Spectrum Conversion for Reflectances", with exact smooth spectra
//! in place of his steps): nothing to fit, continuous in the pixel's value, and exact too. Both are reflectances under D65.
use super::{NM_MAX, NM_MIN, Rgb, observer::observer};
use glam::{DMat3, DVec3, Vec4};
use std::sync::OnceLock;

/// A spectrum made from a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Uplift {
    /// The same at every wavelength.
    Grey(f32),
    /// A fitted spectrum times a scale.
    Colour { scale: f32, sigmoid: Sigmoid },
}

/// `½ + x/(2√(1 + x²))` with `x = c₀t² + c₁t + c₂` and t running from −1 to 1 over the wavelengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sigmoid([f32; 3]);

/// Middle and half width of the range of wavelengths, nm.
const MIDDLE: f32 = 0.5 * (NM_MIN + NM_MAX);
const HALF: f32 = 0.5 * (NM_MAX - NM_MIN);

impl Sigmoid {
    #[inline]
    pub(super) fn lanes(self, nm: Vec4) -> Vec4 {
        let [a, b, c] = self.0;
        let t = (nm - MIDDLE) * (1.0 / HALF);
        let x = (a * t + b) * t + c;
        let root = (x * x + 1.0).to_array().map(f32::sqrt);
        0.5 + 0.5 * x / Vec4::from_array(root)
    }
}

impl Uplift {
    /// Fits a colour; negative channels count as 0. A colour with a channel above 1 is twice that channel times a
    /// reflectance, so that its spectrum stays as smooth as that of a dim colour.
    pub(super) fn new(rgb: Rgb) -> Self {
        let rgb = rgb.max(Rgb::ZERO);
        let most = rgb.max_element();
        if rgb.min_element() == most || !most.is_finite() {
            return Self::Grey(most);
        }
        let scale = if most > 1.0 { 2.0 * most } else { 1.0 };
        Self::Colour { scale, sigmoid: fit((rgb / scale).as_dvec3()) }
    }
    #[inline]
    pub(super) fn lanes(&self, nm: Vec4) -> Vec4 {
        match self {
            Self::Grey(v) => Vec4::splat(*v),
            Self::Colour { scale, sigmoid } => *scale * sigmoid.lanes(nm),
        }
    }
}

/// The spectra of the full primaries and secondaries, each at [red, green, blue] = [i & 1, i & 2, i & 4].
fn corners() -> &'static [Sigmoid; 8] {
    static CORNERS: OnceLock<[Sigmoid; 8]> = OnceLock::new();
    CORNERS.get_or_init(|| {
        std::array::from_fn(|i| {
            let on = |bit: usize| f64::from(u8::from(i & bit != 0));
            // Black and white are never asked for.
            if i == 0 || i == 7 { Sigmoid([0.0; 3]) } else { fit(DVec3::new(on(1), on(2), on(4))) }
        })
    })
}

/// The spectrum of a picture's pixel: least channel times white, plus the rise to the middle one times the secondary of
/// the two larger, plus the rise to the largest times its primary. Negative channels count as 0.
#[inline]
pub(super) fn mix(rgb: Rgb, nm: Vec4) -> Vec4 {
    let c = rgb.max(Rgb::ZERO).to_array();
    let (mut low, mut high) = (0, 0);
    for i in 1..3 {
        if c[i] < c[low] {
            low = i;
        }
        if c[i] >= c[high] {
            high = i;
        }
    }
    if c[low] == c[high] {
        return Vec4::splat(c[low]);
    }
    let middle = c[3 - low - high];
    let corners = corners();
    let (secondary, primary) = (&corners[7 ^ (1 << low)], &corners[1 << high]);
    c[low] + (middle - c[low]) * secondary.lanes(nm) + (c[high] - middle) * primary.lanes(nm)
}

/// Place t of each whole nanometre, with the weight of the reflectance there for linear sRGB under D65.
fn nodes() -> &'static [(f64, DVec3)] {
    static TABLE: OnceLock<Vec<(f64, DVec3)>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let o = observer();
        let node = |(i, (w, d)): (usize, (&DVec3, &f32))| (i as f64 / f64::from(HALF) - 1.0, *w * f64::from(*d));
        o.rgb.iter().zip(&o.d65).enumerate().map(node).collect()
    })
}

/// Residual for the coefficients `c`, and its derivatives by them.
fn residual(c: DVec3, rgb: DVec3) -> (DVec3, DMat3) {
    let (mut r, mut j) = (-rgb, DMat3::ZERO);
    for (t, w) in nodes() {
        let x = (c.x * t + c.y) * t + c.z;
        let inverse = 1.0 / (1.0 + x * x).sqrt();
        r += *w * (0.5 + 0.5 * x * inverse);
        let slope = *w * (0.5 * inverse * inverse * inverse);
        j.x_axis += slope * (t * t);
        j.y_axis += slope * *t;
        j.z_axis += slope;
    }
    (r, j)
}

/// The sigmoid whose colour under D65 is `rgb` in [0, 1]: Gauss and Newton's method with Levenberg and Marquardt's damping,
/// from the grey in the middle. Ends at an error of 10⁻⁶, which all of sRGB's corners reach.
fn fit(rgb: DVec3) -> Sigmoid {
    let mut c = DVec3::ZERO;
    let mut damping = 1e-3;
    let (mut r, mut j) = residual(c, rgb);
    for _ in 0..60 {
        if r.length_squared() < 1e-12 {
            break;
        }
        let normal = j.transpose() * j;
        let diagonal = DVec3::new(normal.x_axis.x, normal.y_axis.y, normal.z_axis.z) + 1e-9;
        let step = (normal + DMat3::from_diagonal(damping * diagonal)).inverse() * (j.transpose() * r);
        let (next_r, next_j) = residual(c - step, rgb);
        if next_r.length_squared() < r.length_squared() {
            (c, r, j) = (c - step, next_r, next_j);
            damping = (damping * 0.2).max(1e-12);
        } else {
            damping *= 5.0;
        }
    }
    Sigmoid(c.as_vec3().to_array())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::observer::STEPS;

    /// Linear sRGB under D65 of the spectrum `s`, by steps of 1 nm, with its least and largest value.
    fn seen(s: impl Fn(Vec4) -> Vec4) -> (Rgb, f32, f32) {
        let o = observer();
        let values: Vec<f32> = (0..STEPS).map(|i| s(Vec4::splat(NM_MIN + i as f32)).x).collect();
        let (low, high) = values.iter().fold((f32::MAX, f32::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
        (o.colour(|i| f64::from(values[i]) * f64::from(o.d65[i])).as_vec3(), low, high)
    }

    /// A grid over the cube of colours, its corners and edges included.
    fn colours() -> impl Iterator<Item = Rgb> {
        let at = |i: u32| [0.0, 0.004, 0.03, 0.1, 0.3, 0.6, 0.9, 0.98, 1.0][i as usize];
        (0..9 * 9 * 9).map(move |i| Rgb::new(at(i % 9), at(i / 9 % 9), at(i / 81)))
    }

    #[test]
    fn colours_come_back_as_they_went_in() {
        let mut worst = [(0.0f32, Rgb::ZERO); 2];
        for rgb in colours() {
            let uplift = Uplift::new(rgb);
            for (worst, (back, low, high)) in
                worst.iter_mut().zip([seen(|nm| uplift.lanes(nm)), seen(|nm| mix(rgb, nm))])
            {
                let error = (back - rgb).abs().max_element();
                if error > worst.0 {
                    *worst = (error, rgb);
                }
                assert!(low >= -1e-6 && high <= 1.0 + 1e-6, "{rgb}: {low} to {high}");
            }
        }
        assert!(worst.iter().all(|w| w.0 < 2e-5), "{worst:?}");
    }

    #[test]
    fn greys_are_flat_and_bright_colours_scale() {
        for v in [0.0, 0.2, 1.0, 7.0] {
            assert_eq!(Uplift::new(Rgb::splat(v)), Uplift::Grey(v));
            assert_eq!(mix(Rgb::splat(v), Vec4::splat(500.0)), Vec4::splat(v));
        }
        let bright = Rgb::new(9.0, 3.0, 0.5);
        for back in [seen(|nm| Uplift::new(bright).lanes(nm)).0, seen(|nm| mix(bright, nm)).0] {
            assert!((back - bright).abs().max_element() < 1e-2, "{back}");
        }
    }
}
