//! A flat patch `p + a u + b v` with a, b in [0, 1]: NRenderer's plane, and the usual area light.
use super::{AreaSample, SurfacePoint, gamma, plane_error};
use accel::Hit;
use glam::{Affine3A, Vec2, Vec3};

/// A parallelogram; the outer side is that of `u × v`.
#[derive(Clone, Copy, Debug)]
pub struct Parallelogram {
    /// Corner.
    pub p: Vec3,
    /// First edge.
    pub u: Vec3,
    /// Second edge, not parallel to the first.
    pub v: Vec3,
}

impl Parallelogram {
    /// Its corners; triangles (0, 1, 2) and (2, 3, 0) make it up, see [`Parallelogram::TRIANGLES`].
    pub fn corners(&self) -> [Vec3; 4] {
        [self.p, self.p + self.u, self.p + self.u + self.v, self.p + self.v]
    }
    /// Corner indices of its two triangles.
    pub const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [2, 3, 0]];

    #[inline]
    fn ng(&self) -> Vec3 {
        self.u.cross(self.v).normalize_or(Vec3::Z)
    }
    #[inline]
    fn at(&self, a: f32, b: f32) -> (Vec3, Vec3) {
        let (au, bv) = (a * self.u, b * self.v);
        let rounding = gamma(5.0) * (self.p.abs() + au.abs() + bv.abs());
        (self.p + au + bv, rounding + plane_error(self.u, self.u + self.v, self.u.cross(self.v)))
    }
    #[inline]
    pub(super) fn surface_point(&self, hit: &Hit) -> SurfacePoint {
        // Triangle 0 runs along u, then v; triangle 1 comes back.
        let (a, b) = if hit.primitive == 0 { (hit.u + hit.v, hit.v) } else { (1.0 - (hit.u + hit.v), 1.0 - hit.v) };
        let (p, p_error) = self.at(a, b);
        let ng = self.ng();
        SurfacePoint { p, p_error, ng, n: ng, uv: Vec2::new(a, b) }
    }
    pub(super) fn area(&self) -> f32 {
        self.u.cross(self.v).length()
    }
    pub(super) fn sample_area(&self, s: Vec2) -> AreaSample {
        let (p, p_error) = self.at(s.x, s.y);
        AreaSample { p, p_error, ng: self.ng() }
    }
    pub(super) fn transformed(&self, m: &Affine3A) -> Self {
        let (u, v) = (m.transform_vector3(self.u), m.transform_vector3(self.v));
        // A mirroring transform turns u × v to the other side; swapping the edges keeps the outer side outside.
        let (u, v) = if m.matrix3.determinant() < 0.0 { (v, u) } else { (u, v) };
        Self { p: m.transform_point3(self.p), u, v }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hits_of_both_triangles_map_back_to_their_point() {
        let q =
            Parallelogram { p: Vec3::new(1.0, 0.0, 2.0), u: Vec3::new(2.0, 0.5, 0.0), v: Vec3::new(0.0, 1.0, -3.0) };
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
        let q = Parallelogram { p: Vec3::ZERO, u: Vec3::X, v: Vec3::Y };
        let m = q.transformed(&Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0)));
        assert!(m.ng().dot(Vec3::Z) > 0.99);
    }
}
