//! Spatial splits: a plane that cuts the references it meets, for primitives so long that every grouping overlaps.
//!
//! Stich, Friedrich & Dietrich 2009, "Spatial Splits in Bounding Volume Hierarchies".

use super::{
    Geometry,
    clip::cut,
    collapse::blocks_for,
    refs::{Bounds, Ref},
};

/// Bins per axis.
const BINS: usize = 16;

#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    /// References that start here.
    enter: u32,
    /// References that end here.
    exit: u32,
}

/// One axis of the box, divided evenly.
#[derive(Clone, Copy)]
struct Ruler {
    axis: usize,
    start: f32,
    width: f32,
    per_width: f32,
}

impl Ruler {
    fn new(bounds: &Bounds, axis: usize) -> Option<Self> {
        let (start, width) = (bounds.lo[axis], (bounds.hi[axis] - bounds.lo[axis]) / BINS as f32);
        // Planes must be told apart from each other in f32.
        let fine = bounds.lo[axis].abs().max(bounds.hi[axis].abs()) * (16.0 * f32::EPSILON);
        (width > fine).then_some(Self { axis, start, width, per_width: 1.0 / width })
    }

    /// The plane where a bin begins.
    fn plane(&self, bin: usize) -> f32 {
        self.start + self.width * bin as f32
    }

    /// First and last bin of a reference.
    #[inline(always)]
    fn bins(&self, bounds: &Bounds) -> (usize, usize) {
        let bin = |x: f32| (((x - self.start) * self.per_width) as usize).min(BINS - 1);
        (bin(bounds.lo[self.axis]), bin(bounds.hi[self.axis]))
    }
}

/// A way to divide a range of references in two by a plane.
pub(super) struct SpatialSplit {
    ruler: Ruler,
    /// First bin of the right side.
    bin: usize,
    /// Sum over the sides of half surface times number of blocks.
    pub(super) cost: f32,
    left: (Bounds, u32),
    right: (Bounds, u32),
}

impl SpatialSplit {
    /// The cheapest split that cuts at most `budget` references.
    pub(super) fn find(refs: &[Ref], bounds: &Bounds, geometries: &[Geometry], budget: usize) -> Option<Self> {
        let axes = (0..3).filter_map(|axis| Ruler::new(bounds, axis));
        let most = refs.len() + budget;
        let splits = axes.filter_map(|ruler| sweep(&fill(refs, &ruler, geometries), ruler, most as u32));
        splits.reduce(|best, other| if other.cost < best.cost { other } else { best })
    }

    /// The references of both sides. One that is cut goes to one side as a whole where that is cheaper.
    pub(super) fn divide(&self, refs: &[Ref], geometries: &[Geometry]) -> (Vec<Ref>, Vec<Ref>) {
        let mut sides = [(Vec::new(), self.left), (Vec::new(), self.right)];
        sides[0].0.reserve(self.left.1 as usize);
        sides[1].0.reserve(self.right.1 as usize);
        for reference in refs {
            let (first, last) = self.ruler.bins(&reference.bounds());
            if last < self.bin {
                sides[0].0.push(*reference);
            } else if first >= self.bin {
                sides[1].0.push(*reference);
            } else {
                self.place(reference, &mut sides, geometries);
            }
        }
        let [(left, _), (right, _)] = sides;
        (left, right)
    }

    /// Decides about a reference across the plane (Stich et al. 2009, section 4.4, "reference unsplitting").
    fn place(&self, reference: &Ref, sides: &mut [(Vec<Ref>, (Bounds, u32)); 2], geometries: &[Geometry]) {
        let bounds = reference.bounds();
        let [(left_bounds, left_count), (right_bounds, right_count)] = [sides[0].1, sides[1].1];
        let (left_area, right_area) = (left_bounds.half_area(), right_bounds.half_area());
        let (n_left, n_right) = (left_count as f32, right_count as f32);
        let both = left_area * n_left + right_area * n_right;
        let grown = [left_bounds.union(&bounds), right_bounds.union(&bounds)];
        let all_left = grown[0].half_area() * n_left + right_area * (n_right - 1.0);
        let all_right = left_area * (n_left - 1.0) + grown[1].half_area() * n_right;
        if all_left < both && all_left <= all_right {
            sides[0].0.push(*reference);
            sides[0].1.0 = grown[0];
            sides[1].1.1 -= 1;
        } else if all_right < both {
            sides[1].0.push(*reference);
            sides[1].1.0 = grown[1];
            sides[0].1.1 -= 1;
        } else {
            let (below, above) = cut(reference, self.ruler.axis, self.ruler.plane(self.bin), geometries);
            sides[0].0.extend(below);
            sides[1].0.extend(above);
        }
    }
}

fn fill(refs: &[Ref], ruler: &Ruler, geometries: &[Geometry]) -> [Bin; BINS] {
    let mut bins = [Bin { bounds: Bounds::EMPTY, enter: 0, exit: 0 }; BINS];
    for reference in refs {
        let bounds = reference.bounds();
        let (first, last) = ruler.bins(&bounds);
        bins[first].enter += 1;
        bins[last].exit += 1;
        let mut rest = Some(*reference);
        for (bin, place) in bins.iter_mut().enumerate().take(last).skip(first) {
            let Some(whole) = rest else { break };
            let (below, above) = cut(&whole, ruler.axis, ruler.plane(bin + 1), geometries);
            if let Some(below) = below {
                place.bounds.grow(&below.bounds());
            }
            rest = above;
        }
        if let Some(rest) = rest {
            bins[last].bounds.grow(&rest.bounds());
        }
    }
    bins
}

fn sweep(bins: &[Bin; BINS], ruler: Ruler, most: u32) -> Option<SpatialSplit> {
    let mut right = [(Bounds::EMPTY, 0); BINS];
    let (mut bounds, mut count) = (Bounds::EMPTY, 0);
    for i in (1..BINS).rev() {
        bounds.grow(&bins[i].bounds);
        count += bins[i].exit;
        right[i] = (bounds, count);
    }
    let mut best: Option<SpatialSplit> = None;
    (bounds, count) = (Bounds::EMPTY, 0);
    for i in 1..BINS {
        bounds.grow(&bins[i - 1].bounds);
        count += bins[i - 1].enter;
        if count == 0 || right[i].1 == 0 || count + right[i].1 > most {
            continue;
        }
        let cost =
            bounds.half_area() * blocks_for(count) as f32 + right[i].0.half_area() * blocks_for(right[i].1) as f32;
        if cost < best.as_ref().map_or(f32::INFINITY, |b| b.cost) {
            best = Some(SpatialSplit { ruler, bin: i, cost, left: (bounds, count), right: right[i] });
        }
    }
    best
}
