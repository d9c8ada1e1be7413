//! Lamps seen through mirrors and glass alone.
//!
//! No light path can be joined to such a view, and a lamp behind several faint reflections is as bright as it is rare: a few
//! pixels sparkle for hours. So a second walk from the same camera ray reflects more often than glass does, and the two walks are weighed against each other by the balance heuristic.
use crate::{
    light::{Light, LightId},
    sampler::Sampler,
    scene::{Interaction, Scattered, World},
    spectrum::Spectrum,
    walk::{Arrival, Step, Visit, way_prob},
};

/// Probabilities with which the two walks take a chain of delta lobes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chain {
    by_weight: f32,
    evenly: f32,
    choices: u32,
}

/// Choices in a chain at most; longer ones are left to the first walk.
const CHOICES: u32 = 24;

impl Chain {
    pub(super) fn new() -> Self {
        Self { by_weight: 1.0, evenly: 1.0, choices: 0 }
    }
    /// Goes on along a delta lobe.
    #[inline]
    pub(super) fn pass(&mut self, s: &Scattered) {
        self.by_weight *= s.pdf;
        if s.pdf < 1.0 {
            self.choices += 1;
            self.evenly *= way_prob(s);
        }
    }
    /// Whether the second walk still follows.
    fn is_followed(&self) -> bool {
        self.choices <= CHOICES
    }
    /// Weight of the first walk.
    #[inline]
    pub(super) fn weight(&self) -> f32 {
        if self.is_followed() { self.by_weight / (self.by_weight + self.evenly) } else { 1.0 }
    }
}

/// A lamp is small if its area is less than this part of a sphere around the scene. Others are met often, and are no brighter
/// than what surrounds them: of those, one walk alone sees an even picture.
const SMALL: f32 = 0.01;

/// Whether `light` is looked for by the second walk too.
#[inline]
pub(super) fn is_small(world: &World, light: &Light) -> bool {
    match light {
        Light::Area(l) => l.shape.area() < SMALL * 4.0 * world.around().disk_area(),
        _ => false,
    }
}

/// The second walk: adds up the lamps it sees past the first surface.
pub(super) struct Lamps<'w> {
    world: &'w World<'w>,
    chain: Chain,
    pub(super) sum: Spectrum,
}

impl<'w> Lamps<'w> {
    pub(super) fn new(world: &'w World<'w>) -> Self {
        Self { world, chain: Chain::new(), sum: Spectrum::BLACK }
    }
}

impl Visit for Lamps<'_> {
    #[inline]
    fn surface(&mut self, a: &Arrival, _: &mut Sampler) -> Step {
        if a.scatterings > 0 && a.at.light.is_some_and(|id: LightId| is_small(self.world, self.world.light(id))) {
            self.sum += a.beta * self.world.emitted(a.at) * (1.0 - self.chain.weight());
        }
        if a.at.is_connectible() { Step::Stop } else { Step::OnIfDelta }
    }
    #[inline]
    fn scatter(&mut self, _: &Interaction, s: &Scattered) {
        self.chain.pass(s);
    }
}
