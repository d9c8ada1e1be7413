//! The sun: an even disc infinitely far away.
use super::{Emitter, EmitterHit, LeOrigin, LeSample, LiSample, LightEnd, Surroundings};
use crate::{
    math::{Frame, Local},
    spectrum::{Illuminant, Rgb, Spectrum, Wavelengths},
};
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// A distant disc, small or not.
#[derive(Clone, Debug)]
pub struct SunLight {
    /// Its axis is the direction to the middle of the disc.
    frame: Frame,
    /// Angle (radians) from the middle to the edge.
    radius: f32,
    irradiance: Illuminant,
}

impl SunLight {
    /// Light that travels along `direction` (of any length) from a disc of angular `radius` (radians, kept within 10⁻⁴ and a
    /// quarter turn), and brings `irradiance` (W/m²) to a surface facing it. `None` if the direction is zero or not finite.
    pub fn new(direction: Vec3, radius: f32, irradiance: impl Into<Illuminant>) -> Option<Self> {
        let frame = Frame::from_normal(-direction.try_normalize()?);
        Some(Self { frame, radius: radius.clamp(1e-4, FRAC_PI_2), irradiance: irradiance.into() })
    }
    /// Unit direction in which the light of its middle travels.
    pub fn direction(&self) -> Vec3 {
        -self.frame.n
    }
    /// Angle (radians) from the middle to the edge.
    pub fn radius(&self) -> f32 {
        self.radius
    }
    /// Irradiance (W/m²) of a surface that faces it.
    pub fn irradiance(&self) -> &Illuminant {
        &self.irradiance
    }
    /// 1 − cos of the radius, with all its digits.
    #[inline]
    fn depth(&self) -> f32 {
        let half = (0.5 * self.radius).sin();
        2.0 * half * half
    }
    /// Density (1/sr) of a direction out of those to the disc.
    #[inline]
    fn density(&self) -> f32 {
        1.0 / (TAU * self.depth())
    }
    /// Whether the disc lies in the unit direction `d`; by the chord, as all the digits of a cosine near 1 are nines. Directions
    /// drawn at the edge belong to it.
    #[inline]
    fn covers(&self, d: Vec3) -> bool {
        0.5 * (d - self.frame.n).length_squared() <= self.depth() * 1.0002
    }
    /// The irradiance over `π sin²` of the radius.
    #[inline]
    fn radiance(&self, lambda: Wavelengths) -> Spectrum {
        let sin = self.radius.sin();
        self.irradiance.at(lambda) / (PI * sin * sin)
    }
    /// A direction to the disc, uniform in solid angle.
    #[inline]
    fn sample(&self, u: Vec2) -> Vec3 {
        let h = u.x * self.depth();
        let r = (h * (2.0 - h)).max(0.0).sqrt();
        let (y, x) = (TAU * u.y).sin_cos();
        self.frame.to_world(Local(Vec3::new(r * x, r * y, 1.0 - h))).normalize()
    }
}

impl Emitter for SunLight {
    fn name(&self) -> &'static str {
        "sun"
    }
    /// πR² times the radiance and the solid angle.
    fn power(&self, around: &Surroundings) -> Rgb {
        let sin = self.radius.sin();
        self.irradiance.rgb() * (2.0 * self.depth() / (sin * sin) * around.disk_area())
    }
    #[inline]
    fn sample_li(&self, _: Vec3, u: Vec2, around: &Surroundings) -> Option<LiSample> {
        let (wi, li) = (self.sample(u), self.radiance(around.lambda));
        Some(LiSample { wi, li, pdf: self.density(), delta: false, end: LightEnd::Infinite })
    }
    #[inline]
    fn pdf_li(&self, _: Vec3, wi: Vec3, hit: Option<&EmitterHit>) -> f32 {
        if hit.is_none() && self.covers(wi) { self.density() } else { 0.0 }
    }
    #[inline]
    fn sample_le(&self, u_area: Vec2, u_dir: Vec2, around: &Surroundings) -> Option<LeSample> {
        let from = self.sample(u_dir);
        Some(LeSample {
            ray: around.ray_from_outside(-from, u_area),
            le: self.radiance(around.lambda),
            pdf_area: 1.0 / around.disk_area(),
            pdf_dir: self.density(),
            cos: 1.0,
            origin: LeOrigin::Infinite,
        })
    }
    #[inline]
    fn pdf_le(&self, hit: Option<&EmitterHit>, d: Vec3, around: &Surroundings) -> (f32, f32) {
        let is_seen = hit.is_none() && self.covers(-d);
        if is_seen { (1.0 / around.disk_area(), self.density()) } else { (0.0, 0.0) }
    }
    #[inline]
    fn le_escaped(&self, d: Vec3, lambda: Wavelengths) -> Spectrum {
        if self.covers(d) { self.radiance(lambda) } else { Spectrum::BLACK }
    }
    fn is_infinite(&self) -> bool {
        true
    }
    fn is_delta(&self) -> bool {
        false
    }
}
