//! What the camera needs: places where photons will be gathered, and what its paths meet on the way.
use crate::{
    bsdf::Lobes,
    camera::{Project, Spread},
    film::FilmSpec,
    photon::{Reach, Sighting},
    sampler::{Domain, Sampler},
    scene::{Interaction, World},
    walk::{Arrival, Escape, Limits, Start, Step, Visit, walk},
};
use glam::Vec3;
use rayon::prelude::*;

/// A place where the camera needs photons.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub(super) p: Vec3,
    /// True normal on the side of the eye.
    pub(super) n: Vec3,
    /// How far photons count, world units.
    pub(super) radius: f32,
    /// Irradiance (mean of lanes) that needs no photons.
    pub(super) direct: f32,
}

/// What a number of camera paths found.
pub(super) struct Needs {
    pub(super) spots: Vec<Spot>,
    /// Points where camera paths went on as caustics do, and all points that they met.
    pub(super) bent: Vec<Vec3>,
    pub(super) met: Vec<Vec3>,
}

/// Camera paths.
const PATHS: u64 = 4096;
/// Radius of a spot in pixel widths: so many that some of the few photons of a trial fall into it.
const PIXELS: f32 = 6.0;
/// Connections to lights at a spot.
const CONNECTIONS: u32 = 4;

impl Needs {
    pub(super) fn new(world: &World, spec: FilmSpec, limits: Limits, seed: u64) -> Self {
        let limits = Limits { scatterings: limits.scatterings.min(12), ..limits };
        let look = |index| {
            let mut sampler = Sampler::new(seed, Domain::Prepare, u64::MAX - 1, index);
            let camera = world.camera().ray(sampler.next_2d(), sampler.next_2d());
            let start = Start::from_camera(world, camera.ray);
            let mut glance = Glance::new(world, limits.gathers, camera.spread.of_pixel(spec.pixels()));
            walk(world, &start, &limits, &mut sampler, &mut glance);
            (glance.spot, glance.bent, glance.met)
        };
        let found: Vec<_> = (0..PATHS).into_par_iter().map(look).collect();
        let sightings: Vec<Sighting> =
            found.iter().filter_map(|(s, ..)| s.map(|s| Sighting { p: s.p, width: s.radius })).collect();
        let reach = Reach::from_footprints(&sightings, PIXELS, 1e-3 * world.around().radius);
        let spots = found.iter().filter_map(|(s, ..)| s.map(|s| Spot { radius: reach.at(s.radius), ..s })).collect();
        let bent = found.iter().flat_map(|(_, bent, _)| bent).copied().collect();
        let met = found.iter().flat_map(|(.., met)| met).copied().collect();
        Self { spots, bent, met }
    }
}

/// Follows one camera path to the second place where photons could be gathered.
struct Glance<'w> {
    world: &'w World<'w>,
    least: Lobes,
    pixel: Spread,
    spot: Option<Spot>,
    bent: Vec<Vec3>,
    met: Vec<Vec3>,
}

impl<'w> Glance<'w> {
    fn new(world: &'w World<'w>, least: Lobes, pixel: Spread) -> Self {
        Self { world, least, pixel, spot: None, bent: Vec::new(), met: Vec::new() }
    }
    /// The last scattering turns out to have been where nothing is gathered, if `caustic`.
    fn bend(&mut self, caustic: bool) {
        if caustic {
            self.bent.extend(self.met.last().copied());
        }
    }
}

impl Visit for Glance<'_> {
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        self.bend(a.caustic);
        self.met.push(a.at.p);
        if !a.at.gathers(self.least) {
            return Step::On;
        }
        if self.spot.is_some() {
            return Step::Stop;
        }
        // The width of a pixel, until the radius is known.
        let radius = self.pixel.width_at(a.travelled);
        let n = a.at.ng * 1f32.copysign(a.at.ng.dot(a.at.wo));
        self.spot = Some(Spot { p: a.at.p, n, radius, direct: irradiance(self.world, a.at, n, sampler) });
        Step::On
    }
    fn escape(&mut self, e: &Escape) {
        self.bend(e.caustic);
    }
}

/// Irradiance on the side of `n` that comes straight from lights.
fn irradiance(world: &World, at: &Interaction, n: Vec3, sampler: &mut Sampler) -> f32 {
    let one = |(u_light, u)| {
        let li = world.sample_direct(at.p, u_light, u)?.li;
        let cos = n.dot(li.wi);
        let passed = if cos > 0.0 { world.passed(at, &at.spawn_toward(li.wi, &li.end))? } else { return None };
        Some((li.li * passed).mean() * cos / li.pdf)
    };
    let sum: f32 = (0..CONNECTIONS).filter_map(|_| one((sampler.next_1d(), sampler.next_2d()))).sum();
    sum / CONNECTIONS as f32
}
