//! Ground or frosted glass: a landscape of clear facets.
use super::{
    Bsdf, BsdfSample, Dielectric, DielectricMaterial, Lobes, Lookup, Model, Roughness, Scatter, TextureId, Transport,
    facets::Landscape, fresnel, ggx::reflect_up, seen_from,
};
use crate::{math::Local, spectrum::Spectrum};
use glam::Vec2;

/// A rough boundary between two clear media. Light that would meet a second facet is lost, the more the rougher.
#[derive(Clone, Copy, Debug)]
pub struct RoughDielectricMaterial {
    /// The media and tints.
    pub glass: DielectricMaterial,
    /// Roughness in [0, 1]. The boundary is taken as smooth below [`super::ggx::Ggx::MIN_ALPHA`], and also where the blur it
    /// gives to refracted light, `alpha·|eta − 1|`, is below 10⁻⁴ (nearly equal indices: f32 could not tell which facet
    /// had bent the light).
    pub alpha: Roughness,
}

impl Model for RoughDielectricMaterial {
    type Closure = Bsdf;
    const NAME: &'static str = "roughdielectric";
    const ABOUT: &'static str =
        "frosted glass: `eta` as for dielectric, roughness `alpha` (0 clear, 0.1 satin, 0.5 milky)";
    #[inline]
    fn resolve(&self, at: &Lookup) -> Bsdf {
        let glass = self.glass.resolve(at);
        self.alpha.landscape(at).map_or(glass.into(), |facets| RoughDielectric { glass, facets }.if_it_blurs())
    }
    fn textures(&self) -> Vec<TextureId> {
        self.glass.textures().into_iter().chain(self.alpha.textures()).collect()
    }
    fn is_aligned(&self) -> bool {
        self.alpha.is_aligned()
    }
    fn is_dispersive(&self) -> bool {
        self.glass.is_dispersive()
    }
}

/// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", with visible normals. Transmission uses
/// the paper's separable masking (eq. 23); reflection that of the landscape, as the metals here do.
///
/// Where wavelengths are bent differently, a direction still carries all of them, each by its own facet: one of the lanes
/// is drawn to choose the direction, and the density is the mean of the lanes' densities (the balance heuristic).
#[derive(Clone, Copy, Debug)]
pub struct RoughDielectric {
    glass: Dielectric,
    facets: Landscape,
}

impl RoughDielectric {
    /// Itself, or the smooth boundary where f32 could not tell which facet had bent the light.
    #[inline]
    fn if_it_blurs(self) -> Bsdf {
        let blur = self.facets.alpha().max_element() * (self.glass.eta.hero() - 1.0).abs();
        if blur >= 1e-4 { self.into() } else { self.glass.into() }
    }
    /// See [`Bsdf::immersed`].
    pub(super) fn immersed(self, outer: Spectrum) -> Bsdf {
        Self { glass: self.glass.immersed(outer), ..self }.if_it_blurs()
    }
    /// [`Scatter::sample`] where all wavelengths are bent alike.
    #[inline]
    fn sample_alike(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
        let up = seen_from(wo, wo);
        let eta = self.glass.eta_beyond(wo);
        let m = self.facets.sample_visible(up, u);
        let cos = up.dot(m).clamp(0.0, 1.0);
        let boundary = fresnel::dielectric(cos, eta);
        let fresnel = boundary.reflectance();
        let prob = self.glass.prob_reflect(fresnel);
        if u_lobe < prob {
            let wi = reflect_up(up, m)?;
            let weight = self.glass.reflectance * (fresnel / prob * self.facets.shadowing(up, wi));
            return BsdfSample::scattered(seen_from(wo, wi), weight, prob * self.facets.glint(up, wi)?.pdf);
        }
        // Snell's law in vectors (Walter et al. 2007, eq. 40).
        let wi = Local(((cos / eta - boundary.cos_t) * m.0 - up.0 / eta).normalize());
        let p = self.facets.passage(up, wi, eta)?;
        let carried = (1.0 - fresnel) / (1.0 - prob) * self.facets.g1(wi);
        let weight = self.glass.transmission(eta, mode) * carried;
        let s = BsdfSample::scattered(seen_from(wo, wi), weight, (1.0 - prob) * p.pdf)?;
        Some(BsdfSample { eta, ..s })
    }
}

impl Scatter for RoughDielectric {
    #[inline]
    fn eval(&self, wo: Local, wi: Local, mode: Transport) -> Spectrum {
        let (up, wi) = (seen_from(wo, wo), seen_from(wo, wi));
        if let Some(g) = self.facets.glint(up, wi) {
            let fresnel = self.glass.by_lane(wo, |eta| fresnel::dielectric(g.cos, eta).reflectance());
            return self.glass.reflectance * (fresnel * g.f);
        }
        let squeeze = |eta: f32| if mode == Transport::Radiance { 1.0 / (eta * eta) } else { 1.0 };
        let f = |eta| self.facets.passage(up, wi, eta).map_or(0.0, |p| squeeze(eta) * p.f * (1.0 - p.fresnel));
        self.glass.transmittance * self.glass.by_lane(wo, f)
    }
    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let (up, wi) = (seen_from(wo, wo), seen_from(wo, wi));
        let prob_reflect = |fresnel| self.glass.prob_reflect(fresnel);
        let by_lane = if let Some(g) = self.facets.glint(up, wi) {
            self.glass.by_lane(wo, |eta| g.pdf * prob_reflect(fresnel::dielectric(g.cos, eta).reflectance()))
        } else {
            self.glass.by_lane(wo, |eta| {
                self.facets.passage(up, wi, eta).map_or(0.0, |p| p.pdf * (1.0 - prob_reflect(p.fresnel)))
            })
        };
        by_lane.mean()
    }
    #[inline]
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
        if wo.cos_theta() == 0.0 {
            return None;
        }
        if !self.glass.is_dispersive() {
            return self.sample_alike(wo, u_lobe, u, mode);
        }
        let lane = (4.0 * u_lobe) as usize & 3;
        let eta = Spectrum::splat(self.glass.eta.lanes()[lane]);
        let alone = Self { glass: Dielectric { eta, ..self.glass }, facets: self.facets };
        let s = alone.sample_alike(wo, (4.0 * u_lobe).fract(), u, mode)?;
        let pdf = self.pdf(wo, s.wi);
        let weight = self.eval(wo, s.wi, mode) * (s.wi.abs_cos_theta() / pdf);
        let eta = if s.eta == 1.0 { 1.0 } else { self.glass.eta_beyond(wo) };
        Some(BsdfSample { eta, ..BsdfSample::scattered(s.wi, weight, pdf)? })
    }
    #[inline]
    fn lobes(&self) -> Lobes {
        let black = self.glass.reflectance.is_black() && self.glass.transmittance.is_black();
        if black { Lobes::Delta } else { self.facets.lobes() }
    }
}
