//! Rounds of trials, each from the mixture that the last one led to.
use super::{
    cluster::spheres,
    learn::learn,
    mixture::{Mixture, Row},
    need::Needs,
    trial::{Volley, pool},
};
use crate::{
    film::FilmSpec,
    light::LightId,
    scene::{MID_SHUTTER, Scene, World},
    spectrum::Wavelengths,
    walk::Limits,
};
use glam::Vec3;

/// How light is aimed.
#[derive(Clone, Copy, Debug)]
pub struct Training {
    /// The user's seed.
    pub seed: u64,
    /// When whole paths, from light to eye, end.
    pub limits: Limits,
    /// Whether light straight from lights is found by photons too.
    pub direct: bool,
}

/// The same in the first round, which knows only where camera paths go.
const PLAIN_AT_FIRST: f64 = 0.5;
/// Light paths of each round, per pixel, and at most.
const ROUNDS: [(f64, u64); 4] = [(0.0625, 16_384), (0.0625, 16_384), (0.125, 32_768), (0.125, 32_768)];
/// Light paths of a round at least.
const LEAST: u64 = 4096;
/// Groups of points that camera paths met.
const LEAVES: usize = 8;
/// Lights that are aimed before anything is known of them.
const LIGHTS: usize = 32;
/// Lights that can be learned of one by one.
const MOST_LIGHTS: usize = 4096;
/// Trials that something can be learned from.
const ENOUGH: usize = 32;
/// Aiming is worth its cost when it leaves less than this of the error of plain emission: a picture has other errors as
/// well, and photons that are not alike are noisier where all are needed. A matt Cornell box was promised 0.68, and got 1.
const WORTH: f64 = 0.5;
/// A training that promises no more than this after the first rounds is given up.
const HOPE: f64 = 0.75;

impl Training {
    /// The mixture to start light paths from; `None` where plain emission serves as well. Deterministic in (scene, spec,
    /// settings).
    pub(crate) fn train(&self, scene: &Scene, spec: FilmSpec) -> Option<Mixture> {
        let world = &scene.world(Wavelengths::Rgb, MID_SHUTTER);
        let lights = world.lights().count();
        if lights == 0 || lights > MOST_LIGHTS || self.limits.scatterings == 0 {
            return None;
        }
        let needs = Needs::new(world, spec, self.limits, self.seed);
        if needs.spots.is_empty() {
            return None;
        }
        let mut mixture = first(world, &needs);
        let (mut trials, mut volleys) = (Vec::new(), Vec::new());
        for (round, (share, most)) in (0..).zip(ROUNDS) {
            let paths = ((spec.pixels() as f64 * share) as u64).clamp(LEAST, most);
            let volley = Volley { seed: self.seed, round, paths, limits: self.limits, direct: self.direct };
            trials.extend(volley.shoot(world, &mixture, &needs));
            volleys.push((mixture, paths));
            pool(&mut trials, &volleys);
            if trials.len() < ENOUGH {
                return None;
            }
            let (next, left) = learn(world, &trials);
            if left > if round + 1 == ROUNDS.len() as u64 { WORTH } else { HOPE } && round > 0 {
                return None;
            }
            mixture = next;
        }
        Some(mixture)
    }
}

/// Half of all light as it comes; a quarter to where camera paths are bent, and a quarter to all that they meet.
fn first(world: &World, needs: &Needs) -> Mixture {
    let even =
        |points: &[Vec3]| spheres(&points.iter().map(|&p| (p, 1.0)).collect::<Vec<_>>(), LEAVES, world.around().radius);
    let groups = [even(&needs.bent), even(&needs.met)];
    let mut by_power: Vec<LightId> = (0..world.lights().count() as u32).map(LightId).collect();
    by_power.sort_by(|a, b| world.light_prob(*b).total_cmp(&world.light_prob(*a)));
    let mut rows = Vec::new();
    for (rank, &light) in by_power.iter().enumerate() {
        let power = f64::from(world.light_prob(light));
        rows.push((Row { light, target: None }, PLAIN_AT_FIRST * power));
        for group in groups.iter().filter(|_| rank < LIGHTS) {
            let share = 0.5 * (1.0 - PLAIN_AT_FIRST) * power / group.iter().count().max(1) as f64;
            rows.extend(group.iter().map(|&t| (Row { light, target: Some(t) }, share)));
        }
    }
    rows.sort_by_key(|(row, _)| row.light.0);
    let (rows, weights): (Vec<Row>, Vec<f64>) = rows.into_iter().unzip();
    Mixture::new(world, rows, &weights)
}
