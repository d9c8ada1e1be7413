//! From a binary tree to an eight-wide one of least expected cost.
//!
//! Ylitie, Karras & Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 4.2:
//! for each binary node, the least cost of representing its subtree as a forest of at most i roots, i = 1..7.

use super::{node::Child, triangle::LANES};

/// Expected cost of visiting one node, in units of testing one block of triangles.
const NODE_COST: f32 = 1.0;
const BLOCK_COST: f32 = 0.8;
/// Most triangles that collapse into one leaf.
const MAX_LEAF: u32 = (LANES * Child::MAX_BLOCKS) as u32;

/// The optimal choices for one binary subtree: for a forest of i roots, how many go to the left child (0: as with i - 1
/// roots), and whether the subtree as one root is a leaf.
#[derive(Clone, Copy, Default)]
pub(super) struct Plan(u32);

impl Plan {
    const LEAF: u32 = 1 << 31;

    /// Roots given to the left child when the subtree is represented by `i` roots, 2 to 8.
    pub(super) const fn left_roots(self, i: usize) -> usize {
        (self.0 >> (3 * i) & 7) as usize
    }

    pub(super) const fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }
}

/// What a parent needs to know about a subtree to choose.
#[derive(Clone, Copy)]
pub(super) struct Forest {
    /// `cost[i]`: least cost with at most i + 1 roots.
    cost: [f32; 7],
    /// References below.
    count: u32,
    /// Whether all of them are triangles, so that they can share a leaf.
    blocks: bool,
}

impl Forest {
    pub(super) fn primitive(half_area: f32, is_triangle: bool) -> (Self, Plan) {
        (Self { cost: [half_area * BLOCK_COST; 7], count: 1, blocks: is_triangle }, Plan(Plan::LEAF))
    }

    pub(super) fn join(left: &Self, right: &Self, half_area: f32) -> (Self, Plan) {
        let mut plan = 0;
        let mut best = [f32::INFINITY; 9];
        for (roots, best) in best.iter_mut().enumerate().skip(2) {
            for k in 1.max(roots.saturating_sub(7))..roots.min(8) {
                let cost = left.cost[k - 1] + right.cost[roots - k - 1];
                if cost < *best || k == 1.max(roots.saturating_sub(7)) {
                    *best = cost;
                    plan = plan & !(7 << (3 * roots)) | (k as u32) << (3 * roots);
                }
            }
        }
        let count = left.count + right.count;
        let blocks = left.blocks && right.blocks;
        let inner = half_area * NODE_COST + best[8];
        let leaf = half_area * BLOCK_COST * count.div_ceil(LANES as u32) as f32;
        let is_leaf = blocks && count <= MAX_LEAF && leaf <= inner;
        let mut cost = [if is_leaf { leaf } else { inner }; 7];
        for roots in 2..=7 {
            cost[roots - 1] = cost[roots - 2].min(best[roots]);
            if best[roots] >= cost[roots - 2] {
                plan &= !(7 << (3 * roots));
            }
        }
        if is_leaf {
            plan |= Plan::LEAF;
        }
        (Self { cost, count, blocks }, Plan(plan))
    }
}
