//! Phong's highlight: a lobe in proportion to cosⁿ of the angle with an axis.
use crate::math::{Frame, Local};
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// A lobe `max(0, cos α)ⁿ` about any axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct CosineLobe {
    /// Exponent.
    pub(super) n: f32,
}

impl CosineLobe {
    /// The lobe of exponent `n`, kept within 0 and 10⁶ (a lobe a thousandth wide, about the least that f32 directions
    /// resolve).
    #[inline]
    pub(super) fn new(n: f32) -> Self {
        Self { n: n.clamp(0.0, 1e6) }
    }
    /// `max(0, cos α)ⁿ` between unit vectors.
    #[inline]
    pub(super) fn value(self, axis: Local, w: Local) -> f32 {
        // From the chord: in a narrow lobe all the digits of a dot product are nines.
        let one_minus_cos = 0.5 * (w.0 - axis.0).length_squared();
        if one_minus_cos < 1.0 { (self.n * (-one_minus_cos).ln_1p()).exp() } else { 0.0 }
    }
    /// What [`CosineLobe::value`] is multiplied by to become the density (1/sr) of [`CosineLobe::sample`].
    #[inline]
    pub(super) fn normalisation(self) -> f32 {
        (self.n + 1.0) / TAU
    }
    /// Draws a direction with density `(n+1)/2π cosⁿ α` (Lafortune & Willems 1994, eq. 9).
    #[inline]
    pub(super) fn sample(self, axis: Local, u: Vec2) -> Local {
        let h = -((-u.x).ln_1p() / (self.n + 1.0)).exp_m1(); // 1 − cos α
        let r = (h * (2.0 - h)).max(0.0).sqrt();
        let (sin, cos) = (TAU * u.y).sin_cos();
        let about_axis = Vec3::new(r * cos, r * sin, 1.0 - h);
        Local(Frame::from_normal(axis.0).to_world(Local(about_axis)).normalize())
    }
}
