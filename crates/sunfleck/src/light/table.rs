//! Which light next: in proportion to power.
use super::{Emitter, Light, LightId, Surroundings};
use crate::math::Discrete;

/// The lights' probabilities, and which of them rays see when they leave the scene.
#[derive(Clone, Debug, Default)]
pub struct LightTable {
    by_power: Discrete,
    infinite: Vec<LightId>,
}

impl LightTable {
    /// Weighs each light by the sum of its power over the channels.
    pub fn new<'a>(lights: impl Iterator<Item = &'a Light> + Clone, around: &Surroundings) -> Self {
        let infinite = lights.clone().zip(0..).filter(|(l, _)| l.is_infinite()).map(|(_, i)| LightId(i)).collect();
        Self { by_power: Discrete::new(lights.map(|l| l.power(around).element_sum())), infinite }
    }
    /// A light, its discrete probability, and a fresh uniform number. `None` if there is no light.
    #[inline]
    pub fn sample(&self, u: f32) -> Option<(LightId, f32, f32)> {
        self.by_power.sample(u).map(|(i, prob, rest)| (LightId(i as u32), prob, rest))
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
