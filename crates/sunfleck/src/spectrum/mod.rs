//! What light carries: four lanes of f32.
//!
//! In RGB mode lanes 0..3 are linear sRGB and lane 3 is unused; in a spectral mode the lanes are four wavelengths.
//! Transport code is the same for both: it may add, multiply and ask for [`Spectrum::max`], [`Spectrum::mean`] and
//! [`Spectrum::is_black`], and nothing else. Colours enter through [`Spectrum::from_rgb`] (scene data are [`Rgb`]) and
//! leave through [`Spectrum::to_rgb`] (the film).
use glam::{Vec3, Vec4};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// A colour of a scene file or of a film: linear sRGB, unclamped.
pub type Rgb = Vec3;

/// What the lanes of a [`Spectrum`] stand for. Drawn once per pass, so that photons and camera paths can meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Wavelengths {
    /// Linear sRGB in lanes 0..3.
    #[default]
    Rgb,
}

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

    /// The same value in every lane.
    #[inline]
    pub const fn splat(v: f32) -> Self {
        Self(Vec4::splat(v))
    }
    /// A colour, as seen at `lambda`.
    #[inline]
    pub fn from_rgb(rgb: Rgb, lambda: Wavelengths) -> Self {
        match lambda {
            Wavelengths::Rgb => Self(rgb.extend(0.0)),
        }
    }
    /// The film's colour of a value carried at `lambda`.
    #[inline]
    pub fn to_rgb(self, lambda: Wavelengths) -> Rgb {
        match lambda {
            Wavelengths::Rgb => self.0.truncate(),
        }
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
        let tint = Spectrum::from_rgb(Rgb::new(0.2, 0.5, 0.1), Wavelengths::Rgb);
        assert_eq!((tint * Spectrum::ONE).max(), 0.5);
        assert_eq!((tint + Spectrum::splat(0.25)).max(), 0.75);
        assert_eq!((Spectrum::splat(2.0) * tint).to_rgb(Wavelengths::Rgb), Rgb::new(0.4, 1.0, 0.2));
        assert!((tint * 0.0).is_black());
    }
}
