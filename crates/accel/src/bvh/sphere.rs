//! Spheres as exact quadrics.

use crate::{Hit, Ray};
use glam::{DVec3, Vec3};

/// A sphere and its place in the caller's geometry.
#[derive(Clone, Copy)]
pub(super) struct Sphere {
    pub(super) centre: Vec3,
    pub(super) radius: f32,
    pub(super) geometry: u32,
}

impl Sphere {
    /// Both parameters at which the line of the ray meets the surface, in rising order.
    ///
    /// In f64 throughout: the discriminant is taken from the part of the centre's offset perpendicular to the ray, and
    /// the smaller root from the product of the roots, so that neither far nor tiny spheres cancel (Haines et al.
    /// 2019, "Precision Improvements for Ray/Sphere Intersection").
    pub(super) fn roots(&self, ray: &Ray) -> Option<[f32; 2]> {
        let (o, d, centre) = (ray.o.as_dvec3(), ray.d.as_dvec3(), self.centre.as_dvec3());
        let radius = f64::from(self.radius);
        let to_origin: DVec3 = o - centre;
        let a = d.length_squared();
        let half_b = -to_origin.dot(d);
        let perpendicular = to_origin + d * (half_b / a);
        let discriminant = radius * radius - perpendicular.length_squared();
        if discriminant.is_nan() || discriminant < 0.0 {
            return None;
        }
        let q = half_b + (a * discriminant).sqrt().copysign(half_b);
        let c = to_origin.length_squared() - radius * radius;
        let (t0, t1) = (c / q, q / a);
        Some([t0.min(t1) as f32, t0.max(t1) as f32])
    }

    pub(super) fn hit(&self, t: f32, instance: u32) -> Hit {
        Hit { t, u: 0.0, v: 0.0, geometry: self.geometry, primitive: 0, instance }
    }
}
