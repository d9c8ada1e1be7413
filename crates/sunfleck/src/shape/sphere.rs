//! A full sphere.
use super::{AreaSample, SurfacePoint, gamma};
use crate::math::{
    Frame,
    warp::{square_to_cone, square_to_cone_pdf, square_to_sphere},
};
use glam::{Affine3A, Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// A full sphere; the outer side is outside.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    /// Centre.
    pub centre: Vec3,
    /// Radius, > 0.
    pub radius: f32,
}

impl Sphere {
    /// The point of the surface nearest to `at`: hits are pulled onto the sphere, which makes their error independent
    /// of how far the ray came.
    #[inline]
    pub(super) fn surface_point(&self, at: Vec3, wants_uv: bool) -> SurfacePoint {
        let n = (at - self.centre).normalize_or(Vec3::Z);
        let uv = if wants_uv { Self::uv(n) } else { Vec2::ZERO };
        SurfacePoint { p: self.centre + self.radius * n, p_error: self.p_error(), ng: n, n, uv }
    }
    /// Longitude and latitude about the z axis of the unit vector `n`.
    fn uv(n: Vec3) -> Vec2 {
        let v = n.z.clamp(-1.0, 1.0).acos() / PI;
        let u = n.y.atan2(n.x).rem_euclid(TAU) / TAU;
        Vec2::new(u, 1.0 - v)
    }
    /// Along the circle of latitude and up the meridian, at the point with normal `n`.
    pub(super) fn tangents(&self, n: Vec3) -> Option<[Vec3; 2]> {
        let r = n.truncate().length();
        (r > 0.0).then(|| {
            let out = n.truncate() / r;
            let up = Vec3::new(-n.z * out.x, -n.z * out.y, r);
            [TAU * self.radius * Vec3::new(-n.y, n.x, 0.0), PI * self.radius * up]
        })
    }
    #[inline]
    fn p_error(&self) -> Vec3 {
        gamma(6.0) * (self.centre.abs() + self.radius)
    }
    pub(super) fn area(&self) -> f32 {
        4.0 * PI * self.radius * self.radius
    }
    pub(super) fn sample_area(&self, u: Vec2) -> AreaSample {
        let n = square_to_sphere(u);
        AreaSample { p: self.centre + self.radius * n, p_error: self.p_error(), ng: n }
    }
    /// A point of the side seen from `from`, uniform in the solid angle: `(point, pdf in 1/sr)`. `None` from inside.
    pub fn sample_visible(&self, from: Vec3, u: Vec2) -> Option<(AreaSample, f32)> {
        let to_centre = self.centre - from;
        let one_minus_cos_max = self.cone(to_centre)?;
        let d2 = to_centre.length_squared();
        let w = square_to_cone(u, one_minus_cos_max);
        let w = Frame::from_normal(to_centre / d2.sqrt()).to_world(w);
        // Nearer intersection of the ray with the sphere; the tangent where rounding says it misses.
        let b = w.dot(to_centre);
        let perpendicular = to_centre - b * w;
        let half = (self.radius * self.radius - perpendicular.length_squared()).max(0.0).sqrt();
        let n = ((b - half) * w - to_centre).normalize_or(-w);
        let p = AreaSample { p: self.centre + self.radius * n, p_error: self.p_error(), ng: n };
        Some((p, square_to_cone_pdf(one_minus_cos_max)))
    }
    /// Density (1/sr) of [`Sphere::sample_visible`] toward any point of the visible side; `None` from inside.
    pub fn visible_pdf(&self, from: Vec3) -> Option<f32> {
        self.cone(self.centre - from).map(square_to_cone_pdf)
    }
    /// 1 − cos of the half-angle under which the sphere is seen.
    fn cone(&self, to_centre: Vec3) -> Option<f32> {
        let sin2 = self.radius * self.radius / to_centre.length_squared();
        // Closer than that, rounding leaves no direction to aim at.
        (sin2 < 0.999_99).then(|| sin2 / (1.0 + (1.0 - sin2).sqrt()))
    }
    pub(super) fn transformed(&self, m: &Affine3A) -> Option<Self> {
        let (x, y, z) = (Vec3::from(m.matrix3.x_axis), Vec3::from(m.matrix3.y_axis), Vec3::from(m.matrix3.z_axis));
        let s = x.length();
        let tolerance = 1e-4 * s;
        let even = (y.length() - s).abs() < tolerance && (z.length() - s).abs() < tolerance;
        let square = [x.dot(y), y.dot(z), z.dot(x)].iter().all(|d| d.abs() < tolerance * s);
        (even && square && s > 0.0).then(|| Self { centre: m.transform_point3(self.centre), radius: s * self.radius })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn visible_points_lie_on_the_near_side_with_the_stated_density() {
        let s = Sphere { centre: Vec3::new(1.0, 2.0, 3.0), radius: 0.5 };
        let from = Vec3::new(-1.0, 0.0, 2.5);
        let d2 = s.centre.distance_squared(from);
        let solid_angle = TAU * (1.0 - (1.0 - s.radius * s.radius / d2).sqrt());
        assert!((s.visible_pdf(from).unwrap() * solid_angle - 1.0).abs() < 1e-4);
        for i in 0..256 {
            let u = Vec2::new((i % 16) as f32 + 0.5, (i / 16) as f32 + 0.5) / 16.0;
            let (q, pdf) = s.sample_visible(from, u).unwrap();
            assert!((q.p.distance(s.centre) - s.radius).abs() < 1e-5);
            assert!(q.ng.dot(from - q.p) > -1e-4, "the far side was drawn");
            assert!((pdf - s.visible_pdf(from).unwrap()).abs() < 1e-5);
        }
        assert!(s.sample_visible(s.centre + 0.1, Vec2::splat(0.5)).is_none());
    }

    #[test]
    fn a_sphere_follows_rotations_and_even_scaling_only() {
        let s = Sphere { centre: Vec3::X, radius: 1.0 };
        let moved = s
            .transformed(&Affine3A::from_scale_rotation_translation(
                Vec3::splat(2.0),
                glam::Quat::from_rotation_z(1.0),
                Vec3::Y,
            ))
            .unwrap();
        assert!((moved.radius - 2.0).abs() < 1e-5);
        assert!(s.transformed(&Affine3A::from_scale(Vec3::new(1.0, 2.0, 1.0))).is_none());
    }
}
