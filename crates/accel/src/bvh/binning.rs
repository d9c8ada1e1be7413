//! Object splits: which of a few planes best divides the references by their centres.
//!
//! Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".

use super::{
    collapse::blocks_for,
    refs::{Bounds, Corners, Ref},
    simd::SimdLevel,
};
use glam::Vec4;
use rayon::prelude::*;

/// Ranges longer than this are binned by several threads.
const PARALLEL: usize = 1 << 15;
/// From so many references on they go to two sets of bins in turn: neighbours mostly have the same bin, and the second would
/// wait for the first.
const TWO_SETS: usize = 256;

/// `K` bins on each axis: the boxes around what they hold, and how much that is.
#[derive(Clone, Copy)]
struct Bins<const K: usize> {
    boxes: [[Corners; K]; 3],
    counts: [[u32; K]; 3],
}

/// Maps a doubled centre to a bin on each axis.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    pub(super) origin: Vec4,
    pub(super) scale: Vec4,
    last: Vec4,
}

impl Grid {
    fn new(centres: &Bounds, bins: usize) -> Self {
        let [x, y, z, _] = (centres.hi - centres.lo).to_array();
        let scale = [x, y, z, 0.0].map(|e| if e > 0.0 { bins as f32 / e } else { 0.0 });
        // A subnormal extent makes the quotient infinite.
        let scale = scale.map(|s| if s.is_finite() { s } else { 0.0 });
        Self { origin: centres.lo, scale: Vec4::from(scale), last: Vec4::splat(bins as f32 - 1.0) }
    }

    #[inline(always)]
    fn bins(&self, reference: &Ref) -> [usize; 3] {
        let x = ((reference.centre2() - self.origin) * self.scale).min(self.last).to_array();
        // SAFETY: the grid starts at the smallest centre and its scale is finite, so these are numbers from 0 to `last`.
        [x[0], x[1], x[2]].map(|x| unsafe { x.to_int_unchecked::<i32>() } as usize)
    }
}

/// A way to divide a range of references in two.
pub(super) struct ObjectSplit {
    pub(super) grid: Grid,
    pub(super) axis: usize,
    /// First bin of the right side.
    pub(super) bin: usize,
    /// Sum over the sides of half surface times number of blocks.
    pub(super) cost: f32,
    /// The boxes of both sides.
    pub(super) sides: [Bounds; 2],
}

impl ObjectSplit {
    /// The cheapest split, or `None` if all centres coincide.
    pub(super) fn find(refs: &[Ref], centres: &Bounds, level: SimdLevel) -> Option<Self> {
        // With few references, clearing and sweeping many bins would take longer than filling them.
        match refs.len() {
            0..8 => Self::find_with::<4>(refs, centres, level),
            8..32 => Self::find_with::<8>(refs, centres, level),
            _ => Self::find_with::<16>(refs, centres, level),
        }
    }

    fn find_with<const K: usize>(refs: &[Ref], centres: &Bounds, level: SimdLevel) -> Option<Self> {
        let grid = Grid::new(centres, K);
        if refs.len() > PARALLEL {
            let parts = refs.par_chunks(PARALLEL / 4).map(|chunk| Bins::<K>::filled(chunk, &grid, level));
            parts.reduce(|| Bins::EMPTY, Bins::plus).best(grid)
        } else {
            Bins::<K>::best_of(refs, grid, level)
        }
    }
}

impl<const K: usize> Bins<K> {
    const EMPTY: Self = Self { boxes: [[Corners::EMPTY; K]; 3], counts: [[0; K]; 3] };

    fn filled(refs: &[Ref], grid: &Grid, level: SimdLevel) -> Self {
        match level {
            SimdLevel::Portable => Self::fill(refs, grid),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: the builder takes the level from `SimdLevel::detect`.
            SimdLevel::Avx2 | SimdLevel::Avx512 => unsafe { Self::fill_avx2(refs, grid) },
            #[cfg(not(target_arch = "x86_64"))]
            _ => Self::fill(refs, grid),
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn fill_avx2(refs: &[Ref], grid: &Grid) -> Self {
        Self::fill(refs, grid)
    }

    #[inline(always)]
    fn fill(refs: &[Ref], grid: &Grid) -> Self {
        let mut bins = Self::EMPTY;
        let (pairs, rest) = if refs.len() < TWO_SETS { refs.split_at(0) } else { refs.split_at(refs.len() & !1) };
        for reference in rest {
            bins.add(reference, grid);
        }
        if pairs.is_empty() {
            return bins;
        }
        let mut others = Self::EMPTY;
        for pair in pairs.chunks_exact(2) {
            bins.add(&pair[0], grid);
            others.add(&pair[1], grid);
        }
        bins.plus(others)
    }

    #[inline(always)]
    fn add(&mut self, reference: &Ref, grid: &Grid) {
        for (axis, bin) in grid.bins(reference).into_iter().enumerate() {
            self.boxes[axis][bin & (K - 1)].grow(&Corners(reference.0));
            self.counts[axis][bin & (K - 1)] += 1;
        }
    }

    #[inline(always)]
    fn plus(mut self, other: Self) -> Self {
        for axis in 0..3 {
            for bin in 0..K {
                self.boxes[axis][bin].grow(&other.boxes[axis][bin]);
                self.counts[axis][bin] += other.counts[axis][bin];
            }
        }
        self
    }

    /// The cheapest split of references that one thread looks at.
    fn best_of(refs: &[Ref], grid: Grid, level: SimdLevel) -> Option<ObjectSplit> {
        match level {
            SimdLevel::Portable => Self::fill(refs, &grid).best(grid),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: the builder takes the level from `SimdLevel::detect`.
            SimdLevel::Avx2 | SimdLevel::Avx512 => unsafe { Self::best_of_avx2(refs, grid) },
            #[cfg(not(target_arch = "x86_64"))]
            _ => Self::fill(refs, &grid).best(grid),
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn best_of_avx2(refs: &[Ref], grid: Grid) -> Option<ObjectSplit> {
        Self::fill(refs, &grid).best(grid)
    }

    /// The cheapest split, if there is one.
    #[inline(always)]
    fn best(&self, grid: Grid) -> Option<ObjectSplit> {
        let (mut axis, mut bin, mut cost) = (0, 0, f32::INFINITY);
        for other in 0..3 {
            if grid.scale[other] > 0.0 {
                let (at, least) = self.sweep(other);
                if least < cost {
                    (axis, bin, cost) = (other, at, least);
                }
            }
        }
        if bin == 0 {
            return None;
        }
        let mut sides = [Corners::EMPTY; 2];
        for (i, corners) in self.boxes[axis].iter().enumerate() {
            sides[usize::from(i >= bin)].grow(corners);
        }
        Some(ObjectSplit { grid, axis, bin, cost, sides: [sides[0].bounds(), sides[1].bounds()] })
    }

    /// The best first bin of the right side on one axis, and what it costs: infinitely much if there is none.
    #[inline(always)]
    fn sweep(&self, axis: usize) -> (usize, f32) {
        let (boxes, counts) = (&self.boxes[axis], &self.counts[axis]);
        let mut right = [0.0; K];
        let (mut around, mut count) = (Corners::EMPTY, 0);
        for i in (1..K).rev() {
            around.grow(&boxes[i]);
            count += counts[i];
            right[i] = if count == 0 { f32::INFINITY } else { around.half_area() * blocks_for(count) as f32 };
        }
        let mut best = (0, f32::INFINITY);
        (around, count) = (Corners::EMPTY, 0);
        for i in 1..K {
            around.grow(&boxes[i - 1]);
            count += counts[i - 1];
            let left = if count == 0 { f32::INFINITY } else { around.half_area() * blocks_for(count) as f32 };
            if left + right[i] < best.1 {
                best = (i, left + right[i]);
            }
        }
        best
    }
}
