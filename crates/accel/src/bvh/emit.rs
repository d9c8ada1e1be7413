//! Writing the wide nodes and triangle blocks that a collapse plan asks for.

use super::{
    Geometry,
    build::Binary,
    cells::{Cell, Places, Stored},
    collapse::{Plan, Size},
    node::{Child, Node, WIDTH},
    refs::Owner,
    triangle::{Block, LANES},
};
use crate::memory::large_vec;
use glam::Vec4Swizzles;
use rayon::prelude::*;

/// Subtrees with more wide nodes than this are written in parallel.
const PARALLEL: u32 = 1024;

/// Cells of a page of memory: 4 KiB.
const PAGE: u32 = 128;

/// A binary node whose wide node has no place yet.
struct Open {
    at: usize,
    /// Which node of the top names it in which slot.
    parent: Option<(usize, usize)>,
}

/// A binary subtree that becomes one wide node and its descendants, and the cells where they go.
struct Job<'a> {
    at: usize,
    cells: Places<'a>,
}

/// The wide hierarchy of a binary one, which may be empty; its root lies at cell 0. `firsts` are the first numbers of the
/// geometries.
pub(super) fn emit(binary: &[Binary], geometries: &[Geometry], firsts: &[u32]) -> Vec<Cell> {
    let (root_is_leaf, size) = match binary.first() {
        Some(root) => (root.plan.is_leaf(), root.size),
        None => (true, Size::default()),
    };
    let count = (size.cells() + if root_is_leaf { Node::CELLS } else { 0 }) as usize;
    assert!(count < Child::MAX_INDEX, "a hierarchy takes at most 8 GiB");
    let mut table = large_vec(count);
    let emitter = Emitter { binary, geometries, firsts };
    let cells = Places::new(&mut table.spare_capacity_mut()[..count]);
    if root_is_leaf {
        emitter.single_leaf(cells);
    } else {
        emitter.subtree(Job { at: 0, cells });
    }
    // SAFETY: the sizes in the binary tree are exact, and all cells have been written; `Places` would have panicked had
    // there been too few, and the checks in `subtree` and `leaf` if there were too many.
    unsafe { table.set_len(count) };
    table
}

/// Tells a parent in which cell its child lies.
fn link(top: &mut [(Node, Places)], parent: Option<(usize, usize)>, cell: u32) {
    if let Some((parent, slot)) = parent {
        top[parent].0.children[slot] = Child::inner(cell);
    }
}

struct Emitter<'a> {
    binary: &'a [Binary],
    geometries: &'a [Geometry<'a>],
    firsts: &'a [u32],
}

impl Emitter<'_> {
    /// A root node with at most one child, which is a leaf.
    fn single_leaf(&self, mut cells: Places) {
        let mut node = Node::EMPTY;
        let mut own = cells.take(Node::CELLS);
        if let Some(leaf) = self.binary.first() {
            let bounds = leaf.entry.bounds();
            node.set(0, bounds.lo.xyz(), bounds.hi.xyz(), self.leaf(0, cells));
        }
        own.put(node);
    }

    /// Writes a subtree: first its top, as much as a page holds, then the subtrees below.
    fn subtree(&self, mut job: Job) {
        let mut open = vec![Open { at: job.at, parent: None }];
        let mut top: Vec<(Node, Places)> = Vec::new();
        let mut used = 0;
        while used < PAGE {
            let larger = |&a: &usize, &b: &usize| self.half_area(open[a].at).total_cmp(&self.half_area(open[b].at));
            let Some(largest) = (0..open.len()).max_by(larger) else { break };
            let Open { at, parent } = open.swap_remove(largest);
            let before = job.cells.first();
            let cells = job.cells.take(Node::CELLS);
            link(&mut top, parent, cells.first());
            let node = self.node(at, top.len(), &mut job.cells, &mut open);
            top.push((node, cells));
            used += job.cells.first() - before;
        }
        let large = self.binary[job.at].size.nodes > PARALLEL;
        let below: Vec<_> = open
            .into_iter()
            .map(|Open { at, parent }| {
                let cells = job.cells.take(self.binary[at].size.cells());
                link(&mut top, parent, cells.first());
                Job { at, cells }
            })
            .collect();
        assert!(job.cells.is_empty(), "sizes are exact");
        for (node, mut cells) in top {
            cells.put(node);
        }
        if large {
            below.into_par_iter().for_each(|job| self.subtree(job));
        } else {
            below.into_iter().for_each(|job| self.subtree(job));
        }
    }

    /// Makes the wide node of `at`, which is the `index`th of its top, and writes its leaves. Its inner children are opened.
    fn node(&self, at: usize, index: usize, cells: &mut Places, open: &mut Vec<Open>) -> Node {
        let mut roots = Vec::with_capacity(WIDTH);
        self.split(at, self.binary[at].plan.left_roots(WIDTH), WIDTH, &mut roots);
        // Rays that ask for any hit take the last child first: the largest box is the likeliest to hold one.
        roots.sort_by(|&a, &b| self.half_area(a).total_cmp(&self.half_area(b)));
        let mut node = Node::EMPTY;
        for (slot, at) in roots.into_iter().enumerate() {
            let Binary { entry, plan, size } = self.binary[at];
            let child = if plan.is_leaf() {
                self.leaf(at, cells.take(size.cells()))
            } else {
                open.push(Open { at, parent: Some((index, slot)) });
                Child::inner(0)
            };
            let bounds = entry.bounds();
            node.set(slot, bounds.lo.xyz(), bounds.hi.xyz(), child);
        }
        node
    }

    fn half_area(&self, at: usize) -> f32 {
        self.binary[at].entry.bounds().half_area()
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
    fn leaf(&self, at: usize, mut cells: Places) -> Child {
        let mut owners = Vec::with_capacity(LANES * Child::MAX_BLOCKS);
        self.owners(at, &mut owners);
        match owners[0] {
            Owner::Sphere(index) => return Child::sphere(index),
            Owner::Instance(index) => return Child::instance(index),
            Owner::Triangle { .. } => {}
        }
        let first = cells.first();
        let blocks = owners.chunks(LANES).map(|owners| cells.put(self.block(owners))).count();
        assert!(cells.is_empty(), "sizes are exact");
        Child::blocks(first, blocks as u32)
    }

    fn block(&self, owners: &[Owner]) -> Block {
        let mut block = Block::EMPTY;
        for (lane, owner) in owners.iter().enumerate() {
            let &Owner::Triangle { geometry, primitive } = owner else { unreachable!("only triangles share a leaf") };
            let corners = self.geometries[geometry as usize].corners(primitive);
            block.set(lane, corners, self.firsts[geometry as usize] + primitive);
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
