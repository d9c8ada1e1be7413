//! Light from infinitely far away in one direction: the sun without its disk.
use super::{Emitter, EmitterHit, LeOrigin, LeSample, LiSample, LightEnd, Surroundings};
use crate::spectrum::{Illuminant, Rgb};
use glam::{Vec2, Vec3};

/// A distant light.
#[derive(Clone, Debug)]
pub struct DirectionalLight {
    /// Unit direction in which the light travels.
    direction: Vec3,
    irradiance: Illuminant,
}

impl DirectionalLight {
    /// Light that travels along `direction` (of any length) and brings `irradiance` (W/m²) to a surface facing it.
    /// `None` if the direction is zero or not finite.
    pub fn new(direction: Vec3, irradiance: impl Into<Illuminant>) -> Option<Self> {
        Some(Self { direction: direction.try_normalize()?, irradiance: irradiance.into() })
    }
    /// Unit direction in which the light travels.
    pub fn direction(&self) -> Vec3 {
        self.direction
    }
    /// Irradiance (W/m²) of a surface that faces it.
    pub fn irradiance(&self) -> &Illuminant {
        &self.irradiance
    }
}

impl Emitter for DirectionalLight {
    fn name(&self) -> &'static str {
        "directional"
    }
    /// E·πR².
    fn power(&self, around: &Surroundings) -> Rgb {
        self.irradiance.rgb() * around.disk_area()
    }
    #[inline]
    fn sample_li(&self, _: Vec3, _: Vec2, around: &Surroundings) -> Option<LiSample> {
        let li = self.irradiance.at(around.lambda);
        Some(LiSample { wi: -self.direction, li, pdf: 1.0, delta: true, end: LightEnd::Infinite })
    }
    #[inline]
    fn sample_le(&self, u_area: Vec2, _: Vec2, around: &Surroundings) -> Option<LeSample> {
        Some(LeSample {
            ray: around.ray_from_outside(self.direction, u_area),
            le: self.irradiance.at(around.lambda),
            pdf_area: 1.0 / around.disk_area(),
            pdf_dir: 1.0,
            cos: 1.0,
            origin: LeOrigin::Infinite,
        })
    }
    /// `d` is taken to be the direction of the light: no other is asked for.
    #[inline]
    fn pdf_le(&self, hit: Option<&EmitterHit>, _: Vec3, around: &Surroundings) -> (f32, f32) {
        if hit.is_some() { (0.0, 0.0) } else { (1.0 / around.disk_area(), 1.0) }
    }
    fn is_delta(&self) -> bool {
        true
    }
}
