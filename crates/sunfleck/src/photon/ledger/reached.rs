//! Which photons lie within the kernel around some place that the camera sees.
use super::{
    Audit,
    book::{Kept, Page},
};
use crate::{
    bsdf::Lobes,
    camera::Project,
    film::FilmSpec,
    photon::RadiusMap,
    sampler::{Domain, Sampler},
    scene::{Interaction, World},
    walk::{Arrival, Start, Step, Visit, walk},
};
use glam::Vec3;
use rayon::prelude::*;

/// Camera paths at least and at most; in between, one a pixel. Kernels are some pixels wide, so that even pictures of many
/// more pixels are covered.
const LOOKS: std::ops::RangeInclusive<u64> = 1 << 12..=1 << 18;
/// Camera paths that are looked along one after the other.
const CHUNK: u64 = 4096;
/// A family of random numbers of its own among those of [`Domain::Prepare`].
const PASS: u64 = u64::MAX - 3;

/// For each photon of `page`, whether some gather reaches it.
pub(super) fn marks(audit: &Audit, world: &World, spec: FilmSpec, page: &Page) -> Vec<bool> {
    let photons: Vec<Found> =
        page.photons.iter().zip(0..).map(|(&Kept { wi, .. }, index)| Found { wi, index }).collect();
    if photons.is_empty() {
        return Vec::new();
    }
    let map = RadiusMap::spanning(&page.positions, &photons, audit.radii.span());
    let looks = (spec.pixels() as u64).clamp(*LOOKS.start(), *LOOKS.end());
    let none = || vec![false; photons.len()];
    // A mark that is set twice is set: the order does not matter.
    (0..looks.div_ceil(CHUNK))
        .into_par_iter()
        .fold(none, |mut marked, c| {
            (c * CHUNK..((c + 1) * CHUNK).min(looks)).for_each(|i| look(audit, world, &map, i, &mut marked));
            marked
        })
        .reduce(none, |mut a, b| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a |= b);
            a
        })
}

/// A photon as gathers find it.
#[derive(Clone, Copy)]
struct Found {
    /// Unit direction back to where it came from.
    wi: Vec3,
    index: u32,
}

fn look(audit: &Audit, world: &World, map: &RadiusMap<Found>, index: u64, marked: &mut [bool]) {
    let mut sampler = Sampler::new(audit.seed, Domain::Prepare, PASS, index);
    let raster = sampler.next_2d();
    let camera = world.camera().ray(raster, sampler.next_2d());
    let start = Start::from_camera(world, camera.ray);
    let mut first = First { least: audit.limits.gathers, at: None };
    walk(world, &start, &audit.limits, &mut sampler, &mut first);
    let Some(at) = first.at else { return };
    let eye = at.toward_eye();
    map.within(at.p, audit.radii.at(raster), |photon, _| {
        let mark = &mut marked[photon.index as usize];
        // Photons from behind are near, but lend nothing.
        *mark = *mark || !eye.f_photon(photon.wi).is_black();
    });
}

/// The first surface that gathers.
struct First {
    least: Lobes,
    at: Option<Interaction>,
}

impl Visit for First {
    fn surface(&mut self, a: &Arrival, _: &mut Sampler) -> Step {
        if !a.at.gathers(self.least) {
            return Step::On;
        }
        self.at = Some(*a.at);
        Step::Stop
    }
}
