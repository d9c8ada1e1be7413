//! Photons beside an index of their positions.
use super::{Catch, Photon};
use accel::{KdTree, Neighbours, PointGrid};
use glam::Vec3;
use rayon::prelude::*;

/// Finds all photons within a radius.
pub struct RadiusMap<P = Photon> {
    grid: PointGrid,
    /// In the order of the grid's slots, so that neighbours in space are neighbours in memory.
    photons: Vec<P>,
}

impl<P: Copy + Send + Sync> RadiusMap<P> {
    /// Sorts `photons` at `positions` for queries of about `radius` (world units, positive and finite); others work, but
    /// slower.
    pub fn new(positions: &[Vec3], photons: &[P], radius: f32) -> Self {
        let grid = PointGrid::build(positions, 1.5 * radius);
        let photons = grid.order().par_iter().map(|&i| photons[i as usize]).collect();
        Self { grid, photons }
    }
    /// Calls `visit(photon, d2)` for every photon at squared distance `d2 <= r·r` from `p`.
    #[inline]
    pub fn within(&self, p: Vec3, r: f32, mut visit: impl FnMut(&P, f32)) {
        self.grid.within_slots(p, r, |slot, d2| visit(&self.photons[slot as usize], d2));
    }
    /// Photons held.
    pub fn len(&self) -> usize {
        self.photons.len()
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.photons.is_empty()
    }
}

/// Photons asked for [`NearestMap::spacing`]: the median to about 5 %.
const SPACING_SAMPLES: usize = 256;

/// Finds the photons nearest to a place.
pub struct NearestMap {
    tree: KdTree,
    positions: Vec<Vec3>,
    photons: Vec<Photon>,
}

impl NearestMap {
    /// Indexes a catch.
    pub fn new(catch: Catch) -> Self {
        Self { tree: KdTree::build(&catch.positions), positions: catch.positions, photons: catch.photons }
    }
    /// Fills `out` with the up to `k` photons nearest to `p` among those within `r_max`, nearest first.
    #[inline]
    pub fn nearest(&self, p: Vec3, k: usize, r_max: f32, out: &mut Neighbours) {
        self.tree.nearest(p, k, r_max, out);
    }
    /// As [`NearestMap::nearest`], but only the farthest has its place, at the end; for sums over all of them.
    #[inline]
    pub fn nearest_unordered(&self, p: Vec3, k: usize, r_max: f32, out: &mut Neighbours) {
        self.tree.nearest_unordered(p, k, r_max, out);
    }
    /// The median distance from a photon to the `k`-th nearest (itself counted; to the farthest if there are fewer), over
    /// an even choice of photons. `None` without photons, or where most of them coincide.
    pub fn spacing(&self, k: usize) -> Option<f32> {
        let step = self.positions.len().div_ceil(SPACING_SAMPLES).max(1);
        let mut distances: Vec<f32> = self
            .positions
            .par_iter()
            .step_by(step)
            .map_init(Neighbours::new, |found, &p| {
                self.nearest(p, k, f32::MAX, found);
                found.farthest().map_or(0.0, |(_, d2)| d2.sqrt())
            })
            .collect();
        distances.sort_by(f32::total_cmp);
        distances.get(distances.len() / 2).copied().filter(|d| *d > 0.0)
    }
    /// The photon that an answer of [`NearestMap::nearest`] calls `index`.
    #[inline]
    pub fn photon(&self, index: u32) -> &Photon {
        &self.photons[index as usize]
    }
    /// Photons held.
    pub fn len(&self) -> usize {
        self.photons.len()
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.photons.is_empty()
    }
}
