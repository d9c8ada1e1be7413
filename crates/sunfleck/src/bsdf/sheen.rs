//! Cloth: fibres that stand up and catch light at grazing angles.
use crate::math::Local;
use std::f32::consts::TAU;

/// The distribution of Estevez & Kulla 2017, "Production Friendly Microfacet Sheen BRDF" (eq. 2), with the masking of Neubelt &
/// Pettineo 2013 that glTF prescribes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheen {
    /// 1/alpha.
    exponent: f32,
}

impl Sheen {
    /// Below, the lobe is too thin to matter.
    const MIN_ALPHA: f32 = 5e-3;

    /// A sheen of roughness `alpha`, kept within 0.005 and 1.
    #[inline]
    pub(super) fn new(alpha: f32) -> Self {
        Self { exponent: 1.0 / alpha.clamp(Self::MIN_ALPHA, 1.0) }
    }
    /// `D / (4 (cos θo + cos θi − cos θo cos θi))`, 1/sr, between directions above the surface. Alone it may give back
    /// more than it gets: see [`super::albedo::TabulatedSheen`].
    #[inline]
    pub(super) fn f(self, wo: Local, wi: Local) -> f32 {
        let (co, ci) = (wo.cos_theta(), wi.cos_theta());
        let Some(m) = (wo.0 + wi.0).try_normalize() else { return 0.0 };
        let sin2 = (1.0 - m.z * m.z).clamp(0.0, 1.0);
        let d = (2.0 + self.exponent) * sin2.powf(0.5 * self.exponent) / TAU;
        d / (4.0 * (co + ci - co * ci).max(1e-4))
    }
}
