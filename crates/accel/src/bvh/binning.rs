//! Object splits: which of a few planes best divides the references by their centres.
//!
//! Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".

use super::refs::{Bounds, Ref, xyz};
use glam::Vec4;
use rayon::prelude::*;

/// Most bins per axis.
const BINS: usize = 16;
/// Ranges longer than this are binned by several threads.
const PARALLEL: usize = 1 << 16;

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    count: u32,
}

type Bins = [[Bin; BINS]; 3];

/// Maps a doubled centre to a bin on each axis.
#[derive(Clone, Copy)]
struct Grid {
    origin: Vec4,
    scale: Vec4,
    /// Bins per axis: fewer for few references, as clearing and sweeping them then costs more than filling.
    bins: usize,
}

impl Grid {
    fn new(centres: &Bounds, count: usize) -> Self {
        let bins = if count >= 32 {
            BINS
        } else if count >= 6 {
            BINS / 2
        } else {
            BINS / 4
        };
        let extent = xyz(centres.hi - centres.lo);
        let scale = extent.to_array().map(|e| if e > 0.0 { (bins as f32 * 0.9999) / e } else { 0.0 });
        // A subnormal extent makes the quotient infinite.
        let scale = scale.map(|s| if s.is_finite() { s } else { 0.0 });
        Self { origin: centres.lo, scale: Vec4::from(scale), bins }
    }

    #[inline(always)]
    fn bins(&self, reference: &Ref) -> [usize; 3] {
        let x = ((reference.centre2() - self.origin) * self.scale).to_array();
        [x[0] as i32 as usize & (BINS - 1), x[1] as i32 as usize & (BINS - 1), x[2] as i32 as usize & (BINS - 1)]
    }
}

/// A way to divide a range of references in two.
pub(super) struct ObjectSplit {
    grid: Grid,
    axis: usize,
    /// First bin of the right side.
    bin: usize,
    /// Sum over the sides of half surface times number of references.
    pub(super) cost: f32,
    pub(super) left: Bounds,
    pub(super) right: Bounds,
}

impl ObjectSplit {
    /// The cheapest split, or `None` if all centres coincide.
    pub(super) fn find(refs: &[Ref], centres: &Bounds) -> Option<Self> {
        let grid = Grid::new(centres, refs.len());
        let bins = if refs.len() > PARALLEL {
            refs.par_chunks(PARALLEL / 4).map(|chunk| fill(chunk, &grid)).reduce(|| EMPTY, merge)
        } else {
            fill(refs, &grid)
        };
        (0..3)
            .filter(|&axis| grid.scale[axis] > 0.0)
            .filter_map(|axis| sweep(&bins[axis], grid, axis))
            .reduce(|best, other| if other.cost < best.cost { other } else { best })
    }

    #[inline(always)]
    pub(super) fn is_left(&self, reference: &Ref) -> bool {
        self.grid.bins(reference)[self.axis] < self.bin
    }
}

const EMPTY: Bins = [[Bin { bounds: Bounds::EMPTY, count: 0 }; BINS]; 3];

fn fill(refs: &[Ref], grid: &Grid) -> Bins {
    let mut bins = EMPTY;
    for reference in refs {
        let bounds = reference.bounds();
        for (axis, bin) in grid.bins(reference).into_iter().enumerate() {
            let bin = &mut bins[axis][bin];
            bin.bounds.grow(&bounds);
            bin.count += 1;
        }
    }
    bins
}

fn merge(mut a: Bins, b: Bins) -> Bins {
    for (a, b) in a.iter_mut().flatten().zip(b.iter().flatten()) {
        a.bounds.grow(&b.bounds);
        a.count += b.count;
    }
    a
}

fn sweep(bins: &[Bin; BINS], grid: Grid, axis: usize) -> Option<ObjectSplit> {
    let mut right = [(Bounds::EMPTY, 0.0); BINS];
    let (mut bounds, mut count) = (Bounds::EMPTY, 0);
    for i in (1..grid.bins).rev() {
        bounds.grow(&bins[i].bounds);
        count += bins[i].count;
        right[i] = (bounds, if count == 0 { f32::INFINITY } else { bounds.half_area() * count as f32 });
    }
    let mut best: Option<ObjectSplit> = None;
    (bounds, count) = (Bounds::EMPTY, 0);
    for i in 1..grid.bins {
        bounds.grow(&bins[i - 1].bounds);
        count += bins[i - 1].count;
        if count == 0 {
            continue;
        }
        let cost = bounds.half_area() * count as f32 + right[i].1;
        if cost < best.as_ref().map_or(f32::INFINITY, |b| b.cost) {
            best = Some(ObjectSplit { grid, axis, bin: i, cost, left: bounds, right: right[i].0 });
        }
    }
    best
}
