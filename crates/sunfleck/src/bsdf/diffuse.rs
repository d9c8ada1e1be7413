//! Lambert's cosine law, on both sides of the surface.
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

/// A matt surface.
#[derive(Clone, Copy, Debug)]
pub struct DiffuseMaterial {
    /// Albedo.
    pub reflectance: TextureId,
}

impl Model for DiffuseMaterial {
    type Closure = Diffuse;
    const NAME: &'static str = "diffuse";
    const ABOUT: &'static str = "matt surface (Lambert), two-sided";
    #[inline]
    fn resolve(&self, at: &Lookup) -> Diffuse {
        Diffuse { reflectance: at.spectrum(self.reflectance) }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.reflectance]
    }
    fn is_matt(&self) -> bool {
        true
    }
}

/// Reflects the same radiance in all directions of `wo`'s side: `f = ρ/π`.
#[derive(Clone, Copy, Debug)]
pub struct Diffuse {
    /// Albedo in [0, 1].
    pub reflectance: Spectrum,
}

impl Scatter for Diffuse {
    #[inline]
    fn eval(&self, wo: Local, wi: Local, _: Transport) -> Spectrum {
        if wo.same_side(wi) { self.reflectance * FRAC_1_PI } else { Spectrum::BLACK }
    }
    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        if wo.same_side(wi) { square_to_cosine_hemisphere_pdf(Local(wi.0.abs())) } else { 0.0 }
    }
    #[inline]
    fn sample(&self, wo: Local, _: f32, u: Vec2, _: Transport) -> Option<BsdfSample> {
        if self.reflectance.is_black() || wo.cos_theta() == 0.0 {
            return None;
        }
        let mut wi = square_to_cosine_hemisphere(u);
        let pdf = square_to_cosine_hemisphere_pdf(wi);
        wi.0.z = wi.0.z.copysign(wo.0.z);
        Some(BsdfSample { wi, weight: self.reflectance, pdf, delta: false, eta: 1.0, disperses: false })
    }
    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::wide_if(!self.reflectance.is_black())
    }
}
