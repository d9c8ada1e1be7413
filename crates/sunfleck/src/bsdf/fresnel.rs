//! How much a boundary reflects: Fresnel's equations and their popular short cut.
//!
//! All cosines are those of the angle with the (micro)normal on the side the light is on, in [0, 1]. `eta` is always
//! *relative*: η of the far side over η of the side of the given cosine.
use crate::spectrum::Spectrum;

/// What happens at a smooth boundary between two clear media.
#[derive(Clone, Copy, Debug)]
pub struct Refraction {
    /// Reflected fraction of light polarised perpendicular to the plane of incidence.
    pub r_s: f32,
    /// Reflected fraction of light polarised parallel to the plane of incidence.
    pub r_p: f32,
    /// Cosine of the refracted direction on the far side; 0 in total internal reflection.
    pub cos_t: f32,
}

impl Refraction {
    /// Reflected fraction of unpolarised light, in [0, 1]; exactly 1 in total internal reflection.
    #[inline]
    pub fn reflectance(self) -> f32 {
        0.5 * (self.r_s + self.r_p)
    }
}

/// Fresnel's equations and Snell's law for clear media (Born & Wolf 1999, section 1.5.2, eqs. 20 to 22).
#[inline]
pub fn dielectric(cos_i: f32, eta: f32) -> Refraction {
    // sin² θt = sin² θi / η², written without the cancellation of 1 − sin² that makes a grazing, index-matched boundary
    // look like a mirror.
    let cos2_t = ((eta - 1.0) * (eta + 1.0) + cos_i * cos_i) / (eta * eta);
    if cos2_t <= 0.0 {
        return Refraction { r_s: 1.0, r_p: 1.0, cos_t: 0.0 };
    }
    between(cos_i, cos2_t.sqrt(), eta)
}

/// As [`dielectric`], where the cosine on the far side is known: near the critical angle it does not follow from `cos_i`
/// without a loss of digits.
#[inline]
pub fn between(cos_i: f32, cos_t: f32, eta: f32) -> Refraction {
    let s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    Refraction { r_s: s * s, r_p: p * p, cos_t }
}

/// Reflected fraction of unpolarised light at a metal of complex index `eta + i·k`, relative to the medium of the light
/// (Born & Wolf 1999, section 14.2; in the real form of Lagarde 2013, "Memo on Fresnel equations").
#[inline]
pub fn conductor(cos_i: f32, eta: Spectrum, k: Spectrum) -> Spectrum {
    let cos2 = cos_i * cos_i;
    let sin2 = (1.0 - cos2).max(0.0);
    eta.zip(k, |eta, k| {
        // a² + b² and a of the complex cosine (a + i·b) = sqrt((η + i·k)² − sin² θ).
        let difference = eta * eta - k * k - sin2;
        let a2_b2 = difference.hypot(2.0 * eta * k);
        let a = (0.5 * (a2_b2 + difference)).max(0.0).sqrt();
        let (t1, t2) = (a2_b2 + cos2, 2.0 * a * cos_i);
        let r_s = (t1 - t2) / (t1 + t2);
        let (t3, t4) = (cos2 * a2_b2 + sin2 * sin2, t2 * sin2);
        // Both are zero for light along the normal of an index of 0 (an unused lane), where the answer is r_s.
        let r_p = if t3 + t4 > 0.0 { r_s * (t3 - t4) / (t3 + t4) } else { r_s };
        0.5 * (r_s + r_p)
    })
}

/// The index of refraction (over that of the outside, ≥ 1) of a clear medium that reflects `f0` along the normal.
#[inline]
pub(super) fn f0_to_ior(f0: f32) -> f32 {
    let r = f0.clamp(0.0, 0.9999).sqrt();
    (1.0 + r) / (1.0 - r)
}

/// Schlick's approximation: from `f0` along the normal to 1 at grazing angles (Schlick 1994, "An Inexpensive BRDF Model
/// for Physically-based Rendering", eq. 15).
#[inline]
pub fn schlick(f0: Spectrum, cos: f32) -> Spectrum {
    let x = (1.0 - cos).clamp(0.0, 1.0);
    let x2 = x * x;
    f0 + (Spectrum::ONE - f0) * (x2 * x2 * x)
}
