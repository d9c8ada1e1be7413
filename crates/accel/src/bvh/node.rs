//! The one node format, and the words that name a node's children.

use glam::Vec3;

/// Children per node.
pub(super) const WIDTH: usize = 8;

/// A child of a node, packed in 32 bits: bit 31 tells leaf from inner node, bits 28..31 of a leaf its kind, the rest
/// an index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub(super) struct Child(pub(super) u32);

/// What a leaf word points at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Leaf {
    /// `count` consecutive triangle blocks from cell `first`.
    Blocks { first: u32, count: u32 },
    /// One sphere.
    Sphere(u32),
    /// One instance of an object.
    Instance(u32),
    /// On the stack only: what lies below belongs to the world again.
    LeaveInstance,
}

impl Child {
    const LEAF: u32 = 1 << 31;
    const INDEX: u32 = (1 << 28) - 1;
    const SPHERE: u32 = 6;
    const INSTANCE: u32 = 7;
    /// The word of [`Leaf::LeaveInstance`].
    pub(super) const LEAVE_INSTANCE: Self = Self(u32::MAX);
    /// Most triangle blocks one leaf can name.
    pub(super) const MAX_BLOCKS: usize = 6;
    /// Most cells, spheres or instances one table can hold; one less, as the last is a sentinel.
    pub(super) const MAX_INDEX: usize = Self::INDEX as usize;

    pub(super) const fn inner(cell: u32) -> Self {
        Self(cell)
    }

    pub(super) fn blocks(first: u32, count: u32) -> Self {
        debug_assert!(count >= 1 && count as usize <= Self::MAX_BLOCKS && first <= Self::INDEX);
        Self(Self::LEAF | (count - 1) << 28 | first)
    }

    pub(super) const fn sphere(index: u32) -> Self {
        Self(Self::LEAF | Self::SPHERE << 28 | index)
    }

    pub(super) const fn instance(index: u32) -> Self {
        Self(Self::LEAF | Self::INSTANCE << 28 | index)
    }

    #[inline(always)]
    pub(super) const fn is_inner(self) -> bool {
        self.0 & Self::LEAF == 0
    }

    /// The first cell of an inner node or of blocks, or the index of a sphere or an instance.
    #[inline(always)]
    pub(super) const fn index(self) -> u32 {
        self.0 & Self::INDEX
    }

    /// What a leaf points at; only for leaves.
    #[inline(always)]
    pub(super) const fn leaf(self) -> Leaf {
        match self.0 >> 28 & 7 {
            Self::SPHERE => Leaf::Sphere(self.index()),
            Self::INSTANCE if self.0 == Self::LEAVE_INSTANCE.0 => Leaf::LeaveInstance,
            Self::INSTANCE => Leaf::Instance(self.index()),
            blocks => Leaf::Blocks { first: self.index(), count: blocks + 1 },
        }
    }
}

/// Eight child boxes in structure-of-arrays form, and the children.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
pub(super) struct Node {
    /// Planes, ordered min x, max x, min y, max y, min z, max z.
    pub(super) planes: [[f32; WIDTH]; 6],
    pub(super) children: [Child; WIDTH],
}

impl Node {
    /// A node all of whose boxes are empty, so that no ray enters it.
    pub(super) const EMPTY: Self = Self {
        planes: [
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        children: [Child(0); WIDTH],
    };

    /// Puts a child into `slot`. The box is grown by a few units in the last place: a hit found by the triangle test
    /// may lie outside the exact box by the rounding of the test, about 2^-24 of the box's extent (see `traverse`).
    pub(super) fn set(&mut self, slot: usize, lo: Vec3, hi: Vec3, child: Child) {
        for axis in 0..3 {
            let slack = (hi[axis] - lo[axis]) * (4.0 * f32::EPSILON);
            self.planes[2 * axis][slot] = next_normal_down(lo[axis] - slack);
            self.planes[2 * axis + 1][slot] = -next_normal_down(-hi[axis] - slack);
        }
        self.children[slot] = child;
    }
}

/// A number below `v`, the next one unless that is subnormal: processors multiply those in microcode, and floors at height 0
/// are everywhere.
fn next_normal_down(v: f32) -> f32 {
    let next = v.next_down();
    match next.is_subnormal() {
        true if next < 0.0 => -f32::MIN_POSITIVE,
        true => 0.0,
        false => next,
    }
}

impl Node {
    /// Whether there is a child in `slot`.
    pub(super) fn is_used(&self, slot: usize) -> bool {
        self.planes[0][slot] <= self.planes[1][slot]
    }
}

/// Where the tables of one object start inside the shared ones.
#[derive(Clone, Copy, Default)]
pub(super) struct Offsets {
    pub(super) cells: u32,
    pub(super) names: u32,
    pub(super) spheres: u32,
}

impl Child {
    /// The same child after its tables were moved.
    pub(super) fn moved(self, by: Offsets) -> Self {
        let step = if self.is_inner() {
            by.cells
        } else {
            match self.leaf() {
                Leaf::Blocks { .. } => by.cells,
                Leaf::Sphere(_) => by.spheres,
                Leaf::Instance(_) | Leaf::LeaveInstance => 0,
            }
        };
        Self(self.0 + step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_lie_outside_and_are_never_subnormal() {
        let tiny = f32::MIN_POSITIVE / 3.0;
        for v in [0.0, -0.0, tiny, -tiny, f32::MIN_POSITIVE, -f32::MIN_POSITIVE, f32::from_bits(1), 1.0, -7.5e10] {
            let mut node = Node::EMPTY;
            node.set(3, Vec3::splat(v), Vec3::splat(v), Child(0));
            for axis in 0..3 {
                let (min, max) = (node.planes[2 * axis][3], node.planes[2 * axis + 1][3]);
                assert!(min < v && v < max || v.is_subnormal() && min <= v && v <= max, "{min} {v} {max}");
                assert!(!min.is_subnormal() && !max.is_subnormal(), "{min} {max} around {v}");
            }
        }
    }
}
