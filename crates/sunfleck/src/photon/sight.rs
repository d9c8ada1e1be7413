//! Where a camera path first gathers.
use crate::{
    bsdf::Lobes,
    camera::{Project, Spread},
    film::FilmSpec,
    sampler::Sampler,
    scene::{Interaction, World},
    spectrum::Spectrum,
    walk::{Arrival, Limits, Start, Step, Visit, walk},
};
use glam::Vec2;

/// The first surface on a camera path that gathers photons, past mirrors and glass.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight {
    pub(crate) at: Interaction,
    /// Throughput of the path that leads there.
    pub(super) beta: Spectrum,
    pub(super) scatterings: u32,
    pub(super) dispersed: bool,
    /// Distance travelled.
    travelled: f32,
    /// That of [`crate::camera::CameraRay`].
    spread: Spread,
}

impl Sight {
    /// Follows the path that begins at `raster` through the lens at `u_lens`; `None` if it meets no such surface.
    pub(crate) fn find(
        world: &World,
        limits: Limits,
        raster: Vec2,
        u_lens: Vec2,
        sampler: &mut Sampler,
    ) -> Option<Self> {
        let camera = world.camera().ray(raster, u_lens);
        let start = Start::from_camera(world, camera.ray);
        let mut first = First { least: limits.gathers, spread: camera.spread, found: None };
        walk(world, &start, &limits, sampler, &mut first);
        first.found
    }
    /// Width (world units) of a pixel at the distance travelled.
    pub(crate) fn width(&self, spec: FilmSpec) -> f32 {
        self.spread.of_pixel(spec.pixels()).width_at(self.travelled)
    }
}

struct First {
    least: Lobes,
    spread: Spread,
    found: Option<Sight>,
}

impl Visit for First {
    fn surface(&mut self, a: &Arrival, _: &mut Sampler) -> Step {
        if !a.at.gathers(self.least) {
            return Step::On;
        }
        self.found = Some(Sight {
            at: *a.at,
            beta: a.beta,
            scatterings: a.scatterings,
            dispersed: a.dispersed,
            travelled: a.travelled,
            spread: self.spread,
        });
        Step::Stop
    }
}
