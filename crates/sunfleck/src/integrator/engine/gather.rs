//! Density estimation with a weight for each photon.
use super::{vertex::Photon, weights::Between};
use crate::{
    bsdf::{Bsdf, Transport},
    photon::{CameraEnd, Disc, RadiusMap},
    scene::Interaction,
    spectrum::Spectrum,
};
use std::f32::consts::{FRAC_1_PI, PI};

/// Radiance that `at` scatters toward `at.wo` from the photons of the disc around it that `takes` takes and that were scattered
/// at most [`CameraEnd::most`] times, each times its weight, if they are weighed (see [`crate::photon::gather`] for the
/// estimate).
#[inline]
pub(super) fn gather(
    map: &RadiusMap<Photon>,
    at: &Interaction,
    disc: Disc,
    end: CameraEnd,
    takes: impl Fn(&Photon) -> bool,
    weigh: Option<&impl Fn(&Photon, Between) -> f32>,
) -> Spectrum {
    let r2 = disc.radius * disc.radius;
    let join = |photon: &Photon| Spectrum::join(end.dispersed, photon.dispersed);
    let takes = |photon: &Photon| u32::from(photon.scatterings) <= end.most && takes(photon);
    let mut sum = Spectrum::BLACK;
    if let Bsdf::Diffuse(_) = at.bsdf {
        // Scattering is the same for all directions on the eye's side, and none on the other.
        let (side, back) = (at.near_side(), at.shading_cos(at.wo) * FRAC_1_PI);
        map.within(at.p, disc.radius, |photon, d2| {
            let Some((cos, ratio)) = side.cos_and_ratio(photon.wi) else { return };
            if takes(photon) {
                let weight = weigh.map_or(1.0, |weigh| weigh(photon, Between { forward: cos * FRAC_1_PI, back }));
                sum += photon.flux * (join(photon) * weight * ratio * disc.kernel.shape(d2, r2));
            }
        });
        sum *= at.f(at.wo, Transport::Radiance);
    } else {
        let eye = at.toward_eye();
        let between = |wi| Between { forward: at.pdf(wi), back: at.pdf_back(wi) };
        map.within(at.p, disc.radius, |photon, d2| {
            if !takes(photon) {
                return;
            }
            let f = eye.f_photon(photon.wi);
            if !f.is_black() {
                let weight = weigh.map_or(1.0, |weigh| weigh(photon, between(photon.wi)));
                sum += f * photon.flux * (join(photon) * weight * disc.kernel.shape(d2, r2));
            }
        });
    }
    sum * (1.0 / (PI * r2))
}
