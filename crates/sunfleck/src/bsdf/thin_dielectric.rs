//! Window panes: two parallel boundaries so near to each other that the way between them does not matter.
use super::{BsdfSample, Lookup, Model, Scatter, TextureId, Transport, fresnel};
use crate::{
    math::Local,
    spectrum::{Ior, Spectrum},
};
use glam::Vec2;

/// A pane of glass without thickness, the same from both sides: light passes straight through.
#[derive(Clone, Copy, Debug)]
pub struct ThinDielectricMaterial {
    /// Index of refraction of the pane over that of its surroundings; > 0.
    pub eta: Ior,
    /// Tint in [0, 1] of what is reflected; white is physical.
    pub reflectance: TextureId,
    /// Tint in [0, 1] of what passes; white is physical.
    pub transmittance: TextureId,
}

impl Model for ThinDielectricMaterial {
    type Closure = ThinDielectric;
    const NAME: &'static str = "thindielectric";
    const ABOUT: &'static str =
        "a pane of clear glass without thickness: reflects by Fresnel, and lets light straight through";
    #[inline]
    fn resolve(&self, at: &Lookup) -> ThinDielectric {
        ThinDielectric {
            eta: self.eta.at(at.lambda),
            reflectance: at.spectrum(self.reflectance),
            transmittance: at.spectrum(self.transmittance),
        }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.reflectance, self.transmittance]
    }
}

/// Reflects `R' = R + T²R/(1 − R²) = 2R/(1 + R)`, light that went to and fro in the pane included, and lets `1 − R'` through
/// (Stokes 1862; R of one boundary by Fresnel).
#[derive(Clone, Copy, Debug)]
pub struct ThinDielectric {
    eta: Spectrum,
    reflectance: Spectrum,
    transmittance: Spectrum,
}

impl ThinDielectric {
    /// A pane that changes nothing.
    pub(crate) const NOTHING: Self =
        Self { eta: Spectrum::ONE, reflectance: Spectrum::ONE, transmittance: Spectrum::ONE };
}

impl Scatter for ThinDielectric {
    #[inline]
    fn sample(&self, wo: Local, u_lobe: f32, _: Vec2, _: Transport) -> Option<BsdfSample> {
        let cos = wo.abs_cos_theta();
        let reflected = self.eta.map(|eta| {
            // An unused lane may hold anything.
            let r = if eta > 0.0 { fresnel::dielectric(cos, eta).reflectance() } else { 0.0 };
            2.0 * r / (1.0 + r)
        });
        let (r, t) = (self.reflectance * reflected, self.transmittance * (Spectrum::ONE - reflected));
        let all = r.max() + t.max();
        let prob = if all > 0.0 { r.max() / all } else { 0.0 };
        if u_lobe < prob {
            return BsdfSample::specular(wo, r / prob).map(|s| BsdfSample { pdf: prob, ..s });
        }
        let weight = t / (1.0 - prob);
        BsdfSample::specular(wo, weight).map(|s| BsdfSample { wi: Local(-wo.0), pdf: 1.0 - prob, ..s })
    }
}
