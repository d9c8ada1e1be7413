//! Weights of rows that leave the least noise.
//!
//! A path's share of a picture's error is `c² p / q`, if it added c when its density was p and is to have q from now on. The
//! sum over trials is convex in the weights of a mixture q. At its least, `G_k = Σ c² p p_k / q²` is the same for all rows
//! k that have a weight; so weights are multiplied by `√G_k` over and over, which for rows that do not overlap arrives in
//! one step.
use super::{mixture::Mixture, trial::Trial};

/// Turns of the iteration.
const TURNS: u32 = 24;

/// What trials say of the rows of a mixture.
pub(super) struct Fit {
    trials: Vec<Reached>,
    rows: usize,
}

/// What one trial says.
struct Reached {
    /// Its share of the error where the density is 1: c² p.
    error: f64,
    /// Its density by the fixed part.
    fixed: f64,
    /// Its density by each row that reaches it.
    rows: Vec<(usize, f64)>,
}

impl Reached {
    fn density(&self, w: &[f64]) -> f64 {
        self.fixed + self.rows.iter().map(|(k, p)| w[*k] * p).sum::<f64>()
    }
}

impl Fit {
    /// `fixed` is what each row has whatever is learned.
    pub(super) fn new(trials: &[Trial], mixture: &Mixture, fixed: &[f64]) -> Self {
        let look = |t: &Trial| {
            let reached = mixture.rows_of(t.light).map(|i| (i, f64::from(mixture.row_density(i, t.plain, t.line))));
            let rows: Vec<(usize, f64)> = reached.filter(|(_, p)| *p > 0.0).collect();
            let fixed = rows.iter().map(|(i, p)| fixed[*i] * p).sum();
            Reached { error: t.square / t.pdf, fixed, rows }
        };
        Self { trials: trials.iter().map(look).collect(), rows: mixture.rows().len() }
    }
    /// Error left by the learned weights `w` beside the fixed part, of which both together are a mixture.
    pub(super) fn error(&self, w: &[f64]) -> f64 {
        self.trials.iter().map(|t| t.error / t.density(w)).sum()
    }
    /// The weights, which sum to `total`, that leave the least.
    pub(super) fn solve(&self, total: f64) -> Vec<f64> {
        let mut w = vec![total / self.rows as f64; self.rows];
        for _ in 0..TURNS {
            let mut gain = vec![0.0; self.rows];
            for t in &self.trials {
                let q = t.density(&w);
                t.rows.iter().for_each(|(k, p)| gain[*k] += t.error * p / (q * q));
            }
            w.iter_mut().zip(&gain).for_each(|(w, g)| *w *= g.sqrt());
            let sum: f64 = w.iter().sum();
            w.iter_mut().for_each(|w| *w *= total / sum);
        }
        w
    }
}
