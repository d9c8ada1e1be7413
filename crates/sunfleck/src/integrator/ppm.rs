//! Progressive photon mapping: every pass shoots its own photons and gathers them where a camera path first scatters by
//! a lobe with a density; the radius shrinks from pass to pass, so that the mean over passes has neither noise nor bias
//! in the end (Hachisuka, Ogaki & Jensen 2008, in the memoryless form of Knaus & Zwicker 2011).
//!
//! Paths by Heckbert's letters (D stands for any lobe with a density), each found once:
//!
//! | path | found by |
//! |---|---|
//! | `L S* E` | the camera walk hitting the light |
//! | `L D S* E` | a light connection and one ray past the gather point, weighed against each other (`direct=connect`), or photons (`direct=photons`) |
//! | `L S⁺ D S* E`, `L S* D (S\|D)* D S* E` | photons |
use super::{
    Entry, Integrator, ParamInfo, Pass, PassRenderer,
    eye_ray::EyeRay,
    path::{direct, power_heuristic},
};
use crate::{
    film::{Counts, FilmSpec, PassImage},
    photon::{
        CameraEnd, Disc, Keep, Kernel, RadiusMap, Reach, Schedule, Shower, Source, gather_within, pixel_angle, survey,
    },
    sampler::{Domain, Sampler},
    scene::{Scene, Sky, World},
    spectrum::Spectrum,
    walk::{Arrival, Escape, Limits, Step, Visit, walk},
};
use glam::Vec3;

/// First radius in pixel widths. Relative error of single pixels after 64 passes with one light path per pixel: matt
/// Cornell box at 200² 10 % with 1.5, 6.6 % with 3, 6.1 % with this, 5.4 % with 6; glass ball under a large lamp at 128²
/// 7.3 % with 1.3, 5.0 % with 2.7, 4.9 % with this, 5.2 % with 5.4, where the caustic gets too soft.
const PIXELS: f32 = 4.0;

pub(super) const ENTRY: Entry = Entry {
    name: "ppm",
    about: "progressive photon mapping: finds caustics seen through glass and in mirrors; noise and blur both vanish",
    params: &[
        ParamInfo { name: "photons", about: "light paths a pass, 1 to 1e9 (default: one per pixel)" },
        ParamInfo { name: "radius", about: "first radius, world units > 0 (default: 4 pixel widths)" },
        ParamInfo { name: "alpha", about: "how the radius shrinks, 0.01 to 1 (default 2/3; 1 keeps it)" },
        ParamInfo { name: "kernel", about: "constant, cone or epanechnikov (default epanechnikov)" },
        ParamInfo {
            name: "direct",
            about: "light that comes straight from a light: connect or photons (default connect)",
        },
    ],
    mergeable: true,
    make: |p| {
        let d = Ppm::default();
        let photons = p.count("photons", 0, 1..=1_000_000_000)?;
        let radius = p.number("radius", 0.0, f64::from(f32::MIN_POSITIVE)..=1e30)? as f32;
        Ok(Box::new(Ppm {
            limits: p.limits()?,
            photons: (photons > 0).then_some(photons),
            radius: (radius > 0.0).then_some(radius),
            schedule: Schedule { alpha: p.number("alpha", d.schedule.alpha, 0.01..=1.0)? },
            kernel: Kernel::ALL[p.word("kernel", d.kernel as usize, &Kernel::WORDS)?],
            direct: [Direct::Connect, Direct::Photons][p.word("direct", d.direct as usize, &["connect", "photons"])?],
        }))
    },
};

/// How light that comes straight from a light is found. Connecting is the default: on the matt Cornell box it left 6.6 %
/// error where photons left 9.4 % in the same time, and no blur around the lamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direct {
    /// By drawing a point of a light, and by a ray that may hit one.
    Connect,
    /// By photons, as all other light.
    Photons,
}

/// Settings of progressive photon mapping.
#[derive(Clone, Copy, Debug)]
pub struct Ppm {
    /// When paths end.
    pub limits: Limits,
    /// Light paths a pass; `None`: one per pixel.
    pub photons: Option<u64>,
    /// First radius (world units); `None`: from what pixels cover.
    pub radius: Option<f32>,
    /// How the radius shrinks.
    pub schedule: Schedule,
    /// What a photon counts.
    pub kernel: Kernel,
    /// How direct light is found.
    pub direct: Direct,
}

impl Default for Ppm {
    fn default() -> Self {
        Self {
            limits: Limits::default(),
            photons: None,
            radius: None,
            schedule: Schedule::default(),
            kernel: Kernel::Epanechnikov,
            direct: Direct::Connect,
        }
    }
}

impl Integrator for Ppm {
    fn prepare<'s>(&'s self, scene: &'s Scene, spec: FilmSpec, seed: u64) -> Box<dyn PassRenderer + 's> {
        let reach = self.radius.map_or_else(
            || {
                let sightings = survey(scene, spec, &self.limits, seed);
                Reach::from_footprints(&sightings, PIXELS, 1e-3 * scene.bounding_sphere().1)
            },
            Reach::fixed,
        );
        Box::new(Prepared { scene, settings: self, reach, source: Source::plain() })
    }
}

struct Prepared<'s> {
    scene: &'s Scene,
    settings: &'s Ppm,
    reach: Reach,
    source: Source,
}

impl PassRenderer for Prepared<'_> {
    fn render_pass(&self, pass: &Pass, image: &mut PassImage) {
        let world = self.scene.world(pass.lambda, pass.time);
        let spec = image.spec();
        let shrink = self.settings.schedule.radius(pass.index);
        let map = self.shoot(&world, pass, image, shrink);
        image.fill(|x, y, counts| {
            let mut eye = EyeRay::new(&world, spec, pass, pass.index, (x, y));
            let mut look = Look {
                world: &world,
                settings: self.settings,
                map: &map,
                reach: &self.reach,
                angle: pixel_angle(eye.camera.solid_angle, spec),
                shrink,
                sum: Spectrum::BLACK,
                gathered_at: Vec3::ZERO,
                counts,
            };
            let rays = walk(&world, &eye.start(), &self.settings.limits, &mut eye.sampler, &mut look);
            look.counts.rays += rays;
            look.sum.to_rgb(pass.lambda)
        });
    }
}

impl Prepared<'_> {
    fn shoot(&self, world: &World, pass: &Pass, image: &mut PassImage, shrink: f32) -> RadiusMap {
        let shower = Shower {
            seed: pass.seed,
            domain: Domain::Light,
            pass: pass.index,
            first: 0,
            paths: self.settings.photons.unwrap_or(image.spec().pixels() as u64),
            keep: if self.settings.direct == Direct::Photons { Keep::All } else { Keep::Scattered },
            limits: self.settings.limits,
        };
        let catch = shower.shoot(world, &self.source);
        image.counts += catch.counts;
        RadiusMap::new(&catch.positions, &catch.photons, self.reach.typical() * shrink)
    }
}

/// Adds up what a camera walk finds.
struct Look<'w> {
    world: &'w World<'w>,
    settings: &'w Ppm,
    map: &'w RadiusMap,
    reach: &'w Reach,
    /// Width of a pixel at distance 1.
    angle: f32,
    /// Radius of this pass over the first.
    shrink: f32,
    sum: Spectrum,
    /// Where the camera path gathered.
    gathered_at: Vec3,
    counts: &'w mut Counts,
}

impl Visit for Look<'_> {
    #[inline]
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        let le = self.world.emitted(a.at);
        if !a.delta {
            // Past the gather point there is this one ray, which finds what connections to lights find badly.
            if !le.is_black() {
                let pdf_light = self.world.pdf_direct(self.gathered_at, -a.at.wo, a.at);
                self.sum += a.beta * le * power_heuristic(a.pdf, pdf_light);
            }
            return Step::Stop;
        }
        self.sum += a.beta * le;
        let (u_light, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(most) = self.settings.limits.scatterings.checked_sub(a.scatterings + 1) else { return Step::Stop };
        let connect = self.settings.direct == Direct::Connect;
        if a.at.is_connectible() {
            if connect {
                self.counts.rays += 1;
                self.sum += a.beta * direct(self.world, a.at, u_light, u, power_heuristic);
                self.gathered_at = a.at.p;
            }
            let radius = self.shrink * self.reach.at(self.angle * a.travelled);
            let disc = Disc { radius, kernel: self.settings.kernel };
            self.sum += a.beta * gather_within(self.map, a.at, disc, CameraEnd { most, dispersed: a.dispersed });
        }
        if connect { Step::On } else { Step::OnIfDelta }
    }
    #[inline]
    fn escape(&mut self, e: &Escape) {
        for Sky { le, pdf_direct, .. } in self.world.escaped(self.gathered_at, e.ray.d) {
            self.sum += e.beta * le * if e.delta { 1.0 } else { power_heuristic(e.pdf, pdf_direct) };
        }
    }
}
