//! Rough surfaces as a landscape of tiny mirrors: the GGX distribution of their normals, what hides what, and how to draw
//! the ones that can be seen.
//!
//! `m` is a micronormal, with `m.z > 0`; `wo` is on the upper side (models flip the surface for light from below).
use crate::math::Local;
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, TAU};

/// GGX (Trowbridge–Reitz) landscape with Smith's masking, its slopes along the two tangents of like size or not.
#[derive(Clone, Copy, Debug)]
pub struct Ggx {
    alpha: Vec2,
}

/// A mirror reflection from `wo` to `wi` by the landscape, but for Fresnel's factor.
#[derive(Clone, Copy, Debug)]
pub struct Glint {
    /// Cosine between `wo` and the micronormal half way between the directions.
    pub cos: f32,
    /// `D·G₂ / (4 cos θo cos θi)`, 1/sr.
    pub f: f32,
    /// Density (1/sr) of `wi` when visible micronormals are drawn.
    pub pdf: f32,
}

impl Ggx {
    /// Least roughness that f32 directions still resolve; smoother surfaces are mirrors.
    pub const MIN_ALPHA: f32 = 1e-3;

    /// The smoothest landscape.
    pub(super) const POLISHED: Self = Self { alpha: Vec2::splat(Self::MIN_ALPHA) };

    /// A landscape of roughness `alpha`, kept within [`Ggx::MIN_ALPHA`] and 1.
    #[inline]
    pub fn new(alpha: f32) -> Self {
        Self::aligned(alpha, alpha)
    }
    /// A landscape of roughness `u` along the first tangent and `v` along the second, both kept as in [`Ggx::new`].
    #[inline]
    pub fn aligned(u: f32, v: f32) -> Self {
        Self { alpha: Vec2::new(u, v).clamp(Vec2::splat(Self::MIN_ALPHA), Vec2::ONE) }
    }
    /// Roughness along the two tangents: about the slope of a typical microfacet.
    #[inline]
    pub fn alpha(self) -> Vec2 {
        self.alpha
    }

    /// Area of microfacets facing `m` per area of surface and solid angle (1/sr); `∫ D(m) (m·n) dm = 1`
    /// (Walter et al. 2007, eq. 33, rewritten for unit vectors).
    #[inline]
    pub fn d(self, m: Local) -> f32 {
        let Vec3 { x, y, z } = m.0;
        if z <= 0.0 {
            return 0.0;
        }
        let a = self.alpha;
        let (x, y) = (x / a.x, y / a.y);
        let q = x * x + y * y + z * z;
        FRAC_1_PI / (a.x * a.y * q * q)
    }
    /// Length of `w` with its horizontal parts scaled by alpha: `|cos θ|·(1 + 2Λ)` with Smith's Λ (Heitz 2014,
    /// "Understanding the Masking-Shadowing Function", eq. 72). In these terms nothing below divides by a grazing cosine.
    #[inline]
    fn stretched(self, w: Local) -> f32 {
        let Vec3 { x, y, z } = w.0;
        let (x, y) = (self.alpha.x * x, self.alpha.y * y);
        (x * x + y * y + z * z).sqrt()
    }
    /// Area of the microfacets that face `w` as `w` sees it, per area of surface: `|cos θ|·(1 + Λ)`.
    #[inline]
    pub(super) fn area(self, w: Local) -> f32 {
        0.5 * (w.abs_cos_theta() + self.stretched(w))
    }
    /// Fraction of the microfacets facing `w` that `w` sees: `1/(1 + Λ)` (Heitz 2014, eq. 57).
    #[inline]
    pub fn g1(self, w: Local) -> f32 {
        let c = w.abs_cos_theta();
        2.0 * c / (c + self.stretched(w))
    }
    /// Density (1/sr) of the micronormals seen from `wo`: `G₁ D max(0, wo·m) / cos θo` (Heitz 2014, eq. 2); it integrates
    /// to 1.
    #[inline]
    pub fn pdf_visible(self, wo: Local, m: Local) -> f32 {
        2.0 * wo.dot(m).max(0.0) * self.d(m) / (wo.cos_theta() + self.stretched(wo))
    }
    /// Draws a micronormal seen from `wo`: a mirror image of a spherical cap (Dupuy & Benyoub 2023, "Sampling Visible GGX
    /// Normals with Spherical Caps", listing 3).
    #[inline]
    pub fn sample_visible(self, wo: Local, u: Vec2) -> Local {
        let a = self.alpha;
        let w = Vec3::new(a.x * wo.0.x, a.y * wo.0.y, wo.0.z).normalize();
        // A uniform point of the cap z > −w.z of the unit sphere, by its distance h from the top.
        let h = (1.0 + w.z) * u.y;
        let r = (h * (2.0 - h)).max(0.0).sqrt();
        let (sin, cos) = (TAU * u.x).sin_cos();
        let half = Vec3::new(r * cos, r * sin, 1.0 - h) + w;
        Local(Vec3::new(a.x * half.x, a.y * half.y, half.z.max(f32::MIN_POSITIVE)).normalize())
    }

    /// The reflection from `wo` to `wi`, both above the surface; `None` otherwise. Masking and shadowing are
    /// height-correlated, `G₂ = 1/(1 + Λo + Λi)` (Heitz 2014, eq. 99).
    #[inline]
    pub fn glint(self, wo: Local, wi: Local) -> Option<Glint> {
        let (co, ci) = (wo.cos_theta(), wi.cos_theta());
        if co <= 0.0 || ci <= 0.0 {
            return None;
        }
        let m = Local((wo.0 + wi.0).try_normalize()?);
        let (so, si) = (self.stretched(wo), self.stretched(wi));
        let d = self.d(m);
        // dm/dwi = 1 / 4(wo·m) (Walter et al. 2007, eq. 14).
        Some(Glint { cos: wo.dot(m).min(1.0), f: 0.5 * d / cross_lengths(co, so, ci, si), pdf: 0.5 * d / (co + so) })
    }
    /// `G₂/G₁(wo)` of a reflection: what a drawn visible micronormal still loses to shadowing.
    #[inline]
    pub fn shadowing(self, wo: Local, wi: Local) -> f32 {
        let (co, ci) = (wo.cos_theta(), wi.cos_theta());
        let (so, si) = (self.stretched(wo), self.stretched(wi));
        ci * (co + so) / cross_lengths(co, so, ci, si)
    }
}

/// `2 cos θo cos θi / G₂` from cosines and stretched lengths, kept from underflow when both directions lie in the plane.
#[inline]
fn cross_lengths(co: f32, so: f32, ci: f32, si: f32) -> f32 {
    (so * ci + si * co).max(1e-30)
}

/// The mirror image of `wo` about the micronormal `m`, as it leaves a surface seen from above: `None` if it goes down,
/// where a second bounce that this model leaves out would await it.
#[inline]
pub fn reflect_up(wo: Local, m: Local) -> Option<Local> {
    let wi = (2.0 * wo.dot(m) * m.0 - wo.0).normalize();
    (wi.z > 0.0).then_some(Local(wi))
}
