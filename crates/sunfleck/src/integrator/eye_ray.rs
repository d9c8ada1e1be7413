//! The camera's end of a path: which place of a pixel, through which point of the lens.
use super::Pass;
use crate::{
    camera::{CameraRay, Project},
    film::{FilmSpec, Sample},
    sampler::{Domain, Sampler},
    scene::World,
    walk::Start,
};
use glam::Vec2;

/// A camera ray and the stream of numbers that goes on with its path.
pub(super) struct EyeRay {
    /// Place on the picture.
    pub(super) raster: Vec2,
    /// What is found there counts so much: see [`crate::film::Sample`].
    pub(super) weight: f32,
    /// Ray and solid angle.
    pub(super) camera: CameraRay,
    /// The path's numbers; two pairs are drawn.
    pub(super) sampler: Sampler<'static>,
}

/// The pair of numbers for a point of the lens; drawn if there is a lens.
#[inline]
pub(super) fn lens_point(world: &World, sampler: &mut Sampler) -> Vec2 {
    if world.camera().has_lens() { sampler.next_2d() } else { Vec2::splat(sampler.skip()) }
}

impl EyeRay {
    /// Sample number `sample` of pixel (`x`, `y`): for one sample a pass, the number of the pass.
    #[inline]
    pub(super) fn new(world: &World, spec: FilmSpec, pass: &Pass, sample: u64, (x, y): (u32, u32)) -> Self {
        let pixel = u64::from(y) * u64::from(spec.width) + u64::from(x);
        let mut sampler = Sampler::new(pass.seed, Domain::Camera, sample, pixel);
        let Sample { raster, weight } = spec.sample(x, y, sampler.next_2d());
        let camera = world.camera().ray(raster, lens_point(world, &mut sampler));
        Self { raster, weight, camera, sampler }
    }
    /// The beginning of a camera walk.
    #[inline]
    pub(super) fn start(&self, world: &World) -> Start {
        Start::from_camera(world, self.camera.ray)
    }
}
