//! What goes into a ray query and what comes out.

use glam::Vec3;

/// A half-open question: what lies on `o + t d` for `tmin < t < tmax`?
///
/// Both ends are exclusive. `d` need not be of unit length; `t` counts in units of `d`. A negative `tmin` counts
/// as zero. A ray with a NaN, an infinite origin or direction, or a zero direction meets nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin.
    pub o: Vec3,
    /// Direction, of any length.
    pub d: Vec3,
    /// Hits must lie strictly beyond this parameter.
    pub tmin: f32,
    /// Hits must lie strictly before this parameter; may be infinite.
    pub tmax: f32,
}

impl Ray {
    /// The ray from `o` along `d` without an end, `t` in (0, ∞).
    pub const fn new(o: Vec3, d: Vec3) -> Self {
        Self { o, d, tmin: 0.0, tmax: f32::INFINITY }
    }

    /// The point `o + t d`.
    pub fn at(&self, t: f32) -> Vec3 {
        self.o + self.d * t
    }

    /// Whether the ray can meet anything at all.
    pub(crate) fn is_usable(&self) -> bool {
        self.o.is_finite() && self.d.is_finite() && self.d != Vec3::ZERO && self.tmin < self.tmax
    }
}

/// Where a ray meets a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Ray parameter, in units of the ray's direction.
    pub t: f32,
    /// Barycentric weight of vertex 1, so p = (1-u-v) p0 + u p1 + v p2; 0 for spheres.
    pub u: f32,
    /// Barycentric weight of vertex 2; 0 for spheres.
    pub v: f32,
    /// Index into the slice of geometries given for the object that was hit (or for the world).
    pub geometry: u32,
    /// Triangle within the geometry; 0 for spheres.
    pub primitive: u32,
    /// Index into the slice of instances, or [`Hit::NO_INSTANCE`] for geometry placed in the world directly.
    pub instance: u32,
}

impl Hit {
    /// The value of [`Hit::instance`] for geometry that is placed in the world without an instance.
    pub const NO_INSTANCE: u32 = u32::MAX;
}
