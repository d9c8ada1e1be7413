//! The `k` nearest points: a kd-tree, sixteen wide.
//!
//! Space is halved at medians along the longest axis, as in any kd-tree; sixteen points make a leaf, and four halvings
//! make one node of sixteen children. All but the last element of a level are full, so the tree needs no pointers:
//! child `c` of node `i` is number `16 i + c` one level below. Nodes hold the bounds of their children, which are tested
//! all at once. A query descends into the nearest child first and drops what lies beyond the worst of the `k` best.

mod build;
mod neighbours;
mod query;

use glam::Vec3;

use super::lanes::{Isa, LANES, Row};
pub use neighbours::Neighbours;
use query::Query;

/// An index over points that finds the nearest ones. Immutable once built.
pub struct KdTree {
    leaves: Vec<Leaf>,
    /// The nodes above the leaves, then those above these, up to the root.
    nodes: Vec<Node>,
    /// Level 0 is the leaves.
    levels: Vec<Level>,
    len: usize,
    isa: Isa,
}

/// Up to sixteen points; the rest of the lanes have NaN coordinates, which are within no distance.
#[repr(align(64))]
struct Leaf {
    at: [Row; 3],
    index: [u32; LANES],
}

/// Bounds of up to sixteen children.
#[repr(align(64))]
struct Node {
    lo: [Row; 3],
    hi: [Row; 3],
    /// The lowest index of a point in each child.
    lowest: [u32; LANES],
}

/// One level of the tree.
struct Level {
    /// Its first element in the list of leaves or of nodes.
    first: usize,
    /// The number of its elements.
    count: usize,
}

impl KdTree {
    /// Indexes `points`. Points that are not finite are left out.
    ///
    /// # Panics
    /// If there are more than `u32::MAX` points.
    pub fn build(points: &[Vec3]) -> Self {
        assert!(u32::try_from(points.len()).is_ok(), "more than u32::MAX points");
        build::build(points)
    }

    /// Fills `out` with the up to `k` points nearest to `p` among those with squared distance `d2 <= r_max * r_max`,
    /// nearest first, equal distances by index. A negative or NaN `r_max`, or a `p` that is not finite, finds nothing.
    #[inline]
    pub fn nearest(&self, p: Vec3, k: usize, r_max: f32, out: &mut Neighbours) {
        self.search(p, k, r_max, out);
        out.sort();
    }

    /// As [`KdTree::nearest`], but only the farthest of the points found has its place, at the end; the others come in some
    /// order that may depend on `r_max`. For few neighbours, sorting takes as long as finding.
    #[inline]
    pub fn nearest_unordered(&self, p: Vec3, k: usize, r_max: f32, out: &mut Neighbours) {
        self.search(p, k, r_max, out);
        out.put_farthest_last();
    }

    #[inline]
    fn search(&self, p: Vec3, k: usize, r_max: f32, out: &mut Neighbours) {
        out.begin(k, r_max * r_max);
        if p.is_finite() && r_max >= 0.0 && k > 0 && !self.is_empty() {
            self.isa.run(Query::new(self, p, out));
        }
    }

    /// The number of points kept, which is the number of finite ones.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether no point was kept.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Heap memory held, in bytes.
    pub fn memory_bytes(&self) -> usize {
        size_of_val(self.leaves.as_slice()) + size_of_val(self.nodes.as_slice())
    }
}
