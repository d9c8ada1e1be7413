//! Writing the wide nodes and triangle blocks that a collapse plan asks for.

use super::{
    Geometry,
    build::Binary,
    collapse::Plan,
    node::{Child, Node, WIDTH},
    refs::Owner,
    triangle::{Block, LANES},
};
use crate::memory::large_vec;
use glam::Vec4Swizzles;
use rayon::prelude::*;
use std::mem::MaybeUninit;

/// Subtrees with more wide nodes than this are written in parallel.
const PARALLEL: u32 = 1024;

/// The wide tables of one object; node 0 is the root.
pub(super) struct Wide {
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<Block>,
}

/// A binary subtree that becomes one wide node and its descendants, and the places where they go.
struct Job<'a> {
    at: usize,
    nodes: Places<'a, Node>,
    blocks: Places<'a, Block>,
}

/// Consecutive unwritten places of a table.
struct Places<'a, T> {
    first: u32,
    places: &'a mut [MaybeUninit<T>],
}

impl<T> Places<'_, T> {
    /// Takes the first `count` places away.
    fn take(&mut self, count: u32) -> Self {
        let (taken, rest) = std::mem::take(&mut self.places).split_at_mut(count as usize);
        self.places = rest;
        let first = self.first;
        self.first += count;
        Self { first, places: taken }
    }
}

/// The wide hierarchy of a binary one, which may be empty.
pub(super) fn emit(binary: &[Binary], geometries: &[Geometry]) -> Wide {
    let Some(root) = binary.first() else { return Wide { nodes: vec![Node::EMPTY], blocks: Vec::new() } };
    let (node_count, block_count) = (root.size.nodes.max(1) as usize, root.size.blocks as usize);
    let (mut nodes, mut blocks) = (large_vec(node_count), large_vec(block_count));
    let emitter = Emitter { binary, geometries };
    let job = Job {
        at: 0,
        nodes: Places { first: 0, places: &mut nodes.spare_capacity_mut()[..node_count] },
        blocks: Places { first: 0, places: &mut blocks.spare_capacity_mut()[..block_count] },
    };
    if root.plan.is_leaf() {
        emitter.single_leaf(job);
    } else {
        emitter.node(job);
    }
    // SAFETY: the sizes in the binary tree are exact, and each place has been written; `Places` would have panicked
    // had there been too few, and the checks at the end of `node` if there were too many.
    unsafe {
        nodes.set_len(node_count);
        blocks.set_len(block_count);
    }
    Wide { nodes, blocks }
}

struct Emitter<'a> {
    binary: &'a [Binary],
    geometries: &'a [Geometry<'a>],
}

impl Emitter<'_> {
    /// A root node whose only child is a leaf.
    fn single_leaf(&self, mut job: Job) {
        let mut node = Node::EMPTY;
        let bounds = self.binary[0].entry.bounds();
        node.set(0, bounds.lo.xyz(), bounds.hi.xyz(), self.leaf(0, &mut job.blocks));
        job.nodes.places[0].write(node);
    }

    /// Writes a wide node and everything below.
    fn node(&self, mut job: Job) {
        let mut roots = Vec::with_capacity(WIDTH);
        let plan = self.binary[job.at].plan;
        self.split(job.at, plan.left_roots(WIDTH), WIDTH, &mut roots);
        // Rays that ask for any hit take the last child first: the largest box is the likeliest to hold one.
        let area = |at: &usize| self.binary[*at].entry.bounds().half_area();
        roots.sort_by(|a, b| area(a).total_cmp(&area(b)));
        let own = job.nodes.take(1);
        let mut node = Node::EMPTY;
        let mut inner = Vec::with_capacity(WIDTH);
        for (slot, &at) in roots.iter().enumerate() {
            let Binary { entry, plan, size } = self.binary[at];
            let (nodes, mut blocks) = (job.nodes.take(size.nodes), job.blocks.take(size.blocks));
            let child = if plan.is_leaf() {
                self.leaf(at, &mut blocks)
            } else {
                let child = Child::inner(nodes.first);
                inner.push(Job { at, nodes, blocks });
                child
            };
            let bounds = entry.bounds();
            node.set(slot, bounds.lo.xyz(), bounds.hi.xyz(), child);
        }
        assert!(job.nodes.places.is_empty() && job.blocks.places.is_empty(), "sizes are exact");
        own.places[0].write(node);
        if self.binary[job.at].size.nodes > PARALLEL {
            inner.into_par_iter().for_each(|job| self.node(job));
        } else {
            inner.into_iter().for_each(|job| self.node(job));
        }
    }

    /// The binary nodes that represent the children of `at` as `count` roots, `left` of them in the left child.
    fn split(&self, at: usize, left: usize, count: usize, out: &mut Vec<usize>) {
        let right_at = at + self.binary[at].entry.number() as usize;
        for (at, mut count) in [(at + 1, left), (right_at, count - left)] {
            let plan = self.binary[at].plan;
            while count > 1 && plan.left_roots(count) == 0 {
                count -= 1;
            }
            if count == 1 {
                out.push(at);
            } else {
                self.split(at, plan.left_roots(count), count, out);
            }
        }
    }

    /// Writes the leaf for everything below `at`.
    fn leaf(&self, at: usize, blocks: &mut Places<Block>) -> Child {
        let mut owners = Vec::with_capacity(LANES * Child::MAX_BLOCKS);
        self.owners(at, &mut owners);
        match owners[0] {
            Owner::Sphere(index) => return Child::sphere(index),
            Owner::Instance(index) => return Child::instance(index),
            Owner::Triangle { .. } => {}
        }
        for (place, owners) in blocks.places.iter_mut().zip(owners.chunks(LANES)) {
            place.write(self.block(owners));
        }
        assert_eq!(blocks.places.len(), owners.len().div_ceil(LANES), "sizes are exact");
        Child::blocks(blocks.first, blocks.places.len() as u32)
    }

    fn block(&self, owners: &[Owner]) -> Block {
        let mut block = Block::EMPTY;
        for (lane, owner) in owners.iter().enumerate() {
            let &Owner::Triangle { geometry, primitive } = owner else { unreachable!("only triangles share a leaf") };
            let corners = self.geometries[geometry as usize].corners(primitive);
            block.set(lane, corners, geometry, primitive);
        }
        block
    }

    fn owners(&self, at: usize, out: &mut Vec<Owner>) {
        let Binary { entry, plan, .. } = self.binary[at];
        if plan == Plan::PRIMITIVE {
            out.push(entry.owner());
        } else {
            self.owners(at + 1, out);
            self.owners(at + entry.number() as usize, out);
        }
    }
}
