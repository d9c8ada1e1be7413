//! Writing the triangle blocks of leaves.

use super::{
    Geometry,
    cells::Places,
    names::Names,
    node::Child,
    tree::{Binary, Content, NO_TRIANGLE, Words},
    triangle::{Block, LANES},
};
use std::ops::Range;

/// Triangles of the leaves of one wide node. Their corners lie anywhere in memory, so all are asked for before any is used.
pub(super) struct Leaves<'a> {
    geometries: &'a [Geometry<'a>],
    names: &'a Names,
    triangles: Vec<Named>,
}

/// A triangle with its number.
struct Named {
    number: u32,
    geometry: u32,
    primitive: u32,
}

impl<'a> Leaves<'a> {
    pub(super) fn new(geometries: &'a [Geometry<'a>], names: &'a Names) -> Self {
        Self { geometries, names, triangles: Vec::with_capacity(64) }
    }

    /// Adds the triangles of the subtree at `at` and tells where they are.
    pub(super) fn gather(&mut self, tree: &[Words], at: usize) -> Range<usize> {
        let before = self.triangles.len();
        self.add(tree, at);
        before..self.triangles.len()
    }

    fn add(&mut self, tree: &[Words], at: usize) {
        match Binary::unpack(&tree[at]).content {
            Content::Pair { right, .. } => {
                self.add(tree, at + 1);
                self.add(tree, at + right as usize);
            }
            Content::Row(row) => {
                for number in row.into_iter().filter(|&number| number != NO_TRIANGLE) {
                    let (geometry, primitive) = self.names.of(number);
                    self.geometries[geometry as usize].prefetch_indices(primitive);
                    self.triangles.push(Named { number, geometry, primitive });
                }
            }
            Content::Sphere(_) | Content::Instance(_) => {}
        }
    }

    /// Asks for the corners of all triangles.
    pub(super) fn prefetch(&self) {
        for triangle in &self.triangles {
            self.geometries[triangle.geometry as usize].prefetch_corners(triangle.primitive);
        }
    }

    /// Writes the blocks of a leaf into cells that are as many as they take; also gives the surface of the triangles.
    pub(super) fn write(&self, triangles: Range<usize>, mut cells: Places) -> (Child, f32) {
        let (first, mut surface) = (cells.first(), 0.0);
        let blocks =
            self.triangles[triangles].chunks(LANES).map(|four| cells.put(self.block(four, &mut surface))).count();
        assert!(cells.is_empty(), "sizes are exact");
        (Child::blocks(first, blocks as u32), surface)
    }

    fn block(&self, triangles: &[Named], surface: &mut f32) -> Block {
        let mut block = Block::EMPTY;
        for (lane, triangle) in triangles.iter().enumerate() {
            let corners @ [a, b, c] = self.geometries[triangle.geometry as usize].corners(triangle.primitive);
            *surface += 0.5 * (b - a).cross(c - a).length();
            block.set(lane, corners, triangle.number);
        }
        block
    }
}
