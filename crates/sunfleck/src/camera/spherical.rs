//! The whole sphere around a point as one picture.
use super::{CameraError, CameraRay, CameraSample, Project, Spread, View, frame::Stand};
use crate::math::{
    Ray,
    warp::{sphere_to_equal_area_square, square_to_equal_area_sphere},
};
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, PI, TAU};

/// How the sphere becomes a rectangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unrolling {
    /// Longitude from left to right, all around; the latitude from the pole above to the one below. The middle of the
    /// picture looks forward.
    #[default]
    Equirectangular,
    /// The equal-area map of Clarberg 2008 that folds the four triangles of the lower half outward; up is in the middle,
    /// forward at the lower edge, right at the right edge.
    EqualArea,
}

/// A camera that sees in all directions.
#[derive(Clone, Debug)]
pub struct Spherical {
    stand: Stand,
    unrolling: Unrolling,
}

impl Spherical {
    /// An eye that looks ahead in the middle of the picture (see [`Unrolling`] for the rest).
    ///
    /// # Errors
    /// Coinciding points.
    pub fn new(view: &View, unrolling: Unrolling) -> Result<Self, CameraError> {
        Ok(Self { stand: Stand::new(view)?, unrolling })
    }
    /// Exchanges left and right, as in programs whose axes are left-handed.
    pub fn mirrored(self) -> Self {
        Self { stand: self.stand.mirrored(), ..self }
    }
    /// Solid angle per raster area in the direction `d` (right, up, forward).
    fn solid_angle(&self, d: Vec3) -> f32 {
        match self.unrolling {
            // dφ·sin θ·dθ with φ over 2π and θ over π. Exactly at the poles there would be none.
            Unrolling::Equirectangular => TAU * PI * d.x.hypot(d.z).max(1e-6),
            Unrolling::EqualArea => 4.0 * PI,
        }
    }
    fn direction(&self, raster: Vec2) -> Vec3 {
        match self.unrolling {
            Unrolling::Equirectangular => {
                let ((sin_phi, cos_phi), (sin, cos)) = ((TAU * (raster.x - 0.5)).sin_cos(), (PI * raster.y).sin_cos());
                Vec3::new(sin * sin_phi, cos, sin * cos_phi)
            }
            Unrolling::EqualArea => {
                let d = square_to_equal_area_sphere(raster);
                Vec3::new(d.x, d.z, d.y)
            }
        }
    }
    fn raster(&self, d: Vec3) -> Vec2 {
        match self.unrolling {
            Unrolling::Equirectangular => {
                let theta = d.x.hypot(d.z).atan2(d.y);
                Vec2::new(0.5 + d.x.atan2(d.z) / TAU, theta * FRAC_1_PI)
            }
            Unrolling::EqualArea => sphere_to_equal_area_square(Vec3::new(d.x, d.z, d.y)),
        }
    }
}

impl Project for Spherical {
    #[inline]
    fn ray(&self, raster: Vec2, _: Vec2) -> CameraRay {
        let local = self.direction(raster);
        let ray = Ray { o: self.stand.position, d: self.stand.to_world(local), tmin: 0.0, tmax: f32::INFINITY };
        CameraRay { ray, spread: Spread::SolidAngle(self.solid_angle(local)) }
    }
    #[inline]
    fn sample_wi(&self, from: Vec3, _: Vec2) -> Option<CameraSample> {
        let to = self.stand.position - from;
        let wi = to.try_normalize()?;
        let local = self.stand.to_local(-wi);
        let importance = 1.0 / (self.solid_angle(local) * to.length_squared());
        Some(CameraSample { p: self.stand.position, wi, raster: self.raster(local), importance })
    }
    #[inline]
    fn has_lens(&self) -> bool {
        false
    }
    /// The eye moves along a straight line and turns at constant speed.
    fn between(&self, to: &Self, time: f32) -> Option<Self> {
        let stand = self.stand.between(&to.stand, time)?;
        (self.unrolling == to.unrolling).then_some(Self { stand, unrolling: self.unrolling })
    }
}
