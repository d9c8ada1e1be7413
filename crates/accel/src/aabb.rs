//! Axis-aligned boxes.

use glam::{Affine3A, BVec3, Vec3};

/// A closed axis-aligned box. A box with `min > max` on some axis is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest corner.
    pub min: Vec3,
    /// Largest corner.
    pub max: Vec3,
}

impl Aabb {
    /// The box that holds nothing: the neutral element of [`Aabb::union`].
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// Whether the box holds no point at all.
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// Whether `p` lies inside or on the boundary.
    pub fn contains(&self, p: Vec3) -> bool {
        (self.min.cmple(p) & p.cmple(self.max)).all()
    }

    /// The smallest box around both.
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// The smallest box around this one and `p`.
    pub fn with_point(&self, p: Vec3) -> Self {
        Self { min: self.min.min(p), max: self.max.max(p) }
    }

    /// Midpoint; meaningless for an empty box.
    pub fn centre(&self) -> Vec3 {
        self.min.midpoint(self.max)
    }

    /// The box around the transformed box, grown by the rounding of the transform and of its inverse; empty if this is.
    pub fn transformed(&self, map: &Affine3A) -> Self {
        if self.is_empty() {
            return Self::EMPTY;
        }
        let corners = (0..8_u32).map(|i| {
            let high = BVec3::new(i & 1 != 0, i & 2 != 0, i & 4 != 0);
            map.transform_point3(Vec3::select(high, self.max, self.min))
        });
        let exact = corners.fold(Self::EMPTY, |all, p| all.with_point(p));
        let slack = exact.min.abs().max(exact.max.abs()) * (8.0 * f32::EPSILON);
        Self { min: exact.min - slack, max: exact.max + slack }
    }
}
