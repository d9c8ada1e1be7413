//! Camera paths and final-gather rays through the maps.
use super::{
    PhotonMapper,
    maps::{Lookup, Maps},
};
use crate::{
    bsdf::Transport,
    film::Counts,
    integrator::path::direct,
    photon::CameraEnd,
    sampler::Sampler,
    scene::{Interaction, Sky, World},
    spectrum::Spectrum,
    walk::{Arrival, Escape, Limits, Start, Step, Visit, walk},
};
use glam::Vec2;

/// Looks at the scene; what is kept from path to path only saves time.
pub(super) struct Eye<'p> {
    world: &'p World<'p>,
    settings: &'p PhotonMapper,
    /// Lookups where camera paths end.
    seen: Lookups<'p>,
    /// Lookups where final-gather rays end, which jump about.
    gathered: Lookups<'p>,
}

struct Lookups<'p> {
    indirect: Lookup<'p>,
    caustic: Lookup<'p>,
}

impl<'p> Eye<'p> {
    pub(super) fn new(world: &'p World<'p>, settings: &'p PhotonMapper, maps: &'p Maps) -> Self {
        let k = settings.nearest;
        let lookups = || Lookups { indirect: maps.indirect.lookup(k), caustic: maps.caustic.lookup(k) };
        Self { world, settings, seen: lookups(), gathered: lookups() }
    }
    /// An estimate of the radiance that arrives along the ray of `start`.
    #[inline]
    pub(super) fn radiance(&mut self, start: &Start, sampler: &mut Sampler, counts: &mut Counts) -> Spectrum {
        let world = self.world;
        let limits = self.settings.limits;
        let mut camera = CameraWalk { eye: self, sum: Spectrum::BLACK, rays: 0 };
        let rays = walk(world, start, &limits, sampler, &mut camera);
        counts.rays += rays + camera.rays;
        camera.sum
    }
}

impl Lookups<'_> {
    fn caustic(&mut self, at: &Interaction, settings: &PhotonMapper, end: CameraEnd) -> Spectrum {
        self.caustic.radiance(at, settings.kernel, end)
    }
    fn indirect(&mut self, at: &Interaction, settings: &PhotonMapper, end: CameraEnd) -> Spectrum {
        self.indirect.radiance(at, settings.kernel, end)
    }
}

/// Adds up what a camera path finds.
struct CameraWalk<'e, 'p> {
    eye: &'e mut Eye<'p>,
    sum: Spectrum,
    rays: u64,
}

impl Visit for CameraWalk<'_, '_> {
    #[inline]
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        let Eye { world, settings, seen, .. } = &mut *self.eye;
        self.sum += a.beta * world.emitted(a.at);
        let (u_light, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(most) = settings.limits.scatterings.checked_sub(a.scatterings + 1) else { return Step::Stop };
        if a.at.is_connectible() {
            self.rays += 1;
            let end = CameraEnd { most, dispersed: a.dispersed };
            let near = direct(world, a.at, u_light, u, |_, _| 1.0) + seen.caustic(a.at, settings, end);
            self.sum += a.beta * near;
            let indirect = if settings.final_gather > 0 {
                self.final_gather(a, most, sampler)
            } else {
                seen.indirect(a.at, settings, end)
            };
            self.sum += a.beta * indirect;
        }
        Step::OnIfDelta
    }
    #[inline]
    fn escape(&mut self, e: &Escape) {
        for Sky { le, .. } in self.eye.world.escaped(e.ray.o, e.ray.d) {
            self.sum += e.beta * le;
        }
    }
}

impl CameraWalk<'_, '_> {
    /// Indirect light at `a` from rays that look up the maps where they end. `most` scatterings are left after this one.
    fn final_gather(&mut self, a: &Arrival, most: u32, sampler: &mut Sampler) -> Spectrum {
        let Eye { world, settings, gathered, .. } = &mut *self.eye;
        let limits = Limits {
            scatterings: most,
            roulette_after: settings.limits.roulette_after.saturating_sub(a.scatterings + 1),
            ..settings.limits
        };
        let n = settings.final_gather;
        let shift = (sampler.next_1d(), sampler.next_2d());
        let mut walker = GatherWalk { world, settings, lookups: gathered, most, sum: Spectrum::BLACK, rays: 0 };
        for i in 0..n {
            let (u_lobe, u) = lattice(i, n, shift);
            // Delta lobes are part of the camera path.
            let Some(s) = a.at.sample(u_lobe, u, Transport::Radiance).filter(|s| !s.delta) else { continue };
            let start = a.branch(world, &s, Transport::Radiance);
            walker.rays += walk(world, &start, &limits, sampler, &mut walker);
        }
        let (sum, rays) = (walker.sum, walker.rays);
        self.rays += rays;
        sum / n as f32
    }
}

/// Point `i` of `n` of a golden-ratio lattice, shifted as a whole so that each point alone is uniform.
#[inline]
fn lattice(i: u32, n: u32, (lobe, place): (f32, Vec2)) -> (f32, Vec2) {
    /// Fractional parts of the golden ratio, and of the plastic number's inverse.
    const STEPS: (f64, f64) = (0.618_033_988_749_894_9, 0.754_877_666_246_692_8);
    let at = |shift: f32, x: f64| ((f64::from(shift) + x).fract() as f32).min(1.0 - f32::EPSILON / 2.0);
    let i = f64::from(i);
    (at(lobe, i * STEPS.1), Vec2::new(at(place.x, i / f64::from(n)), at(place.y, i * STEPS.0)))
}

/// Adds up what final-gather rays find: nothing on the lights themselves, everything at the first lobe with a density.
struct GatherWalk<'g, 'p> {
    world: &'g World<'p>,
    settings: &'g PhotonMapper,
    lookups: &'g mut Lookups<'p>,
    /// Scatterings left when the ray starts.
    most: u32,
    sum: Spectrum,
    rays: u64,
}

impl Visit for GatherWalk<'_, '_> {
    #[inline]
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        let Some(most) = self.most.checked_sub(a.scatterings + 1) else { return Step::Stop };
        if a.at.is_connectible() {
            let (u_light, u) = (sampler.next_1d(), sampler.next_2d());
            self.rays += 1;
            let end = CameraEnd { most, dispersed: a.dispersed };
            self.sum += a.beta
                * (direct(self.world, a.at, u_light, u, |_, _| 1.0)
                    + self.lookups.caustic(a.at, self.settings, end)
                    + self.lookups.indirect(a.at, self.settings, end));
        }
        Step::OnIfDelta
    }
}
