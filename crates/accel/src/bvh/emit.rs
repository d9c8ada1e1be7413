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

/// A child of a wide node that is being made.
struct Kid {
    /// Its binary node.
    at: usize,
    child: Child,
    /// The surface of everything inside, one side of triangles.
    surface: f32,
}

/// A wide node that has a place.
struct Top<'a> {
    cells: Places<'a>,
    kids: Vec<Kid>,
    parent: Option<(usize, usize)>,
}

/// What the parent knows of a child, if there is a parent.
fn kid<'a>(top: &'a mut [Top], parent: Option<(usize, usize)>) -> Option<&'a mut Kid> {
    parent.map(|(parent, slot)| &mut top[parent].kids[slot])
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
            node.set(0, bounds.lo.xyz(), bounds.hi.xyz(), self.leaf(0, cells).0);
        }
        own.put(node);
    }

    /// Writes a subtree: first its top, as much as a page holds, then the subtrees below. Returns the surface inside.
    fn subtree(&self, mut job: Job) -> f32 {
        let mut open = vec![Open { at: job.at, parent: None }];
        let mut top: Vec<Top> = Vec::new();
        let mut used = 0;
        while used < PAGE {
            let larger = |&a: &usize, &b: &usize| self.half_area(open[a].at).total_cmp(&self.half_area(open[b].at));
            let Some(largest) = (0..open.len()).max_by(larger) else { break };
            let Open { at, parent } = open.swap_remove(largest);
            let before = job.cells.first();
            let cells = job.cells.take(Node::CELLS);
            if let Some(kid) = kid(&mut top, parent) {
                kid.child = Child::inner(cells.first());
            }
            let kids = self.kids(at, &mut job.cells);
            let inner = kids.iter().enumerate().filter(|(_, kid)| kid.child.is_inner());
            open.extend(inner.map(|(slot, kid)| Open { at: kid.at, parent: Some((top.len(), slot)) }));
            top.push(Top { cells, kids, parent });
            used += job.cells.first() - before;
        }
        self.below(&mut top, open, &mut job);
        let mut surface = 0.0;
        while let Some(Top { mut cells, kids, parent }) = top.pop() {
            surface = kids.iter().map(|kid| kid.surface).sum();
            cells.put(self.node(kids));
            if let Some(kid) = kid(&mut top, parent) {
                kid.surface = surface;
            }
        }
        surface
    }

    /// Writes the subtrees below a top.
    fn below(&self, top: &mut [Top], open: Vec<Open>, job: &mut Job) {
        let job_of = |open: &Open| Job { at: open.at, cells: job.cells.take(self.binary[open.at].size.cells()) };
        let jobs: Vec<_> = open.iter().map(job_of).collect();
        assert!(job.cells.is_empty(), "sizes are exact");
        for (job, open) in jobs.iter().zip(&open) {
            if let Some(kid) = kid(top, open.parent) {
                kid.child = Child::inner(job.cells.first());
            }
        }
        let surfaces: Vec<f32> = if self.binary[job.at].size.nodes > PARALLEL {
            jobs.into_par_iter().map(|job| self.subtree(job)).collect()
        } else {
            jobs.into_iter().map(|job| self.subtree(job)).collect()
        };
        for (surface, open) in surfaces.into_iter().zip(open) {
            if let Some(kid) = kid(top, open.parent) {
                kid.surface = surface;
            }
        }
    }

    /// The children of the wide node of `at`; leaves are written.
    fn kids(&self, at: usize, cells: &mut Places) -> Vec<Kid> {
        let mut roots = Vec::with_capacity(WIDTH);
        self.split(at, self.binary[at].plan.left_roots(WIDTH), WIDTH, &mut roots);
        let kid = |at: usize| {
            let Binary { plan, size, .. } = self.binary[at];
            let (child, surface) =
                if plan.is_leaf() { self.leaf(at, cells.take(size.cells())) } else { (Child::inner(0), 0.0) };
            Kid { at, child, surface }
        };
        roots.into_iter().map(kid).collect()
    }

    /// Rays that ask for any hit take the last child first: the one with the best odds of a hit for its cost, of which
    /// only the root counts, as a hit ends the search. A line that meets a box meets surfaces inside as often, on average, as
    /// half of the box's surface goes into theirs.
    fn node(&self, mut kids: Vec<Kid>) -> Node {
        let worth = |kid: &Kid| {
            let half_area = self.half_area(kid.at);
            (1.0 - (-kid.surface / half_area).exp()) / self.binary[kid.at].cost.sqrt()
        };
        kids.sort_by_cached_key(|kid| worth(kid).to_bits());
        let mut node = Node::EMPTY;
        for (slot, kid) in kids.into_iter().enumerate() {
            let bounds = self.binary[kid.at].entry.bounds();
            node.set(slot, bounds.lo.xyz(), bounds.hi.xyz(), kid.child);
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

    /// Writes the leaf for everything below `at`; also the surface inside.
    fn leaf(&self, at: usize, mut cells: Places) -> (Child, f32) {
        let mut owners = Vec::with_capacity(LANES * Child::MAX_BLOCKS);
        self.owners(at, &mut owners);
        match owners[0] {
            Owner::Sphere(index) => return (Child::sphere(index), self.half_area(at)),
            Owner::Instance(index) => return (Child::instance(index), self.half_area(at)),
            Owner::Triangle { .. } => {}
        }
        let (first, mut surface) = (cells.first(), 0.0);
        let blocks = owners.chunks(LANES).map(|owners| cells.put(self.block(owners, &mut surface))).count();
        assert!(cells.is_empty(), "sizes are exact");
        (Child::blocks(first, blocks as u32), surface)
    }

    fn block(&self, owners: &[Owner], surface: &mut f32) -> Block {
        let mut block = Block::EMPTY;
        for (lane, owner) in owners.iter().enumerate() {
            let &Owner::Triangle { geometry, primitive } = owner else { unreachable!("only triangles share a leaf") };
            let corners @ [a, b, c] = self.geometries[geometry as usize].corners(primitive);
            *surface += 0.5 * (b - a).cross(c - a).length();
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
