//! Radii that fit the light: smaller where photons do not lie evenly within a gather, a little larger where they do.
//!
//! After Lin et al. 2020, "CPPM: Chi-squared Progressive Photon Mapping", who test each gather's photons for an even spread.
//! Here the test belongs to a training, tile by tile of the picture, and what it finds is kept: passes stay pure functions.
use super::{Keep, Radii, RadiusMap, Shower, Source, sight::Sight};
use crate::{
    math::Frame,
    sampler::{Domain, Sampler},
    scene::{Interaction, MID_SHUTTER, Scene, World},
    spectrum::Wavelengths,
    walk::Limits,
};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

/// What a training of radii needs.
#[derive(Clone, Copy)]
pub struct Evenness<'s> {
    /// Where light paths start.
    pub source: &'s Source,
    /// When whole paths end.
    pub limits: Limits,
    /// The user's seed.
    pub seed: u64,
    /// Light paths of a round, > 0.
    pub paths: u64,
}

/// Rounds of photons, each tested with the radii that the last one led to.
const ROUNDS: u64 = 5;
/// Gathers tested in a tile each round.
const GATHERS: u64 = 4;
/// A radius where the photons are uneven, and where they are not, over the one that was tested.
const STEPS: [f32; 2] = [0.7, 1.15];
/// Radii over the first ones.
const BOUNDS: [f32; 2] = [1.0 / 16.0, 2.0];
/// Parts of a disc, of equal area: inside and outside, by quarters.
const PARTS: usize = 8;
/// Photons of a gather that can be tested, at least.
const ENOUGH: u32 = 24;

/// A photon as the test sees it.
#[derive(Clone, Copy)]
struct Spot {
    p: Vec3,
    wi: Vec3,
}

impl Radii {
    /// Fits the radii to the light of `scene`; a function of scene, radii and settings.
    pub fn fitted(self, scene: &Scene, how: &Evenness) -> Self {
        let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
        let centres = self.centres();
        let mut factors = vec![1.0f32; centres.len()];
        for round in 0..ROUNDS {
            let map = how.shoot(&world, round, self.typical());
            let next = |(i, (centre, factor)): (usize, (&(Vec2, Vec2), &f32))| {
                let radius = self.at(centre.0) * factor;
                match how.is_even(&world, &map, round * centres.len() as u64 + i as u64, *centre, radius) {
                    Some(even) => (factor * STEPS[usize::from(even)]).clamp(BOUNDS[0], BOUNDS[1]),
                    None => *factor,
                }
            };
            factors = centres.par_iter().zip(&factors).enumerate().map(next).collect();
        }
        self.times(&factors)
    }
}

impl Evenness<'_> {
    fn shoot(&self, world: &World, round: u64, radius: f32) -> RadiusMap<Spot> {
        let shower = Shower {
            seed: self.seed,
            domain: Domain::Prepare,
            pass: u64::MAX - 16 - round,
            first: 0,
            paths: self.paths,
            keep: Keep::Scattered,
            limits: self.limits,
        };
        let catch = shower.shoot(world, self.source);
        let spots: Vec<Spot> =
            catch.positions.iter().zip(&catch.photons).map(|(p, photon)| Spot { p: *p, wi: photon.wi }).collect();
        RadiusMap::new(&catch.positions, &spots, radius)
    }

    /// Whether the gathers of a tile find photons that might be spread evenly: the sum of their χ² statistics is below the 95 %
    /// quantile. `None` if there is too little to test.
    fn is_even(&self, world: &World, map: &RadiusMap<Spot>, n: u64, tile: (Vec2, Vec2), radius: f32) -> Option<bool> {
        let (mut chi2, mut degrees) = (0.0, 0.0);
        for g in 0..GATHERS {
            let mut sampler = Sampler::new(self.seed, Domain::Prepare, u64::MAX - 2, n * GATHERS + g);
            let raster = tile.0 + (sampler.next_2d() - 0.5) * tile.1;
            let u_lens = sampler.next_2d();
            let seen = Sight::find(world, self.limits, raster, u_lens, &mut sampler);
            let Some(parts) = seen.and_then(|s| count(map, &s.at, radius)) else { continue };
            let expected = f64::from(parts.iter().sum::<u32>()) / PARTS as f64;
            chi2 += parts.iter().map(|n| (f64::from(*n) - expected).powi(2) / expected).sum::<f64>();
            degrees += PARTS as f64 - 1.0;
        }
        (degrees > 0.0).then(|| chi2 < chi2_quantile(degrees))
    }
}

/// Photons in each part of the disc at `at`; `None` if they are few.
fn count(map: &RadiusMap<Spot>, at: &Interaction, radius: f32) -> Option<[u32; PARTS]> {
    let frame = Frame::from_normal(at.ng);
    let (mut parts, side) = ([0; PARTS], at.near_side());
    map.within(at.p, radius, |spot, d2| {
        if side.cos_and_ratio(spot.wi).is_some() {
            let d = spot.p - at.p;
            let quarter = usize::from(d.dot(frame.s) > 0.0) + 2 * usize::from(d.dot(frame.t) > 0.0);
            parts[quarter + 4 * usize::from(2.0 * d2 > radius * radius)] += 1;
        }
    });
    (parts.iter().sum::<u32>() >= ENOUGH).then_some(parts)
}

/// The 95 % quantile of χ² with `k` degrees of freedom (Wilson & Hilferty 1931).
fn chi2_quantile(k: f64) -> f64 {
    let v = 2.0 / (9.0 * k);
    k * (1.0 - v + 1.644_854 * v.sqrt()).powi(3)
}

#[cfg(test)]
mod tests {
    use super::chi2_quantile;

    #[test]
    fn quantiles_are_those_of_tables() {
        // Abramowitz & Stegun, table 26.8.
        for (k, q) in [(7.0, 14.0671), (14.0, 23.6848), (28.0, 41.3372)] {
            assert!((chi2_quantile(k) / q - 1.0).abs() < 2e-3, "{k}: {}", chi2_quantile(k));
        }
    }
}
