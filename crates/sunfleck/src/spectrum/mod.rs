//! What light carries: four lanes of f32.
//!
//! In RGB mode lanes 0..3 are linear sRGB and lane 3 is unused; in spectral mode the lanes are four wavelengths, the same for
//! all paths of a pass. Transport code is the same for both: it may add, multiply and ask for [`Spectrum::max`],
//! [`Spectrum::mean`] and [`Spectrum::is_black`], and nothing else.
//!
//! Colours enter as [`Colour`] (properties of matter) or [`Illuminant`] (light), or, pixel by pixel, by
//! [`Spectrum::reflectance`] and [`Spectrum::emission`]; they leave through [`Spectrum::to_rgb`] (the film).
//!
//! **Dispersion.** Where a smooth boundary bends each wavelength differently, the walk follows the hero (lane 0), and only
//! it survives, weighed by 4 ([`Spectrum::hero_only`]): each wavelength is the hero of every fourth pass. A path is then
//! *dispersed*; further boundaries change nothing more. Where a dispersed path from the camera meets a dispersed path from
//! a light, the 4 is there twice, and [`Spectrum::join`] takes one back.
mod cie_tables;
mod colour;
mod curve;
mod fringes;
mod ior;
mod named;
mod observer;
mod packed;
mod uplift;
mod wavelengths;

pub use colour::{Colour, Illuminant};
pub use curve::{CHANNELS_NM, Curve, CurveError};
pub(crate) use fringes::fringe;
pub use ior::Ior;
pub use named::{NAMED, Named, named};
pub use packed::PackedSpectrum;
pub use wavelengths::{ColorMode, NM_MAX, NM_MIN, Wavelengths};

use glam::{Vec3, Vec4};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// A colour of a scene file or of a film: linear sRGB, unclamped.
pub type Rgb = Vec3;

/// Radiance, flux, throughput or reflectance, by lane.
///
/// In RGB mode the unused lane of a non-negative value never exceeds the smallest used one: it is 0 for colours and
/// equal to the others for [`Spectrum::splat`], and sums and products keep that order. So `max` is always right.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Spectrum(Vec4);

impl Spectrum {
    /// Zero in every lane.
    pub const BLACK: Self = Self(Vec4::ZERO);
    /// One in every lane.
    pub const ONE: Self = Self(Vec4::ONE);

    /// One for the hero, zero for the others.
    pub const HERO: Self = Self(Vec4::X);

    /// The same value in every lane.
    #[inline]
    pub const fn splat(v: f32) -> Self {
        Self(Vec4::splat(v))
    }
    /// A reflectance in [0, 1] at `lambda`: a pixel of a picture. A colour that is the same everywhere is better a
    /// [`Colour`].
    #[inline]
    pub fn reflectance(rgb: Rgb, lambda: Wavelengths) -> Self {
        match lambda {
            Wavelengths::Rgb => Self(rgb.extend(0.0)),
            Wavelengths::Spectral(nm) => Self(uplift::mix(rgb, nm)),
        }
    }
    /// Light of the colour `rgb`, unbounded, at `lambda`: (1, 1, 1) is D65. A colour that does not change is better an
    /// [`Illuminant`].
    #[inline]
    pub fn emission(rgb: Rgb, lambda: Wavelengths) -> Self {
        match lambda {
            Wavelengths::Rgb => Self(rgb.extend(0.0)),
            Wavelengths::Spectral(nm) => Self(uplift::mix(rgb, nm) * observer::at_lanes(&observer::observer().d65, nm)),
        }
    }
    /// The film's colour of a value carried at `lambda`. In spectral mode that of one pass lies anywhere; the mean over
    /// passes is the colour.
    #[inline]
    pub fn to_rgb(self, lambda: Wavelengths) -> Rgb {
        match lambda {
            Wavelengths::Rgb => self.0.truncate(),
            Wavelengths::Spectral(nm) => wavelengths::to_film(self.0, nm),
        }
    }
    /// The value of the hero, lane 0.
    #[inline]
    pub fn hero(self) -> f32 {
        self.0.x
    }
    /// What is left where wavelengths part: the hero, weighed for the three that are dropped.
    #[inline]
    pub fn hero_only(self) -> Self {
        Self(Vec4::new(4.0 * self.0.x, 0.0, 0.0, 0.0))
    }
    /// What the product of a camera path and a light path is multiplied by where they meet, in a photon's kernel or by a
    /// connection: if both are dispersed, each has already been weighed for the lanes that it dropped.
    #[inline]
    pub fn join(camera_dispersed: bool, light_dispersed: bool) -> f32 {
        if camera_dispersed && light_dispersed { 0.25 } else { 1.0 }
    }
    /// The four lanes.
    #[inline]
    pub fn lanes(self) -> [f32; 4] {
        self.0.to_array()
    }
    /// From four lanes.
    #[inline]
    pub fn from_lanes(lanes: [f32; 4]) -> Self {
        Self(Vec4::from_array(lanes))
    }
    /// Largest lane.
    #[inline]
    pub fn max(self) -> f32 {
        self.0.max_element()
    }
    /// Mean of the lanes, the unused one included: for probabilities and comparisons between like values only.
    #[inline]
    pub fn mean(self) -> f32 {
        self.0.element_sum() * 0.25
    }
    /// True when nothing is carried.
    #[inline]
    pub fn is_black(self) -> bool {
        self.0 == Vec4::ZERO
    }
    /// True when every lane is finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    /// Applies `f` to each lane.
    #[inline]
    pub fn map(self, f: impl Fn(f32) -> f32) -> Self {
        let [a, b, c, d] = self.0.to_array();
        Self(Vec4::new(f(a), f(b), f(c), f(d)))
    }
    /// Applies `f` to each pair of lanes.
    #[inline]
    pub fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        let (a, b) = (self.0.to_array(), other.0.to_array());
        Self(Vec4::new(f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])))
    }
}

impl Add for Spectrum {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self(self.0 + o.0)
    }
}
impl AddAssign for Spectrum {
    #[inline]
    fn add_assign(&mut self, o: Self) {
        self.0 += o.0;
    }
}
impl Sub for Spectrum {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Self(self.0 - o.0)
    }
}
impl Mul for Spectrum {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        Self(self.0 * o.0)
    }
}
impl MulAssign for Spectrum {
    #[inline]
    fn mul_assign(&mut self, o: Self) {
        self.0 *= o.0;
    }
}
impl Mul<f32> for Spectrum {
    type Output = Self;
    #[inline]
    fn mul(self, k: f32) -> Self {
        Self(self.0 * k)
    }
}
impl MulAssign<f32> for Spectrum {
    #[inline]
    fn mul_assign(&mut self, k: f32) {
        self.0 *= k;
    }
}
impl Div<f32> for Spectrum {
    type Output = Self;
    #[inline]
    fn div(self, k: f32) -> Self {
        Self(self.0 / k)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unused_lane_never_wins_the_maximum() {
        let tint = Spectrum::reflectance(Rgb::new(0.2, 0.5, 0.1), Wavelengths::Rgb);
        assert_eq!((tint * Spectrum::ONE).max(), 0.5);
        assert_eq!((tint + Spectrum::splat(0.25)).max(), 0.75);
        assert_eq!((Spectrum::splat(2.0) * tint).to_rgb(Wavelengths::Rgb), Rgb::new(0.4, 1.0, 0.2));
        assert!((tint * 0.0).is_black());
    }
}
