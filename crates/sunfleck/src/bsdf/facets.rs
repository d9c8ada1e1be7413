//! Which landscape of tiny mirrors a rough surface is: how its slopes are spread, and how its hills hide one another.
use super::{
    Lobes,
    beckmann::Beckmann,
    fresnel,
    ggx::{Ggx, Glint},
};
use crate::math::Local;
use glam::Vec2;

/// A kind of landscape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Facets {
    /// GGX, with height-correlated masking: what pbrt and glTF have.
    #[default]
    Ggx,
    /// GGX, seen and lit independently (Walter et al. 2007, eq. 23): what Mitsuba has.
    GgxSeparate,
    /// Beckmann's, seen and lit independently: Mitsuba's default.
    Beckmann,
}

/// A kind of landscape with its roughness.
#[derive(Clone, Copy, Debug)]
pub struct Landscape {
    ggx: Ggx,
    facets: Facets,
}

/// A refraction by one facet, but for the share 1 − F and the squeeze of radiance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    /// Reflected fraction at the facet.
    pub(super) fresnel: f32,
    /// Scattering function for flux, 1/sr.
    pub(super) f: f32,
    /// Density (1/sr) of `wi` when visible micronormals are drawn.
    pub(super) pdf: f32,
}

impl Landscape {
    /// Of roughness `u` along the first tangent and `v` along the second, kept as in [`Ggx::aligned`].
    #[inline]
    pub fn new(facets: Facets, u: f32, v: f32) -> Self {
        Self { ggx: Ggx::aligned(u, v), facets }
    }
    /// Roughness along the two tangents.
    #[inline]
    pub fn alpha(self) -> Vec2 {
        self.ggx.alpha()
    }
    /// How far it spreads light that one facet sends on.
    #[inline]
    pub(super) fn lobes(self) -> Lobes {
        Lobes::of_facets(self.alpha().max_element())
    }
    /// Its kind.
    #[inline]
    pub fn facets(self) -> Facets {
        self.facets
    }
    #[inline]
    fn beckmann(self) -> Beckmann {
        Beckmann { alpha: self.ggx.alpha() }
    }
    /// See [`Ggx::d`].
    #[inline]
    pub fn d(self, m: Local) -> f32 {
        if self.facets == Facets::Beckmann { self.beckmann().d(m) } else { self.ggx.d(m) }
    }
    /// Area of the facets that face `w` as `w` sees it, per area of surface: `|cos θ|/G₁`.
    #[inline]
    fn area(self, w: Local) -> f32 {
        if self.facets == Facets::Beckmann { self.beckmann().area(w) } else { self.ggx.area(w) }
    }
    /// See [`Ggx::g1`].
    #[inline]
    pub fn g1(self, w: Local) -> f32 {
        w.abs_cos_theta() / self.area(w)
    }
    /// See [`Ggx::pdf_visible`].
    #[inline]
    pub fn pdf_visible(self, wo: Local, m: Local) -> f32 {
        wo.dot(m).max(0.0) * self.d(m) / self.area(wo)
    }
    /// See [`Ggx::sample_visible`].
    #[inline]
    pub fn sample_visible(self, wo: Local, u: Vec2) -> Local {
        if self.facets == Facets::Beckmann {
            self.beckmann().sample_visible(wo, u)
        } else {
            self.ggx.sample_visible(wo, u)
        }
    }
    /// See [`Ggx::glint`].
    #[inline]
    pub fn glint(self, wo: Local, wi: Local) -> Option<Glint> {
        if self.facets == Facets::Ggx {
            return self.ggx.glint(wo, wi);
        }
        if wo.cos_theta() <= 0.0 || wi.cos_theta() <= 0.0 {
            return None;
        }
        // Half the length of the sum is the cosine with the half vector, and the same from both ends.
        let sum = wo.0 + wi.0;
        let cos = (0.5 * sum.length()).min(1.0);
        // D·G₁(wo)·G₁(wi) / (4 cos θo cos θi).
        let pdf = 0.25 * self.d(Local(sum.try_normalize()?)) / self.area(wo);
        Some(Glint { cos, f: pdf / self.area(wi), pdf })
    }
    /// See [`Ggx::shadowing`].
    #[inline]
    pub fn shadowing(self, wo: Local, wi: Local) -> f32 {
        if self.facets == Facets::Ggx { self.ggx.shadowing(wo, wi) } else { self.g1(wi) }
    }
    /// The refraction from `up`, above the surface, to `wi`, below it; `None` if no visible facet does that. `eta` is η below
    /// over η above, as `up` sees it.
    #[inline]
    pub(super) fn passage(self, up: Local, wi: Local, eta: f32) -> Option<Passage> {
        if up.cos_theta() <= 0.0 || wi.cos_theta() >= 0.0 {
            return None;
        }
        // Walter et al. 2007, eq. 16, turned to the upper side (as it stands it points into the thinner medium).
        let m = (up.0 + eta * wi.0).try_normalize()?;
        let m = Local(m * 1f32.copysign(m.z));
        let (cos, cos_t) = (up.dot(m), -wi.dot(m));
        if cos <= 0.0 || cos_t <= 0.0 {
            return None;
        }
        // dm/dwi = η² |wi·m| / (wo·m + η wi·m)² (eq. 17).
        let squeeze = cos - eta * cos_t;
        let jacobian = eta * eta * cos_t / (squeeze * squeeze);
        let pdf = self.pdf_visible(up, m) * jacobian;
        // f cos θi = pdf · G₂/G₁(wo), and with separable masking that ratio is G₁(wi) (eqs. 21, 23).
        let fresnel = fresnel::between(cos, cos_t, eta).reflectance();
        Some(Passage { fresnel, f: pdf / self.area(wi), pdf })
    }
}
