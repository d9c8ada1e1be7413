//! Light paths shot on trial, and what each is worth to the camera.
use super::{
    mixture::{Line, Mixture},
    need::{Needs, Spot},
};
use crate::{
    bsdf::Lobes,
    light::LightId,
    photon::Emission,
    sampler::{Domain, Sampler},
    scene::World,
    walk::{Arrival, Limits, Start, Step, Visit, walk},
};
use accel::PointGrid;
use glam::Vec3;
use rayon::prelude::*;

/// A light path of which the camera needs some photons.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trial {
    pub(super) light: LightId,
    pub(super) line: Line,
    /// Density of its start, without that part which targets do not change; over all volleys, once [`pool`] has seen it.
    pub(super) pdf: f64,
    /// The same by what the light itself emits, without the choice of the light.
    pub(super) plain: f32,
    /// Where it first met a surface.
    pub(super) first: Vec3,
    /// Sum over spots of the squares of what it would add at density 1, were it the only path, in units of what the spot
    /// has in all.
    pub(super) square: f64,
}

/// Gives the trials of all volleys (mixture, paths) the density of the volleys together, as if they were one.
pub(super) fn pool(trials: &mut [Trial], volleys: &[(Mixture, u64)]) {
    let paths: u64 = volleys.iter().map(|(_, n)| n).sum();
    let density = |t: &Trial| volleys.iter().map(|(m, n)| *n as f64 * m.density(t.light, t.plain, t.line)).sum::<f64>();
    trials.par_iter_mut().for_each(|t| t.pdf = density(t) / paths as f64);
}

impl Trial {
    /// What it adds, in the mean over the spots and up to a factor common to all.
    pub(super) fn worth(&self) -> f64 {
        self.square.sqrt() / self.pdf
    }
}

/// A photon of a trial.
#[derive(Clone, Copy)]
struct Landing {
    p: Vec3,
    wi: Vec3,
    /// Flux (mean of lanes).
    flux: f32,
}

struct Path {
    trial: Trial,
    landings: Vec<Landing>,
}

/// How light paths are shot on trial.
#[derive(Clone, Copy, Debug)]
pub(super) struct Volley {
    pub(super) seed: u64,
    /// A number of its own for each volley.
    pub(super) round: u64,
    pub(super) paths: u64,
    pub(super) limits: Limits,
    /// Whether light straight from lights is found by photons too.
    pub(super) direct: bool,
}

/// Light paths per task.
const CHUNK: u64 = 512;

impl Volley {
    /// Shoots from `mixture`; returns the paths that the camera needs, in the order of their numbers.
    pub(super) fn shoot(&self, world: &World, mixture: &Mixture, needs: &Needs) -> Vec<Trial> {
        let chunks: Vec<Vec<Path>> = (0..self.paths.div_ceil(CHUNK))
            .into_par_iter()
            .map(|c| {
                let paths = c * CHUNK..((c + 1) * CHUNK).min(self.paths);
                paths.filter_map(|i| self.trace(world, mixture, i)).collect()
            })
            .collect();
        let paths: Vec<Path> = chunks.into_iter().flatten().collect();
        Worth::new(needs, &paths, self.direct).judge(paths, self.paths)
    }
    fn trace(&self, world: &World, mixture: &Mixture, index: u64) -> Option<Path> {
        let limits = Limits { scatterings: self.limits.scatterings.checked_sub(1)?, ..self.limits };
        let mut sampler = Sampler::new(self.seed, Domain::Prepare, self.round, index);
        let drawn = mixture.sample(world, sampler.next_1d(), sampler.next_2d(), sampler.next_2d())?;
        let start = Emission::new(world, drawn.light, drawn.prob, drawn.le)?.start;
        let start = Start { beta: start.beta / self.paths as f32, ..start };
        let mut land = Land { direct: self.direct, least: self.limits.gathers, first: None, landings: Vec::new() };
        walk(world, &start, &limits, &mut sampler, &mut land);
        let line = Line { p: start.ray.o, d: start.ray.d };
        let light = drawn.light;
        let pdf = f64::from(drawn.prob * mixture.changed(light, &drawn.le));
        let plain = mixture.changed(light, &drawn.plain);
        let trial = Trial { light, line, pdf, plain, first: land.first?, square: 0.0 };
        (!land.landings.is_empty()).then_some(Path { trial, landings: land.landings })
    }
}

/// Notes where a light path lands.
struct Land {
    direct: bool,
    least: Lobes,
    first: Option<Vec3>,
    landings: Vec<Landing>,
}

impl Visit for Land {
    fn surface(&mut self, a: &Arrival, _: &mut Sampler) -> Step {
        self.first.get_or_insert(a.at.p);
        if a.at.widest >= self.least && (self.direct || a.scatterings > 0) {
            self.landings.push(Landing { p: a.at.p, wi: a.at.wo, flux: a.beta.mean() });
        }
        Step::On
    }
}

/// What photons are worth: in units of the irradiance of the spots that they reach.
struct Worth<'n> {
    spots: &'n [Spot],
    grid: PointGrid,
    reach: f32,
    /// Irradiance of each spot, photons included.
    irradiance: Vec<f32>,
    /// The least that counts.
    darkest: f32,
}

/// No spot counts as darker than this share of the mean.
const DARKEST: f32 = 0.05;

impl<'n> Worth<'n> {
    fn new(needs: &'n Needs, paths: &[Path], direct: bool) -> Self {
        let spots = &needs.spots;
        let reach = spots.iter().map(|s| s.radius).fold(f32::MIN_POSITIVE, f32::max);
        let places: Vec<Vec3> = spots.iter().map(|s| s.p).collect();
        let landings: Vec<&Landing> = paths.iter().flat_map(|p| &p.landings).collect();
        let landed: Vec<Vec3> = landings.iter().map(|l| l.p).collect();
        let photons = PointGrid::build(&landed, reach);
        let irradiance = |s: &Spot| {
            let mut sum = 0.0;
            photons.within(s.p, s.radius, |i, _| sum += s.receives(landings[i as usize]));
            sum + if direct { 0.0 } else { s.direct }
        };
        let irradiance: Vec<f32> = spots.par_iter().map(irradiance).collect();
        let darkest = DARKEST * irradiance.iter().sum::<f32>() / spots.len().max(1) as f32;
        Self { spots, grid: PointGrid::build(&places, reach), reach, irradiance, darkest }
    }
    /// The paths that are worth something.
    fn judge(&self, paths: Vec<Path>, count: u64) -> Vec<Trial> {
        let worth = |path: Path| {
            let sum: f64 = path.landings.iter().map(|l| self.square(l)).sum();
            let square = sum * (path.trial.pdf * count as f64).powi(2);
            (square > 0.0).then_some(Trial { square, ..path.trial })
        };
        paths.into_par_iter().filter_map(worth).collect()
    }
    fn square(&self, l: &Landing) -> f64 {
        let mut sum = 0.0;
        self.grid.within(l.p, self.reach, |i, d2| {
            let s = &self.spots[i as usize];
            if d2 <= s.radius * s.radius {
                // Without the photon itself: one that is far too bright must not hide in its own light.
                let e = s.receives(l);
                sum += f64::from(e / (self.irradiance[i as usize] - e).max(self.darkest)).powi(2);
            }
        });
        sum
    }
}

impl Spot {
    /// Irradiance that a photon within reach gives.
    fn receives(&self, l: &Landing) -> f32 {
        let near = self.n.dot(l.wi) > 0.0;
        if near { l.flux / (std::f32::consts::PI * self.radius * self.radius) } else { 0.0 }
    }
}
