//! A light without extent whose strength depends on the direction, as measured with a goniometer.
use super::{
    Emitter, EmitterHit, EnvironmentError, LeOrigin, LeSample, LiSample, LightEnd, Surroundings,
    environment::check_map, panorama::Panorama,
};
use crate::{
    math::Ray,
    spectrum::{Illuminant, Rgb, Spectrum, Wavelengths},
    texture::ImageTexture,
};
use glam::{Mat3, Vec2, Vec3};

/// A point light that shines through a picture of the whole sphere around it.
#[derive(Clone, Debug)]
pub struct GoniometricLight {
    p: Vec3,
    /// Radiant intensity (W/sr) where the picture is white.
    intensity: Illuminant,
    picture: Box<Panorama>,
}

impl GoniometricLight {
    /// At `p`, with `intensity` (W/sr) where the latitude-longitude `picture` is white; it lies on the sphere as that of
    /// [`super::EnvironmentLight::panorama`] does, but gives the directions in which light leaves.
    ///
    /// # Errors
    /// A matrix that is not orthogonal, or a negative or non-finite pixel.
    pub fn new(
        p: Vec3,
        intensity: impl Into<Illuminant>,
        picture: ImageTexture,
        world_from_map: Mat3,
    ) -> Result<Self, EnvironmentError> {
        check_map(&picture, world_from_map)?;
        Ok(Self { p, intensity: intensity.into(), picture: Box::new(Panorama::new(picture, world_from_map)) })
    }
    /// Position.
    pub fn position(&self) -> Vec3 {
        self.p
    }
    /// Radiant intensity (W/sr) where the picture is white.
    pub fn intensity(&self) -> &Illuminant {
        &self.intensity
    }
    /// The picture, and what takes its axes to the world's.
    pub fn picture(&self) -> (&ImageTexture, Mat3) {
        self.picture.image()
    }
    /// Intensity in direction `d`.
    #[inline]
    fn toward(&self, d: Vec3, lambda: Wavelengths) -> Spectrum {
        self.intensity.filtered(self.picture.eval(d), lambda)
    }
}

impl Emitter for GoniometricLight {
    fn name(&self) -> &'static str {
        "goniometric"
    }
    fn power(&self, _: &Surroundings) -> Rgb {
        self.intensity.rgb() * self.picture.integral()
    }
    #[inline]
    fn sample_li(&self, from: Vec3, _: Vec2, around: &Surroundings) -> Option<LiSample> {
        let to = self.p - from;
        let wi = to.try_normalize()?;
        let li = self.toward(-wi, around.lambda) / to.length_squared();
        (!li.is_black()).then_some(LiSample { wi, li, pdf: 1.0, delta: true, end: LightEnd::Point(self.p) })
    }
    #[inline]
    fn sample_le(&self, _: Vec2, u_dir: Vec2, around: &Surroundings) -> Option<LeSample> {
        self.le_along(&LightEnd::Point(self.p), self.picture.sample(u_dir).0, around)
    }
    #[inline]
    fn start_le(&self, _: Vec2) -> LightEnd {
        LightEnd::Point(self.p)
    }
    #[inline]
    fn le_along(&self, _: &LightEnd, d: Vec3, around: &Surroundings) -> Option<LeSample> {
        let le = self.toward(d, around.lambda);
        let ray = Ray { o: self.p, d, tmin: 0.0, tmax: f32::INFINITY };
        let pdf_dir = self.picture.pdf(d);
        (!le.is_black()).then_some(LeSample { ray, le, pdf_area: 1.0, pdf_dir, cos: 1.0, origin: LeOrigin::Point })
    }
    #[inline]
    fn pdf_le(&self, hit: Option<&EmitterHit>, d: Vec3, _: &Surroundings) -> (f32, f32) {
        if hit.is_some() { (0.0, 0.0) } else { (1.0, self.picture.pdf(d)) }
    }
    fn is_delta(&self) -> bool {
        true
    }
}
