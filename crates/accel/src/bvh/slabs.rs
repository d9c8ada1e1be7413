//! The conservative test of a ray against the eight boxes of a node.
//!
//! A ray may not miss the box of a triangle that the triangle test would report. The plane distances are
//! b/d - o/d with the second term prepared, so their errors are about 2^-24 of |o/d| plus 2^-24 of the distance itself.
//! The first kind is taken off the near offset and put on the far offset; the second widens the reciprocals. Both are
//! done once per ray and cost nothing per node (compare Ize 2013, "Robust BVH Ray Traversal", who pads the far
//! distance). The third source, rounding in the triangle test, is in proportion to the triangle's size and is met by
//! growing the boxes when a node is written.

use super::{node::Node, simd::Simd};
use glam::Vec3;

/// A ray prepared for box tests.
#[derive(Clone, Copy)]
pub(super) struct Slabs<S: Simd> {
    near_scale: [S::F8; 3],
    near_offset: [S::F8; 3],
    far_scale: [S::F8; 3],
    far_offset: [S::F8; 3],
    /// For each axis the plane of the node that the ray meets first; the other one differs in bit 0. Always below 6.
    near_plane: [usize; 3],
}

/// Reciprocals are clamped to this, so that a plane times a reciprocal stays finite for coordinates up to 1e18.
const MAX_RECIPROCAL: f32 = 1e18;

impl<S: Simd> Slabs<S> {
    #[inline(always)]
    pub(super) fn new(s: S, o: Vec3, d: Vec3) -> Self {
        const RELATIVE: f32 = 4.0 * f32::EPSILON;
        let zero = [s.splat8(0.0); 3];
        let mut slabs =
            Self { near_scale: zero, near_offset: zero, far_scale: zero, far_offset: zero, near_plane: [0, 2, 4] };
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
            slabs.near_plane[axis] = 2 * axis + usize::from(reciprocal < 0.0);
        }
        slabs
    }

    /// Entry distances of the boxes, at least `tmin`, and a bit for each box that the ray meets in [tmin, tmax].
    #[inline(always)]
    pub(super) fn enter(&self, s: S, node: &Node, tmin: S::F8, tmax: S::F8) -> (S::F8, u32) {
        let (mut near, mut far) = (tmin, tmax);
        for axis in 0..3 {
            // SAFETY: `near_plane` is below 6 by construction, and so is its neighbour.
            let (first, second) = unsafe {
                let near_plane = self.near_plane[axis];
                (node.planes.get_unchecked(near_plane), node.planes.get_unchecked(near_plane ^ 1))
            };
            // A NaN is dropped, as `min` and `max` return their second operand then.
            near = s.max8(s.fmadd8(s.load8(first), self.near_scale[axis], self.near_offset[axis]), near);
            far = s.min8(s.fmadd8(s.load8(second), self.far_scale[axis], self.far_offset[axis]), far);
        }
        (near, s.le8(near, far))
    }
}
