//! A light without extent that shines evenly in all directions.
use super::{Emitter, EmitterHit, LeOrigin, LeSample, LiSample, LightEnd, Surroundings};
use crate::{
    math::{Ray, warp::square_to_sphere},
    spectrum::{Illuminant, Rgb},
};
use glam::{Vec2, Vec3};
use std::f32::consts::PI;

/// An isotropic point light.
#[derive(Clone, Debug)]
pub struct PointLight {
    /// Position.
    pub p: Vec3,
    /// Radiant intensity, W/sr.
    pub intensity: Illuminant,
}

impl Emitter for PointLight {
    fn name(&self) -> &'static str {
        "point"
    }
    fn power(&self, _: &Surroundings) -> Rgb {
        self.intensity.rgb() * (4.0 * PI)
    }
    #[inline]
    fn sample_li(&self, from: Vec3, _: Vec2, around: &Surroundings) -> Option<LiSample> {
        let to = self.p - from;
        let d2 = to.length_squared();
        let wi = to.try_normalize()?;
        let li = self.intensity.at(around.lambda) / d2;
        Some(LiSample { wi, li, pdf: 1.0, delta: true, end: LightEnd::Point(self.p) })
    }
    #[inline]
    fn sample_le(&self, _: Vec2, u_dir: Vec2, around: &Surroundings) -> Option<LeSample> {
        self.le_along(&LightEnd::Point(self.p), square_to_sphere(u_dir), around)
    }
    #[inline]
    fn start_le(&self, _: Vec2) -> LightEnd {
        LightEnd::Point(self.p)
    }
    #[inline]
    fn le_along(&self, _: &LightEnd, d: Vec3, around: &Surroundings) -> Option<LeSample> {
        let ray = Ray { o: self.p, d, tmin: 0.0, tmax: f32::INFINITY };
        let le = self.intensity.at(around.lambda);
        Some(LeSample { ray, le, pdf_area: 1.0, pdf_dir: 0.25 / PI, cos: 1.0, origin: LeOrigin::Point })
    }
    #[inline]
    fn pdf_le(&self, hit: Option<&EmitterHit>, _: Vec3, _: &Surroundings) -> (f32, f32) {
        if hit.is_some() { (0.0, 0.0) } else { (1.0, 0.25 / PI) }
    }
    fn is_delta(&self) -> bool {
        true
    }
}
