//! Glass, water and other clear things with a polished boundary.
use super::{BsdfSample, Lookup, Model, Scatter, TextureId, Transport, fresnel};
use crate::{
    math::Local,
    spectrum::{Ior, Spectrum},
};
use glam::{Vec2, Vec3};

/// A smooth boundary between two clear media. The outside is where the normal points.
#[derive(Clone, Copy, Debug)]
pub struct DielectricMaterial {
    /// Index of refraction of the inside over that of the outside; > 0 (glass in air 1.5, water 1.33). One that changes with
    /// the wavelength parts colours in spectral mode; in RGB mode it is that for yellow light.
    pub eta: Ior,
    /// Tint in [0, 1] of each reflection; white is physical.
    pub reflectance: TextureId,
    /// Tint in [0, 1] of each passage through the boundary; white is physical. `NRenderer` calls it `absorbed`.
    pub transmittance: TextureId,
}

impl Model for DielectricMaterial {
    type Closure = Dielectric;
    const NAME: &'static str = "dielectric";
    const ABOUT: &'static str =
        "clear glass or water, polished: reflects and refracts by Fresnel (`eta` 1.5 glass, 1.33 water)";
    #[inline]
    fn resolve(&self, at: &Lookup) -> Dielectric {
        Dielectric {
            eta: self.eta.at(at.lambda),
            reflectance: at.spectrum(self.reflectance),
            transmittance: at.spectrum(self.transmittance),
        }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.reflectance, self.transmittance]
    }
    fn is_dispersive(&self) -> bool {
        self.eta.is_dispersive()
    }
}

/// Reflects or refracts by Fresnel's equations for unpolarised light.
#[derive(Clone, Copy, Debug)]
pub struct Dielectric {
    /// η of the side below the surface over η of the side above it, by wavelength.
    pub eta: Spectrum,
    /// Tint of reflections.
    pub reflectance: Spectrum,
    /// Tint of transmissions.
    pub transmittance: Spectrum,
}

impl Dielectric {
    /// See [`super::Bsdf::immersed`].
    pub(super) fn immersed(self, outer: Spectrum) -> Self {
        Self { eta: self.eta.zip(outer, |eta, outer| eta / outer), ..self }
    }
    /// η of the far side over η of the side that `wo` is on, for the hero.
    #[inline]
    pub(super) fn eta_beyond(&self, wo: Local) -> f32 {
        beyond(wo, self.eta.hero())
    }
    /// Whether wavelengths are bent differently.
    #[inline]
    pub(super) fn is_dispersive(&self) -> bool {
        self.eta != Spectrum::splat(self.eta.hero())
    }
    /// `f` of [`Dielectric::eta_beyond`] at each wavelength; worked out once if all are alike.
    #[inline]
    pub(super) fn by_lane(&self, wo: Local, f: impl Fn(f32) -> f32) -> Spectrum {
        if self.is_dispersive() {
            self.eta.map(|eta| f(beyond(wo, eta)))
        } else {
            Spectrum::splat(f(self.eta_beyond(wo)))
        }
    }
    /// Probability of following the reflection when the boundary reflects the fraction `fresnel`: in proportion to what
    /// each way carries. 0 when neither carries anything.
    #[inline]
    pub(super) fn prob_reflect(&self, fresnel: f32) -> f32 {
        let r = fresnel * self.reflectance.max();
        let t = (1.0 - fresnel) * self.transmittance.max();
        if r > 0.0 { r / (r + t) } else { 0.0 }
    }
    /// What a transmission is multiplied by: radiance is squeezed into the narrower cone of the denser side
    /// (Veach 1997, section 5.2), flux stays. `eta` is η of `wi`'s side over η of `wo`'s side.
    #[inline]
    pub(super) fn transmission(&self, eta: f32, mode: Transport) -> Spectrum {
        match mode {
            Transport::Radiance => self.transmittance / (eta * eta),
            Transport::Flux => self.transmittance,
        }
    }
}

/// η of the far side over η of the side that `wo` is on, from that of below over above.
#[inline]
fn beyond(wo: Local, eta: f32) -> f32 {
    if wo.cos_theta() > 0.0 { eta } else { 1.0 / eta }
}

impl Scatter for Dielectric {
    #[inline]
    fn sample(&self, wo: Local, u_lobe: f32, _: Vec2, mode: Transport) -> Option<BsdfSample> {
        let eta = self.eta_beyond(wo);
        let boundary = fresnel::dielectric(wo.abs_cos_theta(), eta);
        let fresnel = boundary.reflectance();
        let disperses = self.is_dispersive();
        // Every wavelength is reflected alike, if not as much. The hero decides how often, as it is alone on most paths within
        // glass; a tenth of the mean bounds the weights of the others.
        let all = if disperses {
            self.by_lane(wo, |eta| fresnel::dielectric(wo.abs_cos_theta(), eta).reflectance())
        } else {
            Spectrum::splat(fresnel)
        };
        let often = if disperses && fresnel < 1.0 { 0.9 * fresnel + 0.1 * all.mean() } else { fresnel };
        let prob = self.prob_reflect(often);
        if u_lobe < prob {
            let s = BsdfSample::specular(wo, self.reflectance * (all / prob))?;
            return Some(BsdfSample { pdf: prob, ..s });
        }
        let weight = self.transmission(eta, mode) * ((1.0 - fresnel) / (1.0 - prob));
        let weight = if disperses { weight * Spectrum::HERO } else { weight };
        let wi = Local(Vec3::new(-wo.0.x / eta, -wo.0.y / eta, -boundary.cos_t.copysign(wo.0.z)).normalize());
        let carries = wo.cos_theta() * wi.cos_theta() < 0.0 && !weight.is_black();
        carries.then_some(BsdfSample { wi, weight, pdf: 1.0 - prob, delta: true, eta, disperses })
    }
}
