//! From a binary tree to an eight-wide one of least expected cost.
//!
//! Ylitie, Karras & Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 4.2:
//! for each binary node, the least cost of representing its subtree as a forest of at most i roots, i = 1..7.

use super::{
    cells::Stored,
    node::{Child, Node},
    triangle::{Block, LANES},
};

/// What visiting one node and testing one block of triangles cost, measured: a smaller share for blocks makes for fuller
/// ones, and so for smaller tables too.
const NODE_COST: f32 = 1.0;
const BLOCK_COST: f32 = 0.4;
/// Most triangles that collapse into one leaf.
const MAX_LEAF: u32 = (LANES * Child::MAX_BLOCKS) as u32;

/// The optimal choices for one binary subtree: for a forest of i roots, how many go to the left child (0: as with i - 1
/// roots), and whether the subtree as one root is a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Plan(u32);

impl Plan {
    const LEAF: u32 = 1 << 31;
    /// The plan of what is not divided further.
    pub(super) const PRIMITIVE: Self = Self(Self::LEAF);

    /// Roots given to the left child when the subtree is represented by `i` roots, 2 to 8.
    pub(super) const fn left_roots(self, i: usize) -> usize {
        (self.0 >> (3 * i) & 7) as usize
    }

    pub(super) const fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }

    /// The plan with a number below 64 in the bits that it leaves free.
    pub(super) const fn with_kind(self, kind: u32) -> u32 {
        self.0 | kind
    }

    /// The parts of [`Plan::with_kind`].
    pub(super) const fn and_kind(bits: u32) -> (Self, u32) {
        (Self(bits & !63), bits & 63)
    }
}

/// Wide nodes and triangle blocks needed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Size {
    pub(super) nodes: u32,
    pub(super) blocks: u32,
}

/// Blocks of triangles that a leaf of `count` takes.
#[inline(always)]
pub(super) fn blocks_for(count: u32) -> u32 {
    count.div_ceil(LANES as u32)
}

impl Size {
    /// Cells of the table.
    pub(super) fn cells(self) -> u32 {
        self.nodes * Node::CELLS + self.blocks * Block::CELLS
    }

    fn plus(self, other: Self) -> Self {
        Self { nodes: self.nodes + other.nodes, blocks: self.blocks + other.blocks }
    }
}

/// The best forest of at most so many roots.
#[derive(Clone, Copy)]
struct Choice {
    cost: f32,
    size: Size,
}

/// What a parent needs to know about a subtree to choose.
#[derive(Clone, Copy)]
pub(super) struct Forest {
    /// `best[i]`: with at most i + 1 roots.
    best: [Choice; 7],
    /// References below.
    count: u32,
    /// Whether all of them are triangles, so that they can share a leaf.
    blocks: bool,
}

impl Forest {
    /// Triangles that fit one block, or something else alone.
    pub(super) fn primitive(half_area: f32, count: u32, triangles: bool) -> Self {
        let size = Size { nodes: 0, blocks: u32::from(triangles) };
        Self { best: [Choice { cost: half_area * BLOCK_COST, size }; 7], count, blocks: triangles }
    }

    /// Expected cost of the subtree as one root for a ray that meets its box, which has so much surface.
    pub(super) fn cost(&self, half_area: f32) -> f32 {
        self.best[0].cost / half_area
    }

    /// Tables needed for the subtree as one root.
    pub(super) fn size(&self) -> Size {
        self.best[0].size
    }

    pub(super) fn join(left: &Self, right: &Self, half_area: f32) -> (Self, Plan) {
        let pair = |k: usize, roots: usize| left.best[k - 1].cost + right.best[roots - k - 1].cost;
        let mut plan = 0;
        let mut choice = |roots: usize| {
            let first = 1.max(roots.saturating_sub(7));
            let (mut best, mut cost) = (first, pair(first, roots));
            for k in first + 1..roots.min(8) {
                let other = pair(k, roots);
                if other < cost {
                    (best, cost) = (k, other);
                }
            }
            plan = plan & !(7 << (3 * roots)) | (best as u32) << (3 * roots);
            Choice { cost, size: left.best[best - 1].size.plus(right.best[roots - best - 1].size) }
        };
        let inner = choice(8);
        let inner =
            Choice { cost: inner.cost + half_area * NODE_COST, size: inner.size.plus(Size { nodes: 1, blocks: 0 }) };
        let count = left.count + right.count;
        let blocks = left.blocks && right.blocks;
        let in_leaf = blocks_for(count);
        let leaf = Choice { cost: half_area * BLOCK_COST * in_leaf as f32, size: Size { nodes: 0, blocks: in_leaf } };
        let is_leaf = blocks && count <= MAX_LEAF && leaf.cost <= inner.cost;
        let mut best = [if is_leaf { leaf } else { inner }; 7];
        for roots in 2..=7 {
            let forest = choice(roots);
            best[roots - 1] = if forest.cost < best[roots - 2].cost { forest } else { best[roots - 2] };
        }
        // Where a root more does not help, say so.
        for roots in 2..=7 {
            if best[roots - 1].cost >= best[roots - 2].cost {
                plan &= !(7 << (3 * roots));
            }
        }
        if is_leaf {
            plan |= Plan::LEAF;
        }
        (Self { best, count, blocks }, Plan(plan))
    }
}
