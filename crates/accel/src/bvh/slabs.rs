//! The conservative test of a ray against the eight boxes of a node.
//!
//! A ray may not miss the box of a triangle that the triangle test would report. The plane distances are
//! b/d - o/d with the second term prepared, so their errors are about 2^-24 of |o/d| plus 2^-24 of the distance itself.
//! The first kind is taken off the near offset and put on the far offset; the second widens the reciprocals. Both are
//! done once per ray and cost nothing per node (compare Ize 2013, "Robust BVH Ray Traversal", who pads the far
//! distance). The third source, rounding in the triangle test, is in proportion to the triangle's size and is met by
//! growing the boxes when a node is written.

use super::{
    node::{Node, WIDTH},
    simd::Simd,
};
use glam::Vec3;

/// A ray prepared for box tests.
#[derive(Clone, Copy)]
pub(super) struct Slabs<S: Simd> {
    near_scale: [S::F8; 3],
    near_offset: [S::F8; 3],
    far_scale: [S::F8; 3],
    far_offset: [S::F8; 3],
    /// For each axis where in the node the planes are that the ray meets first, in bytes; those it meets last are at
    /// the place that differs in bit 5. Always one of the six rows.
    near_planes: [usize; 3],
}

/// Bytes of one row of planes.
const ROW: usize = WIDTH * size_of::<f32>();

/// Reciprocals are clamped to this, so that a plane times a reciprocal stays finite for coordinates up to 1e18.
const MAX_RECIPROCAL: f32 = 1e18;

impl<S: Simd> Slabs<S> {
    #[inline(always)]
    pub(super) fn new(s: S, o: Vec3, d: Vec3) -> Self {
        const RELATIVE: f32 = 4.0 * f32::EPSILON;
        let zero = [s.splat8(0.0); 3];
        let mut slabs =
            Self { near_scale: zero, near_offset: zero, far_scale: zero, far_offset: zero, near_planes: [0; 3] };
        for axis in 0..3 {
            let clamped = d[axis].abs().max(1.0 / MAX_RECIPROCAL).copysign(d[axis]);
            let reciprocal = 1.0 / clamped;
            let near = reciprocal * (1.0 - RELATIVE);
            let far = reciprocal * (1.0 + RELATIVE);
            let slack = (o[axis] * reciprocal).abs() * RELATIVE;
            slabs.near_scale[axis] = s.splat8(near);
            slabs.near_offset[axis] = s.splat8(-o[axis] * near - slack);
            slabs.far_scale[axis] = s.splat8(far);
            slabs.far_offset[axis] = s.splat8(-o[axis] * far + slack);
            slabs.near_planes[axis] = (2 * axis + usize::from(reciprocal < 0.0)) * ROW;
        }
        slabs
    }

    /// Entry distances of the boxes, at least `tmin`, which is not negative, and a bit for each box that the ray meets in
    /// [tmin, tmax].
    #[inline(always)]
    pub(super) fn enter(&self, s: S, node: &Node, tmin: S::F8, tmax: S::F8) -> (S::F8, u32) {
        let (x0, x1) = self.slab(s, node, 0);
        let (y0, y1) = self.slab(s, node, 1);
        let (z0, z1) = self.slab(s, node, 2);
        // In pairs, as a ray waits for the last of them.
        let near = s.max8(s.max8(x0, y0), s.max8(z0, tmin));
        let far = s.min8(s.min8(x1, y1), s.min8(z1, tmax));
        (near, s.le8(near, far))
    }

    /// Distances of the planes of one axis that the ray meets first, and of those that it meets last.
    #[inline(always)]
    fn slab(&self, s: S, node: &Node, axis: usize) -> (S::F8, S::F8) {
        let near_planes = self.near_planes[axis];
        // SAFETY: both places are rows of the node's planes, by construction.
        let (first, last) = unsafe {
            let rows = node.planes.as_ptr();
            (&*rows.byte_add(near_planes), &*rows.byte_add(near_planes ^ ROW))
        };
        (
            s.fmadd8(s.load8(first), self.near_scale[axis], self.near_offset[axis]),
            s.fmadd8(s.load8(last), self.far_scale[axis], self.far_offset[axis]),
        )
    }
}
