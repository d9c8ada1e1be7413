//! From trials to a mixture.
use super::{
    cluster::spheres,
    fit::Fit,
    mixture::{Mixture, Row},
    trial::Trial,
};
use crate::{light::LightId, scene::World};
use glam::Vec3;

/// Share of the paths that is never aimed. What no trial has found comes with this share of plain emission, so nothing
/// gets much noisier than by plain emission.
const PLAIN: f64 = 0.2;
/// Share of the paths that is aimed loosely, at spheres much larger than what the trials found.
const WIDE: f64 = 0.15;
/// Groups of first hits, over all lights.
const LEAVES: usize = 16;
/// Rows of less weight are left out.
const SLIGHT: f64 = 4e-3;

/// Rows, and the weights that they have whatever is learned.
#[derive(Default)]
struct Candidates {
    rows: Vec<Row>,
    fixed: Vec<f64>,
}

/// A mixture that suits `trials`, and the share of the error of plain emission that it leaves. Every other trial tells
/// where to aim, and the others with which weights, so that groups made of chance get none.
pub(super) fn learn(world: &World, trials: &[Trial]) -> (Mixture, f64) {
    let half = |odd: usize| -> Vec<Trial> { trials.iter().skip(odd).step_by(2).copied().collect() };
    let (shape, judge) = (half(0), half(1));
    let Candidates { rows, fixed } = Candidates::new(world, &shape);
    let mixture = Mixture::new(world, rows, &fixed);
    let fit = Fit::new(&judge, &mixture, &fixed);
    let w = fit.solve(1.0 - PLAIN - WIDE);
    let power = |row: &Row| if row.target.is_none() { f64::from(world.light_prob(row.light)) } else { 0.0 };
    let plain: Vec<f64> = mixture.rows().iter().map(power).collect();
    let left = fit.error(&w) / Fit::new(&judge, &mixture, &plain).error(&vec![0.0; w.len()]);
    let weighted = mixture.rows().iter().zip(fixed.iter().zip(&w).map(|(f, w)| f + if *w > SLIGHT { *w } else { 0.0 }));
    let (rows, weights): (Vec<Row>, Vec<f64>) =
        weighted.filter(|(row, w)| *w > 0.0 || row.target.is_none()).map(|(row, w)| (*row, w)).unzip();
    (Mixture::new(world, rows, &weights), left)
}

impl Candidates {
    /// For each light its plain row, and rows that aim at groups of the first hits of `trials`.
    fn new(world: &World, trials: &[Trial]) -> Self {
        let mean = trials.iter().map(Trial::worth).sum::<f64>() / trials.len().max(1) as f64;
        // One lucky path is no reason to aim at the place where it went.
        let mass = |t: &Trial| t.worth().min(10.0 * mean) as f32;
        let total: f32 = trials.iter().map(mass).sum();
        let mut all = Self::default();
        for light in (0..world.lights().count() as u32).map(LightId) {
            let hits: Vec<(Vec3, f32)> =
                trials.iter().filter(|t| t.light == light).map(|t| (t.first, mass(t))).collect();
            let share = hits.iter().map(|(_, m)| m).sum::<f32>() / total;
            all.add(world, light, &hits, (LEAVES as f32 * share).ceil() as usize);
        }
        all
    }
    fn add(&mut self, world: &World, light: LightId, hits: &[(Vec3, f32)], leaves: usize) {
        let power = f64::from(world.light_prob(light));
        let spheres = spheres(hits, leaves, world.around().radius);
        let wide = spheres.wide.len();
        let mut push = |target, fixed| {
            self.rows.push(Row { light, target });
            self.fixed.push(fixed);
        };
        push(None, power * if wide == 0 { PLAIN + WIDE } else { PLAIN });
        spheres.wide.iter().for_each(|t| push(Some(*t), power * WIDE / wide as f64));
        spheres.tight.iter().for_each(|t| push(Some(*t), 0.0));
    }
}
