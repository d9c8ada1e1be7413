//! Light paths near those that gathers reach, by Markov chains (after Hachisuka & Jensen 2011, "Robust Adaptive Photon Tracing
//! Using Photon Path Visibility").
//!
//! A chain walks through the numbers that light paths are made of. It stays where photons are seen: its target density is 1 for
//! paths with a photon near a place that camera paths gather at, and a small floor elsewhere, so that what a sample of those
//! places misses is found all the same. Chains start from plain light paths, each with the target's value as probability.
//! A chain that starts so has the target's distribution at every step, and the mean number of chains is the target's integral, so
//!
//! ```text
//! E[ 1/(paths · length) · Σ over chains, Σ over steps: f / target ] = ∫ f
//! ```
//!
//! for any `f` of a light path, passes of any length included: there is no factor to be estimated (the paper counts visible
//! paths for it) and no warming up (Veach 1997, section 11.3, starts chains this way). Passes remain pure functions.
use super::{Job, Merge, Prepared, light::Chunk, plan::Plan, vertex::Photon};
use crate::{
    film::FilmSpec,
    integrator::Pass,
    photon::{RadiusMap, Sight},
    sampler::{Domain, Moves, Sampler},
    scene::{MID_SHUTTER, Scene},
    spectrum::Wavelengths,
    walk::Limits,
};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

/// How light paths are chained.
pub(super) struct Chains {
    target: Target,
    /// Paths in a chain.
    pub(super) length: u32,
}

/// Camera paths that tell where gathers happen, at most.
const SIGHTS: u64 = 1 << 16;
/// Light paths of the training.
const TRIALS: u64 = 1 << 14;
/// Part of a pass's light paths that try to start chains.
const STARTS: f64 = 0.5;
/// If more of the plain light paths are seen, chains gain nothing.
const MOST_SEEN: f64 = 0.25;
/// The floor over the part of plain paths that are seen: chains spend a fifth of their steps on the rest.
const FLOOR: f64 = 0.25;
/// Steps of a chain at most.
const LONGEST: f64 = 65_536.0;
/// A place stands for those around it, as far as the next places of camera paths, so many times over.
const BETWEEN: f32 = 2.0;

/// What chains seek.
struct Target {
    seen: RadiusMap<Seen>,
    /// How far queries look.
    reach: f32,
    floor: f32,
}

/// A place where photons are gathered.
#[derive(Clone, Copy)]
struct Seen {
    reach2: f32,
    /// Photons of all kinds, not only those of caustics.
    all: bool,
}

impl Target {
    fn new(scene: &Scene, spec: FilmSpec, limits: Limits, seed: u64, prepared: &Prepared) -> Option<Self> {
        let world = &scene.world(Wavelengths::Rgb, MID_SHUTTER);
        let count = (spec.pixels() as u64).min(SIGHTS);
        let between = BETWEEN * (spec.pixels() as f32 / count as f32).sqrt();
        let merge = |raster: Vec2| prepared.plan.as_ref().map_or(prepared.engine.on.merge, |p: &Plan| p.at(raster));
        let find = |n: u64| {
            let mut sampler = Sampler::new(seed, Domain::Prepare, u64::MAX - 4, n);
            let (raster, u_lens) = (sampler.next_2d(), sampler.next_2d());
            let merge = merge(raster);
            let sight = Sight::find(world, limits, raster, u_lens, &mut sampler).filter(|_| merge.is_on())?;
            let reach = prepared.radii.at(raster).max(between * sight.width(spec));
            Some((sight.at.p, Seen { reach2: reach * reach, all: merge != Merge::Caustic }))
        };
        let (places, seen): (Vec<Vec3>, Vec<Seen>) = (0..count).into_par_iter().filter_map(find).unzip();
        let mut reaches: Vec<f32> = seen.iter().map(|s| s.reach2.sqrt()).collect();
        reaches.sort_by(f32::total_cmp);
        // Wider ones than most would make queries slow; the floor makes up for what they miss.
        let reach = *reaches.get(reaches.len() * 9 / 10)?;
        Some(Self { seen: RadiusMap::new(&places, &seen, reach), reach, floor: 0.0 })
    }
    /// The target density of a path that left these photons.
    fn of(&self, positions: &[Vec3], photons: &[Photon]) -> f32 {
        let is_seen = |(p, photon): (&Vec3, &Photon)| {
            let mut found = false;
            self.seen.within(*p, self.reach, |s, d2| found |= d2 <= s.reach2 && (s.all || photon.caustic));
            found
        };
        if positions.iter().zip(photons).any(is_seen) { 1.0 } else { self.floor }
    }
}

impl Chains {
    /// Walks a chain if `start` begins one: `follow` leaves the photons of a path behind in a chunk, and `out` gets those of
    /// all steps, each over the target.
    pub(super) fn walk(
        &self,
        start: &Sampler,
        random: &mut Sampler,
        out: &mut Chunk,
        follow: impl Fn(&Sampler, &mut Chunk),
    ) {
        let of = |c: &Chunk| self.target.of(&c.positions, &c.photons);
        let (mut now, mut next) = (Chunk::default(), Chunk::default());
        follow(start, &mut now);
        let mut target = of(&now);
        if random.next_1d() >= target {
            out.counts += now.counts;
            return;
        }
        let mut moves = Moves::none();
        let mut steps = 1.0;
        for _ in 1..self.length {
            let moved = moves.step(random);
            next.clear();
            follow(&start.moved(&moved), &mut next);
            let proposed = of(&next);
            if random.next_1d() * target < proposed {
                out.take(&now, steps / target);
                std::mem::swap(&mut now, &mut next);
                (moves, target, steps) = (moved, proposed, 1.0);
            } else {
                out.counts += next.counts;
                steps += 1.0;
            }
        }
        out.take(&now, steps / target);
    }
}

impl Prepared<'_> {
    /// Sets chains up, if a training finds that few plain light paths are seen. A pass goes on to walk about as many paths.
    pub(super) fn link(&mut self, spec: FilmSpec, seed: u64) {
        let limits = self.engine.limits;
        let Some(mut target) = Target::new(self.scene, spec, limits, seed, self) else { return };
        let world = &self.scene.world(Wavelengths::Rgb, MID_SHUTTER);
        let trials = self.paths.min(TRIALS);
        let pass = Pass::new(seed ^ 0x6368_6169, 0);
        let job = Job { pass, only: None, plan: self.plan.as_ref(), paths: 0..trials, sample: 0, share: 1.0 };
        let shower = self.shower(&job, world, self.rule(trials), 1.0, spec);
        let is_seen = |c: &Chunk| target.of(&c.positions, &c.photons) == 1.0;
        let seen =
            (0..trials).into_par_iter().filter(|&path| is_seen(&shower.path(path))).count() as f64 / trials as f64;
        if seen == 0.0 || seen > MOST_SEEN {
            return;
        }
        let floor = FLOOR * seen;
        let chained = seen + floor * (1.0 - seen);
        let length = ((1.0 - STARTS) / STARTS / chained).clamp(1.0, LONGEST) as u32 + 1;
        target.floor = floor as f32;
        self.paths = ((self.paths as f64 * STARTS) as u64).max(1);
        self.chains = Some(Chains { target, length });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{integrator::engine::vertex::LightSums, spectrum::Spectrum};

    /// Leaves one photon in the unit square, of flux x + 3y².
    fn follow(sampler: &Sampler, out: &mut Chunk) {
        let mut sampler = *sampler;
        let u = sampler.next_2d();
        let sums = LightSums { vcm: 0.0, vc: 0.0, vm: 0.0, geometry: 0.0 };
        let flux = Spectrum::splat(u.x + 3.0 * u.y * u.y);
        out.positions.push(u.extend(0.0));
        out.photons.push(Photon { flux, wi: Vec3::Z, scatterings: 1, dispersed: false, caustic: false, sums });
    }

    #[test]
    fn chains_sum_up_to_the_integral_whatever_they_seek() {
        let seen = Seen { reach2: 0.01, all: true };
        let seen = RadiusMap::new(&[Vec3::new(0.3, 0.6, 0.0)], &[seen], 0.1);
        let chains = Chains { target: Target { seen, reach: 0.1, floor: 0.05 }, length: 20 };
        let paths = 40_000;
        let sums: Vec<f64> = (0..paths)
            .map(|path| {
                let mut out = Chunk::default();
                let mut random = Sampler::new(1, Domain::Chain, 0, path);
                chains.walk(&Sampler::new(1, Domain::Light, 0, path), &mut random, &mut out, follow);
                out.photons.iter().map(|p| f64::from(p.flux.lanes()[0])).sum::<f64>() / f64::from(chains.length)
            })
            .collect();
        let n = paths as f64;
        let mean = sums.iter().sum::<f64>() / n;
        let error = (sums.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / (n * (n - 1.0))).sqrt();
        assert!(error < 0.05 && (mean - 1.5).abs() < 4.0 * error, "{mean} ± {error}, not 1.5");
    }
}
