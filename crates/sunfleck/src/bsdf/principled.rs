//! Paint, plastic, metal and cloth under a clear coat: one model for what glTF, Mitsuba and Blender call principled.
use super::{
    BsdfSample, Lobes, Lookup, Model, Roughness, Scalar, Scatter, TextureId, Transport,
    albedo::{Albedo, TabulatedSheen},
    film::{Film, FilmMaterial},
    fresnel::schlick,
    ggx::{Ggx, reflect_up},
    packed::{Unit, UnitSpectrum},
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

/// The opaque part of the principled model, two-sided; [`crate::scene::SceneBuilder::principled`] adds transmission.
#[derive(Clone, Copy, Debug)]
pub struct PrincipledMaterial {
    /// Albedo of the matt part and reflectance of the metal, in [0, 1].
    pub base: TextureId,
    /// 0 non-metal to 1 metal.
    pub metallic: Scalar,
    /// Perceived roughness in [0, 1], along and across; alpha is its square, but at least [`Ggx::MIN_ALPHA`].
    pub roughness: Roughness,
    /// Index of refraction of the non-metal, > 0: reflectance along the normal is ((n − 1)/(n + 1))².
    pub ior: Scalar,
    /// Share in [0, 1] of the non-metal's reflection that is there.
    pub specular: Scalar,
    /// What tints that reflection along the normal; white if absent.
    pub specular_color: Option<TextureId>,
    /// Share in [0, 1] of the surface under a clear coat.
    pub coat: Scalar,
    /// Perceived roughness of the coat, in [0, 1].
    pub coat_roughness: Scalar,
    /// Index of refraction of the coat, > 0.
    pub coat_ior: f32,
    /// Colour in [0, 1] of the sheen; none if absent.
    pub sheen: Option<TextureId>,
    /// Perceived roughness of the sheen, in [0, 1].
    pub sheen_roughness: Scalar,
    /// A thin film on gloss and metal, below the coat, which makes them iridescent.
    pub film: Option<FilmMaterial>,
}

impl PrincipledMaterial {
    /// Half rough, neither metal nor coated, of index 1.5: what glTF, Mitsuba and Blender start from, but for their roughness.
    pub fn new(base: TextureId) -> Self {
        Self {
            base,
            metallic: 0.0.into(),
            roughness: 0.5.into(),
            ior: 1.5.into(),
            specular: 1.0.into(),
            specular_color: None,
            coat: 0.0.into(),
            coat_roughness: 0.0.into(),
            coat_ior: 1.5,
            sheen: None,
            sheen_roughness: 0.3.into(),
            film: None,
        }
    }
}

/// Reflectance along the normal of a boundary of relative index `ior`.
pub(super) fn f0_of(ior: f32) -> f32 {
    let r = (ior - 1.0) / (ior + 1.0);
    r * r
}

impl Model for PrincipledMaterial {
    type Closure = Principled;
    const NAME: &'static str = "principled";
    const ABOUT: &'static str =
        "paint, plastic, metal or cloth under a coat, by base colour, metallic, roughness, ior, coat and sheen";
    fn resolve(&self, at: &Lookup) -> Principled {
        let unit = |id| at.spectrum(id).map(|v| v.clamp(0.0, 1.0));
        let [u, v] = self.roughness.at(at).map(|r| r * r);
        let specular = at.scalar(self.specular).clamp(0.0, 1.0);
        let tint = self.specular_color.map_or(Spectrum::ONE, |id| at.spectrum(id));
        let square = |s| {
            let r = at.scalar(s).clamp(0.0, 1.0);
            r * r
        };
        Principled {
            base: unit(self.base),
            metallic: Unit::new(at.scalar(self.metallic)),
            ggx: Ggx::aligned(u, v),
            f0: UnitSpectrum::new(tint * (f0_of(at.scalar(self.ior)) * specular)),
            f90: Unit::new(specular),
            coat: Unit::new(at.scalar(self.coat)),
            coat_f0: Unit::new(f0_of(self.coat_ior)),
            coat_alpha: Unit::new(square(self.coat_roughness).max(Ggx::MIN_ALPHA)),
            sheen: UnitSpectrum::new(self.sheen.map_or(Spectrum::BLACK, unit)),
            sheen_alpha: Unit::new(square(self.sheen_roughness)),
            film: self.film.map_or(Film::NONE, |film| Film::new(&film, at)),
        }
    }
    fn textures(&self) -> Vec<TextureId> {
        let scalars = [self.metallic, self.ior, self.specular, self.coat, self.coat_roughness, self.sheen_roughness];
        let film = self.film.iter().flat_map(|f| [f.share, f.thickness]);
        let colours = [Some(self.base), self.specular_color, self.sheen];
        let scalars = scalars.into_iter().chain(film).filter_map(Scalar::texture);
        colours.into_iter().flatten().chain(scalars).chain(self.roughness.textures()).collect()
    }
    fn is_aligned(&self) -> bool {
        self.roughness.is_aligned()
    }
}

/// From the top: sheen, coat, and a base that is metal or, matt under a gloss, not.
///
/// - **Gloss**: GGX with Schlick's Fresnel factor, as glTF has it.
/// - **Matt part**: `base/π (1 − R(o))(1 − R(i))/(1 − R̄)` (Kelemen & Szirmay-Kalos 2001), R being the tabulated albedo of the
///   gloss: what the gloss does not reflect reaches the base, and a white base loses nothing.
/// - **Film**: takes the place of Schlick's factor. The matt part gets what the gloss does not reflect at its most iridescent, so
///   nothing gives back more than it gets.
/// - **Metal**: what facets keep from each other comes back after more bounces (Kulla & Conty 2017, "Revisiting Physically Based
///   Shading at Imageworks"), tinted by each.
/// - **Coat and sheen** take what they reflect from what is below: by the angle at which they take more, so that it is
///   the same both ways.
#[derive(Clone, Copy, Debug)]
pub struct Principled {
    pub(super) base: Spectrum,
    pub(super) ggx: Ggx,
    pub(super) f0: UnitSpectrum,
    pub(super) sheen: UnitSpectrum,
    pub(super) metallic: Unit,
    pub(super) f90: Unit,
    pub(super) coat: Unit,
    pub(super) coat_f0: Unit,
    pub(super) coat_alpha: Unit,
    pub(super) sheen_alpha: Unit,
    pub(super) film: Film,
}

/// What does not depend on `wi`: a view of the closure from `wo`, which is above the surface.
struct View {
    up: Local,
    metallic: f32,
    /// Reflectance of gloss and metal along the normal, the same at most with the film, and at grazing angles.
    f0: Spectrum,
    most: Spectrum,
    f90: f32,
    albedo: Albedo,
    /// What the gloss of the non-metal leaves to its matt part.
    below: Spectrum,
    /// Probabilities of coat and gloss; the rest is drawn by the cosine.
    prob_coat: f32,
    prob_gloss: f32,
}

impl Principled {
    /// A black base without anything on it, as polished as can be.
    pub(super) const BARE: Self = Self {
        base: Spectrum::BLACK,
        ggx: Ggx::POLISHED,
        f0: UnitSpectrum::BLACK,
        sheen: UnitSpectrum::BLACK,
        metallic: Unit::ZERO,
        f90: Unit::ZERO,
        coat: Unit::ZERO,
        coat_f0: Unit::ZERO,
        coat_alpha: Unit::ZERO,
        sheen_alpha: Unit::ZERO,
        film: Film::NONE,
    };
    /// Reflectance of the gloss along the normal, at most.
    fn f0_matt(&self) -> Spectrum {
        self.film.most(self.f0.get())
    }
    fn cloth(&self) -> TabulatedSheen {
        TabulatedSheen::new(self.sheen_alpha.get())
    }
    /// Albedo of the coat.
    fn coat_albedo(&self, cos: f32) -> f32 {
        let weight = self.coat.get();
        if weight == 0.0 {
            return 0.0;
        }
        let f0 = Spectrum::splat(self.coat_f0.get());
        weight * Albedo::new(self.coat_alpha.get()).of(f0, 1.0, cos).hero()
    }
    /// What coat and sheen let through at the cosine `cos`.
    fn through(&self, cos: f32) -> f32 {
        let coat = 1.0 - self.coat_albedo(cos);
        if self.sheen.is_black() {
            return coat;
        }
        coat * (1.0 - self.sheen.get().max() * self.cloth().albedo(cos))
    }
    fn view(&self, wo: Local) -> View {
        let up = seen_from(wo, wo);
        let cos = up.cos_theta();
        let metallic = self.metallic.get();
        let alpha = self.ggx.alpha();
        let albedo = Albedo::new((alpha.x * alpha.y).sqrt());
        let f90 = self.f90.get();
        let gloss = albedo.of(self.f0_matt(), f90, cos);
        let f0 = self.f0.get() * (1.0 - metallic) + self.base * metallic;
        let most = self.film.most(f0);
        let f90_mixed = f90 * (1.0 - metallic) + metallic;
        let below = (Spectrum::ONE - gloss) * (1.0 - metallic);
        let coat = self.coat_albedo(cos);
        let through = self.through(cos);
        let glossy = through * albedo.of(most, f90_mixed, cos).max();
        let matt = through * ((self.base * below).max() + metallic * (1.0 - albedo.whole(cos)))
            + if self.sheen.is_black() { 0.0 } else { self.sheen.get().max() * self.cloth().albedo(cos) };
        let (prob_coat, prob_gloss) = shares(coat, glossy, matt);
        View { up, metallic, f0, most, f90: f90_mixed, albedo, below, prob_coat, prob_gloss }
    }
    /// Matt part and metal's further bounces toward `wi`, 1/sr.
    fn even(&self, v: &View, wi: Local) -> Spectrum {
        let mut f = Spectrum::BLACK;
        if v.metallic < 1.0 {
            let f0 = self.f0_matt();
            let f90 = self.f90.get();
            let there = Spectrum::ONE - v.albedo.of(f0, f90, wi.cos_theta());
            let mean = Spectrum::ONE - v.albedo.mean_of(f0, f90);
            f += self.base * v.below * there.zip(mean, |t, m| t / m.max(1e-3)) * FRAC_1_PI;
        }
        if v.metallic > 0.0 {
            let mean = v.albedo.whole_mean();
            // A little less than is lost, so that what tables are off by never adds light.
            let lost = |cos| 0.998 * (1.0 - v.albedo.whole(cos));
            let shape = lost(v.up.cos_theta()) * lost(wi.cos_theta()) / (1.0 - mean).max(1e-4) * FRAC_1_PI;
            // Mean of Schlick's factor over the hemisphere; each further bounce multiplies by it and by what escapes.
            let fresnel = self.base.map(|f0| f0 + (1.0 - f0) / 21.0);
            f += fresnel.map(|f| f * f * mean / (1.0 - f * (1.0 - mean))) * (v.metallic * shape);
        }
        f
    }
    fn f(&self, v: &View, wi: Local) -> Spectrum {
        let mut f = self.even(v, wi);
        if let Some(g) = self.ggx.glint(v.up, wi) {
            let x = (1.0 - g.cos).clamp(0.0, 1.0);
            let x5 = x * x * x * x * x;
            let schlick = |f0: Spectrum| f0 * (1.0 - x5) + Spectrum::splat(v.f90 * x5);
            f += self.film.over(schlick(v.f0), v.f0, schlick(v.most), g.cos) * g.f;
        }
        f *= self.through(v.up.cos_theta()).min(self.through(wi.cos_theta()));
        if self.coat.get() > 0.0
            && let Some(g) = Ggx::new(self.coat_alpha.get()).glint(v.up, wi)
        {
            f += schlick(Spectrum::splat(self.coat_f0.get()), g.cos) * (self.coat.get() * g.f);
        }
        if !self.sheen.is_black() {
            let coat = (1.0 - self.coat_albedo(v.up.cos_theta())).min(1.0 - self.coat_albedo(wi.cos_theta()));
            f += self.sheen.get() * (coat * self.cloth().f(v.up, wi));
        }
        f
    }
    fn density(&self, v: &View, wi: Local) -> f32 {
        let of = |prob: f32, ggx: Ggx| {
            if prob > 0.0 { prob * ggx.glint(v.up, wi).map_or(0.0, |g| g.pdf) } else { 0.0 }
        };
        of(v.prob_coat, Ggx::new(self.coat_alpha.get()))
            + of(v.prob_gloss, self.ggx)
            + (1.0 - v.prob_coat - v.prob_gloss) * square_to_cosine_hemisphere_pdf(wi)
    }
}

/// The closure seen from `wo`.
pub(super) struct Outlook<'p> {
    of: &'p Principled,
    wo: Local,
    /// Unless `wo` lies in the surface.
    view: Option<View>,
}

impl Principled {
    pub(super) fn outlook(&self, wo: Local) -> Outlook<'_> {
        let view = (seen_from(wo, wo).cos_theta() > 0.0).then(|| self.view(wo));
        Outlook { of: self, wo, view }
    }
}

impl Outlook<'_> {
    pub(super) fn eval(&self, wi: Local) -> Spectrum {
        let wi = seen_from(self.wo, wi);
        match &self.view {
            Some(view) if wi.cos_theta() > 0.0 => self.of.f(view, wi),
            _ => Spectrum::BLACK,
        }
    }
}

/// Probabilities of the first two parts, in proportion to what each gives back. A part that gives anything is drawn at least
/// sometimes.
fn shares(coat: f32, gloss: f32, matt: f32) -> (f32, f32) {
    const LEAST: f32 = 0.05;
    let all = coat + gloss + matt;
    if all <= 0.0 {
        return (0.0, 0.0);
    }
    let share = |v: f32| if v > 0.0 { (v / all).max(LEAST) } else { 0.0 };
    let (a, b, c) = (share(coat), share(gloss), share(matt));
    (a / (a + b + c), b / (a + b + c))
}

impl Scatter for Principled {
    fn eval(&self, wo: Local, wi: Local, _: Transport) -> Spectrum {
        // Most directions that are asked for from below carry nothing.
        if wi.cos_theta() * wo.cos_theta() > 0.0 { self.outlook(wo).eval(wi) } else { Spectrum::BLACK }
    }
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let (up, wi) = (seen_from(wo, wo), seen_from(wo, wi));
        if up.cos_theta() <= 0.0 || wi.cos_theta() <= 0.0 {
            return 0.0;
        }
        self.density(&self.view(wo), wi)
    }
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, _: Transport) -> Option<BsdfSample> {
        if seen_from(wo, wo).cos_theta() <= 0.0 {
            return None;
        }
        let v = self.view(wo);
        let wi = if u_lobe < v.prob_coat {
            reflect_up(v.up, Ggx::new(self.coat_alpha.get()).sample_visible(v.up, u))?
        } else if u_lobe < v.prob_coat + v.prob_gloss {
            reflect_up(v.up, self.ggx.sample_visible(v.up, u))?
        } else {
            square_to_cosine_hemisphere(u)
        };
        let pdf = self.density(&v, wi);
        BsdfSample::scattered(seen_from(wo, wi), self.f(&v, wi) * (wi.cos_theta() / pdf), pdf)
    }
    fn lobes(&self) -> Lobes {
        // All others have a matt part.
        let bare = self.metallic.get() >= 1.0 && self.sheen.get().is_black();
        if bare { Lobes::of_facets(self.ggx.alpha().max_element().max(self.coat_alpha.get())) } else { Lobes::Wide }
    }
}
