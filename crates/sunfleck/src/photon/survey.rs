//! What the camera sees: a sample of the places where gathers will happen, taken before the first pass.
use super::sight::Sight;
use crate::{
    film::FilmSpec,
    sampler::{Domain, Sampler},
    scene::{MID_SHUTTER, Scene},
    spectrum::Wavelengths,
    walk::Limits,
};
use glam::Vec3;
use rayon::prelude::*;

/// A place where a camera path first meets a surface that gathers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// Position.
    pub p: Vec3,
    /// Width (world units) of the picture's pixels there, across the path.
    pub width: f32,
}

/// Camera paths of a survey: medians to about 2 %.
const PATHS: u64 = 1024;

/// Follows camera paths, spread over the picture, to the first surface that gathers. Paths that meet
/// none are left out.
pub fn survey(scene: &Scene, spec: FilmSpec, limits: &Limits, seed: u64) -> Vec<Sighting> {
    let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
    let look = |index| {
        let mut sampler = Sampler::new(seed, Domain::Prepare, u64::MAX, index);
        let (raster, u_lens) = (sampler.next_2d(), sampler.next_2d());
        let seen = Sight::find(&world, *limits, raster, u_lens, &mut sampler)?;
        Some(Sighting { p: seen.at.p, width: seen.width(spec) })
    };
    (0..PATHS).into_par_iter().filter_map(look).collect()
}
