//! Writing the wide nodes and triangle blocks that a collapse plan asks for.

use super::{
    Geometry,
    cells::{Cell, Places, Stored},
    collapse::Size,
    leaves::Leaves,
    names::Names,
    node::{Child, Node, WIDTH},
    tree::{Binary, Content, Words},
};
use crate::memory::large_vec;
use rayon::prelude::*;
use std::ops::Range;

/// Subtrees with more wide nodes than this are written in parallel.
const PARALLEL: u32 = 1024;

/// Cells of a page of memory: 4 KiB.
const PAGE: u32 = 128;

/// A binary node whose wide node has no place yet.
struct Open {
    at: usize,
    half_area: f32,
    /// Which node of the top names it in which slot.
    parent: Option<(usize, usize)>,
}

/// A binary subtree that becomes one wide node and its descendants, and the cells where they go.
struct Job<'a> {
    at: usize,
    cells: Places<'a>,
}

/// The wide hierarchy of a binary one, which may be empty; its root lies at cell 0.
pub(super) fn emit(tree: &[Words], geometries: &[Geometry], names: &Names) -> Vec<Cell> {
    let (root_is_leaf, size) = match tree.first().map(Binary::unpack) {
        Some(root) => (root.plan.is_leaf(), root.size()),
        None => (true, Size::default()),
    };
    let count = (size.cells() + if root_is_leaf { Node::CELLS } else { 0 }) as usize;
    assert!(count < Child::MAX_INDEX, "a hierarchy takes at most 8 GiB");
    let mut table = large_vec(count);
    let emitter = Emitter { tree, geometries, names };
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
    /// By this the children of a node are ordered.
    worth: f32,
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
    tree: &'a [Words],
    geometries: &'a [Geometry<'a>],
    names: &'a Names,
}

impl Emitter<'_> {
    #[inline(always)]
    fn get(&self, at: usize) -> Binary {
        Binary::unpack(&self.tree[at])
    }

    /// A root node with at most one child, which is a leaf.
    fn single_leaf(&self, mut cells: Places) {
        let mut node = Node::EMPTY;
        let mut own = cells.take(Node::CELLS);
        if !self.tree.is_empty() {
            let (leaf, mut leaves) = (self.get(0), Leaves::new(self.geometries, self.names));
            let triangles = leaves.gather(self.tree, 0);
            node.set(0, leaf.lo, leaf.hi, Self::leaf(&leaf, &leaves, triangles, &mut cells).0);
        }
        own.put(node);
    }

    /// Writes a subtree: first its top, as much as a page holds, then the subtrees below. Returns the surface inside.
    fn subtree(&self, mut job: Job) -> f32 {
        let mut open = vec![Open { at: job.at, half_area: 0.0, parent: None }];
        let mut top: Vec<Top> = Vec::new();
        let mut used = 0;
        while used < PAGE {
            let larger = |&a: &usize, &b: &usize| open[a].half_area.total_cmp(&open[b].half_area);
            let Some(largest) = (0..open.len()).max_by(larger) else { break };
            let Open { at, parent, .. } = open.swap_remove(largest);
            let before = job.cells.first();
            let cells = job.cells.take(Node::CELLS);
            if let Some(kid) = kid(&mut top, parent) {
                kid.child = Child::inner(cells.first());
            }
            let kids = self.kids(at, &mut job.cells);
            for (slot, kid) in kids.iter().enumerate().filter(|(_, kid)| kid.child.is_inner()) {
                let half_area = self.get(kid.at).half_area();
                open.push(Open { at: kid.at, half_area, parent: Some((top.len(), slot)) });
            }
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
        let job_of = |open: &Open| Job { at: open.at, cells: job.cells.take(self.get(open.at).size().cells()) };
        let jobs: Vec<_> = open.iter().map(job_of).collect();
        assert!(job.cells.is_empty(), "sizes are exact");
        for (job, open) in jobs.iter().zip(&open) {
            if let Some(kid) = kid(top, open.parent) {
                kid.child = Child::inner(job.cells.first());
            }
        }
        let surfaces: Vec<f32> = if self.get(job.at).size().nodes > PARALLEL {
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
        let mut roots = Roots { at: [0; WIDTH], count: 0 };
        self.split(at, self.get(at).plan.left_roots(WIDTH), WIDTH, &mut roots);
        let roots = &roots.at[..roots.count];
        let mut leaves = Leaves::new(self.geometries, self.names);
        let ranges = roots.iter().map(|&at| {
            let is_leaf = self.get(at).plan.is_leaf();
            if is_leaf { leaves.gather(self.tree, at) } else { 0..0 }
        });
        let ranges: Vec<_> = ranges.collect();
        leaves.prefetch();
        let kid = |(&at, range): (&usize, Range<usize>)| {
            let binary = self.get(at);
            let (child, surface) =
                if binary.plan.is_leaf() { Self::leaf(&binary, &leaves, range, cells) } else { (Child::inner(0), 0.0) };
            Kid { at, child, surface, worth: 0.0 }
        };
        roots.iter().zip(ranges).map(kid).collect()
    }

    /// Writes a leaf, whose triangles have been gathered; also gives the surface inside.
    fn leaf(binary: &Binary, leaves: &Leaves, triangles: Range<usize>, cells: &mut Places) -> (Child, f32) {
        match binary.content {
            Content::Sphere(index) => (Child::sphere(index), binary.half_area()),
            Content::Instance(index) => (Child::instance(index), binary.half_area()),
            Content::Pair { .. } | Content::Row(_) => leaves.write(triangles, cells.take(binary.size().cells())),
        }
    }

    /// Rays that ask for any hit take the last child first: the one with the best odds of a hit for its cost, of which
    /// only the root counts, as a hit ends the search. A line that meets a box meets surfaces inside as often, on average, as
    /// half of the box's surface goes into theirs.
    fn node(&self, mut kids: Vec<Kid>) -> Node {
        for kid in &mut kids {
            let binary = self.get(kid.at);
            kid.worth = (1.0 - (-kid.surface / binary.half_area()).exp()) / binary.cost.sqrt();
        }
        kids.sort_by_key(|kid| kid.worth.to_bits());
        let mut node = Node::EMPTY;
        for (slot, kid) in kids.into_iter().enumerate() {
            let binary = self.get(kid.at);
            node.set(slot, binary.lo, binary.hi, kid.child);
        }
        node
    }

    /// The binary nodes that represent the children of `at` as `count` roots, `left` of them in the left child.
    fn split(&self, at: usize, left: usize, count: usize, roots: &mut Roots) {
        let Content::Pair { right, .. } = self.get(at).content else { unreachable!("plans divide pairs only") };
        for (at, mut count) in [(at + 1, left), (at + right as usize, count - left)] {
            let plan = self.get(at).plan;
            while count > 1 && plan.left_roots(count) == 0 {
                count -= 1;
            }
            if count == 1 {
                roots.at[roots.count] = at;
                roots.count += 1;
            } else {
                self.split(at, plan.left_roots(count), count, roots);
            }
        }
    }
}

/// The binary nodes that become the children of a wide one.
struct Roots {
    at: [usize; WIDTH],
    count: usize,
}
