//! What fills closed surfaces: glass, water, wine. How much light it takes on its way, and which of several counts where
//! they overlap.
//!
//! The scene keeps a table of [`Interior`]s; a material may name one, which then lies behind its surface, on the side that
//! normals point away from. [`Inside`] is what a walk carries: the interiors that it is in, of which one is its [`Medium`].
mod inside;

pub use inside::{DEPTH, Inside, Medium};

use crate::spectrum::{Colour, Curve, Ior, Rgb, Spectrum, Wavelengths};

/// Handle of an interior of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InteriorId(pub u16);

/// Matter that light crosses in straight lines, and that takes some of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Interior {
    /// What is left of light, in [0, 1], after [`Interior::distance`] (Beer's law).
    pub color: Colour,
    /// World units, > 0.
    pub distance: f32,
    /// Index of refraction over that of empty space, > 0.
    pub ior: Ior,
    /// Which of two counts where they overlap: the one with the higher number, and nothing is seen of the other's surface
    /// (Schmidt & Budge 2002, "Simple Nested Dielectrics in Ray Traced Images"). Of two with the same number, that which was
    /// entered last.
    ///
    /// 0 is an interior without priority: its surfaces are modelled as they are, indices of refraction included; what lies
    /// behind them is in the place of what lies before them.
    pub priority: u16,
}

/// No less is left of light after an interior's distance: what takes everything has no finite coefficient.
const LEAST: f32 = 1e-30;

impl Interior {
    /// Takes nothing.
    pub fn clear(ior: impl Into<Ior>) -> Self {
        Self { color: Rgb::ONE.into(), distance: 1.0, ior: ior.into(), priority: 0 }
    }
    /// Leaves `color` of white light after `distance` (> 0).
    pub fn passing(color: impl Into<Colour>, distance: f32, ior: impl Into<Ior>) -> Self {
        Self { color: color.into(), distance, ior: ior.into(), priority: 0 }
    }
    /// Of the absorption coefficient `sigma` (≥ 0, per world unit) for each channel.
    pub fn absorbing(sigma: Rgb, ior: impl Into<Ior>) -> Self {
        // The distance after which the channel that is taken most is left by a share that colours can tell.
        let distance = if sigma.max_element() > 0.0 { sigma.max_element().recip() } else { 1.0 };
        Self::passing(Rgb::from_array((sigma * -distance).to_array().map(f32::exp)), distance, ior)
    }
    /// Of an absorption coefficient (≥ 0, per world unit) for each wavelength.
    pub fn absorbing_curve(sigma: &Curve, ior: impl Into<Ior>) -> Self {
        let most = (360..=830).map(|nm| sigma.at(nm as f32)).fold(0.0, f32::max);
        let distance = if most > 0.0 { most.recip() } else { 1.0 };
        let left = Curve::new(|nm| (-distance * sigma.at(nm)).exp());
        Self::passing(Colour::reflectance(left), distance, ior)
    }
    /// The same with a priority.
    #[must_use]
    pub fn with_priority(self, priority: u16) -> Self {
        Self { priority, ..self }
    }
    /// The absorption coefficient (per world unit) at `lambda`.
    pub fn sigma_a(&self, lambda: Wavelengths) -> Spectrum {
        self.color.at(lambda).map(|left| -left.clamp(LEAST, 1.0).ln() / self.distance)
    }
    /// Whether it takes light anywhere.
    pub fn is_clear(&self) -> bool {
        self.color == Rgb::ONE.into()
    }
}

/// An interior as one pass sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Absorption coefficient, per world unit.
    sigma_a: Spectrum,
    /// Index of refraction.
    pub(crate) ior: Spectrum,
    pub(crate) priority: u16,
}

impl Seen {
    pub(crate) fn new(interior: &Interior, lambda: Wavelengths) -> Self {
        Self { sigma_a: interior.sigma_a(lambda), ior: interior.ior.at(lambda), priority: interior.priority }
    }
    /// What is left of light after `distance`. Light that never meets anything is let go: it left by a hole.
    pub(crate) fn transmittance(&self, distance: f32) -> Spectrum {
        if distance.is_finite() { self.sigma_a.map(|s| (-s * distance).exp()) } else { Spectrum::ONE }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_and_colours_say_the_same() {
        let sigma = Rgb::new(0.1, 2.0, 0.0);
        let seen = Interior::absorbing(sigma, 1.5).sigma_a(Wavelengths::Rgb).to_rgb(Wavelengths::Rgb);
        assert!((seen - sigma).abs().max_element() < 1e-6, "{seen}");
        let wine = Interior::passing(Rgb::new(0.5, 0.25, 0.0), 2.0, 1.33);
        let left = Seen::new(&wine, Wavelengths::Rgb).transmittance(4.0).to_rgb(Wavelengths::Rgb);
        assert!((left - Rgb::new(0.25, 0.0625, 0.0)).abs().max_element() < 1e-6, "{left}");
        let flat = Interior::absorbing_curve(&Curve::new(|_| 0.5), 1.5).sigma_a(Wavelengths::Rgb);
        assert!((flat.to_rgb(Wavelengths::Rgb) - 0.5).abs().max_element() < 2e-3, "{flat:?}");
        assert!(Interior::clear(1.5).is_clear() && !wine.is_clear());
    }

    #[test]
    fn the_unused_lane_stays_the_smallest() {
        let left = Seen::new(&Interior::passing(Rgb::new(0.5, 0.25, 0.1), 1.0, 1.5), Wavelengths::Rgb);
        let lanes = left.transmittance(0.3).lanes();
        assert!(lanes[3] <= lanes[2] && lanes[3] >= 0.0, "{lanes:?}");
    }
}
