//! The density estimate: reflected radiance from the photons around a point.
//!
//! `L = Σ f(wi) Φ K(d)` over the photons in a disc (Jensen 1996, eq. 7): photons give irradiance per area of the true
//! surface, and [`Interaction::f_photon`] turns it into radiance. It is zero for photons that arrive on a side from
//! which the material sends nothing to the eye, so light does not leak through thin walls.
use super::{Kernel, NearestMap, Photon, RadiusMap};
use crate::{
    bsdf::{Bsdf, Transport},
    scene::{Interaction, NearSide, TowardEye},
    spectrum::Spectrum,
};
use accel::Neighbours;
use glam::Vec3;
use std::f32::consts::PI;

/// Where a gather looks.
#[derive(Clone, Copy, Debug)]
pub struct Disc {
    /// Radius, world units, > 0.
    pub radius: f32,
    /// What a photon counts.
    pub kernel: Kernel,
}

/// The camera's half of a path, which ends where photons are gathered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CameraEnd {
    /// Scatterings at most that a photon may bring along.
    pub most: u32,
    /// Some boundary parted the camera path's wavelengths: see [`crate::spectrum`].
    pub dispersed: bool,
}

/// Adds up what photons scatter toward the eye.
struct Estimate<'i> {
    at: &'i Interaction,
    eye: TowardEye<'i>,
    end: CameraEnd,
    /// Set where scattering is the same for all directions on the eye's side and none on the other, which is where most
    /// photons are gathered: only their flux needs summing.
    matt: Option<NearSide>,
    sum: Spectrum,
    /// Photons in the sum.
    count: u32,
}

impl<'i> Estimate<'i> {
    #[inline]
    fn new(at: &'i Interaction, end: CameraEnd) -> Self {
        let matt = matches!(at.bsdf, Bsdf::Diffuse(_)).then(|| at.near_side());
        Self { at, eye: at.toward_eye(), end, matt, sum: Spectrum::BLACK, count: 0 }
    }
    #[inline]
    fn add(&mut self, photon: &Photon, weight: f32) {
        if u32::from(photon.scatterings) > self.end.most {
            return;
        }
        let weight = weight * Spectrum::join(self.end.dispersed, photon.dispersed);
        let Some(side) = &self.matt else {
            let f = self.eye.f_photon(photon.wi);
            self.count += u32::from(!f.is_black());
            self.sum += f * photon.flux * weight;
            return;
        };
        if let Some((_, ratio)) = side.cos_and_ratio(photon.wi) {
            self.count += 1;
            self.sum += photon.flux * (weight * ratio);
        }
    }
    /// Radiance, when the weights are over the mean on a disc of squared radius `r2`.
    #[inline]
    fn radiance(self, r2: f32) -> Spectrum {
        let flux_to_radiance =
            if self.matt.is_some() { self.at.f(self.at.wo, Transport::Radiance) } else { Spectrum::ONE };
        flux_to_radiance * self.sum * (1.0 / (PI * r2))
    }
}

/// Radiance that `at`, where the camera path `end`s, scatters toward `at.wo` from the photons of the disc around it.
#[inline]
pub fn gather_within(map: &RadiusMap, at: &Interaction, disc: Disc, end: CameraEnd) -> Spectrum {
    let r2 = disc.radius * disc.radius;
    let mut estimate = Estimate::new(at, end);
    map.within(at.p, disc.radius, |photon, d2| estimate.add(photon, disc.kernel.shape(d2, r2)));
    estimate.radiance(r2)
}

/// What a gather found, not yet over the area of its disc.
#[derive(Clone, Copy, Debug)]
pub struct Gathered {
    /// Flux of each photon times what scatters it toward the eye, summed: radiance times area.
    pub flux: Spectrum,
    /// Photons that count.
    pub photons: u32,
}

/// As [`gather_within`] with every photon of the disc counted alike, before the division by the disc's area.
#[inline]
pub fn gather_counted(map: &RadiusMap, at: &Interaction, radius: f32, end: CameraEnd) -> Gathered {
    let mut estimate = Estimate::new(at, end);
    map.within(at.p, radius, |photon, _| estimate.add(photon, 1.0));
    let photons = estimate.count;
    Gathered { flux: estimate.radiance(1.0) * PI, photons }
}

/// A running search for the nearest photons, reused from place to place.
#[derive(Clone, Debug)]
pub struct NearestQuery {
    /// Photons sought, the one that defines the radius included; at least 2.
    k: usize,
    /// The radius that is never exceeded, world units, > 0.
    r_max: f32,
    found: Neighbours,
    /// The last place, and the distance to its `k`-th photon if there were so many.
    last: Option<(Vec3, f32)>,
}

/// The smallest radius over the largest. Photons may coincide, and light that is focused to a point is still not
/// infinitely bright.
const R_MIN: f32 = 1e-3;

impl NearestQuery {
    /// A search for `k` photons within `r_max` (world units).
    ///
    /// # Panics
    /// If `k` is less than 2 or `r_max` is not positive.
    pub fn new(k: usize, r_max: f32) -> Self {
        assert!(k >= 2 && r_max > 0.0, "{k} photons within {r_max} make no estimate");
        Self { k, r_max, found: Neighbours::new(), last: None }
    }

    /// Finds the nearest photons; returns how many of them count, and the squared radius of the disc that holds these.
    ///
    /// With `k` photons found, the farthest only defines the radius: `k − 1` photons over its disc are an unbiased
    /// estimate of a constant density, `k` are not. With fewer, all of them count, over the largest disc.
    #[inline]
    pub fn find(&mut self, map: &NearestMap, p: Vec3) -> (usize, f32) {
        map.nearest_unordered(p, self.k, self.bound(p), &mut self.found);
        let full = if self.found.len() == self.k { self.found.farthest() } else { None };
        self.last = full.map(|(_, d2)| (p, d2.sqrt()));
        let (least, most) = (R_MIN * self.r_max, self.r_max);
        match full {
            Some((_, d2)) if d2 > least * least => (self.k - 1, d2),
            Some(_) => (self.k, least * least),
            None => (self.found.len(), most * most),
        }
    }
    /// A radius that holds `k` photons, if the last search found so many: those are no farther than they were then plus
    /// how far we moved. The photons found are the same as with the largest radius, if in another order, and come sooner.
    #[inline]
    fn bound(&self, p: Vec3) -> f32 {
        self.last.map_or(self.r_max, |(last, r)| ((r + p.distance(last)) * (1.0 + 1e-5)).min(self.r_max))
    }
}

/// Radiance that `at`, where the camera path `end`s, scatters toward `at.wo` from the photons nearest to it, of which those
/// with too many scatterings count as dark.
#[inline]
pub fn gather_nearest(
    map: &NearestMap,
    at: &Interaction,
    query: &mut NearestQuery,
    kernel: Kernel,
    end: CameraEnd,
) -> Spectrum {
    if map.is_empty() {
        return Spectrum::BLACK;
    }
    let (count, r2) = query.find(map, at.p);
    let mut estimate = Estimate::new(at, end);
    for (index, d2) in query.found.iter().take(count) {
        estimate.add(map.photon(index), kernel.shape(d2, r2));
    }
    estimate.radiance(r2)
}
