//! Cutting a reference in two by an axis-parallel plane.

use super::{
    Geometry,
    refs::{Bounds, Owner, Ref},
};
use glam::{Vec3, Vec4};

/// The parts of a reference below and above the plane at `position`; a part that is empty is `None`.
///
/// A triangle is cut exactly up to rounding, and the boxes of its parts are grown by that rounding. Of spheres and
/// instances only the box is cut.
pub(super) fn cut(reference: &Ref, axis: usize, position: f32, geometries: &[Geometry]) -> (Option<Ref>, Option<Ref>) {
    let bounds = reference.bounds();
    let (mut below, mut above) = match reference.owner() {
        Owner::Triangle { geometry, primitive } => {
            let (below, above) = cut_triangle(geometries[geometry as usize].corners(primitive), axis, position);
            (below.intersection(&bounds), above.intersection(&bounds))
        }
        Owner::Sphere(_) | Owner::Instance(_) => (bounds, bounds),
    };
    below.hi[axis] = below.hi[axis].min(position);
    above.lo[axis] = above.lo[axis].max(position);
    (reference.with_bounds(&below), reference.with_bounds(&above))
}

fn cut_triangle(corners: [Vec3; 3], axis: usize, position: f32) -> (Bounds, Bounds) {
    let (mut below, mut above) = (Bounds::EMPTY, Bounds::EMPTY);
    for i in 0..3 {
        let (p, q) = (corners[i], corners[(i + 1) % 3]);
        if p[axis] <= position {
            below.grow_point(p.extend(0.0));
        }
        if p[axis] >= position {
            above.grow_point(p.extend(0.0));
        }
        if (p[axis] < position) != (q[axis] < position) {
            let at = p.lerp(q, (position - p[axis]) / (q[axis] - p[axis])).extend(0.0);
            let slack = p.abs().max(q.abs()).extend(0.0) * (4.0 * f32::EPSILON);
            for point in [at - slack, at + slack] {
                below.grow_point(point);
                above.grow_point(point);
            }
        }
    }
    (below, above)
}

impl Bounds {
    fn intersection(&self, other: &Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }
}

impl Ref {
    /// The same owner with another box, unless that is empty.
    fn with_bounds(&self, bounds: &Bounds) -> Option<Self> {
        let kept = Vec4::select(bounds.lo.cmple(bounds.hi), bounds.lo, Vec4::NAN);
        (!kept.truncate().is_nan()).then(|| self.moved_to(bounds))
    }
}
