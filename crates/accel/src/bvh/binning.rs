//! Object splits: which of a few planes best divides the references by their centres.
//!
//! Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".

use super::{
    collapse::blocks_for,
    refs::{Bounds, Ref, xyz},
};
use glam::Vec4;
use rayon::prelude::*;

/// Ranges longer than this are binned by several threads.
const PARALLEL: usize = 1 << 16;

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    count: u32,
}

impl Bin {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, count: 0 };
}

/// `K` bins on each axis.
type Bins<const K: usize> = [[Bin; K]; 3];

/// Maps a doubled centre to a bin on each axis.
#[derive(Clone, Copy)]
struct Grid {
    origin: Vec4,
    scale: Vec4,
    last: Vec4,
}

impl Grid {
    fn new(centres: &Bounds, bins: usize) -> Self {
        let extent = xyz(centres.hi - centres.lo);
        let scale = extent.to_array().map(|e| if e > 0.0 { bins as f32 / e } else { 0.0 });
        // A subnormal extent makes the quotient infinite.
        let scale = scale.map(|s| if s.is_finite() { s } else { 0.0 });
        Self { origin: centres.lo, scale: Vec4::from(scale), last: Vec4::splat(bins as f32 - 1.0) }
    }

    #[inline(always)]
    fn bins(&self, reference: &Ref) -> [usize; 3] {
        let x = ((reference.centre2() - self.origin) * self.scale).min(self.last).to_array();
        [x[0] as i32 as usize, x[1] as i32 as usize, x[2] as i32 as usize]
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
}

impl ObjectSplit {
    /// The cheapest split, or `None` if all centres coincide.
    pub(super) fn find(refs: &[Ref], centres: &Bounds) -> Option<Self> {
        // With few references, clearing and sweeping many bins would take longer than filling them.
        match refs.len() {
            0..8 => Self::find_with::<4>(refs, centres),
            8..32 => Self::find_with::<8>(refs, centres),
            _ => Self::find_with::<16>(refs, centres),
        }
    }

    fn find_with<const K: usize>(refs: &[Ref], centres: &Bounds) -> Option<Self> {
        let grid = Grid::new(centres, K);
        let mut bins: Bins<K> = [[Bin::EMPTY; K]; 3];
        if refs.len() > PARALLEL {
            let parts = refs.par_chunks(PARALLEL / 4).map(|chunk| {
                let mut bins = [[Bin::EMPTY; K]; 3];
                fill(chunk, &grid, &mut bins);
                bins
            });
            bins = parts.reduce(|| [[Bin::EMPTY; K]; 3], merge);
        } else {
            fill(refs, &grid, &mut bins);
        }
        let splits = (0..3).filter(|&axis| grid.scale[axis] > 0.0).filter_map(|axis| sweep(&bins[axis], grid, axis));
        splits.reduce(|best, other| if other.cost < best.cost { other } else { best })
    }

    #[inline(always)]
    pub(super) fn is_left(&self, reference: &Ref) -> bool {
        self.grid.bins(reference)[self.axis] < self.bin
    }
}

fn fill<const K: usize>(refs: &[Ref], grid: &Grid, bins: &mut Bins<K>) {
    for reference in refs {
        let bounds = reference.bounds();
        for (axis, bin) in grid.bins(reference).into_iter().enumerate() {
            let bin = &mut bins[axis][bin & (K - 1)];
            bin.bounds.grow(&bounds);
            bin.count += 1;
        }
    }
}

fn merge<const K: usize>(mut a: Bins<K>, b: Bins<K>) -> Bins<K> {
    for (a, b) in a.iter_mut().flatten().zip(b.iter().flatten()) {
        a.bounds.grow(&b.bounds);
        a.count += b.count;
    }
    a
}

fn sweep<const K: usize>(bins: &[Bin; K], grid: Grid, axis: usize) -> Option<ObjectSplit> {
    let mut right = [0.0; K];
    let (mut bounds, mut count) = (Bounds::EMPTY, 0);
    for i in (1..K).rev() {
        bounds.grow(&bins[i].bounds);
        count += bins[i].count;
        right[i] = if count == 0 { f32::INFINITY } else { bounds.half_area() * blocks_for(count) as f32 };
    }
    let mut best: Option<(usize, f32)> = None;
    (bounds, count) = (Bounds::EMPTY, 0);
    for i in 1..K {
        bounds.grow(&bins[i - 1].bounds);
        count += bins[i - 1].count;
        if count == 0 {
            continue;
        }
        let cost = bounds.half_area() * blocks_for(count) as f32 + right[i];
        if cost < best.map_or(f32::INFINITY, |b| b.1) {
            best = Some((i, cost));
        }
    }
    best.map(|(bin, cost)| ObjectSplit { grid, axis, bin, cost })
}
