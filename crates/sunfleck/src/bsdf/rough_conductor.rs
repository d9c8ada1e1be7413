//! Brushed, sand-blasted or worn metal: a landscape of metal facets.
use super::{
    Bsdf, BsdfSample, Conductor, ConductorMaterial, Lobes, Lookup, Model, Roughness, Scatter, TextureId, Transport,
    facets::Landscape, ggx::reflect_up, seen_from,
};
use crate::{math::Local, spectrum::Spectrum};
use glam::Vec2;

/// A rough metal, two-sided. Light that would bounce between facets is lost, the more the rougher (as usual for
/// single-scattering microfacet models).
#[derive(Clone, Copy, Debug)]
pub struct RoughConductorMaterial {
    /// The metal.
    pub metal: ConductorMaterial,
    /// Roughness in [0, 1]. Below [`super::ggx::Ggx::MIN_ALPHA`] the surface is taken as smooth.
    pub alpha: Roughness,
}

impl Model for RoughConductorMaterial {
    type Closure = Bsdf;
    const NAME: &'static str = "roughconductor";
    const ABOUT: &'static str = "rough metal: `eta` + i·`k` by channel under roughness `alpha` (0 polished, 1 matt)";
    #[inline]
    fn resolve(&self, at: &Lookup) -> Bsdf {
        let metal = self.metal.resolve(at);
        match self.alpha.landscape(at) {
            Some(facets) => RoughConductor { metal, facets }.into(),
            None => metal.into(),
        }
    }
    fn textures(&self) -> Vec<TextureId> {
        self.metal.textures().into_iter().chain(self.alpha.textures()).collect()
    }
    fn is_aligned(&self) -> bool {
        self.alpha.is_aligned()
    }
}

/// `f = F D G₂ / (4 cos θo cos θi)` (Torrance & Sparrow 1967; Walter et al. 2007, eq. 20).
#[derive(Clone, Copy, Debug)]
pub struct RoughConductor {
    metal: Conductor,
    facets: Landscape,
}

impl Scatter for RoughConductor {
    #[inline]
    fn eval(&self, wo: Local, wi: Local, _: Transport) -> Spectrum {
        match self.facets.glint(seen_from(wo, wo), seen_from(wo, wi)) {
            Some(g) => self.metal.fresnel(g.cos) * g.f,
            None => Spectrum::BLACK,
        }
    }
    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        self.facets.glint(seen_from(wo, wo), seen_from(wo, wi)).map_or(0.0, |g| g.pdf)
    }
    #[inline]
    fn sample(&self, wo: Local, _: f32, u: Vec2, _: Transport) -> Option<BsdfSample> {
        let up = seen_from(wo, wo);
        if up.cos_theta() <= 0.0 {
            return None;
        }
        let wi = reflect_up(up, self.facets.sample_visible(up, u))?;
        let g = self.facets.glint(up, wi)?;
        let weight = self.metal.fresnel(g.cos) * self.facets.shadowing(up, wi);
        BsdfSample::scattered(seen_from(wo, wi), weight, g.pdf)
    }
    #[inline]
    fn lobes(&self) -> Lobes {
        if self.metal.reflectance.is_black() { Lobes::Delta } else { self.facets.lobes() }
    }
}
