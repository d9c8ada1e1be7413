//! Disney's thin material of 2015 as Mitsuba has it: a sheet that reflects and lets pass, glossy or matt.
use super::{
    BsdfSample, Landscape, Lobes, Lookup, Model, Scalar, Scatter, TextureId, Transport,
    burley::{self, schlick, tinted},
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

/// A sheet without inside, the same from both sides. Numbers are in [0, 1] unless said otherwise.
#[derive(Clone, Copy, Debug)]
pub struct DisneyThinMaterial {
    /// Albedo, and the colour of what passes.
    pub base: TextureId,
    /// Perceived roughness; alpha is its square.
    pub roughness: Scalar,
    /// How much the highlights are drawn out along the texture coordinate u.
    pub anisotropic: Scalar,
    /// Share of the sheet that is glossy and clear; the rest is matt.
    pub transmission: Scalar,
    /// How much of the matt light passes: 0 none to 2 all.
    pub through: Scalar,
    /// Index of refraction, > 1.
    pub ior: Scalar,
    /// How much the reflection takes on the hue of the base.
    pub specular_tint: Scalar,
    /// Sheen at grazing angles.
    pub sheen: Scalar,
    /// How much the sheen takes on the hue of the base.
    pub sheen_tint: Scalar,
    /// From a matt base to the likeness of light below the surface.
    pub flatness: Scalar,
}

impl Model for DisneyThinMaterial {
    type Closure = DisneyThin;
    const NAME: &'static str = "disneythin";
    const ABOUT: &'static str =
        "Disney's thin sheet of 2015 as Mitsuba has it: glossy and matt, reflecting and letting pass";
    fn resolve(&self, at: &Lookup) -> DisneyThin {
        let base = at.spectrum(self.base).map(|v| v.clamp(0.0, 1.0));
        let unit = |s| Unit::new(at.scalar(s));
        let (rough, anisotropic) = (at.scalar(self.roughness).clamp(0.0, 1.0), at.scalar(self.anisotropic));
        let ior = at.scalar(self.ior).max(1.0 + 1e-3);
        DisneyThin {
            base,
            mirror: burley::stretched(rough, anisotropic),
            // What passes is blurred less, the less it is bent (Burley 2015, figure 15).
            pane: burley::stretched((0.65 * ior - 0.35) * rough, anisotropic),
            per_luminance: burley::per_luminance(base, at),
            ior,
            rough: Unit::new(rough),
            clear: unit(self.transmission),
            through: Unit::new(0.5 * at.scalar(self.through)),
            specular_tint: unit(self.specular_tint),
            sheen: unit(self.sheen),
            sheen_tint: unit(self.sheen_tint),
            flatness: unit(self.flatness),
        }
    }
    fn textures(&self) -> Vec<TextureId> {
        let first = [self.roughness, self.anisotropic, self.transmission, self.through, self.ior];
        let others = [self.specular_tint, self.sheen, self.sheen_tint, self.flatness];
        [self.base].into_iter().chain(burley::textures(first)).chain(burley::textures(others)).collect()
    }
    fn is_aligned(&self) -> bool {
        self.anisotropic != 0.0.into()
    }
}

/// Four lobes: facets that reflect, others that let pass straight, and the matt light on both sides.
#[derive(Clone, Copy, Debug)]
pub struct DisneyThin {
    base: Spectrum,
    mirror: Landscape,
    pane: Landscape,
    per_luminance: f32,
    ior: f32,
    rough: Unit,
    clear: Unit,
    through: Unit,
    specular_tint: Unit,
    sheen: Unit,
    sheen_tint: Unit,
    flatness: Unit,
}

impl DisneyThin {
    /// Probabilities of the mirror, the pane, the matt reflection, and the matt passage.
    fn probs(&self) -> [f32; 4] {
        let (clear, through) = (self.clear.get(), self.through.get());
        [0.5 * clear, 0.5 * clear, (1.0 - clear) * (1.0 - through), (1.0 - clear) * through]
    }
    /// `wi` in the frame in which `wo` is above.
    fn f(&self, up: Local, wi: Local) -> Spectrum {
        let (clear, through) = (self.clear.get(), self.through.get());
        let over = Local(wi.0.with_z(wi.0.z.abs()));
        if wi.0.z < 0.0 {
            let pane = self.pane.glint(up, over);
            let passed = pane.map_or(0.0, |g| g.f * (1.0 - fresnel::dielectric(g.cos, self.ior).reflectance()));
            return self.base * (clear * passed + (1.0 - clear) * through * FRAC_1_PI);
        }
        let mut f = Spectrum::BLACK;
        if let Some(g) = self.mirror.glint(up, over) {
            let (glass, tint) = (fresnel::dielectric(g.cos, self.ior).reflectance(), self.specular_tint.get());
            let f0 = tinted(self.base, self.per_luminance, 1.0) * f0_of(self.ior);
            f += (Spectrum::splat(glass * (1.0 - tint)) + schlick(f0, g.cos) * tint) * (clear * g.f);
        }
        let (cos_half, _) = burley::half(up, over);
        let matt = burley::matt(up, over, cos_half, self.rough.get(), self.flatness.get()) * FRAC_1_PI;
        let sheen = self.sheen.get() * burley::weight(cos_half);
        let sheen = tinted(self.base, self.per_luminance, self.sheen_tint.get()) * sheen;
        f + (self.base * matt + sheen) * ((1.0 - clear) * (1.0 - through))
    }
    fn density(&self, up: Local, wi: Local) -> f32 {
        let over = Local(wi.0.with_z(wi.0.z.abs()));
        let [mirror, pane, matt, passage] = self.probs();
        let (glossy, prob, even) = if wi.0.z < 0.0 { (self.pane, pane, passage) } else { (self.mirror, mirror, matt) };
        prob * glossy.glint(up, over).map_or(0.0, |g| g.pdf) + even * square_to_cosine_hemisphere_pdf(over)
    }
}

impl Scatter for DisneyThin {
    fn eval(&self, wo: Local, wi: Local, _: Transport) -> Spectrum {
        let (up, wi) = (seen_from(wo, wo), seen_from(wo, wi));
        if up.0.z <= 0.0 || wi.0.z == 0.0 { Spectrum::BLACK } else { self.f(up, wi) }
    }
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let (up, wi) = (seen_from(wo, wo), seen_from(wo, wi));
        if up.0.z <= 0.0 || wi.0.z == 0.0 { 0.0 } else { self.density(up, wi) }
    }
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, _: Transport) -> Option<BsdfSample> {
        let up = seen_from(wo, wo);
        if up.0.z <= 0.0 {
            return None;
        }
        let [mirror, pane, matt, _] = self.probs();
        let turned = |w: Local| Local(w.0.with_z(-w.0.z));
        let wi = if u_lobe < mirror {
            reflect_up(up, self.mirror.sample_visible(up, u))?
        } else if u_lobe < mirror + pane {
            turned(reflect_up(up, self.pane.sample_visible(up, u))?)
        } else if u_lobe < mirror + pane + matt {
            square_to_cosine_hemisphere(u)
        } else {
            turned(square_to_cosine_hemisphere(u))
        };
        if wi.0.z == 0.0 {
            return None;
        }
        let pdf = self.density(up, wi);
        BsdfSample::scattered(seen_from(wo, wi), self.f(up, wi) * (wi.abs_cos_theta() / pdf), pdf)
    }
    fn lobes(&self) -> Lobes {
        Lobes::Wide
    }
}
