//! The binary hierarchy between building and collapse.

use super::{
    collapse::{Plan, Size},
    refs::Bounds,
    triangle::LANES,
};
use glam::Vec3;

/// A node of the binary hierarchy, stored before its descendants; the left child follows directly.
#[derive(Clone, Copy)]
pub(super) struct Binary {
    pub(super) lo: Vec3,
    pub(super) hi: Vec3,
    /// How to make it wide.
    pub(super) plan: Plan,
    /// What a ray that enters the box is expected to spend below, in visits of nodes.
    pub(super) cost: f32,
    pub(super) content: Content,
}

/// What a binary node holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// Two children.
    Pair {
        /// The distance from this node to its right child.
        right: u32,
        /// What the subtree takes as one root.
        size: Size,
    },
    /// Triangles by their numbers (see `names`), at least one; what is left is [`NO_TRIANGLE`].
    Row([u32; LANES]),
    /// One sphere.
    Sphere(u32),
    /// One instance.
    Instance(u32),
}

/// The number of no triangle.
pub(super) const NO_TRIANGLE: u32 = u32::MAX;

/// A node in memory. As these are plain numbers, the system can give a tree's memory as zeros, and parts of it that stay unused
/// cost nothing.
pub(super) type Words = [u32; 12];

impl Binary {
    pub(super) fn new(bounds: &Bounds, content: Content, plan: Plan, cost: f32) -> Self {
        Self { lo: bounds.lo.truncate(), hi: bounds.hi.truncate(), plan, cost, content }
    }

    /// Half the surface of the box.
    pub(super) fn half_area(&self) -> f32 {
        let d = self.hi - self.lo;
        d.x * d.y + d.y * d.z + d.z * d.x
    }

    /// What the subtree takes as one root.
    pub(super) fn size(&self) -> Size {
        match self.content {
            Content::Pair { size, .. } => size,
            Content::Row(_) => Size { nodes: 0, blocks: 1 },
            Content::Sphere(_) | Content::Instance(_) => Size::default(),
        }
    }

    pub(super) fn pack(&self) -> Words {
        let (kind, [a, b, c, d]) = match self.content {
            Content::Pair { right, size } => (0, [right, size.nodes, size.blocks, 0]),
            Content::Row(numbers) => (1, numbers),
            Content::Sphere(index) => (2, [index, 0, 0, 0]),
            Content::Instance(index) => (3, [index, 0, 0, 0]),
        };
        let ([lx, ly, lz], [hx, hy, hz]) = (self.lo.to_array().map(f32::to_bits), self.hi.to_array().map(f32::to_bits));
        [lx, ly, lz, self.plan.with_kind(kind), hx, hy, hz, self.cost.to_bits(), a, b, c, d]
    }

    pub(super) fn unpack([lx, ly, lz, plan, hx, hy, hz, cost, a, b, c, d]: &Words) -> Self {
        let (plan, kind) = Plan::and_kind(*plan);
        let content = match kind {
            0 => Content::Pair { right: *a, size: Size { nodes: *b, blocks: *c } },
            1 => Content::Row([*a, *b, *c, *d]),
            2 => Content::Sphere(*a),
            _ => Content::Instance(*a),
        };
        let corner = |x: &u32, y: &u32, z: &u32| Vec3::new(f32::from_bits(*x), f32::from_bits(*y), f32::from_bits(*z));
        Self { lo: corner(lx, ly, lz), hi: corner(hx, hy, hz), plan, cost: f32::from_bits(*cost), content }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec4;

    #[test]
    fn what_is_unpacked_is_what_was_packed() {
        let bounds = Bounds { lo: Vec4::new(-1.0, 2.0, 1e-20, 0.0), hi: Vec4::new(0.0, 3.0, 4.0, 0.0) };
        for content in [
            Content::Pair { right: 77, size: Size { nodes: 5, blocks: 9 } },
            Content::Row([3, 1, 4, NO_TRIANGLE]),
            Content::Sphere(6),
            Content::Instance(0),
        ] {
            for plan in [Plan::PRIMITIVE, Plan::and_kind(0x7654_3240).0] {
                let binary = Binary::unpack(&Binary::new(&bounds, content, plan, 0.25).pack());
                assert_eq!((binary.lo, binary.hi), (bounds.lo.truncate(), bounds.hi.truncate()));
                assert_eq!((binary.plan, binary.cost, binary.content), (plan, 0.25, content));
            }
        }
    }
}
