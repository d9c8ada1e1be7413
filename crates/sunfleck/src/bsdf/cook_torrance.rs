//! Painted, plastic and metallic surfaces by base colour, roughness and metalness.
use super::{
    BsdfSample, Lobes, Lookup, Model, Scatter, TextureId, Transport,
    fresnel::schlick,
    ggx::{Ggx, reflect_up},
    seen_from,
};
use crate::{
    math::{
        Local,
        warp::{square_to_cosine_hemisphere, square_to_cosine_hemisphere_pdf},
    },
    spectrum::Spectrum,
};
use glam::Vec2;
use std::f32::consts::FRAC_1_PI;

/// A matt base under a rough, clear surface, turning into a metal with `metallic`; two-sided.
#[derive(Clone, Copy, Debug)]
pub struct CookTorranceMaterial {
    /// Base colour in [0, 1]: albedo of the matt part, and reflectance of the metal.
    pub albedo: TextureId,
    /// Reflectance in [0, 1] of the non-metal along the normal (plastic 0.04).
    pub f0: TextureId,
    /// Perceived roughness in [0, 1]; alpha is its square, but at least [`Ggx::MIN_ALPHA`].
    pub roughness: f32,
    /// 0 non-metal to 1 metal.
    pub metallic: f32,
}

impl Model for CookTorranceMaterial {
    type Closure = CookTorrance;
    const NAME: &'static str = "cooktorrance";
    const ABOUT: &'static str =
        "plastic to metal: `albedo` under a GGX gloss of `roughness` and `f0`; `metallic` 1 gives a coloured metal";
    #[inline]
    fn resolve(&self, at: &Lookup) -> CookTorrance {
        let unit = |id| at.spectrum(id).map(|v| v.clamp(0.0, 1.0));
        let (albedo, metallic) = (unit(self.albedo), self.metallic.clamp(0.0, 1.0));
        CookTorrance {
            base: albedo * (1.0 - metallic),
            f0: unit(self.f0) * (1.0 - metallic) + albedo * metallic,
            ggx: Ggx::new(self.roughness * self.roughness),
        }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.albedo, self.f0]
    }
}

/// `f = F D G₂/(4 cos θo cos θi) + base/π (1 − F(θo)) (1 − F(θi))`, F by Schlick (Cook & Torrance 1982 with GGX).
///
/// The base gets what the gloss lets through on the way in and on the way out, by the angles with the *surface* (as in
/// Ashikhmin & Shirley 2000, section 2.2): symmetric, hence reciprocal, and with the gloss never more than 1.
#[derive(Clone, Copy, Debug)]
pub struct CookTorrance {
    base: Spectrum,
    f0: Spectrum,
    ggx: Ggx,
}

impl CookTorrance {
    /// What the gloss lets through at the cosine of `w`.
    #[inline]
    fn through(&self, w: Local) -> Spectrum {
        Spectrum::ONE - schlick(self.f0, w.cos_theta())
    }
    /// Probability of sampling the gloss, in proportion to what the two parts reflect.
    #[inline]
    fn prob_gloss(&self, up: Local) -> f32 {
        let gloss = schlick(self.f0, up.cos_theta()).max();
        let base = (self.base * self.through(up)).max();
        if base > 0.0 { (gloss / (gloss + base)).clamp(0.1, 0.9) } else { 1.0 }
    }
}

impl Scatter for CookTorrance {
    #[inline]
    fn eval(&self, wo: Local, wi: Local, _: Transport) -> Spectrum {
        let (up, wi) = (seen_from(wo, wo), seen_from(wo, wi));
        let Some(g) = self.ggx.glint(up, wi) else { return Spectrum::BLACK };
        schlick(self.f0, g.cos) * g.f + self.base * self.through(up) * self.through(wi) * FRAC_1_PI
    }
    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let (up, wi) = (seen_from(wo, wo), seen_from(wo, wi));
        let Some(g) = self.ggx.glint(up, wi) else { return 0.0 };
        let prob = self.prob_gloss(up);
        prob * g.pdf + (1.0 - prob) * square_to_cosine_hemisphere_pdf(wi)
    }
    #[inline]
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
        let up = seen_from(wo, wo);
        if up.cos_theta() <= 0.0 {
            return None;
        }
        let wi = if u_lobe < self.prob_gloss(up) {
            reflect_up(up, self.ggx.sample_visible(up, u))?
        } else {
            square_to_cosine_hemisphere(u)
        };
        let wi = seen_from(wo, wi);
        let pdf = self.pdf(wo, wi);
        BsdfSample::scattered(wi, self.eval(wo, wi, mode) * (wi.abs_cos_theta() / pdf), pdf)
    }
    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::Wide
    }
}
