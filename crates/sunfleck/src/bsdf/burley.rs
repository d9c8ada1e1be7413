//! Pieces that Disney's two materials share (Burley 2012, "Physically Based Shading at Disney"; 2015, "Extending the Disney
//! BRDF to a BSDF with Integrated Subsurface Scattering"), in the form that Mitsuba gives them.
use super::{Facets, Landscape, Lookup, Scalar, TextureId, ggx::Ggx};
use crate::{
    math::Local,
    spectrum::{Spectrum, Wavelengths},
};
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, TAU};

/// `(1 − cos)⁵`.
#[inline]
pub(super) fn weight(cos: f32) -> f32 {
    let x = (1.0 - cos).clamp(0.0, 1.0);
    x * x * x * x * x
}

/// Schlick's factor.
#[inline]
pub(super) fn schlick(f0: Spectrum, cos: f32) -> Spectrum {
    let w = weight(cos);
    f0 * (1.0 - w) + Spectrum::splat(w)
}

/// Roughness along and across: alpha is that squared, stretched by √(1 − 0.9·anisotropic) (2012, section 5.4). Kept as in
/// [`Ggx::aligned`].
#[inline]
pub(super) fn stretched(rough: f32, anisotropic: f32) -> Landscape {
    let aspect = (1.0 - 0.9 * anisotropic.clamp(0.0, 1.0)).sqrt();
    let alpha = rough * rough;
    Landscape::new(Facets::GgxSeparate, alpha / aspect, alpha * aspect)
}

/// The base's hue at luminance 1, as a factor of the base: 1 over its luminance.
#[inline]
pub(super) fn per_luminance(base: Spectrum, at: &Lookup) -> f32 {
    let luminance = match at.lambda {
        Wavelengths::Rgb => base.to_rgb(at.lambda).dot(Vec3::new(0.2126, 0.7152, 0.0722)),
        Wavelengths::Spectral(_) => base.mean(),
    };
    if luminance > 0.0 { 1.0 / luminance } else { 0.0 }
}

/// White, or the hue of `base`, by `tint` in [0, 1].
#[inline]
pub(super) fn tinted(base: Spectrum, per_luminance: f32, tint: f32) -> Spectrum {
    if per_luminance > 0.0 { Spectrum::splat(1.0 - tint) + base * (per_luminance * tint) } else { Spectrum::ONE }
}

/// The textures of some numbers.
pub(super) fn textures<const N: usize>(of: [Scalar; N]) -> impl Iterator<Item = TextureId> {
    of.into_iter().filter_map(Scalar::texture)
}

/// Cosine between either direction and the half vector, and the cosine of the half vector.
#[inline]
pub(super) fn half(wo: Local, wi: Local) -> (f32, f32) {
    let sum = wo.0 + wi.0;
    let length = sum.length();
    if length > 0.0 { (0.5 * length, sum.z / length) } else { (0.0, 0.0) }
}

/// The matt part over albedo/π: Lambert's law that darkens at grazing angles, with light sent back on rough surfaces, and toward
/// `flatness` 1 the likeness of light below the surface (2012, section 5.3; 2015, section 4.2).
#[inline]
pub(super) fn matt(wo: Local, wi: Local, cos_half: f32, rough: f32, flatness: f32) -> f32 {
    let (co, ci) = (wo.abs_cos_theta(), wi.abs_cos_theta());
    let (fo, fi) = (weight(co), weight(ci));
    let back = 2.0 * rough * cos_half * cos_half;
    let dull = (1.0 - 0.5 * fo) * (1.0 - 0.5 * fi) + back * (fo + fi + fo * fi * (back - 1.0));
    if flatness <= 0.0 {
        return dull;
    }
    let grazing = |f: f32| 1.0 + f * (0.5 * back - 1.0);
    let below = 1.25 * (grazing(fo) * grazing(fi) * (1.0 / (co + ci).max(1e-6) - 0.5) + 0.5);
    dull + flatness * (below - dull)
}

/// The clear coat: a distribution with long tails, GTR of exponent 1 (2012, appendix B.2), of index 1.5, a quarter as strong as a
/// boundary, and without the cosines below D·F·G.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coat {
    pub(super) alpha: f32,
}

impl Coat {
    /// Roughness of the coat's masking.
    const MASKING: f32 = 0.25;

    /// Density of normals, 1/sr: `(α² − 1) / (π ln α² (1 + (α² − 1) cos²))`.
    #[inline]
    fn d(self, cos: f32) -> f32 {
        let a2 = self.alpha * self.alpha;
        (1.0 - a2) * FRAC_1_PI / (-a2.ln() * (1.0 - (1.0 - a2) * cos * cos))
    }
    /// Scattering function of a whole coat, 1/sr.
    #[inline]
    pub(super) fn f(self, wo: Local, wi: Local) -> f32 {
        let (cos, up) = half(wo, wi);
        let mask = Ggx::new(Self::MASKING);
        let fresnel = 0.04 + 0.96 * weight(cos);
        0.25 * fresnel * self.d(up) * mask.g1(wo) * mask.g1(wi)
    }
    /// Density (1/sr) of the mirror images about drawn normals.
    #[inline]
    pub(super) fn pdf(self, wo: Local, wi: Local) -> f32 {
        let (cos, up) = half(wo, wi);
        if cos > 0.0 { self.d(up) * up / (4.0 * cos) } else { 0.0 }
    }
    /// Draws a normal in proportion to its density and cosine.
    #[inline]
    pub(super) fn sample(self, u: Vec2) -> Local {
        let a2 = self.alpha * self.alpha;
        // 1 − cos², which keeps its digits where the lobe is narrow.
        let sin2 = (a2.powf(1.0 - u.y) - a2) / (1.0 - a2);
        let (r, cos) = (sin2.max(0.0).sqrt(), (1.0 - sin2).max(0.0).sqrt());
        let (y, x) = (TAU * u.x).sin_cos();
        Local(Vec3::new(r * x, r * y, cos))
    }
}
