//! The camera's end of a path: which place of a pixel, through which point of the lens.
use super::Pass;
use crate::{
    camera::{CameraRay, CameraSample, Project, Spread},
    film::{FilmSpec, Sample},
    sampler::{Domain, Sampler},
    scene::{Interaction, World},
    texture::Cone,
    walk::{Arrival, Start},
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
    /// What its pixel covers.
    cone: Cone,
}

/// What a pixel covers in pass `index`, out of a `spread` per raster area: less and less, so that the mean of many passes shows
/// what rays without a width see.
#[inline]
pub(super) fn cone_of(spread: Spread, spec: FilmSpec, index: u64) -> Cone {
    let share = 1.0 / ((index + 1) as f32).sqrt();
    match spread.of_pixel(spec.pixels()) {
        Spread::SolidAngle(w) => Cone { width: 0.0, spread: share * w.sqrt() },
        Spread::Area(a) => Cone { width: share * a.sqrt(), spread: 0.0 },
    }
}

/// The pair of numbers for a point of the lens; drawn if there is a lens.
#[inline]
pub(super) fn lens_point(world: &World, sampler: &mut Sampler) -> Vec2 {
    if world.camera().has_lens() { sampler.next_2d() } else { Vec2::splat(sampler.skip()) }
}

/// `a`, where a walk from a light met a surface, as the camera sees it that `c` connects it to: as [`cone_of`] makes it for a
/// ray from there.
#[inline]
pub(super) fn seen_from_lens(world: &World, a: &Arrival, c: &CameraSample, spec: FilmSpec, index: u64) -> Interaction {
    let area = 1.0 / (c.importance * spec.pixels() as f32);
    world.seen(a.at, a.ray, -c.wi, (area / (index + 1) as f32).sqrt())
}

impl EyeRay {
    /// Sample number `sample` of pixel (`x`, `y`): for one sample a pass, the number of the pass.
    #[inline]
    pub(super) fn new(world: &World, spec: FilmSpec, pass: &Pass, sample: u64, (x, y): (u32, u32)) -> Self {
        let pixel = u64::from(y) * u64::from(spec.width) + u64::from(x);
        let mut sampler = Sampler::new(pass.seed, Domain::Camera, sample, pixel);
        let Sample { raster, weight } = spec.sample(x, y, sampler.next_2d());
        let camera = world.camera().ray(raster, lens_point(world, &mut sampler));
        let cone = cone_of(camera.spread, spec, pass.index);
        Self { raster, weight, camera, sampler, cone }
    }
    /// The beginning of a camera walk.
    #[inline]
    pub(super) fn start(&self, world: &World) -> Start {
        Start { cone: self.cone, ..Start::from_camera(world, self.camera.ray) }
    }
}
