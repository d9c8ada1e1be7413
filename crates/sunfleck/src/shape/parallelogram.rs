//! A flat patch `p + a u + b v` with a, b in [0, 1]: NRenderer's plane, and the usual area light.
use super::{AreaSample, SurfacePoint, gamma, plane_error, unit_and_length};
use accel::Hit;
use glam::{Affine3A, Vec2, Vec3};

/// A parallelogram; the outer side is that of `u × v`.
#[derive(Clone, Copy, Debug)]
pub struct Parallelogram {
    p: Vec3,
    u: Vec3,
    v: Vec3,
    /// What every hit and every drawn point asks for again.
    ng: Vec3,
    area: f32,
    p_error: Vec3,
}

impl Parallelogram {
    /// The patch with corner `p` and edges `u` and `v`, which are not parallel.
    pub fn new(p: Vec3, u: Vec3, v: Vec3) -> Self {
        let (ng, area) = unit_and_length(u.cross(v));
        // The bound at the far corner serves for every point.
        let p_error = gamma(5.0) * (p.abs() + u.abs() + v.abs()) + plane_error(u, u + v, ng, area);
        Self { p, u, v, ng, area, p_error }
    }
    /// Corner.
    pub fn p(&self) -> Vec3 {
        self.p
    }
    /// First edge.
    pub fn u(&self) -> Vec3 {
        self.u
    }
    /// Second edge.
    pub fn v(&self) -> Vec3 {
        self.v
    }
    /// Its corners; triangles (0, 1, 2) and (2, 3, 0) make it up, see [`Parallelogram::TRIANGLES`].
    pub fn corners(&self) -> [Vec3; 4] {
        [self.p, self.p + self.u, self.p + self.u + self.v, self.p + self.v]
    }
    /// Corner indices of its two triangles.
    pub const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [2, 3, 0]];

    #[inline]
    fn at(&self, a: f32, b: f32) -> Vec3 {
        self.p + a * self.u + b * self.v
    }
    #[inline]
    pub(super) fn surface_point(&self, hit: &Hit) -> SurfacePoint {
        // Triangle 0 runs along u, then v; triangle 1 comes back.
        let (a, b) = if hit.primitive == 0 { (hit.u + hit.v, hit.v) } else { (1.0 - (hit.u + hit.v), 1.0 - hit.v) };
        SurfacePoint { p: self.at(a, b), p_error: self.p_error, ng: self.ng, n: self.ng, uv: Vec2::new(a, b) }
    }
    #[inline]
    pub(super) fn area(&self) -> f32 {
        self.area
    }
    #[inline]
    pub(super) fn sample_area(&self, s: Vec2) -> AreaSample {
        AreaSample { p: self.at(s.x, s.y), p_error: self.p_error, ng: self.ng }
    }
    pub(super) fn transformed(&self, m: &Affine3A) -> Self {
        let (u, v) = (m.transform_vector3(self.u), m.transform_vector3(self.v));
        // A mirroring transform turns u × v to the other side; swapping the edges keeps the outer side outside.
        let (u, v) = if m.matrix3.determinant() < 0.0 { (v, u) } else { (u, v) };
        Self::new(m.transform_point3(self.p), u, v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_of_both_triangles_map_back_to_their_point() {
        let q = Parallelogram::new(Vec3::new(1.0, 0.0, 2.0), Vec3::new(2.0, 0.5, 0.0), Vec3::new(0.0, 1.0, -3.0));
        let c = q.corners();
        for (primitive, t) in Parallelogram::TRIANGLES.iter().enumerate() {
            let [p0, p1, p2] = t.map(|i| c[i as usize]);
            let (u, v) = (0.3, 0.2);
            let want = (1.0 - u - v) * p0 + u * p1 + v * p2;
            let hit = Hit { t: 1.0, u, v, geometry: 0, primitive: primitive as u32, instance: Hit::NO_INSTANCE };
            let s = q.surface_point(&hit);
            assert!((s.p - want).length() < 1e-5, "{primitive}");
            assert!((q.p + s.uv.x * q.u + s.uv.y * q.v - want).length() < 1e-5);
        }
    }

    #[test]
    fn mirroring_keeps_the_outer_side_outside() {
        let q = Parallelogram::new(Vec3::ZERO, Vec3::X, Vec3::Y);
        let m = q.transformed(&Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0)));
        assert!(m.ng.dot(Vec3::Z) > 0.99);
    }
}
