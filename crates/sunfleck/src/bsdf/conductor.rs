//! Polished metal.
use super::{BsdfSample, Lookup, Model, Scatter, TextureId, Transport, fresnel};
use crate::{math::Local, spectrum::Spectrum};
use glam::Vec2;

/// A smooth metal, two-sided.
#[derive(Clone, Copy, Debug)]
pub struct ConductorMaterial {
    /// Real part of the index of refraction over that of the outside, by colour channel; > 0.
    pub eta: TextureId,
    /// Imaginary part (extinction) over the index of the outside, by colour channel; ≥ 0.
    pub k: TextureId,
    /// Tint in [0, 1] of the reflection; white is physical.
    pub reflectance: TextureId,
}

impl Model for ConductorMaterial {
    type Closure = Conductor;
    const NAME: &'static str = "conductor";
    const ABOUT: &'static str = "polished metal with the complex index `eta` + i·`k` by channel (exact Fresnel)";
    #[inline]
    fn resolve(&self, at: &Lookup) -> Conductor {
        Conductor {
            eta: at.spectrum_of_point(self.eta),
            k: at.spectrum_of_point(self.k),
            reflectance: at.spectrum(self.reflectance),
        }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.eta, self.k, self.reflectance]
    }
}

/// Reflects into the mirror direction by Fresnel's equations for metals.
#[derive(Clone, Copy, Debug)]
pub struct Conductor {
    /// Real part of the relative index.
    pub eta: Spectrum,
    /// Imaginary part of the relative index.
    pub k: Spectrum,
    /// Tint.
    pub reflectance: Spectrum,
}

impl Conductor {
    /// Reflected fraction at the cosine `cos` with the (micro)normal.
    #[inline]
    pub(super) fn fresnel(&self, cos: f32) -> Spectrum {
        self.reflectance * fresnel::conductor(cos, self.eta, self.k)
    }
}

impl Scatter for Conductor {
    #[inline]
    fn sample(&self, wo: Local, _: f32, _: Vec2, _: Transport) -> Option<BsdfSample> {
        BsdfSample::specular(wo, self.fresnel(wo.abs_cos_theta()))
    }
}
