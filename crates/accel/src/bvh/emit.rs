//! Writing the wide nodes and triangle blocks that a collapse plan asks for.

use super::{
    Geometry,
    build::{Binary, Kind},
    node::{Child, Node, WIDTH},
    refs::{Bounds, Owner},
    triangle::{Block, LANES},
};
use glam::Vec4Swizzles;

/// The wide tables of one object; node 0 is the root.
pub(super) struct Wide {
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<Block>,
}

struct Emitter<'a> {
    binary: &'a [Binary],
    geometries: &'a [Geometry<'a>],
    out: Wide,
}

/// The wide hierarchy of a binary one, which may be empty.
pub(super) fn emit(binary: &[Binary], geometries: &[Geometry]) -> Wide {
    let mut emitter = Emitter { binary, geometries, out: Wide { nodes: vec![Node::EMPTY], blocks: Vec::new() } };
    match binary.first().map(|root| root.kind) {
        None => {}
        Some(Kind::Inner { plan, .. }) if !plan.is_leaf() => emitter.node(0, 0),
        Some(_) => {
            let child = emitter.leaf(0);
            emitter.out.nodes[0].set(0, binary[0].bounds.lo.xyz(), binary[0].bounds.hi.xyz(), child);
        }
    }
    emitter.out.nodes.shrink_to_fit();
    emitter.out.blocks.shrink_to_fit();
    emitter.out
}

impl Emitter<'_> {
    /// Writes the wide node at `slot` for the binary node `at`, and everything below.
    fn node(&mut self, at: usize, slot: usize) {
        let mut roots = Vec::with_capacity(WIDTH);
        self.roots(at, WIDTH, true, &mut roots);
        roots.sort_by(|a, b| area(&self.binary[*b].bounds).total_cmp(&area(&self.binary[*a].bounds)));
        for (i, &root) in roots.iter().enumerate() {
            let Binary { bounds, kind } = self.binary[root];
            let is_inner = matches!(kind, Kind::Inner { plan, .. } if !plan.is_leaf());
            let child = if is_inner {
                let slot = self.out.nodes.len();
                self.out.nodes.push(Node::EMPTY);
                self.node(root, slot);
                Child::inner(slot as u32)
            } else {
                self.leaf(root)
            };
            self.out.nodes[slot].set(i, bounds.lo.xyz(), bounds.hi.xyz(), child);
        }
    }

    /// The binary nodes that represent the subtree at `at` as at most `count` roots.
    fn roots(&self, at: usize, count: usize, open: bool, out: &mut Vec<usize>) {
        let Kind::Inner { right, plan } = self.binary[at].kind else {
            out.push(at);
            return;
        };
        let mut count = count;
        while count > 1 && plan.left_roots(count) == 0 {
            count -= 1;
        }
        if count == 1 && !open {
            out.push(at);
            return;
        }
        let left = plan.left_roots(count);
        self.roots(at + 1, left, false, out);
        self.roots(at + right as usize, count - left, false, out);
    }

    /// Writes the leaf for everything below `at`.
    fn leaf(&mut self, at: usize) -> Child {
        let mut owners = Vec::with_capacity(LANES * Child::MAX_BLOCKS);
        self.owners(at, &mut owners);
        let first = self.out.blocks.len() as u32;
        for chunk in owners.chunks(LANES) {
            let mut block = Block::EMPTY;
            for (lane, owner) in chunk.iter().enumerate() {
                match *owner {
                    Owner::Sphere(index) => return Child::sphere(index),
                    Owner::Instance(index) => return Child::instance(index),
                    Owner::Triangle { geometry, primitive } => {
                        let Geometry::Triangles { positions, indices } = self.geometries[geometry as usize] else {
                            unreachable!("only triangle meshes own triangles")
                        };
                        let corners = indices[primitive as usize].map(|i| positions[i as usize]);
                        block.set(lane, corners, geometry, primitive);
                    }
                }
            }
            self.out.blocks.push(block);
        }
        Child::blocks(first, self.out.blocks.len() as u32 - first)
    }

    fn owners(&self, at: usize, out: &mut Vec<Owner>) {
        match self.binary[at].kind {
            Kind::Primitive(owner) => out.push(owner),
            Kind::Inner { right, .. } => {
                self.owners(at + 1, out);
                self.owners(at + right as usize, out);
            }
        }
    }
}

fn area(bounds: &Bounds) -> f32 {
    bounds.half_area()
}
