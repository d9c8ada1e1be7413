//! What the camera sees: a sample of the places where gathers will happen, taken before the first pass.
use crate::{
    bsdf::Transport,
    camera::{Project, Spread},
    film::FilmSpec,
    sampler::{Domain, Sampler},
    scene::{MID_SHUTTER, Scene},
    spectrum::{Spectrum, Wavelengths},
    walk::{Arrival, Limits, Start, Step, Visit, walk},
};
use glam::Vec3;
use rayon::prelude::*;

/// A place where a camera path first meets a connectible surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// Position.
    pub p: Vec3,
    /// Width (world units) of the picture's pixels there, across the path.
    pub width: f32,
}

/// Camera paths of a survey: medians to about 2 %.
const PATHS: u64 = 1024;

/// Follows camera paths, spread over the picture, through delta surfaces to the first connectible one. Paths that meet
/// none are left out.
pub fn survey(scene: &Scene, spec: FilmSpec, limits: &Limits, seed: u64) -> Vec<Sighting> {
    let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
    let look = |index| {
        let mut sampler = Sampler::new(seed, Domain::Prepare, u64::MAX, index);
        let camera = world.camera().ray(sampler.next_2d(), sampler.next_2d());
        let start = Start { ray: camera.ray, beta: Spectrum::ONE, mode: Transport::Radiance, dispersed: false };
        let mut first = First { pixel: camera.spread.of_pixel(spec.pixels()), found: None };
        walk(&world, &start, limits, &mut sampler, &mut first);
        first.found
    };
    (0..PATHS).into_par_iter().filter_map(look).collect()
}

struct First {
    pixel: Spread,
    found: Option<Sighting>,
}

impl Visit for First {
    fn surface(&mut self, a: &Arrival, _: &mut Sampler) -> Step {
        if !a.at.is_connectible() {
            return Step::OnIfDelta;
        }
        self.found = Some(Sighting { p: a.at.p, width: self.pixel.width_at(a.travelled) });
        Step::Stop
    }
}
