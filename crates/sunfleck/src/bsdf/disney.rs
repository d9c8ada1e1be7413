//! Disney's material of 2012 and 2015 as Mitsuba has it: simple lobes that are added up, without care for what layers take from
//! each other.
use super::{
    BsdfSample, Landscape, Lobes, Lookup, Model, Scalar, Scatter, TextureId, Transport,
    burley::{self, Coat, schlick, tinted},
    fresnel,
    ggx::reflect_up,
    packed::Unit,
    principled::f0_of,
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

/// Numbers are in [0, 1]. [`super::PrincipledMaterial`] is the model to prefer: this one gives back more light than it gets at
/// some angles, and is here so that pictures of Mitsuba's scenes are Mitsuba's.
#[derive(Clone, Copy, Debug)]
pub struct DisneyMaterial {
    /// Albedo, reflectance of the metal, and the square of what passes the glass.
    pub base: TextureId,
    /// Perceived roughness; alpha is its square.
    pub roughness: Scalar,
    /// How much the highlights are drawn out along the texture coordinate u.
    pub anisotropic: Scalar,
    /// 0 non-metal to 1 metal.
    pub metallic: Scalar,
    /// Share of the non-metal that is glass; `None` if nothing passes anywhere: then it looks the same from both sides.
    pub transmission: Option<Scalar>,
    /// Index of refraction, > 1.
    pub ior: f32,
    /// How much the reflection of the non-metal takes on the hue of the base.
    pub specular_tint: Scalar,
    /// Sheen at grazing angles, and how much it takes on that hue.
    pub sheen: Scalar,
    /// See `sheen`.
    pub sheen_tint: Scalar,
    /// From a matt base to the likeness of light below the surface.
    pub flatness: Scalar,
    /// The coat, and its gloss.
    pub coat: Scalar,
    /// From 0 (alpha 0.1) to 1 (alpha 0.001).
    pub coat_gloss: Scalar,
}

impl DisneyMaterial {
    /// Half rough, opaque, neither metal nor coated, of index 1.5.
    pub fn new(base: TextureId) -> Self {
        let none = Scalar::Constant(0.0);
        Self {
            base,
            roughness: 0.5.into(),
            anisotropic: none,
            metallic: none,
            transmission: None,
            ior: 1.5,
            specular_tint: none,
            sheen: none,
            sheen_tint: none,
            flatness: none,
            coat: none,
            coat_gloss: none,
        }
    }
}

impl Model for DisneyMaterial {
    type Closure = Disney;
    const NAME: &'static str = "disney";
    const ABOUT: &'static str = "Disney's principled material of 2012 and 2015 as Mitsuba has it, glass included";
    fn resolve(&self, at: &Lookup) -> Disney {
        let base = at.spectrum(self.base).map(|v| v.clamp(0.0, 1.0));
        let unit = |s| Unit::new(at.scalar(s));
        let rough = at.scalar(self.roughness).clamp(0.0, 1.0);
        Disney {
            base,
            facets: burley::stretched(rough, at.scalar(self.anisotropic)),
            per_luminance: burley::per_luminance(base, at),
            ior: self.ior.max(1.0 + 1e-3),
            rough: Unit::new(rough),
            metallic: unit(self.metallic),
            transmission: self.transmission.map(unit),
            specular_tint: unit(self.specular_tint),
            sheen: unit(self.sheen),
            sheen_tint: unit(self.sheen_tint),
            flatness: unit(self.flatness),
            coat: unit(self.coat),
            coat_alpha: Unit::new(0.1 - 0.099 * at.scalar(self.coat_gloss).clamp(0.0, 1.0)),
        }
    }
    fn textures(&self) -> Vec<TextureId> {
        let first = [self.roughness, self.anisotropic, self.metallic, self.specular_tint, self.sheen, self.sheen_tint];
        let glass = self.transmission.and_then(Scalar::texture);
        let others = burley::textures([self.flatness, self.coat, self.coat_gloss]);
        [self.base].into_iter().chain(glass).chain(burley::textures(first)).chain(others).collect()
    }
    fn is_aligned(&self) -> bool {
        self.anisotropic != 0.0.into()
    }
}

/// Matt part and sheen, coat, and facets that reflect as metal and non-metal or let pass as glass.
#[derive(Clone, Copy, Debug)]
pub struct Disney {
    base: Spectrum,
    facets: Landscape,
    per_luminance: f32,
    ior: f32,
    rough: Unit,
    metallic: Unit,
    transmission: Option<Unit>,
    specular_tint: Unit,
    sheen: Unit,
    sheen_tint: Unit,
    flatness: Unit,
    coat: Unit,
    coat_alpha: Unit,
}

/// How the closure looks from one direction.
struct View {
    up: Local,
    /// Under the glass.
    inside: bool,
    /// η beyond over η here.
    eta: f32,
    /// Share that is glass.
    clear: f32,
    prob_matt: f32,
    prob_coat: f32,
}

impl Disney {
    /// `None` where nothing is seen.
    fn view(&self, wo: Local) -> Option<View> {
        let up = seen_from(wo, wo);
        let metal = self.metallic.get();
        let transmission = self.transmission.map_or(0.0, Unit::get);
        let clear = (1.0 - metal) * transmission;
        let inside = self.transmission.is_some() && wo.0.z < 0.0;
        if up.cos_theta() <= 0.0 || inside && clear == 0.0 {
            return None;
        }
        let (mut matt, mut coat) = ((1.0 - metal) * (1.0 - transmission), 0.25 * self.coat.get());
        matt = matt.max(0.25 * self.sheen.get() * (1.0 - metal));
        if inside {
            (matt, coat) = (0.0, 0.0);
        }
        let all = 1.0 + matt + coat;
        let eta = if inside { 1.0 / self.ior } else { self.ior };
        Some(View { up, inside, eta, clear, prob_matt: matt / all, prob_coat: coat / all })
    }
    /// Probability that facets reflect the light they are drawn for.
    fn prob_reflect(v: &View, fresnel: f32) -> f32 {
        if v.inside { fresnel } else { 1.0 - v.clear * (1.0 - fresnel) }
    }
    /// What facets reflect.
    fn reflected(&self, v: &View, cos: f32) -> Spectrum {
        let glass = fresnel::dielectric(cos, v.eta).reflectance();
        if v.inside {
            return Spectrum::splat(v.clear * glass);
        }
        let (metal, tint) = (self.metallic.get(), self.specular_tint.get());
        let mut all = schlick(self.base, cos) * metal + Spectrum::splat((1.0 - metal) * (1.0 - tint) * glass);
        if tint > 0.0 {
            let f0 = tinted(self.base, self.per_luminance, 1.0) * f0_of(self.ior);
            all += schlick(f0, cos) * ((1.0 - metal) * tint);
        }
        all
    }
    fn f(&self, v: &View, wi: Local, mode: Transport) -> Spectrum {
        if wi.cos_theta() <= 0.0 {
            let Some(p) = self.facets.passage(v.up, wi, v.eta).filter(|_| v.clear > 0.0) else {
                return Spectrum::BLACK;
            };
            let squeeze = if mode == Transport::Radiance { 1.0 / (v.eta * v.eta) } else { 1.0 };
            return self.base.map(f32::sqrt) * (squeeze * v.clear * (1.0 - p.fresnel) * p.f);
        }
        let facets = self.facets.glint(v.up, wi).map_or(Spectrum::BLACK, |g| self.reflected(v, g.cos) * g.f);
        if v.inside {
            return facets;
        }
        let mut f = facets;
        if self.coat.get() > 0.0 {
            f += Spectrum::splat(self.coat.get() * Coat { alpha: self.coat_alpha.get() }.f(v.up, wi));
        }
        let (cos_half, _) = burley::half(v.up, wi);
        let metal = self.metallic.get();
        let matt = (1.0 - metal) * (1.0 - self.transmission.map_or(0.0, Unit::get));
        if matt > 0.0 {
            let shape = burley::matt(v.up, wi, cos_half, self.rough.get(), self.flatness.get());
            f += self.base * (matt * shape * FRAC_1_PI);
        }
        let sheen = self.sheen.get() * (1.0 - metal) * burley::weight(cos_half);
        f + tinted(self.base, self.per_luminance, self.sheen_tint.get()) * sheen
    }
    fn density(&self, v: &View, wi: Local) -> f32 {
        let prob = 1.0 - v.prob_matt - v.prob_coat;
        if wi.cos_theta() <= 0.0 {
            let passed = self.facets.passage(v.up, wi, v.eta).filter(|_| v.clear > 0.0);
            return passed.map_or(0.0, |p| prob * p.pdf * (1.0 - Self::prob_reflect(v, p.fresnel)));
        }
        let facets = self
            .facets
            .glint(v.up, wi)
            .map_or(0.0, |g| prob * g.pdf * Self::prob_reflect(v, fresnel::dielectric(g.cos, v.eta).reflectance()));
        let coat = if v.prob_coat > 0.0 { Coat { alpha: self.coat_alpha.get() }.pdf(v.up, wi) } else { 0.0 };
        facets + v.prob_coat * coat + v.prob_matt * square_to_cosine_hemisphere_pdf(wi)
    }
    /// A direction, and whether it passes the boundary; `None` if the draw fails.
    fn draw(&self, v: &View, u_lobe: f32, u: Vec2) -> Option<(Local, bool)> {
        if u_lobe < v.prob_matt {
            return Some((square_to_cosine_hemisphere(u), false));
        }
        if u_lobe < v.prob_matt + v.prob_coat {
            let coat = Coat { alpha: self.coat_alpha.get() };
            return Some((reflect_up(v.up, coat.sample(u))?, false));
        }
        let before = v.prob_matt + v.prob_coat;
        let u_way = (u_lobe - before) / (1.0 - before);
        let m = self.facets.sample_visible(v.up, u);
        let cos = v.up.dot(m).clamp(0.0, 1.0);
        let boundary = fresnel::dielectric(cos, v.eta);
        if v.clear == 0.0 || u_way < Self::prob_reflect(v, boundary.reflectance()) {
            return Some((reflect_up(v.up, m)?, false));
        }
        // Snell's law in vectors (Walter et al. 2007, eq. 40).
        let wi = Local(((cos / v.eta - boundary.cos_t) * m.0 - v.up.0 / v.eta).normalize());
        (wi.cos_theta() < 0.0).then_some((wi, true))
    }
}

impl Scatter for Disney {
    fn eval(&self, wo: Local, wi: Local, mode: Transport) -> Spectrum {
        self.view(wo).map_or(Spectrum::BLACK, |v| self.f(&v, seen_from(wo, wi), mode))
    }
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        self.view(wo).map_or(0.0, |v| self.density(&v, seen_from(wo, wi)))
    }
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
        let v = self.view(wo)?;
        let (wi, passes) = self.draw(&v, u_lobe, u)?;
        let pdf = self.density(&v, wi);
        let weight = self.f(&v, wi, mode) * (wi.abs_cos_theta() / pdf);
        let s = BsdfSample::scattered(seen_from(wo, wi), weight, pdf)?;
        Some(BsdfSample { eta: if passes { v.eta } else { 1.0 }, ..s })
    }
    fn lobes(&self) -> Lobes {
        let matt = (1.0 - self.metallic.get()) * (1.0 - self.transmission.map_or(0.0, Unit::get));
        // Coats are narrow.
        if matt <= 0.0 && self.sheen.get() <= 0.0 { self.facets.lobes() } else { Lobes::Wide }
    }
}
