//! Density estimation with a weight for each photon.
use super::{vertex::Photon, weights::Between};
use crate::{
    bsdf::{Bsdf, Transport},
    photon::{CameraEnd, Disc, RadiusMap},
    scene::Interaction,
    spectrum::Spectrum,
};
use std::f32::consts::{FRAC_1_PI, PI};

/// Radiance that `at` scatters toward `at.wo` from the photons of the disc around it that were scattered at most
/// [`CameraEnd::most`] times, each times its weight (see [`crate::photon::gather`] for the estimate).
#[inline]
pub(super) fn gather(
    map: &RadiusMap<Photon>,
    at: &Interaction,
    disc: Disc,
    end: CameraEnd,
    weigh: impl Fn(&Photon, Between) -> f32,
) -> Spectrum {
    let r2 = disc.radius * disc.radius;
    let join = |photon: &Photon| Spectrum::join(end.dispersed, photon.dispersed);
    let mut sum = Spectrum::BLACK;
    if let Bsdf::Diffuse(_) = at.bsdf {
        // Scattering is the same for all directions on the eye's side, and none on the other.
        let (side, back) = (at.near_side(), at.shading_cos(at.wo) * FRAC_1_PI);
        map.within(at.p, disc.radius, |photon, d2| {
            let Some((cos, ratio)) = side.cos_and_ratio(photon.wi) else { return };
            if u32::from(photon.scatterings) <= end.most {
                let weight = join(photon) * weigh(photon, Between { forward: cos * FRAC_1_PI, back }) * ratio;
                sum += photon.flux * (weight * disc.kernel.shape(d2, r2));
            }
        });
        sum *= at.f(at.wo, Transport::Radiance);
    } else {
        map.within(at.p, disc.radius, |photon, d2| {
            if u32::from(photon.scatterings) > end.most {
                return;
            }
            let f = at.f_photon(photon.wi);
            if !f.is_black() {
                let between = Between { forward: at.pdf(photon.wi), back: at.pdf_back(photon.wi) };
                sum += f * photon.flux * (join(photon) * weigh(photon, between) * disc.kernel.shape(d2, r2));
            }
        });
    }
    sum * (1.0 / (PI * r2))
}
