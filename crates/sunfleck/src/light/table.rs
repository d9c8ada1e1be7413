//! Which light next: in proportion to power.
use super::{Emitter, Light, LightId, Surroundings};
use crate::math::Discrete;
use accel::Aabb;
use glam::Vec3;
use std::f32::consts::FRAC_1_PI;

/// The lights' probabilities, and which of them rays see when they leave the scene.
#[derive(Clone, Debug, Default)]
pub struct LightTable {
    by_power: Discrete,
    infinite: Vec<LightId>,
    reach: Reach,
}

/// How well the lights that a ray can meet are found by chance.
#[derive(Clone, Debug)]
enum Reach {
    /// Nothing is known.
    Anywhere,
    /// They are surfaces in this box, of this area in all.
    Within(Aabb, f32),
}

impl Default for Reach {
    fn default() -> Self {
        Self::Within(Aabb::EMPTY, 0.0)
    }
}

/// See [`LightTable::chance`].
const CHANCE: f32 = 8.0;

impl LightTable {
    /// Weighs each light by the sum of its power over the channels.
    pub fn new<'a>(lights: impl Iterator<Item = &'a Light> + Clone, around: &Surroundings) -> Self {
        let infinite = lights.clone().zip(0..).filter(|(l, _)| l.is_infinite()).map(|(_, i)| LightId(i)).collect();
        let reach = lights.clone().fold(Reach::default(), |all, light| match (all, light) {
            (Reach::Within(bounds, area), Light::Area(l)) => {
                Reach::Within(bounds.union(&l.shape.bounds()), area + l.shape.area())
            }
            (within, light) if light.is_delta() => within,
            _ => Reach::Anywhere,
        });
        Self { by_power: Discrete::new(lights.map(|l| l.power(around).element_sum())), infinite, reach }
    }
    /// A light, its discrete probability, and a fresh uniform number. `None` if there is no light.
    #[inline]
    pub fn sample(&self, u: f32) -> Option<(LightId, f32, f32)> {
        self.by_power.sample(u).map(|(i, prob, rest)| (LightId(i as u32), prob, rest))
    }
    /// Whether there is exactly one light.
    #[inline]
    pub fn is_one(&self) -> bool {
        self.by_power.len() == 1
    }
    /// Eight times a bound on the chance that a ray of a matt surface at `p` meets a light, at most 1.
    #[inline]
    pub fn chance(&self, p: Vec3) -> f32 {
        match &self.reach {
            Reach::Anywhere => 1.0,
            Reach::Within(bounds, area) => {
                // Seen under no more than area / d², of which a matt surface sends out 1/π per unit.
                let d2 = p.distance_squared(p.clamp(bounds.min, bounds.max));
                (CHANCE * FRAC_1_PI * area / d2).min(1.0)
            }
        }
    }
    /// Probability of choosing `id`.
    #[inline]
    pub fn prob(&self, id: LightId) -> f32 {
        self.by_power.prob(id.0 as usize)
    }
    /// Lights seen by rays that leave the scene.
    pub fn infinite(&self) -> &[LightId] {
        &self.infinite
    }
}
