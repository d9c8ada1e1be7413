//! The Phong formula of the `NRenderer` framework, kept as it is so that its pictures can be reproduced.
use super::{BsdfSample, Lobes, Lookup, Model, Scatter, TextureId, Transport, cosine_lobe::CosineLobe};
use crate::{
    math::{
        Local,
        warp::{square_to_cosine_hemisphere, square_to_cosine_hemisphere_pdf},
    },
    spectrum::Spectrum,
};
use glam::Vec2;
use std::f32::consts::FRAC_1_PI;

/// `NRenderer`'s Phong, two-sided. It is *not* physical: seen or lit at a grazing angle it can reflect more light than it
/// receives, and it is not reciprocal. Use [`super::PhongMaterial`] for pictures of light.
#[derive(Clone, Copy, Debug)]
pub struct NRendererPhongMaterial {
    /// `diffuseColor`.
    pub diffuse: TextureId,
    /// `specularColor`.
    pub specular: TextureId,
    /// `specularEx`, from 0 (wide) to 10⁶ (sharp).
    pub exponent: f32,
}

impl Model for NRendererPhongMaterial {
    type Closure = NRendererPhong;
    const NAME: &'static str = "nrenderer-phong";
    const ABOUT: &'static str =
        "NRenderer's formula, kd·N·L + ks·|V·R|ⁿ, for `raycast`; reflects more than it gets: use phong for real light";
    #[inline]
    fn resolve(&self, at: &Lookup) -> NRendererPhong {
        NRendererPhong {
            kd: at.spectrum(self.diffuse),
            ks: at.spectrum(self.specular),
            lobe: CosineLobe::new(self.exponent),
        }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.diffuse, self.specular]
    }
}

/// `f cos θ = (kd cos θ + ks |V·R|ⁿ)/π`, with θ the angle of the light's direction, V the eye's and R the mirrored light's.
/// The absolute value is `NRenderer`'s own: light also leaves opposite to the highlight.
#[derive(Clone, Copy, Debug)]
pub struct NRendererPhong {
    kd: Spectrum,
    ks: Spectrum,
    lobe: CosineLobe,
}

impl NRendererPhong {
    /// Probability of sampling the matt part; `None` if the surface is black. The two parts carry albedos of about kd and
    /// 2 ks/(n+1).
    #[inline]
    fn prob_diffuse(&self) -> Option<f32> {
        let (d, s) = (self.kd.max(), self.ks.max() * 2.0 / (self.lobe.n + 1.0));
        (d + s > 0.0).then(|| d / (d + s))
    }
    /// `|V·R|ⁿ`.
    #[inline]
    fn highlight(&self, wo: Local, wi: Local) -> f32 {
        let axis = wo.mirrored();
        self.lobe.value(axis, if axis.dot(wi) < 0.0 { Local(-wi.0) } else { wi })
    }
}

impl Scatter for NRendererPhong {
    #[inline]
    fn eval(&self, wo: Local, wi: Local, mode: Transport) -> Spectrum {
        if !wo.same_side(wi) {
            return Spectrum::BLACK;
        }
        // The adjoint of a function that is not reciprocal has its arguments swapped (Veach 1997, section 3.7.6).
        let to_light = match mode {
            Transport::Radiance => wi,
            Transport::Flux => wo,
        };
        // No surface is met at a cosine below the bound; it keeps 1/cos finite.
        (self.kd + self.ks * (self.highlight(wo, wi) / to_light.abs_cos_theta().max(1e-30))) * FRAC_1_PI
    }
    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let Some(prob) = self.prob_diffuse() else { return 0.0 };
        if !wo.same_side(wi) {
            return 0.0;
        }
        let lobe = self.lobe.normalisation() * self.highlight(wo, wi);
        prob * square_to_cosine_hemisphere_pdf(Local(wi.0.abs())) + (1.0 - prob) * lobe
    }
    #[inline]
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
        let w = if u_lobe < self.prob_diffuse()? {
            let w = square_to_cosine_hemisphere(u).0;
            w.with_z(w.z.copysign(wo.0.z))
        } else {
            // Both halves of the double lobe at once: of two opposite directions just one is above the surface.
            let w = self.lobe.sample(wo.mirrored(), u).0;
            if w.z * wo.0.z < 0.0 { -w } else { w }
        };
        let wi = Local(w);
        let pdf = self.pdf(wo, wi);
        BsdfSample::scattered(wi, self.eval(wo, wi, mode) * (wi.abs_cos_theta() / pdf), pdf)
    }
    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::wide_if(self.prob_diffuse().is_some())
    }
}
