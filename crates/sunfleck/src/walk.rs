//! The random walk: from the camera and from the lights, there is exactly one.
//!
//! It traces, scatters and plays Russian roulette; what to do at the places it visits is the [`Visit`]or's business.
use crate::{
    bsdf::{Lobes, Transport},
    math::Ray,
    medium::Inside,
    sampler::Sampler,
    scene::{Interaction, Scattered, World},
    spectrum::Spectrum,
    texture::Cone,
};
use glam::Vec2;

/// When a walk ends by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Scatterings at most, over the whole path from light to camera: 0 sees only the lights, 1 is direct light.
    pub scatterings: u32,
    /// Scatterings before Russian roulette may end a camera walk. Light walks play from the first.
    pub roulette_after: u32,
    /// Photons are left and gathered where lobes are at least so wide: narrow ones may be left to the walks, as delta lobes are.
    pub gathers: Lobes,
    /// Whether colours that the camera sees are means over what a pixel covers.
    pub filter: bool,
}

impl Default for Limits {
    /// 64 scatterings, roulette after the third: bright, clear glass needs more than a handful.
    fn default() -> Self {
        Self { scatterings: 64, roulette_after: 3, gathers: Lobes::Narrow, filter: true }
    }
}

/// A walker reaching a surface, about to scatter.
#[expect(clippy::struct_excessive_bools, reason = "facts about the way that do not exclude each other")]
#[derive(Clone, Copy, Debug)]
pub struct Arrival<'a> {
    /// Where.
    pub at: &'a Interaction,
    /// The ray that led here.
    pub ray: &'a Ray,
    /// Throughput (camera walk) or flux (light walk) that arrives.
    pub beta: Spectrum,
    /// The same at the beginning of the last leg, before an interior took its share.
    pub departed: Spectrum,
    /// Scatterings so far.
    pub scatterings: u32,
    /// Density (1/sr) of the direction that led here; meaningless if `delta`.
    pub pdf: f32,
    /// The direction that led here came from a delta lobe (or, for the first segment, from what started the walk).
    pub delta: bool,
    /// It was scattered, and last by a delta lobe, or by a surface that gathers nothing: see [`Limits::gathers`].
    pub caustic: bool,
    /// Every scattering so far was from a delta lobe.
    pub all_delta: bool,
    /// Some boundary parted the wavelengths, and `beta` is that of the hero alone: see [`crate::spectrum`].
    pub dispersed: bool,
    /// Distance travelled so far.
    pub travelled: f32,
    /// The interiors that the path is in as it arrives.
    pub inside: &'a Inside,
}

/// A ray leaving the scene.
#[derive(Clone, Copy, Debug)]
pub struct Escape<'a> {
    /// The ray.
    pub ray: &'a Ray,
    /// Throughput or flux that leaves.
    pub beta: Spectrum,
    /// Scatterings so far.
    pub scatterings: u32,
    /// Density (1/sr) of its direction; meaningless if `delta`.
    pub pdf: f32,
    /// Its direction came from a delta lobe (or from what started the walk).
    pub delta: bool,
    /// As [`Arrival::caustic`].
    pub caustic: bool,
    /// Some boundary parted the wavelengths, and `beta` is that of the hero alone.
    pub dispersed: bool,
}

/// Whether a walk goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Scatter.
    On,
    /// Scatter, but go on only if the scattering turns out to be from a delta lobe; the others were dealt with here.
    OnIfDelta,
    /// End here.
    Stop,
}

/// What happens at the places a walk visits.
pub trait Visit {
    /// A surface was reached. Draws from `sampler` come before those for scattering.
    fn surface(&mut self, arrival: &Arrival, sampler: &mut Sampler) -> Step;
    /// The walk goes on from `at`, where it was last seen: roulette spared it.
    fn scatter(&mut self, _at: &Interaction, _s: &Scattered) {}
    /// Roulette ended the walk where it was last seen; `next` is what it would have carried on.
    fn roulette(&mut self, _next: Spectrum) {}
    /// The walk left the scene, and ends.
    fn escape(&mut self, _: &Escape) {}
}

/// The first ray of a walk.
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// Origin and unit direction.
    pub ray: Ray,
    /// Throughput or flux it carries.
    pub beta: Spectrum,
    /// What `beta` is.
    pub mode: Transport,
    /// Only the hero counts from the beginning: the walk goes on from a dispersed path, which has weighed it.
    pub dispersed: bool,
    /// The interiors that it starts in.
    pub inside: Inside,
    /// How wide it is: see [`Cone`].
    pub cone: Cone,
}

impl Start {
    /// Of a path from the camera, as wide as a mere ray.
    #[inline]
    pub fn from_camera(world: &World, ray: Ray) -> Self {
        let inside = world.camera_inside();
        Self { ray, beta: Spectrum::ONE, mode: Transport::Radiance, dispersed: false, inside, cone: Cone::RAY }
    }
}

impl Arrival<'_> {
    /// The start of another walk, which goes on from here as `s` says, with a throughput or flux of its own.
    #[inline]
    pub fn branch(&self, world: &World, s: &Scattered, mode: Transport) -> Start {
        let mut inside = *self.inside;
        if s.crosses && world.is_filled() {
            world.cross(self.at, &mut inside);
        }
        Start { ray: self.at.spawn(s.wi), beta: s.weight, mode, dispersed: self.dispersed, inside, cone: Cone::RAY }
    }
}

/// Walks from `start` until it escapes, is absorbed, the visitor stops it, or the limit is reached.
///
/// On each leg, interiors take their share of what is carried, and surfaces that they hide are passed (see [`crate::medium`]).
///
/// Russian roulette: light walks survive with `min(1, β_new / β_old)`, `β_old` as of the beginning of
/// the last leg, so that photons keep like power; camera walks,
/// after [`Limits::roulette_after`] scatterings, with `min(1, β·η²)`, where η² undoes the compression of radiance inside
/// glass (without it, walks would die or multiply there). Both are unbiased: survivors are divided by the probability.
///
/// Returns the number of rays traced.
pub fn walk(world: &World, start: &Start, limits: &Limits, sampler: &mut Sampler, visitor: &mut impl Visit) -> u64 {
    let Start { mut ray, mut beta, mode, mut dispersed, mut inside, mut cone } = *start;
    if !(limits.filter && world.has_means()) {
        cone = Cone::RAY;
    }
    let (mut pdf, mut delta, mut caustic, mut all_delta) = (1.0, true, false, true);
    let (mut eta_scale, mut travelled) = (1.0f32, 0.0);
    let mut scatterings = 0;
    loop {
        let mut hit = world.intersect_seen(&ray, |t| (!cone.is_ray()).then(|| (ray.d, cone.width_at(t))));
        if world.is_filled() {
            world.within(&mut hit, &mut inside);
        }
        let Some(at) = &hit else {
            visitor.escape(&Escape { ray: &ray, beta, scatterings, pdf, delta, caustic, dispersed });
            break;
        };
        travelled += at.distance;
        let departed = beta;
        if world.is_filled() {
            beta *= world.transmittance(at.near, at.distance);
        }
        let arrival = Arrival {
            at,
            ray: &ray,
            beta,
            departed,
            scatterings,
            pdf,
            delta,
            caustic,
            all_delta,
            dispersed,
            travelled,
            inside: &inside,
        };
        let step = visitor.surface(&arrival, sampler);
        if step == Step::Stop || scatterings >= limits.scatterings {
            break;
        }
        let u_lobe = if at.bsdf.has_one_lobe() { sampler.skip() } else { sampler.next_1d() };
        let u = if at.bsdf.is_polished() { Vec2::splat(sampler.skip()) } else { sampler.next_2d() };
        let Some(s) = at.sample(u_lobe, u, mode) else { break };
        if step == Step::OnIfDelta && !s.delta {
            break;
        }
        let mut next = beta * s.weight;
        if s.disperses && !dispersed {
            next = next.hero_only();
            dispersed = true;
        }
        eta_scale *= s.eta * s.eta;
        let survive = match mode {
            Transport::Flux => next.max() / departed.max(),
            Transport::Radiance if scatterings >= limits.roulette_after => next.max() * eta_scale,
            Transport::Radiance => 1.0,
        };
        if survive < 1.0 {
            if sampler.next_1d() >= survive {
                visitor.roulette(next);
                break;
            }
            beta = next / survive;
        } else {
            beta = next;
        }
        visitor.scatter(at, &s);
        (pdf, delta) = (s.pdf, s.delta);
        caustic = s.delta || !at.gathers(limits.gathers);
        cone = if s.delta && !at.curved && !cone.is_ray() { cone.beyond(at.distance, s.eta) } else { Cone::RAY };
        all_delta &= s.delta;
        if s.crosses && world.is_filled() {
            world.cross(at, &mut inside);
        }
        ray = at.spawn(s.wi);
        scatterings += 1;
    }
    u64::from(scatterings) + 1
}
