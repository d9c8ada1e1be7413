//! Paper, leaves and lampshades: matt on both sides, and light comes through.
use super::{BsdfSample, Lobes, Lookup, Model, Scatter, TextureId, Transport};
use crate::{
    math::{
        Local,
        warp::{square_to_cosine_hemisphere, square_to_cosine_hemisphere_pdf},
    },
    spectrum::Spectrum,
};
use glam::Vec2;
use std::f32::consts::FRAC_1_PI;

/// A thin matt sheet, the same from both sides. If the two albedos add up to more than 1, both are scaled down.
#[derive(Clone, Copy, Debug)]
pub struct DiffuseTransmissionMaterial {
    /// Albedo of the side that the light is on.
    pub reflectance: TextureId,
    /// Share of the light that comes out evenly on the other side.
    pub transmittance: TextureId,
}

impl Model for DiffuseTransmissionMaterial {
    type Closure = DiffuseTransmission;
    const NAME: &'static str = "diffusetransmission";
    const ABOUT: &'static str = "a thin matt sheet that lets light through: paper, leaves, lampshades";
    #[inline]
    fn resolve(&self, at: &Lookup) -> DiffuseTransmission {
        let (r, t) = (at.spectrum(self.reflectance), at.spectrum(self.transmittance));
        let excess = (r + t).max().max(1.0);
        DiffuseTransmission { reflectance: r / excess, transmittance: t / excess }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.reflectance, self.transmittance]
    }
    fn is_matt(&self) -> bool {
        true
    }
}

/// `f` is the albedo of a side over π.
#[derive(Clone, Copy, Debug)]
pub struct DiffuseTransmission {
    reflectance: Spectrum,
    transmittance: Spectrum,
}

impl DiffuseTransmission {
    /// Probability of staying on the side of `wo`; `None` if the sheet is black.
    #[inline]
    fn prob_reflect(&self) -> Option<f32> {
        let (r, t) = (self.reflectance.max(), self.transmittance.max());
        (r + t > 0.0).then(|| r / (r + t))
    }
}

impl Scatter for DiffuseTransmission {
    #[inline]
    fn eval(&self, wo: Local, wi: Local, _: Transport) -> Spectrum {
        if wo.cos_theta() == 0.0 || wi.cos_theta() == 0.0 {
            return Spectrum::BLACK;
        }
        let stays = (wo.0.z < 0.0) == (wi.0.z < 0.0);
        (if stays { self.reflectance } else { self.transmittance }) * FRAC_1_PI
    }
    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let Some(prob) = self.prob_reflect() else { return 0.0 };
        let stays = (wo.0.z < 0.0) == (wi.0.z < 0.0);
        let side = if stays { prob } else { 1.0 - prob };
        side * square_to_cosine_hemisphere_pdf(Local(wi.0.abs()))
    }
    #[inline]
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
        if wo.cos_theta() == 0.0 {
            return None;
        }
        let stays = u_lobe < self.prob_reflect()?;
        let w = square_to_cosine_hemisphere(u).0;
        let wi = Local(w.with_z(w.z.copysign(if stays { wo.0.z } else { -wo.0.z })));
        let pdf = self.pdf(wo, wi);
        BsdfSample::scattered(wi, self.eval(wo, wi, mode) * (wi.abs_cos_theta() / pdf), pdf)
    }
    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::wide_if(self.prob_reflect().is_some())
    }
}
