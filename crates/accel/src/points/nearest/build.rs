//! Splitting points at medians, and bounding what ends up together.

use glam::Vec3;
use rayon::prelude::*;

use super::{KdTree, Leaf, Level, Node};
use crate::points::lanes::{Isa, LANES};

/// Halves longer than this are worth a task of their own.
const PARALLEL: usize = 1 << 12;

/// A point and its place in the input.
#[derive(Clone, Copy)]
struct Item {
    p: Vec3,
    index: u32,
}

/// Bounds of an element of the tree, and the lowest index of its points.
#[derive(Clone, Copy)]
struct Bound {
    lo: Vec3,
    hi: Vec3,
    lowest: u32,
}

pub(super) fn build(points: &[Vec3]) -> KdTree {
    let numbered = points.iter().zip(0..).filter(|(p, _)| p.is_finite());
    let mut items: Vec<Item> = numbered.map(|(&p, index)| Item { p, index }).collect();
    let mut unit = LANES;
    while unit * LANES < items.len() {
        unit *= LANES;
    }
    split(&mut items, unit);
    let leaves: Vec<Leaf> = items.par_chunks(LANES).map(Leaf::new).collect();
    let mut bounds: Vec<Bound> = items.par_chunks(LANES).map(Bound::of_points).collect();
    let mut levels = vec![Level { first: 0, count: leaves.len() }];
    let mut nodes = Vec::new();
    while bounds.len() > 1 {
        let first = nodes.len();
        nodes.par_extend(bounds.par_chunks(LANES).map(Node::new));
        bounds = bounds.par_chunks(LANES).map(Bound::of_all).collect();
        levels.push(Level { first, count: bounds.len() });
    }
    KdTree { leaves, nodes, levels, len: items.len(), isa: Isa::detect() }
}

/// Sorts `items` so that each run of `unit` points is one element of a level, each run of `unit / 16` one of the level
/// below, and so on: halves the elements at the median along the longest axis until one is left. Equal coordinates are
/// told apart by index, so that coinciding points end up in the order of their indices.
fn split(items: &mut [Item], unit: usize) {
    let elements = items.len().div_ceil(unit);
    if elements <= 1 {
        if items.len() > LANES {
            split(items, unit / LANES);
        }
        return;
    }
    let bound = Bound::of_points(items);
    // Halves, since the whole may be too long for a float.
    let axis = (bound.hi * 0.5 - bound.lo * 0.5).max_position();
    let middle = elements / 2 * unit;
    items.select_nth_unstable_by_key(middle, |item| u64::from(rank(item.p[axis])) << 32 | u64::from(item.index));
    let (low, high) = items.split_at_mut(middle);
    if low.len() > PARALLEL {
        rayon::join(|| split(low, unit), || split(high, unit));
    } else {
        split(low, unit);
        split(high, unit);
    }
}

/// The place of a number in the order of floats.
fn rank(v: f32) -> u32 {
    let bits = v.to_bits();
    bits ^ (((bits as i32 >> 31) as u32) | 1 << 31)
}

impl Leaf {
    fn new(items: &[Item]) -> Self {
        let mut leaf = Self { at: [[f32::NAN; LANES]; 3], index: [u32::MAX; LANES] };
        for (i, item) in items.iter().enumerate() {
            for axis in 0..3 {
                leaf.at[axis][i] = item.p[axis];
            }
            leaf.index[i] = item.index;
        }
        leaf
    }
}

impl Node {
    fn new(children: &[Bound]) -> Self {
        let mut node =
            Self { lo: [[f32::INFINITY; LANES]; 3], hi: [[f32::NEG_INFINITY; LANES]; 3], lowest: [u32::MAX; LANES] };
        for (i, child) in children.iter().enumerate() {
            for axis in 0..3 {
                node.lo[axis][i] = child.lo[axis];
                node.hi[axis][i] = child.hi[axis];
            }
            node.lowest[i] = child.lowest;
        }
        node
    }
}

impl Bound {
    const EMPTY: Self = Self { lo: Vec3::INFINITY, hi: Vec3::NEG_INFINITY, lowest: u32::MAX };

    fn of_points(items: &[Item]) -> Self {
        items.iter().fold(Self::EMPTY, |bound, item| bound.and(&Self { lo: item.p, hi: item.p, lowest: item.index }))
    }

    fn of_all(bounds: &[Self]) -> Self {
        bounds.iter().fold(Self::EMPTY, Self::and)
    }

    fn and(self, other: &Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi), lowest: self.lowest.min(other.lowest) }
    }
}
