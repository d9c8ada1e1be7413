//! A matt base under a rough, clear boundary that reflects by Fresnel's own equations: Mitsuba's rough plastic.
use super::{
    BsdfSample, Facets, Landscape, Lobes, Lookup, Model, Scatter, TextureId, Transport, fresnel, ggx::reflect_up,
    seen_from,
};
use crate::{
    math::{
        Local,
        warp::{square_to_cosine_hemisphere, square_to_cosine_hemisphere_pdf},
    },
    spectrum::Spectrum,
};
use glam::{Vec2, Vec3};
use std::{
    collections::BTreeMap,
    f32::consts::FRAC_1_PI,
    sync::{Mutex, OnceLock, PoisonError},
};

/// Cosines at which the albedo of a boundary is worked out.
const NODES: usize = 64;
/// Micronormals that are drawn for one of them, along each side of the unit square.
const SIDE: u32 = 32;

/// What a rough boundary does in all: worked out once for each setting, kept for good.
#[derive(Debug)]
struct Totals {
    /// The share of light from outside that passes, at even cosines from 0 to 1.
    passed: [f32; NODES],
    /// The share of even light from inside that is sent back.
    inside: f32,
}

impl Totals {
    fn new(ior: f32, landscape: Landscape) -> Self {
        let cos = |i: usize| (i as f32 / (NODES - 1) as f32).max(1e-6);
        let even = |i| 2.0 * Self::shares(landscape, cos(i), 1.0 / ior)[0] * cos(i);
        Self {
            passed: std::array::from_fn(|i| Self::shares(landscape, cos(i), ior)[1]),
            // Mitsuba's rule for the mean over the hemisphere, which counts both ends whole: some percent below the integral.
            inside: (0..NODES).map(even).sum::<f32>() / NODES as f32,
        }
    }
    /// What facets reflect of light at a cosine, and what they let pass; both only once, so that some is lost between them.
    fn shares(landscape: Landscape, cos: f32, eta: f32) -> [f32; 2] {
        let wo = Local(Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos));
        let one = |i: u32| {
            let u = (Vec2::new((i % SIDE) as f32, (i / SIDE) as f32) + 0.5) / SIDE as f32;
            let m = landscape.sample_visible(wo, u);
            let cos = wo.dot(m).clamp(0.0, 1.0);
            let boundary = fresnel::dielectric(cos, eta);
            let fresnel = boundary.reflectance();
            let reflected = reflect_up(wo, m).map_or(0.0, |wi| fresnel * landscape.shadowing(wo, wi));
            // Snell's law in vectors (Walter et al. 2007, eq. 40).
            let down = Local((cos / eta - boundary.cos_t) * m.0 - wo.0 / eta);
            let passes = fresnel < 1.0 && down.cos_theta() < 0.0;
            Vec2::new(reflected, if passes { (1.0 - fresnel) * landscape.g1(down) } else { 0.0 })
        };
        ((0..SIDE * SIDE).map(one).sum::<Vec2>() / (SIDE * SIDE) as f32).to_array()
    }
    /// The share of light from outside that passes.
    #[inline]
    fn passed(&self, cos: f32) -> f32 {
        let x = cos.clamp(0.0, 1.0) * (NODES - 1) as f32;
        let i = (x as usize).min(NODES - 2);
        let [a, b] = [self.passed[i], self.passed[i + 1]];
        a + (x - i as f32) * (b - a)
    }
}

/// By the bits of index and roughness, and the kind of landscape.
type Known = BTreeMap<(u32, u32, u8), &'static Totals>;

/// A rough boundary of a clear thing, with its integrals.
#[derive(Clone, Copy, Debug)]
pub struct RoughBoundary {
    ior: f32,
    landscape: Landscape,
    totals: &'static Totals,
}

impl RoughBoundary {
    /// Of relative index `ior`, at least 1.0001, and roughness `alpha`, the same in all directions.
    pub fn new(ior: f32, alpha: f32, facets: Facets) -> Self {
        static KNOWN: OnceLock<Mutex<Known>> = OnceLock::new();
        let ior = ior.max(1.0 + 1e-4);
        let landscape = Landscape::new(facets, alpha, alpha);
        let key = (ior.to_bits(), landscape.alpha().x.to_bits(), facets as u8);
        let mut known = KNOWN.get_or_init(Mutex::default).lock().unwrap_or_else(PoisonError::into_inner);
        let totals = *known.entry(key).or_insert_with(|| Box::leak(Box::new(Totals::new(ior, landscape))));
        Self { ior, landscape, totals }
    }
    /// Relative index of refraction.
    pub fn ior(&self) -> f32 {
        self.ior
    }
    /// Its roughness.
    pub fn alpha(&self) -> f32 {
        self.landscape.alpha().x
    }
    /// The kind of its landscape.
    pub fn facets(&self) -> Facets {
        self.landscape.facets()
    }
}

/// A matt base under a rough, clear boundary, two-sided.
#[derive(Clone, Copy, Debug)]
pub struct RoughPlasticMaterial {
    /// Albedo of the base, in [0, 1].
    pub diffuse: TextureId,
    /// Tint in [0, 1] of the reflection at the boundary; white is physical.
    pub specular: TextureId,
    /// The boundary.
    pub boundary: RoughBoundary,
    /// The base is coloured anew by each bounce under the boundary.
    pub nonlinear: bool,
}

impl Model for RoughPlasticMaterial {
    type Closure = RoughPlastic;
    const NAME: &'static str = "roughplastic";
    const ABOUT: &'static str = "a matt base under a rough clear boundary, by Fresnel's equations, without what facets send to one another: Mitsuba's";
    fn resolve(&self, at: &Lookup) -> RoughPlastic {
        let unit = |id| at.spectrum(id).map(|v| v.clamp(0.0, 1.0));
        let RoughBoundary { ior, totals, .. } = self.boundary;
        let r = totals.inside;
        let within = |rho: f32| rho / (ior * ior * (1.0 - if self.nonlinear { rho * r } else { r }));
        let specular = unit(self.specular);
        RoughPlastic { base: unit(self.diffuse).map(within), specular, boundary: self.boundary }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.diffuse, self.specular]
    }
}

/// `F D G / (4 cos θo cos θi) + ρ T(o) T(i) / (π n² (1 − ρ r))`: T passes the boundary from above, and r
/// of the light from below is sent back.
#[derive(Clone, Copy, Debug)]
pub struct RoughPlastic {
    /// `ρ / (n² (1 − ρ r))`.
    base: Spectrum,
    specular: Spectrum,
    boundary: RoughBoundary,
}

impl RoughPlastic {
    /// Probability of the boundary's reflection; `None` if nothing is given back.
    #[inline]
    fn prob_gloss(&self, up: Local) -> Option<f32> {
        let passed = self.boundary.totals.passed(up.cos_theta());
        let (s, d) = (self.specular.max() * (1.0 - passed), self.base.max() * passed);
        (s + d > 0.0).then(|| s / (s + d))
    }
    #[inline]
    fn f(&self, up: Local, wi: Local) -> Spectrum {
        let RoughBoundary { ior, landscape, totals } = self.boundary;
        let matt = totals.passed(up.cos_theta()) * totals.passed(wi.cos_theta()) * FRAC_1_PI;
        let gloss = landscape.glint(up, wi).map_or(0.0, |g| fresnel::dielectric(g.cos, ior).reflectance() * g.f);
        self.base * matt + self.specular * gloss
    }
    #[inline]
    fn density(&self, up: Local, wi: Local, prob: f32) -> f32 {
        let gloss = if prob > 0.0 { self.boundary.landscape.glint(up, wi).map_or(0.0, |g| g.pdf) } else { 0.0 };
        prob * gloss + (1.0 - prob) * square_to_cosine_hemisphere_pdf(wi)
    }
}

impl Scatter for RoughPlastic {
    #[inline]
    fn eval(&self, wo: Local, wi: Local, _: Transport) -> Spectrum {
        let (up, wi) = (seen_from(wo, wo), seen_from(wo, wi));
        if up.cos_theta() <= 0.0 || wi.cos_theta() <= 0.0 {
            return Spectrum::BLACK;
        }
        self.f(up, wi)
    }
    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let (up, wi) = (seen_from(wo, wo), seen_from(wo, wi));
        if up.cos_theta() <= 0.0 || wi.cos_theta() <= 0.0 {
            return 0.0;
        }
        self.prob_gloss(up).map_or(0.0, |prob| self.density(up, wi, prob))
    }
    #[inline]
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, _: Transport) -> Option<BsdfSample> {
        let up = seen_from(wo, wo);
        if up.cos_theta() <= 0.0 {
            return None;
        }
        let prob = self.prob_gloss(up)?;
        let wi = if u_lobe < prob {
            reflect_up(up, self.boundary.landscape.sample_visible(up, u))?
        } else {
            square_to_cosine_hemisphere(u)
        };
        let pdf = self.density(up, wi, prob);
        BsdfSample::scattered(seen_from(wo, wi), self.f(up, wi) * (wi.cos_theta() / pdf), pdf)
    }
    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::wide_if(!self.base.is_black() || !self.specular.is_black())
    }
}
