//! Plastic, lacquer and wet paint: a matt base under a clear boundary.
use super::{
    Bsdf, BsdfSample, Lobes, Lookup, Model, Principled, Roughness, Scatter, TextureId, Transport,
    albedo::Albedo,
    fresnel,
    packed::{Unit, UnitSpectrum},
    principled::f0_of,
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

/// A matt base under a clear, smooth or rough boundary, two-sided. Light that the base sends up at a slant is sent down again by
/// the boundary: it leaves darker and more coloured than the base alone would be.
#[derive(Clone, Copy, Debug)]
pub struct PlasticMaterial {
    /// Albedo of the base, in [0, 1].
    pub diffuse: TextureId,
    /// Tint in [0, 1] of the reflection at the boundary; white is physical.
    pub specular: TextureId,
    /// Index of refraction of the boundary, > 1.
    pub ior: f32,
    /// GGX roughness in [0, 1] of the boundary. Below [`super::ggx::Ggx::MIN_ALPHA`] it is smooth.
    pub alpha: Roughness,
    /// The base is coloured anew by each bounce under the boundary; otherwise colours stay as pure as those of the base, and
    /// only brightness is lost.
    pub nonlinear: bool,
}

impl Model for PlasticMaterial {
    type Closure = Bsdf;
    const NAME: &'static str = "plastic";
    const ABOUT: &'static str =
        "a matt base under a clear boundary of index `ior` and GGX roughness `alpha`, with the light between the two";
    fn resolve(&self, at: &Lookup) -> Bsdf {
        let unit = |id| at.spectrum(id).map(|v| v.clamp(0.0, 1.0));
        let (base, specular) = (unit(self.diffuse), unit(self.specular));
        let ior = self.ior.max(1.0 + 1e-4);
        let Some(ggx) = self.alpha.ggx(at) else {
            let outside = mean_reflectance(ior);
            return Plastic { base: self.within(base, ior, outside), specular, ior, through: 1.0 - outside }.into();
        };
        let [u, v] = ggx.alpha().to_array();
        let f0 = Spectrum::splat(f0_of(ior));
        let outside = Albedo::new((u * v).sqrt()).mean_of(f0, 1.0).hero();
        Principled {
            base: self.within(base, ior, outside),
            metallic: Unit::new(0.0),
            ggx,
            f0: UnitSpectrum::new(specular * f0),
            f90: Unit::new(specular.max()),
            ..Principled::BARE
        }
        .into()
    }
    fn textures(&self) -> Vec<TextureId> {
        [self.diffuse, self.specular].into_iter().chain(self.alpha.textures()).collect()
    }
    fn is_aligned(&self) -> bool {
        self.alpha.is_aligned()
    }
}

impl PlasticMaterial {
    /// Share of the light under the boundary that comes out again: `ρ (1 − r)/(1 − ρ r)`, where the boundary sends back `r` of
    /// diffuse light from below, `1 − r = (1 − R̄)/n²` by reciprocity (R̄ from above). A white base gives all of it back.
    fn within(&self, base: Spectrum, ior: f32, outside: f32) -> Spectrum {
        let r = 1.0 - (1.0 - outside) / (ior * ior);
        if self.nonlinear { base.map(|rho| rho * (1.0 - r) / (1.0 - rho * r)) } else { base }
    }
}

/// Mean over the hemisphere, weighed by the cosine, of what a smooth boundary of relative index `ior` reflects.
fn mean_reflectance(ior: f32) -> f32 {
    // Midpoints in cos²: 64 of them are right to 10⁻³ of the value.
    const STEPS: u32 = 64;
    let at = |i: u32| fresnel::dielectric(((i as f32 + 0.5) / STEPS as f32).sqrt(), ior).reflectance();
    (0..STEPS).map(at).sum::<f32>() / STEPS as f32
}

/// A mirror reflection by Fresnel over `base/π (1 − F(o))(1 − F(i))/(1 − F̄)`: as in [`Principled`], with a smooth boundary.
#[derive(Clone, Copy, Debug)]
pub struct Plastic {
    base: Spectrum,
    specular: Spectrum,
    ior: f32,
    /// `1 − F̄`.
    through: f32,
}

impl Plastic {
    #[inline]
    fn fresnel(&self, w: Local) -> f32 {
        fresnel::dielectric(w.abs_cos_theta(), self.ior).reflectance()
    }
    /// Probability of the mirror reflection, in proportion to what the two parts give back; `None` if they give nothing.
    #[inline]
    fn prob_mirror(&self, fresnel: f32) -> Option<f32> {
        let (s, d) = (self.specular.max() * fresnel, self.base.max() * (1.0 - fresnel));
        (s + d > 0.0).then(|| s / (s + d))
    }
}

impl Scatter for Plastic {
    #[inline]
    fn eval(&self, wo: Local, wi: Local, _: Transport) -> Spectrum {
        if !wo.same_side(wi) {
            return Spectrum::BLACK;
        }
        self.base * ((1.0 - self.fresnel(wo)) * (1.0 - self.fresnel(wi)) / self.through * FRAC_1_PI)
    }
    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let Some(prob) = self.prob_mirror(self.fresnel(wo)) else { return 0.0 };
        if !wo.same_side(wi) {
            return 0.0;
        }
        (1.0 - prob) * square_to_cosine_hemisphere_pdf(Local(wi.0.abs()))
    }
    #[inline]
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
        if wo.cos_theta() == 0.0 {
            return None;
        }
        let fresnel = self.fresnel(wo);
        let prob = self.prob_mirror(fresnel)?;
        if u_lobe < prob {
            let s = BsdfSample::specular(wo, self.specular * (fresnel / prob))?;
            return Some(BsdfSample { pdf: prob, ..s });
        }
        let w = square_to_cosine_hemisphere(u).0;
        let wi = Local(w.with_z(w.z.copysign(wo.0.z)));
        let pdf = self.pdf(wo, wi);
        BsdfSample::scattered(wi, self.eval(wo, wi, mode) * (wi.abs_cos_theta() / pdf), pdf)
    }
    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::wide_if(!self.base.is_black())
    }
}
