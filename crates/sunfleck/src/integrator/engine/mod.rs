//! One engine, several samplers: light subpaths, then camera subpaths, and each way to join them that is switched on,
//! weighed against the others (Georgiev et al. 2012, "Light Transport Simulation with Vertex Connection and Merging").
//!
//! ```text
//! light: subpaths ──▶ photons by place, vertices by path, splats
//!                           │            │
//! camera: subpaths ──▶ gather ──── connect ──── choose a light ──── meet a light
//!                                   all weighed by `weights`, from the sums of `mis` that a `track` carries along
//! ```
//!
//! The named algorithms that run on it are settings of [`Engine`], one file each beside this folder.
mod camera;
mod chains;
mod gather;
mod joins;
mod lamps;
mod light;
mod mis;
mod plan;
mod settings;
mod techniques;
#[cfg(test)]
mod tests;
mod track;
mod vertex;
mod weights;

pub(super) use settings::PARAMS;
pub use techniques::{Fit, Heuristic, Merge, Technique, Techniques};

use super::{Integrator, Pass, PassRenderer, eye_ray::EyeRay};
use crate::{
    camera::{Project, Spread},
    film::{FilmSpec, PassImage},
    photon::{After, Audit, Bandwidth, Evenness, Fitted, Keep, Kernel, Radii, Schedule, Source, Training, bandwidth},
    scene::{MID_SHUTTER, Scene, World},
    spectrum::Wavelengths,
    walk::{Limits, walk},
};
use camera::{Eye, EyeStart, Look, Only};
use chains::Chains;
use glam::Vec2;
use light::{Shower, Subpaths};
use mis::Rule;
use plan::Plan;
use std::ops::Range;

/// Settings of the engine.
#[derive(Clone, Copy, Debug)]
pub struct Engine {
    /// Which samplers are on.
    pub on: Techniques,
    /// When paths end.
    pub limits: Limits,
    /// Light paths a pass; `None`: chosen by the size of the picture.
    pub paths: Option<u64>,
    /// First radius; `None`: from what pixels cover.
    pub radius: Option<f32>,
    /// First radius over what pixels cover, or over `radius`.
    pub radius_scale: f32,
    /// How a training fits the first radii to the light.
    pub fit: Fit,
    /// How the radius shrinks.
    pub schedule: Schedule,
    /// What a photon counts.
    pub kernel: Kernel,
    /// Bytes that photons and light vertices may take at once. A pass that needs more is rendered as the mean of several
    /// complete ones with fewer light paths each.
    pub memory: u64,
    /// What weights compare.
    pub heuristic: Heuristic,
    /// Whether light paths are sent to where the camera needs them, if a training finds that it helps.
    pub aim: bool,
    /// Whether light paths that gathers reach are sought by Markov chains; only where light paths serve gathers alone.
    pub chains: bool,
    /// Whether a training decides, for each part of the picture, what is merged there.
    pub planned: bool,
}

/// First radius in widths of a pixel.
const PIXELS: f32 = 4.0;
/// A round that fits radii has this many times fewer light paths than a pass.
const FITTING_SHARE: u64 = 3;
/// Light paths a pass at least and at most, if not set: few pixels still need photons, and many share them.
const PATHS: std::ops::RangeInclusive<u64> = 1 << 14..=1 << 21;

impl Engine {
    /// With its usual settings.
    pub fn new(on: Techniques) -> Self {
        Self {
            on,
            limits: Limits::default(),
            paths: None,
            radius: None,
            radius_scale: 1.0,
            fit: Fit::Off,
            schedule: Schedule::default(),
            kernel: Kernel::Epanechnikov,
            memory: 2_000_000_000,
            heuristic: Heuristic::default(),
            aim: on.merge.is_on(),
            chains: false,
            planned: false,
        }
    }
}

impl Engine {
    fn source(&self, scene: &Scene, spec: FilmSpec, seed: u64) -> Source {
        let training = Training { seed, limits: self.limits, direct: self.on.merge.of_direct() };
        let aim = self.aim && self.on.need_light_paths();
        if aim { Source::aimed(scene, spec, &training) } else { Source::plain() }
    }
}

impl Integrator for Engine {
    fn prepare<'s>(&'s self, scene: &'s Scene, spec: FilmSpec, seed: u64) -> Box<dyn PassRenderer + 's> {
        let fallback = 1e-3 * scene.bounding_sphere().1;
        let seen = Radii::from_footprints(scene, spec, &self.limits, seed, PIXELS, fallback);
        let paths = self.paths.unwrap_or((spec.pixels() as u64).clamp(*PATHS.start(), *PATHS.end()));
        // The typical radius is PIXELS pixels wide; how many of those make one degree?
        let middle = scene.world(Wavelengths::Rgb, MID_SHUTTER).camera().ray(Vec2::splat(0.5), Vec2::splat(0.5)).spread;
        let degree = seen.typical() / PIXELS * pixels_of_degree(middle, spec);
        let radii = self.radius.map_or(seen.clone(), |r| seen.levelled(r)).scaled(self.radius_scale);
        let mut prepared = Prepared {
            scene,
            engine: self,
            radii,
            source: Source::plain(),
            paths: if self.on.need_light_paths() { paths } else { 0 },
            parts: 1,
            same_place: std::f32::consts::PI * degree * degree,
            plan: None,
            chains: None,
            by_path_tracer: false,
        };
        if self.planned && scene.is_matt() && Plan::needs_no_photons(&mut prepared, spec, seed) {
            prepared.by_path_tracer = self.heuristic == Heuristic::default();
            return Box::new(prepared);
        }
        prepared.source = self.source(scene, spec, seed);
        let fitted = prepared.fit(spec, seed);
        if self.planned {
            Plan::train(&mut prepared, fitted.as_ref(), spec, seed);
        } else if let Some(fitted) = fitted {
            let after = After::new(bandwidth::PASSES, self.schedule);
            prepared.radii = fitted.by(|tile, _| fitted.best(0, tile, after));
        }
        if self.chains && prepared.paths > 0 {
            prepared.link(spec, seed);
        }
        prepared.parts = prepared.count_parts(spec, seed);
        Box::new(prepared)
    }
}

impl Prepared<'_> {
    /// Fits radii to the light; `Some` with what is known of their errors.
    fn fit(&mut self, spec: FilmSpec, seed: u64) -> Option<Fitted> {
        let (scene, engine, source) = (self.scene, self.engine, &self.source);
        if self.paths == 0 || !engine.on.merge.is_on() {
            return None;
        }
        let limits = engine.limits;
        match engine.fit {
            Fit::Off => None,
            Fit::Even => {
                let paths = self.paths.div_ceil(FITTING_SHARE);
                self.radii = self.radii.clone().fitted(scene, &Evenness { source, limits, seed, paths });
                None
            }
            Fit::Error => {
                let keep = if engine.on.merge.of_direct() { Keep::All } else { Keep::Scattered };
                let (kernel, schedule, paths) = (engine.kernel, engine.schedule, self.paths);
                let bandwidth = Bandwidth { source, spec, limits, keep, kernel, schedule, seed, paths };
                Some(bandwidth.fit(scene, self.radii.clone()))
            }
        }
    }
}

/// How many pixels wide a degree is; where rays are parallel, 40 of them are as high as the picture.
fn pixels_of_degree(spread: Spread, spec: FilmSpec) -> f32 {
    match spread.of_pixel(spec.pixels()) {
        Spread::SolidAngle(pixel) => 1f32.to_radians().tan() / pixel.sqrt(),
        Spread::Area(_) => spec.height as f32 / 40.0,
    }
}

struct Prepared<'s> {
    scene: &'s Scene,
    engine: &'s Engine,
    radii: Radii,
    source: Source,
    /// Light paths a pass.
    paths: u64,
    /// Complete renders, with a share of the light paths each, that a pass is the mean of.
    parts: u64,
    same_place: f32,
    plan: Option<Plan>,
    /// Each of `paths` begins a chain.
    chains: Option<Chains>,
    /// Pictures are left to `path`, which sums up the same samplers without what others need. Each sampler alone is still shown
    /// from here, by weights of its own.
    by_path_tracer: bool,
}

impl PassRenderer for Prepared<'_> {
    fn render_pass(&self, pass: &Pass, image: &mut PassImage) {
        if self.by_path_tracer {
            let world = self.scene.world(pass.lambda, pass.time);
            return super::path::trace(&world, self.engine.limits, pass, image);
        }
        self.render_parts(pass, None, image);
    }
    fn techniques(&self) -> Vec<Technique> {
        Technique::ALL.into_iter().filter(|t| self.engine.on.includes(*t)).collect()
    }
    fn render_technique(&self, pass: &Pass, technique: Technique, weighted: bool, image: &mut PassImage) {
        self.render_parts(pass, Some(Only { technique, weighted }), image);
    }
    fn audit(&self, seed: u64, paths: u64) -> Option<Audit> {
        let keep = self.plan.as_ref().map_or(self.engine.on.merge, Plan::needs).keeps();
        let (source, radii, limits) = (self.source.clone(), self.radii.clone(), self.engine.limits);
        (self.paths > 0).then_some(Audit { source, keep, radii, limits, seed, paths })
    }
}

/// What one call of the engine renders.
#[derive(Clone)]
struct Job<'p> {
    pass: Pass,
    /// Set to see one sampler alone.
    only: Option<Only>,
    plan: Option<&'p Plan>,
    /// Numbers of the light paths.
    paths: Range<u64>,
    /// Number of the camera path in each pixel.
    sample: u64,
    /// What the result is multiplied by.
    share: f32,
}

impl Job<'_> {
    /// Light paths.
    fn count(&self) -> u64 {
        self.paths.end - self.paths.start
    }
    /// The light path that camera path `pixel` is connected to, among [`Job::paths`]. Pixel by pixel they are read in the order
    /// in which they are kept; where that begins is different in each pass.
    fn partner(&self, pixel: u32) -> usize {
        let first = (self.pass.seed ^ self.sample).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
        ((u64::from(pixel) + first) % self.count().max(1)) as usize
    }
}

impl Prepared<'_> {
    fn render_parts(&self, pass: &Pass, only: Option<Only>, image: &mut PassImage) {
        for part in 0..self.parts {
            let job = Job {
                pass: *pass,
                only,
                plan: self.plan.as_ref(),
                paths: self.paths * part / self.parts..self.paths * (part + 1) / self.parts,
                sample: pass.index * self.parts + part,
                share: 1.0 / self.parts as f32,
            };
            self.render(&job, image);
        }
    }

    /// How many parts keep light vertices within the memory, going by some light paths.
    fn count_parts(&self, spec: FilmSpec, seed: u64) -> u64 {
        let some = self.paths.min(1024);
        if some == 0 {
            return 1;
        }
        let pass = Pass::new(seed ^ 0x7061_7274, 0);
        let job = Job { pass, only: None, plan: self.plan.as_ref(), paths: 0..some, sample: 0, share: 1.0 };
        let world = self.scene.world(pass.lambda, pass.time);
        let bytes = self.walk_light(&job, &world, self.rule(some), 1.0, &mut PassImage::new(spec)).bytes();
        let needed = bytes as f64 * self.paths as f64 / some as f64;
        ((needed / self.engine.memory as f64).ceil() as u64).clamp(1, self.paths)
    }

    fn rule(&self, paths: u64) -> Rule {
        let paths = paths as f32 * self.chains.as_ref().map_or(1.0, |c| c.length as f32);
        let Engine { on, heuristic, limits, .. } = *self.engine;
        Rule { on, heuristic, least: limits.gathers, paths, same_place: self.same_place }
    }

    fn render(&self, job: &Job, image: &mut PassImage) {
        let world = self.scene.world(job.pass.lambda, job.pass.time);
        let shrink = self.engine.schedule.radius(job.pass.index);
        let subpaths = self.walk_light(job, &world, self.rule(job.count()), shrink, image);
        self.look(job, &world, subpaths, &self.radii, image);
    }

    /// Camera paths, which meet `subpaths`.
    fn look(&self, job: &Job, world: &World, subpaths: Subpaths, radii: &Radii, image: &mut PassImage) {
        let rule = self.rule(job.count());
        let shrink = self.engine.schedule.radius(job.pass.index);
        let map = rule.on.merge.is_on().then(|| subpaths.index(radii.span().scaled(shrink), image.spec().pixels()));
        let eye = Eye {
            world,
            rule,
            source: &self.source,
            limits: self.engine.limits,
            kernel: self.engine.kernel,
            map,
            subpaths,
            radii,
            shrink,
            plan: job.plan,
            only: job.only,
        };
        let spec = image.spec();
        image.fill(|x, y, counts| {
            let mut ray = EyeRay::new(world, spec, &job.pass, job.sample, (x, y));
            let start = EyeStart {
                raster: ray.raster,
                from: ray.camera.ray.o,
                pixel: ray.camera.spread.of_pixel(spec.pixels()),
                partner: job.partner(x + y * spec.width),
            };
            let mut look = Look::new(&eye, start, counts);
            let (limits, start_ray) = (&self.engine.limits, ray.start(world));
            let rays = walk(world, &start_ray, limits, &mut ray.sampler, &mut look);
            look.add_lamps(&mut ray.sampler);
            look.finish(rays).to_rgb(job.pass.lambda) * (job.share * ray.weight)
        });
    }

    fn walk_light(&self, job: &Job, world: &World, rule: Rule, shrink: f32, image: &mut PassImage) -> Subpaths {
        self.shower(job, world, rule, shrink, image.spec()).walk(image)
    }

    fn shower<'w>(&'w self, job: &'w Job, world: &'w World<'w>, rule: Rule, shrink: f32, spec: FilmSpec) -> Shower<'w> {
        Shower {
            world,
            rule,
            keep: job.plan.map_or(rule.on.merge, Plan::needs),
            source: &self.source,
            limits: self.engine.limits,
            radii: &self.radii,
            shrink,
            pass: &job.pass,
            paths: job.paths.clone(),
            share: job.share,
            spec,
            only: job.only,
            chains: self.chains.as_ref(),
        }
    }
}
