//! Writing the wide nodes and triangle blocks that a collapse plan asks for.

use super::{
    Geometry,
    cells::{Cell, Places, Stored},
    collapse::{MAX_LEAF, Size},
    names::Names,
    node::{Child, Node, WIDTH},
    tree::{Binary, Content, NO_TRIANGLE, Words},
    triangle::{Block, LANES},
};
use crate::memory::large_vec;
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
            let leaf = self.get(0);
            node.set(0, leaf.lo, leaf.hi, self.leaf(0, cells).0);
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
        let mut roots = Vec::with_capacity(WIDTH);
        self.split(at, self.get(at).plan.left_roots(WIDTH), WIDTH, &mut roots);
        let kid = |at: usize| {
            let binary = self.get(at);
            let (child, surface) = if binary.plan.is_leaf() {
                self.leaf(at, cells.take(binary.size().cells()))
            } else {
                (Child::inner(0), 0.0)
            };
            Kid { at, child, surface }
        };
        roots.into_iter().map(kid).collect()
    }

    /// Rays that ask for any hit take the last child first: the one with the best odds of a hit for its cost, of which
    /// only the root counts, as a hit ends the search. A line that meets a box meets surfaces inside as often, on average, as
    /// half of the box's surface goes into theirs.
    fn node(&self, mut kids: Vec<Kid>) -> Node {
        let worth = |kid: &Kid| {
            let binary = self.get(kid.at);
            (1.0 - (-kid.surface / binary.half_area()).exp()) / binary.cost.sqrt()
        };
        kids.sort_by_cached_key(|kid| worth(kid).to_bits());
        let mut node = Node::EMPTY;
        for (slot, kid) in kids.into_iter().enumerate() {
            let binary = self.get(kid.at);
            node.set(slot, binary.lo, binary.hi, kid.child);
        }
        node
    }

    fn half_area(&self, at: usize) -> f32 {
        self.get(at).half_area()
    }

    /// The binary nodes that represent the children of `at` as `count` roots, `left` of them in the left child.
    fn split(&self, at: usize, left: usize, count: usize, out: &mut Vec<usize>) {
        let [left_at, right_at] = self.children(at);
        for (at, mut count) in [(left_at, left), (right_at, count - left)] {
            let plan = self.get(at).plan;
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

    fn children(&self, at: usize) -> [usize; 2] {
        let Content::Pair { right, .. } = self.get(at).content else { unreachable!("plans divide pairs only") };
        [at + 1, at + right as usize]
    }

    /// Writes the leaf for everything below `at`; also the surface inside.
    fn leaf(&self, at: usize, mut cells: Places) -> (Child, f32) {
        match self.get(at).content {
            Content::Sphere(index) => return (Child::sphere(index), self.half_area(at)),
            Content::Instance(index) => return (Child::instance(index), self.half_area(at)),
            Content::Pair { .. } | Content::Row(_) => {}
        }
        let mut leaf = Gathered { numbers: [NO_TRIANGLE; MAX_LEAF as usize], count: 0 };
        self.gather(at, &mut leaf);
        let (first, mut surface) = (cells.first(), 0.0);
        let blocks = leaf.numbers[..leaf.count]
            .chunks(LANES)
            .map(|numbers| cells.put(self.block(numbers, &mut surface)))
            .count();
        assert!(cells.is_empty(), "sizes are exact");
        (Child::blocks(first, blocks as u32), surface)
    }

    fn block(&self, numbers: &[u32], surface: &mut f32) -> Block {
        let mut block = Block::EMPTY;
        for (lane, &number) in numbers.iter().enumerate() {
            let (geometry, primitive) = self.names.of(number);
            let corners @ [a, b, c] = self.geometries[geometry as usize].corners(primitive);
            *surface += 0.5 * (b - a).cross(c - a).length();
            block.set(lane, corners, number);
        }
        block
    }

    /// Adds the triangles below `at`.
    fn gather(&self, at: usize, leaf: &mut Gathered) {
        match self.get(at).content {
            Content::Pair { right, .. } => {
                self.gather(at + 1, leaf);
                self.gather(at + right as usize, leaf);
            }
            Content::Row(row) => {
                for number in row.into_iter().filter(|&number| number != NO_TRIANGLE) {
                    leaf.numbers[leaf.count] = number;
                    leaf.count += 1;
                }
            }
            Content::Sphere(_) | Content::Instance(_) => unreachable!("only triangles share a leaf"),
        }
    }
}

/// The triangles of a leaf.
struct Gathered {
    numbers: [u32; MAX_LEAF as usize],
    count: usize,
}
