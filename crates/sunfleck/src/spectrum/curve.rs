//! A function of wavelength, as measured or computed.
use super::{
    NM_MIN, Rgb,
    observer::{STEPS, at_lanes, at_nm, observer},
};
use glam::{DVec3, Vec4};
use std::sync::Arc;

/// A value at every wavelength, kept in steps of 1 nm and linear between them. Cheap to clone.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve(Arc<[f32]>);

/// Why samples do not make a curve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// Nothing to go by.
    #[error("a spectrum needs at least one pair of wavelength and value")]
    Empty,
    /// A wavelength that does not follow the last one.
    #[error("wavelengths must rise, but {1} nm follows {0} nm")]
    Order(f32, f32),
    /// A number that is not finite.
    #[error("the value at {0} nm is {1}, which is not a finite number")]
    Value(f32, f32),
}

/// Wavelengths (nm) that stand for red, green and blue where a curve is no colour, as an index of refraction: the dominant
/// wavelengths of the primaries of sRGB.
pub const CHANNELS_NM: [f32; 3] = [611.4, 549.1, 464.2];

impl Curve {
    /// The values of `f` (of nm).
    pub fn new(f: impl Fn(f32) -> f32) -> Self {
        Self((0..STEPS).map(|i| f(NM_MIN + i as f32)).collect())
    }
    /// Linear between `(nm, value)` pairs of rising wavelength; the first and the last value hold beyond them.
    ///
    /// # Errors
    /// No pair, wavelengths that do not rise, or numbers that are not finite.
    pub fn sampled(pairs: &[(f32, f32)]) -> Result<Self, CurveError> {
        let (Some(first), Some(last)) = (pairs.first(), pairs.last()) else { return Err(CurveError::Empty) };
        if let Some((nm, v)) = pairs.iter().find(|(nm, v)| !(nm.is_finite() && v.is_finite())) {
            return Err(CurveError::Value(*nm, *v));
        }
        if let Some(w) = pairs.windows(2).find(|w| w[0].0 >= w[1].0) {
            return Err(CurveError::Order(w[0].0, w[1].0));
        }
        let at = |nm: f32| {
            let after = pairs.partition_point(|p| p.0 <= nm);
            match after {
                0 => first.1,
                n if n == pairs.len() => last.1,
                n => {
                    let ((a, v), (b, w)) = (pairs[n - 1], pairs[n]);
                    v + (nm - a) / (b - a) * (w - v)
                }
            }
        };
        Ok(Self::new(at))
    }
    /// The value at `nm`; the ends hold beyond the range.
    #[inline]
    pub fn at(&self, nm: f32) -> f32 {
        at_nm(&self.0, nm)
    }
    /// The values at four wavelengths.
    #[inline]
    pub(super) fn lanes(&self, nm: Vec4) -> Vec4 {
        at_lanes(&self.0, nm)
    }
    /// The curve times `k`.
    pub fn scaled(&self, k: f32) -> Self {
        Self(self.0.iter().map(|v| v * k).collect())
    }
    /// Linear sRGB of a radiance of this spectrum; may lie outside the gamut. Luminance 1 is that of a radiance of 1 at
    /// every wavelength.
    pub fn radiance_rgb(&self) -> Rgb {
        observer().colour(|i| f64::from(self.0[i])).as_vec3()
    }
    /// Linear sRGB of a reflectance of this spectrum under D65; may lie outside the gamut.
    pub fn reflectance_rgb(&self) -> Rgb {
        let o = observer();
        o.colour(|i| f64::from(self.0[i]) * f64::from(o.d65[i])).as_vec3()
    }
    /// The values at [`CHANNELS_NM`].
    pub fn channels(&self) -> Rgb {
        Rgb::from_array(CHANNELS_NM.map(|nm| self.at(nm)))
    }
    /// Luminance of a radiance of this spectrum; 1 for a radiance of 1 at every wavelength.
    pub fn luminance(&self) -> f32 {
        let o = observer();
        let rgb = o.colour(|i| f64::from(self.0[i]));
        // The even spectrum has luminance 1, which fixes the weights' scale: those of IEC 61966-2-1.
        rgb.dot(DVec3::new(0.212_639, 0.715_169, 0.072_192)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_met_and_lines_join_them() {
        let c = Curve::sampled(&[(400.0, 1.0), (500.0, 2.0), (600.0, 0.0)]).unwrap();
        for (nm, want) in [(360.0, 1.0), (400.0, 1.0), (450.0, 1.5), (500.0, 2.0), (550.5, 0.99), (830.0, 0.0)] {
            assert!((c.at(nm) - want).abs() < 1e-5, "{nm}: {}", c.at(nm));
        }
        assert!((c.scaled(2.0).at(425.0) - 2.5).abs() < 1e-5);
        assert!((Curve::new(|_| 1.0).luminance() - 1.0).abs() < 1e-3);
    }

    #[test]
    fn nonsense_is_refused() {
        assert_eq!(Curve::sampled(&[]), Err(CurveError::Empty));
        assert_eq!(Curve::sampled(&[(500.0, 1.0), (400.0, 1.0)]), Err(CurveError::Order(500.0, 400.0)));
        assert!(matches!(Curve::sampled(&[(500.0, f32::NAN)]), Err(CurveError::Value(..))));
    }
}
