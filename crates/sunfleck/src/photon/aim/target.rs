//! A sphere that light paths are sent to: by a cone from a place, by a disk across a direction from infinity.
use crate::{
    light::across,
    math::{
        Frame,
        warp::{square_to_cone, square_to_cone_pdf, square_to_sphere},
    },
};
use glam::{Vec2, Vec3};
use std::f32::consts::PI;

/// Where light is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Centre of the sphere.
    pub centre: Vec3,
    /// Its radius, > 0.
    pub radius: f32,
}

impl Target {
    /// The axis of the cone that the sphere fills seen from `from`, and one minus the cosine of its half-angle. `None`
    /// from inside.
    #[inline]
    fn cone(&self, from: Vec3) -> Option<(Vec3, f32)> {
        let to = self.centre - from;
        let d2 = to.length_squared();
        let sin2 = self.radius * self.radius / d2;
        (sin2 < 1.0).then(|| (to / d2.sqrt(), sin2 / (1.0 + (1.0 - sin2).sqrt())))
    }
    /// A unit direction from `from` toward the sphere, even in solid angle; from inside, any.
    #[inline]
    pub(super) fn sample_direction(&self, from: Vec3, u: Vec2) -> Vec3 {
        match self.cone(from) {
            Some((axis, versine)) => Frame::from_normal(axis).to_world(square_to_cone(u, versine)),
            None => square_to_sphere(u),
        }
    }
    /// Density (1/sr) of [`Target::sample_direction`] within its cone.
    #[inline]
    pub(super) fn pdf_direction_inside(&self, from: Vec3) -> f32 {
        self.cone(from).map_or(0.25 / PI, |(_, versine)| square_to_cone_pdf(versine))
    }
    /// Density (1/sr) of [`Target::sample_direction`].
    #[inline]
    pub(super) fn pdf_direction(&self, from: Vec3, d: Vec3) -> f32 {
        match self.cone(from) {
            Some((axis, versine)) if 0.5 * axis.distance_squared(d) <= versine => square_to_cone_pdf(versine),
            Some(_) => 0.0,
            None => 0.25 / PI,
        }
    }
    /// A point on the disk of the sphere across the unit direction `d`, even in area.
    #[inline]
    pub(super) fn sample_across(&self, d: Vec3, u: Vec2) -> Vec3 {
        across(self.centre, self.radius, d, u)
    }
    /// Density (1/m²) of [`Target::sample_across`] on its disk.
    #[inline]
    pub(super) fn pdf_across_inside(&self) -> f32 {
        1.0 / (PI * self.radius * self.radius)
    }
    /// Density (1/m²) with which [`Target::sample_across`] draws the line through `p` along the unit direction `d`.
    #[inline]
    pub(super) fn pdf_across(&self, p: Vec3, d: Vec3) -> f32 {
        let to = self.centre - p;
        let off = to - to.dot(d) * d;
        if off.length_squared() <= self.radius * self.radius { self.pdf_across_inside() } else { 0.0 }
    }
}
