//! Light tracing: paths from the lights, each vertex connected to the camera. Finds caustics on matt surfaces; cannot
//! see anything in a mirror or through glass.
use super::{
    Entry, Integrator, Pass, PassRenderer,
    eye_ray::{EyeRay, seen_from_lens},
};
use crate::{
    bsdf::{Lobes, Transport},
    camera::Project,
    film::{Counts, FilmSpec, PassImage, Splat, Splats},
    photon::Source,
    sampler::{Domain, Sampler},
    scene::{Scene, World},
    spectrum::Spectrum,
    walk::{Arrival, Limits, Start, Step, Visit, walk},
};
use rayon::prelude::*;

pub(super) const ENTRY: Entry = Entry {
    name: "light",
    about: "light tracing: paths from the lights, connected to the camera; blind to mirrors and glass, good for checking",
    params: &[],
    mergeable: true,
    make: |p| Ok(Box::new(LightTracer { limits: p.limits()? })),
};

/// Settings of the light tracer. A pass starts as many light paths as the picture has pixels.
#[derive(Clone, Copy, Debug, Default)]
pub struct LightTracer {
    /// When paths end.
    pub limits: Limits,
}

impl Integrator for LightTracer {
    fn prepare<'s>(&'s self, scene: &'s Scene, _: FilmSpec, _: u64) -> Box<dyn PassRenderer + 's> {
        Box::new(Prepared { scene, limits: self.limits })
    }
}

struct Prepared<'s> {
    scene: &'s Scene,
    limits: Limits,
}

/// Light paths per task. Splats are joined in path order, so any value gives the same picture.
const CHUNK: u64 = 4096;

impl PassRenderer for Prepared<'_> {
    fn render_pass(&self, pass: &Pass, image: &mut PassImage) {
        let world = self.scene.world(pass.lambda, pass.time);
        lights_seen_directly(&world, pass, image);
        let paths = image.spec().pixels() as u64;
        let spec = image.spec();
        let chunks: Vec<(Splats, Counts)> = (0..paths.div_ceil(CHUNK))
            .into_par_iter()
            .map(|c| {
                let (world, limits) = (&world, self.limits);
                let (splats, counts) = (Vec::new(), Counts::default());
                let mut out = Connect { world, limits, spec, pass: pass.index, splats, counts };
                for index in c * CHUNK..((c + 1) * CHUNK).min(paths) {
                    out.trace(Sampler::new(pass.seed, Domain::Light, pass.index, index), paths);
                }
                (Splats::new(&spec, &out.splats), out.counts)
            })
            .collect();
        chunks.iter().for_each(|(_, counts)| image.counts += *counts);
        image.splat(&chunks.iter().map(|(splats, _)| splats).collect::<Vec<_>>());
    }
}

/// Paths without any scattering: found by camera rays, as a connection from a light would have no pixel to miss.
fn lights_seen_directly(world: &World, pass: &Pass, image: &mut PassImage) {
    let spec = image.spec();
    image.fill(|x, y, counts| {
        let eye = EyeRay::new(world, spec, pass, pass.index, (x, y));
        let ray = eye.camera.ray;
        counts.rays += 1;
        let mut hit = world.intersect(&ray);
        world.within(&mut hit, &mut world.camera_inside());
        let le = match &hit {
            Some(at) => world.emitted(at) * world.transmittance(at.near, at.distance),
            None => world.escaped(ray.o, ray.d).fold(Spectrum::BLACK, |sum, sky| sum + sky.le),
        };
        le.to_rgb(pass.lambda) * eye.weight
    });
}

/// Connects every vertex of a light walk to the camera.
struct Connect<'w> {
    world: &'w World<'w>,
    limits: Limits,
    spec: FilmSpec,
    /// Number of the pass.
    pass: u64,
    splats: Vec<Splat>,
    counts: Counts,
}

impl Connect<'_> {
    fn trace(&mut self, mut sampler: Sampler, paths: u64) {
        self.counts.emitted += 1;
        let Some(start) = Source::plain().emit(self.world, &mut sampler).map(|e| e.start) else { return };
        let start = Start { beta: start.beta / paths as f32, ..start };
        let world = self.world;
        let limits = self.limits;
        self.counts.rays += walk(world, &start, &limits, &mut sampler, self);
    }
}

impl Visit for Connect<'_> {
    #[inline]
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        let u_lens = sampler.next_2d();
        // What is black here may be seen as the mean over a pixel.
        if a.scatterings >= self.limits.scatterings || a.at.widest == Lobes::Delta {
            return Step::On;
        }
        let Some(c) = self.world.camera().sample_wi(a.at.p, u_lens) else { return Step::On };
        let seen;
        let at = if self.limits.filter && self.world.has_means() {
            seen = seen_from_lens(self.world, a, &c, self.spec, self.pass);
            &seen
        } else {
            a.at
        };
        let value = a.beta * at.f_cos(c.wi, Transport::Flux) * c.importance;
        if !value.is_black() {
            self.counts.rays += 1;
            if let Some(passed) = self.world.passed(a.at, &a.at.spawn_to(c.wi, c.p)) {
                self.splats.push(Splat { raster: c.raster, value: (value * passed).to_rgb(self.world.lambda()) });
            }
        }
        Step::On
    }
}
