//! The two maps, and how they are looked up.
use super::PhotonMapper;
use crate::{
    film::Counts,
    photon::{
        CameraEnd, Disc, Keep, Kernel, NearestMap, NearestQuery, RadiusMap, Shower, Source, gather_nearest,
        gather_within,
    },
    sampler::Domain,
    scene::{Interaction, World},
    spectrum::Spectrum,
};

/// The photons of a pass, or of all passes.
pub(super) struct Maps {
    /// What some lobe with a density has scattered.
    pub(super) indirect: Map,
    /// What only delta lobes have scattered.
    pub(super) caustic: Map,
}

/// A map with its way of asking it.
pub(super) enum Map {
    /// The nearest photons, within a largest radius.
    Nearest(NearestMap, f32),
    /// All photons within a radius.
    Within(RadiusMap, f32),
}

/// The largest radius over the median of those that hold the photons sought: where photons are so much thinner, blur
/// would reach farther than the eye forgives, and fewer photons are the lesser evil.
const MOST: f32 = 2.0;

impl Maps {
    /// Shoots both showers with the random numbers of (domain, seed, pass).
    pub(super) fn shoot(
        settings: &PhotonMapper,
        world: &World,
        (domain, seed, pass): (Domain, u64, u64),
        counts: &mut Counts,
    ) -> Self {
        let limits = settings.limits;
        let mut map = |first, paths, keep| {
            let catch = Shower { seed, domain, pass, first, paths, keep, limits }.shoot(world, &Source::plain());
            *counts += catch.counts;
            if let Some(radius) = settings.radius {
                return Map::Within(RadiusMap::new(&catch.positions, &catch.photons, radius), radius);
            }
            let map = NearestMap::new(catch);
            let spacing = || map.spacing(settings.nearest).map(|r| MOST * r);
            let fallback = || 1e-3 * world.around().radius;
            let r_max = settings.max_radius.or_else(spacing).unwrap_or_else(fallback);
            Map::Nearest(map, r_max)
        };
        Self {
            indirect: map(0, settings.photons, Keep::Indirect),
            caustic: map(settings.photons, settings.caustic_photons, Keep::Caustic),
        }
    }
}

/// A map being asked from place to place.
pub(super) enum Lookup<'m> {
    Nearest(&'m NearestMap, NearestQuery),
    Within(&'m RadiusMap, f32),
}

impl Map {
    pub(super) fn lookup(&self, k: usize) -> Lookup<'_> {
        match self {
            Self::Nearest(map, r_max) => Lookup::Nearest(map, NearestQuery::new(k, *r_max)),
            Self::Within(map, radius) => Lookup::Within(map, *radius),
        }
    }
}

impl Lookup<'_> {
    /// Radiance toward `at.wo` from the photons around `at`, where the camera path `end`s.
    #[inline]
    pub(super) fn radiance(&mut self, at: &Interaction, kernel: Kernel, end: CameraEnd) -> Spectrum {
        match self {
            Self::Nearest(map, query) => gather_nearest(map, at, query, kernel, end),
            Self::Within(map, radius) => gather_within(map, at, Disc { radius: *radius, kernel }, end),
        }
    }
}
