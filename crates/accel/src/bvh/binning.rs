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

/// `K` bins on each axis: the boxes around what they hold, and how much that is.
#[derive(Clone, Copy)]
struct Bins<const K: usize> {
    boxes: [[Corners; K]; 3],
    counts: [[u32; K]; 3],
}

/// Maps a doubled centre to a bin on each axis.
#[derive(Clone, Copy)]
struct Grid {
    origin: Vec4,
    scale: Vec4,
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
    grid: Grid,
    axis: usize,
    /// First bin of the right side.
    bin: usize,
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
            Bins::<K>::filled(refs, &grid, level).best(grid)
        }
    }

    /// Moves the left side to the front; returns its length and the boxes around the doubled centres of both sides.
    pub(super) fn partition(&self, refs: &mut [Ref], level: SimdLevel) -> (usize, [Bounds; 2]) {
        match level {
            SimdLevel::Portable => self.partition_with(refs),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: the processor was asked.
            SimdLevel::Avx2 | SimdLevel::Avx512 => unsafe { self.partition_avx2(refs) },
            #[cfg(not(target_arch = "x86_64"))]
            _ => self.partition_with(refs),
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn partition_avx2(&self, refs: &mut [Ref]) -> (usize, [Bounds; 2]) {
        self.partition_with(refs)
    }

    /// Without branches, as nothing foretells to which side a reference goes.
    #[inline(always)]
    fn partition_with(&self, refs: &mut [Ref]) -> (usize, [Bounds; 2]) {
        let (origin, scale, bin) = (self.grid.origin[self.axis], self.grid.scale[self.axis], self.bin as f32);
        let mut centres = [Corners::EMPTY; 2];
        let mut middle = 0;
        for i in 0..refs.len() {
            let reference = refs[i];
            let centre = reference.0[self.axis] - reference.0[self.axis + 4];
            let is_left = (centre - origin) * scale < bin;
            let centre = Corners::point(reference.centre2());
            centres[0].grow(&centre.plus([f32::INFINITY, 0.0][usize::from(is_left)]));
            centres[1].grow(&centre.plus([0.0, f32::INFINITY][usize::from(is_left)]));
            refs[i] = refs[middle];
            refs[middle] = reference;
            middle += usize::from(is_left);
        }
        (middle, centres.map(|side| side.bounds()))
    }
}

impl<const K: usize> Bins<K> {
    const EMPTY: Self = Self { boxes: [[Corners::EMPTY; K]; 3], counts: [[0; K]; 3] };

    fn filled(refs: &[Ref], grid: &Grid, level: SimdLevel) -> Self {
        let mut bins = Self::EMPTY;
        match level {
            SimdLevel::Portable => bins.fill(refs, grid),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: the processor was asked.
            SimdLevel::Avx2 | SimdLevel::Avx512 => unsafe { bins.fill_avx2(refs, grid) },
            #[cfg(not(target_arch = "x86_64"))]
            _ => bins.fill(refs, grid),
        }
        bins
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn fill_avx2(&mut self, refs: &[Ref], grid: &Grid) {
        self.fill(refs, grid);
    }

    #[inline(always)]
    fn fill(&mut self, refs: &[Ref], grid: &Grid) {
        for reference in refs {
            for (axis, bin) in grid.bins(reference).into_iter().enumerate() {
                self.boxes[axis][bin & (K - 1)].grow(&Corners(reference.0));
                self.counts[axis][bin & (K - 1)] += 1;
            }
        }
    }

    fn plus(mut self, other: Self) -> Self {
        for axis in 0..3 {
            for bin in 0..K {
                self.boxes[axis][bin].grow(&other.boxes[axis][bin]);
                self.counts[axis][bin] += other.counts[axis][bin];
            }
        }
        self
    }

    /// The cheapest split, if there is one.
    fn best(&self, grid: Grid) -> Option<ObjectSplit> {
        let splits = (0..3).filter(|&axis| grid.scale[axis] > 0.0).filter_map(|axis| Some((axis, self.sweep(axis)?)));
        let (axis, (bin, cost)) = splits.reduce(|best, other| if other.1.1 < best.1.1 { other } else { best })?;
        let (left, right) = self.boxes[axis].split_at(bin);
        let around = |boxes: &[Corners]| boxes.iter().fold(Corners::EMPTY, Corners::union).bounds();
        Some(ObjectSplit { grid, axis, bin, cost, sides: [around(left), around(right)] })
    }

    /// The best first bin of the right side on one axis, and what it costs.
    fn sweep(&self, axis: usize) -> Option<(usize, f32)> {
        let (boxes, counts) = (&self.boxes[axis], &self.counts[axis]);
        let mut right = [0.0; K];
        let (mut around, mut count) = (Corners::EMPTY, 0);
        for i in (1..K).rev() {
            around.grow(&boxes[i]);
            count += counts[i];
            right[i] = if count == 0 { f32::INFINITY } else { around.half_area() * blocks_for(count) as f32 };
        }
        let mut best: Option<(usize, f32)> = None;
        (around, count) = (Corners::EMPTY, 0);
        for i in 1..K {
            around.grow(&boxes[i - 1]);
            count += counts[i - 1];
            if count == 0 {
                continue;
            }
            let cost = around.half_area() * blocks_for(count) as f32 + right[i];
            if cost < best.map_or(f32::INFINITY, |b| b.1) {
                best = Some((i, cost));
            }
        }
        best
    }
}
