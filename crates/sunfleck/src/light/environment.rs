//! Light from all around: a colour, or a panorama that surrounds the scene at infinity.
use super::{Emitter, EmitterHit, LeOrigin, LeSample, LiSample, LightEnd, Surroundings, panorama::Panorama};
use crate::{
    math::warp::square_to_sphere,
    spectrum::{Illuminant, Rgb, Spectrum, Wavelengths},
    texture::ImageTexture,
};
use glam::{Mat3, Vec2, Vec3};
use std::f32::consts::PI;

/// Light that comes from infinitely far away in every direction.
#[derive(Clone, Debug)]
pub struct EnvironmentLight {
    /// Radiance, W/(m²·sr); what a panorama is multiplied by.
    radiance: Illuminant,
    panorama: Option<Box<Panorama>>,
}

/// Why a picture cannot surround the scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EnvironmentError {
    /// The matrix stretches or shears.
    #[error("an environment can be turned and mirrored, but its matrix also stretches or shears: {0}")]
    NotARotation(Mat3),
    /// A pixel that is no radiance.
    #[error("pixel ({x}, {y}) of the environment is {value}: radiance must be finite and not negative")]
    Pixel {
        /// Column.
        x: usize,
        /// Row from the top.
        y: usize,
        /// Its value.
        value: Rgb,
    },
}

/// Density (1/sr) of a direction out of all.
const UNIFORM: f32 = 0.25 / PI;

/// Whether a picture can be light on the sphere.
pub(super) fn check_map(image: &ImageTexture, world_from_map: Mat3) -> Result<(), EnvironmentError> {
    if !(world_from_map * world_from_map.transpose()).abs_diff_eq(Mat3::IDENTITY, 1e-3) {
        return Err(EnvironmentError::NotARotation(world_from_map));
    }
    for (y, x) in (0..image.height()).flat_map(|y| (0..image.width()).map(move |x| (y, x))) {
        let value = image.pixel(x, y);
        if !(value.is_finite() && value.min_element() >= 0.0) {
            return Err(EnvironmentError::Pixel { x, y, value });
        }
    }
    Ok(())
}

impl EnvironmentLight {
    /// The same `radiance` (W/(m²·sr)) from everywhere.
    pub fn constant(radiance: impl Into<Illuminant>) -> Self {
        Self { radiance: radiance.into(), panorama: None }
    }
    /// A latitude-longitude `image` of radiance over `scale`: the direction (x, y, z) of the map is found at
    /// `u = (atan2(z, x) + π)/2π` to the right and `acos(y)/π` down, as in NRenderer's forks. `world_from_map` turns those
    /// axes into the world's; it may mirror.
    ///
    /// # Errors
    /// A matrix that is not orthogonal, or a negative or non-finite pixel.
    pub fn panorama(
        image: ImageTexture,
        scale: impl Into<Illuminant>,
        world_from_map: Mat3,
    ) -> Result<Self, EnvironmentError> {
        check_map(&image, world_from_map)?;
        Ok(Self { radiance: scale.into(), panorama: Some(Box::new(Panorama::new(image, world_from_map))) })
    }
    /// Radiance, W/(m²·sr); of a panorama where it is white.
    pub fn radiance(&self) -> &Illuminant {
        &self.radiance
    }
    /// The picture, and what takes its axes to the world's, if there is one.
    pub fn picture(&self) -> Option<(&ImageTexture, Mat3)> {
        self.panorama.as_ref().map(|p| p.image())
    }
    /// Radiance arriving from the unit direction `d`.
    #[inline]
    fn arriving(&self, d: Vec3, lambda: Wavelengths) -> Spectrum {
        match &self.panorama {
            None => self.radiance.at(lambda),
            Some(p) => self.radiance.filtered(p.eval(d), lambda),
        }
    }
    #[inline]
    fn sample(&self, u: Vec2) -> (Vec3, f32) {
        self.panorama.as_ref().map_or_else(|| (square_to_sphere(u), UNIFORM), |p| p.sample(u))
    }
    #[inline]
    fn pdf(&self, d: Vec3) -> f32 {
        self.panorama.as_ref().map_or(UNIFORM, |p| p.pdf(d))
    }
}

impl Emitter for EnvironmentLight {
    fn name(&self) -> &'static str {
        "environment"
    }
    /// πR² times the integral of the radiance over all directions.
    fn power(&self, around: &Surroundings) -> Rgb {
        let integral = self.panorama.as_ref().map_or(Rgb::splat(4.0 * PI), |p| p.integral());
        self.radiance.rgb() * integral * around.disk_area()
    }
    #[inline]
    fn sample_li(&self, _: Vec3, u: Vec2, around: &Surroundings) -> Option<LiSample> {
        let (wi, pdf) = self.sample(u);
        let li = self.arriving(wi, around.lambda);
        (!li.is_black()).then_some(LiSample { wi, li, pdf, delta: false, end: LightEnd::Infinite })
    }
    #[inline]
    fn pdf_li(&self, _: Vec3, wi: Vec3, hit: Option<&EmitterHit>) -> f32 {
        if hit.is_some() { 0.0 } else { self.pdf(wi) }
    }
    #[inline]
    fn sample_le(&self, u_area: Vec2, u_dir: Vec2, around: &Surroundings) -> Option<LeSample> {
        let (from, pdf_dir) = self.sample(u_dir);
        let le = self.arriving(from, around.lambda);
        let ray = around.ray_from_outside(-from, u_area);
        (!le.is_black()).then(|| LeSample {
            ray,
            le,
            pdf_area: 1.0 / around.disk_area(),
            pdf_dir,
            cos: 1.0,
            origin: LeOrigin::Infinite,
        })
    }
    #[inline]
    fn pdf_le(&self, hit: Option<&EmitterHit>, d: Vec3, around: &Surroundings) -> (f32, f32) {
        if hit.is_some() { (0.0, 0.0) } else { (1.0 / around.disk_area(), self.pdf(-d)) }
    }
    fn le(&self, _: &EmitterHit, _: Vec3, _: Wavelengths) -> Spectrum {
        Spectrum::BLACK
    }
    #[inline]
    fn le_escaped(&self, d: Vec3, lambda: Wavelengths) -> Spectrum {
        self.arriving(d, lambda)
    }
    fn is_infinite(&self) -> bool {
        true
    }
    fn is_delta(&self) -> bool {
        false
    }
}
