//! Sorting points along the curve, and bounding what is next to each other on it.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::{KdTree, Leaf, Level, Node};
use crate::points::lanes::{Isa, LANES};

/// Bits of a place on the curve per axis.
const BITS: u32 = 10;

/// Bounds of an element of the tree, and the lowest index of its points.
#[derive(Clone, Copy)]
struct Bound {
    lo: Vec3,
    hi: Vec3,
    lowest: u32,
}

pub(super) fn build(points: &[Vec3]) -> KdTree {
    let mut items: Vec<u64> = (0..points.len() as u64).filter(|&i| points[i as usize].is_finite()).collect();
    sort(points, &mut items);
    let leaves: Vec<Leaf> = items.par_chunks(LANES).map(|items| Leaf::new(points, items)).collect();
    let mut bounds: Vec<Bound> = items.par_chunks(LANES).map(|items| Bound::of_points(points, items)).collect();
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

/// Sorts `items`, whose lower halves are indices of points in rising order, along the Morton curve of their bounds.
/// Points that share a place on it are sorted along a finer curve of their own, so that a small dense spot in a large
/// scene is split as well as the scene; those that coincide keep the order of their indices.
fn sort(points: &[Vec3], items: &mut [u64]) {
    let point = |item: u64| points[item as u32 as usize];
    let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (lo, hi) = items.iter().fold(start, |(lo, hi), &item| (lo.min(point(item)), hi.max(point(item))));
    if items.is_empty() || lo == hi {
        return;
    }
    let lo = lo.as_dvec3();
    let scale = f64::from(1 << BITS) / (hi.as_dvec3() - lo).max_element();
    items.par_iter_mut().with_min_len(1 << 12).for_each(|item| {
        *item = morton((point(*item).as_dvec3() - lo) * scale) << 32 | (*item & u64::from(u32::MAX));
    });
    items.par_sort_unstable();
    let runs: Vec<&mut [u64]> = items.chunk_by_mut(|a, b| a >> 32 == b >> 32).filter(|run| run.len() > LANES).collect();
    runs.into_par_iter().for_each(|run| sort(points, run));
}

/// Interleaves the lowest bits of the coordinates' whole parts.
fn morton(place: DVec3) -> u64 {
    let [x, y, z] = place.to_array().map(|v| spread((v as u64).min((1 << BITS) - 1)));
    x | y << 1 | z << 2
}

/// Puts two zeros above each of the lowest ten bits.
fn spread(v: u64) -> u64 {
    let v = (v | v << 16) & 0x0300_00FF;
    let v = (v | v << 8) & 0x0300_F00F;
    let v = (v | v << 4) & 0x030C_30C3;
    (v | v << 2) & 0x0924_9249
}

impl Leaf {
    fn new(points: &[Vec3], items: &[u64]) -> Self {
        let mut leaf = Self { at: [[f32::NAN; LANES]; 3], index: [u32::MAX; LANES] };
        for (i, &item) in items.iter().enumerate() {
            let index = item as u32;
            for (axis, v) in points[index as usize].to_array().into_iter().enumerate() {
                leaf.at[axis][i] = v;
            }
            leaf.index[i] = index;
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

    fn of_points(points: &[Vec3], items: &[u64]) -> Self {
        items.iter().fold(Self::EMPTY, |bound, &item| {
            let p = points[item as u32 as usize];
            bound.and(&Self { lo: p, hi: p, lowest: item as u32 })
        })
    }

    fn of_all(bounds: &[Self]) -> Self {
        bounds.iter().fold(Self::EMPTY, |all, bound| all.and(bound))
    }

    fn and(self, other: &Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi), lowest: self.lowest.min(other.lowest) }
    }
}
