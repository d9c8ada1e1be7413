//! Where radii are tried.
use super::Bandwidth;
use crate::{
    film::FilmSpec,
    photon::{Radii, sight::Sight},
    sampler::{Domain, Sampler},
    scene::World,
};
use rayon::prelude::*;

/// A place that gathers.
#[derive(Clone, Copy)]
pub(super) struct Spot {
    pub(super) seen: Sight,
    /// Of the radii.
    pub(super) tile: usize,
    /// Radius (world units) before the ladder.
    pub(super) radius: f32,
}

/// Makes spots.
pub(super) struct Spots;

impl Spots {
    /// `count` in each tile, where camera paths meet something to gather at.
    pub(super) fn every_tile(world: &World, radii: &Radii, how: &Bandwidth, count: u64) -> Vec<Spot> {
        let centres = radii.centres();
        let find = |n: u64| {
            let tile = (n / count) as usize;
            let (middle, size) = centres[tile];
            let mut sampler = Sampler::new(how.seed, Domain::Prepare, u64::MAX - 3, n);
            let raster = middle + (sampler.next_2d() - 0.5) * size;
            let u_lens = sampler.next_2d();
            let seen = Sight::find(world, how.limits, raster, u_lens, &mut sampler)?;
            Some(Spot { seen, tile, radius: radii.at(raster) })
        };
        (0..centres.len() as u64 * count).into_par_iter().filter_map(find).collect()
    }
    /// About `count`, spread over the picture.
    pub(super) fn some(world: &World, radii: &Radii, how: &Bandwidth, count: usize) -> Vec<Spot> {
        let per_tile = count.div_ceil(radii.len()) as u64;
        let all = Self::every_tile(world, radii, how, per_tile);
        let step = all.len().div_ceil(count).max(1);
        all.into_iter().step_by(step).collect()
    }
    /// The radius in the middle of all, in widths of a pixel; `None` without spots.
    pub(super) fn typical_width(spots: &[Spot], spec: FilmSpec) -> Option<f32> {
        let mut widths: Vec<f32> = spots.iter().map(|s| s.radius / s.seen.width(spec)).collect();
        widths.sort_by(f32::total_cmp);
        widths.get(widths.len() / 2).copied().filter(|w| w.is_finite() && *w > 0.0)
    }
}
