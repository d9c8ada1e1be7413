//! Phong's highlight on a matt base, made physical.
use super::{BsdfSample, Lobes, Lookup, Model, Scatter, TextureId, Transport, cosine_lobe::CosineLobe};
use crate::{
    math::{
        Local,
        warp::{square_to_cosine_hemisphere, square_to_cosine_hemisphere_pdf},
    },
    spectrum::Spectrum,
};
use glam::Vec2;
use std::f32::consts::{FRAC_1_PI, TAU};

/// A matt surface with a glossy highlight, two-sided.
#[derive(Clone, Copy, Debug)]
pub struct PhongMaterial {
    /// Albedo of the matt part.
    pub diffuse: TextureId,
    /// Albedo of the highlight, seen along the normal.
    pub specular: TextureId,
    /// Sharpness of the highlight, from 0 (wide) to 10⁶.
    pub exponent: f32,
}

impl Model for PhongMaterial {
    type Closure = Phong;
    const NAME: &'static str = "phong";
    const ABOUT: &'static str =
        "matt base plus a highlight of `exponent` n, physically normalised (if kd + ks > 1, both are scaled down)";
    #[inline]
    fn resolve(&self, at: &Lookup) -> Phong {
        let (kd, ks) = (at.spectrum(self.diffuse), at.spectrum(self.specular));
        let excess = (kd + ks).max().max(1.0);
        Phong { kd: kd / excess, ks: ks / excess, lobe: CosineLobe::new(self.exponent) }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.diffuse, self.specular]
    }
}

/// `f = kd/π + ks (n+2)/2π cosⁿ α`, with α the angle between `wi` and the mirror direction (Lafortune & Willems 1994,
/// "Using the Modified Phong Reflectance Model for Physically Based Rendering", eqs. 2 and 5): reciprocal, and never
/// reflects more than kd + ks.
#[derive(Clone, Copy, Debug)]
pub struct Phong {
    kd: Spectrum,
    ks: Spectrum,
    lobe: CosineLobe,
}

impl Phong {
    /// Probability of sampling the matt part; `None` if the surface is black.
    #[inline]
    fn prob_diffuse(&self) -> Option<f32> {
        let (d, s) = (self.kd.max(), self.ks.max());
        (d + s > 0.0).then(|| d / (d + s))
    }
}

impl Scatter for Phong {
    #[inline]
    fn eval(&self, wo: Local, wi: Local, _: Transport) -> Spectrum {
        if !wo.same_side(wi) {
            return Spectrum::BLACK;
        }
        let lobe = (self.lobe.n + 2.0) / TAU * self.lobe.value(wo.mirrored(), wi);
        self.kd * FRAC_1_PI + self.ks * lobe
    }
    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let Some(prob) = self.prob_diffuse() else { return 0.0 };
        if !wo.same_side(wi) {
            return 0.0;
        }
        let lobe = self.lobe.normalisation() * self.lobe.value(wo.mirrored(), wi);
        prob * square_to_cosine_hemisphere_pdf(Local(wi.0.abs())) + (1.0 - prob) * lobe
    }
    #[inline]
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
        let wi = if u_lobe < self.prob_diffuse()? {
            let w = square_to_cosine_hemisphere(u);
            Local(w.0.with_z(w.0.z.copysign(wo.0.z)))
        } else {
            self.lobe.sample(wo.mirrored(), u)
        };
        let pdf = self.pdf(wo, wi);
        BsdfSample::scattered(wi, self.eval(wo, wi, mode) * (wi.abs_cos_theta() / pdf), pdf)
    }
    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::wide_if(self.prob_diffuse().is_some())
    }
}
