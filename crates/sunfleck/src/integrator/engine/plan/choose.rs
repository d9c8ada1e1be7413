//! What each tile costs and leaves by each way to render it, and which is best.
//!
//! The sooner a picture is good, the less the product of its error and its cost. So a tile takes what adds least to
//! `error / mean error + cost / mean cost`, round by round as the means follow, for each number of light paths, and the
//! number with the least product wins; none at all is among them.
//!
//! What a short training has not met, it cannot measure: a path tracer that never found the caustic looks calm, and so does a
//! gather that no photon reached. Yet one candidate sees what the other misses, so light that is missing beyond noise counts as
//! error (see [`Choice::unseen`]).
use super::{
    super::{Prepared, techniques::Merge},
    Plan,
    trial::{self, SHARE, Trial, Way},
};
use crate::{
    film::FilmSpec,
    photon::{
        After, Fitted, GatherError,
        bandwidth::{self, Rung},
    },
};
use glam::Vec2;
use std::ops::AddAssign;

/// A photon that a gather meets, and a gather itself, cost as much as so many rays.
const PHOTON: f64 = 0.02;
const GATHER: f64 = 1.0;
/// Light paths over those that the size of the picture suggests.
const SHARES: [f64; 7] = [2.0, 1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125];
/// Passes that a picture is judged after.
const PASSES: f64 = bandwidth::PASSES as f64;
/// Squared radiance below which a tile is as good as black.
const DARKEST: f64 = 1e-30;
/// Light is missing if it is more than the square root of this times the noise.
const SURE: f64 = 16.0;
/// Rounds of prices.
const ROUNDS: usize = 4;
/// Pixels of the picture that candidates are tried on, at most, and of one that a glance will do for.
const PIXELS: f64 = 16_384.0;
const GLANCE: f64 = 4_096.0;
/// In a room without caustics photons must be so many times better, for the noise of camera paths goes on falling as fast as
/// passes grow in number, and means over parts of the picture are right.
const BETTER: f64 = 8.0;
/// Points along a tile's edge where ladders are looked up.
const LOOKS: usize = 3;

/// A candidate for tiles.
struct Candidate<'t> {
    merge: Merge,
    trial: &'t Trial,
    /// Of [`Fitted::ladders`].
    family: usize,
    /// Cost of a pixel in rays, photons not counted.
    cost: f64,
}

/// Relative mean squared error, and cost in rays, of a pixel.
#[derive(Clone, Copy, Default)]
struct Bill {
    error: f64,
    cost: f64,
}

impl AddAssign for Bill {
    fn add_assign(&mut self, o: Self) {
        self.error += o.error;
        self.cost += o.cost;
    }
}

impl Bill {
    /// What it adds by these prices.
    fn at(&self, prices: Bill) -> f64 {
        self.error * prices.error + self.cost * prices.cost
    }
    fn product(&self) -> f64 {
        self.error * self.cost
    }
    fn over(self, n: f64) -> Self {
        Self { error: self.error / n, cost: self.cost / n }
    }
}

/// What decides.
struct Choice<'t> {
    plan: Plan,
    candidates: [Candidate<'t>; 2],
    fitted: Option<&'t Fitted>,
    after: After,
    /// Square of the radiance in each tile.
    light2: Vec<f64>,
    /// Error that is not of gathers, by tile and candidate, relative.
    rest: Vec<[f64; 2]>,
    /// Rays of light paths for each pixel, at a share of 1.
    light: f64,
}

impl Choice<'_> {
    /// Ladders to judge tile `i` by.
    fn ladders(&self, i: usize) -> impl Iterator<Item = usize> {
        let (corner, size) = self.plan.area(i);
        (0..LOOKS * LOOKS)
            .map(move |n| {
                let at = Vec2::new((n % LOOKS) as f32 + 0.5, (n / LOOKS) as f32 + 0.5) / LOOKS as f32;
                corner + at * size
            })
            .filter_map(|p| self.fitted.map(|f| f.radii.tile(p)))
    }
    /// The bill of a rung.
    fn rung(&self, rung: Rung, light2: f64, share: f64) -> Bill {
        let e = GatherError { variance: rung.error.variance / share, ..rung.error };
        Bill { error: self.after.of(e, rung.pixels) / light2, cost: PHOTON * share * rung.photons }
    }
    /// The rung that a ladder takes.
    fn best_rung(&self, family: usize, ladder: usize, light2: f64, share: f64, prices: Bill) -> usize {
        let Some(fitted) = self.fitted else { return 0 };
        fitted.ladders[family][ladder].least(|rung| self.rung(rung, light2, share).at(prices))
    }
    /// The bill of tile `i` by candidate `c`.
    fn bill(&self, i: usize, c: usize, share: f64, prices: Bill) -> Bill {
        let candidate = &self.candidates[c];
        let mut sum = Bill::default();
        let mut n = 0.0;
        if let Some(fitted) = self.fitted {
            for l in self.ladders(i) {
                let rung = self.best_rung(candidate.family, l, self.light2[i], share, prices);
                let ladder = &fitted.ladders[candidate.family][l];
                sum += self.rung(ladder.rung(rung), self.light2[i], share);
                n += 1.0;
            }
        }
        let mut bill = sum.over(f64::max(n, 1.0));
        bill += Bill { error: self.rest[i][c], cost: candidate.cost };
        bill
    }
    /// The better candidate of tile `i`.
    fn better(&self, i: usize, share: f64, prices: Bill) -> (usize, Bill) {
        let bills = [0, 1].map(|c| self.bill(i, c, share, prices));
        let c = usize::from(bills[1].at(prices) < bills[0].at(prices));
        (c, bills[c])
    }
    /// Prices that the choices by themselves lead to, and the bill of the whole picture.
    fn settle(&self, share: f64) -> (Bill, Bill) {
        let n = self.plan.tiles.len();
        let mut prices = Bill { error: 1.0, cost: 0.0 };
        let mut bill = Bill::default();
        for _ in 0..ROUNDS {
            bill = Bill::default();
            for i in 0..n {
                bill += self.better(i, share, prices).1;
            }
            bill = bill.over(n as f64);
            bill.cost += share * self.light;
            prices = Bill { error: 1.0 / bill.error.max(f64::MIN_POSITIVE), cost: 1.0 / bill.cost };
        }
        (prices, bill)
    }
}

impl<'t> Choice<'t> {
    fn new(trials: &'t [Trial; 2], fitted: Option<&'t Fitted>, after: After, plan: Plan, light: f64) -> Self {
        let [by_paths, by_photons] = trials;
        let candidates = [
            Candidate { merge: Merge::Caustic, trial: by_paths, family: 1, cost: by_paths.pixel },
            Candidate { merge: Merge::First, trial: by_photons, family: 0, cost: by_photons.pixel + GATHER },
        ];
        let tiles = plan.tiles.len();
        let radiance = |i: usize| plan.around(i, |j| by_photons.tiles[j].mean);
        let light2 = (0..tiles).map(|i| radiance(i).powi(2).max(DARKEST)).collect();
        let mut choice = Self { plan, candidates, fitted, after, light2, rest: Vec::new(), light };
        let rest = |i: usize, c: usize| (choice.without_gathers(i, c) + choice.unseen(i, c)) / choice.light2[i];
        choice.rest = (0..tiles).map(|i| [0, 1].map(|c| rest(i, c))).collect();
        choice
    }
    /// Error of candidate `c` in tile `i` that is not of gathers, radiance squared.
    fn without_gathers(&self, i: usize, c: usize) -> f64 {
        let candidate = &self.candidates[c];
        let variance = self.plan.around(i, |j| candidate.trial.tiles[j].variance);
        let Some(fitted) = self.fitted else {
            // Nothing is known of gathers: where they find all but direct light, all noise is theirs.
            let gathered = GatherError { variance: variance / SHARE as f64, bias2: 0.0 };
            return if candidate.family == 0 { self.after.of(gathered, 0.0) } else { variance / PASSES };
        };
        let (mut gathers, mut n) = (0.0, 0.0f64);
        for l in self.ladders(i) {
            let ladder = &fitted.ladders[candidate.family][l];
            gathers += ladder.rung(fitted.best(candidate.family, l, self.after)).error.variance;
            n += 1.0;
        }
        (variance - SHARE as f64 * gathers / n.max(1.0)).max(0.0) / PASSES
    }
    /// Error (radiance squared) of candidate `c` in tile `i` by light that the other candidate saw there and it did not.
    ///
    /// What `n` samples did not meet comes less often than once in `n`, and so is in each sample a variance of at least `n` times
    /// its square. Photons are shared, so that none in any of the gathers says less: what they miss counts as blur does.
    fn unseen(&self, i: usize, c: usize) -> f64 {
        // Photons are shared by neighbours: only passes are independent.
        let mean_and_noise2 = |c: usize| {
            let tiles = &self.candidates[c].trial.tiles;
            let passes: [f64; trial::PASSES as usize] =
                std::array::from_fn(|pass| self.plan.around(i, |j| tiles[j].passes[pass]));
            let n = passes.len() as f64;
            let mean = passes.iter().sum::<f64>() / n;
            (mean, passes.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / (n * (n - 1.0)))
        };
        let [own, other] = [c, 1 - c].map(mean_and_noise2);
        let (missing, noise2) = (other.0 - own.0, own.1 + other.1);
        if missing <= 0.0 || missing * missing < SURE * noise2 {
            return 0.0;
        }
        let error = missing * missing - noise2;
        let samples = self.plan.around_sum(i, |j| self.candidates[c].trial.tiles[j].samples);
        if self.candidates[c].merge == Merge::Caustic { error * samples / PASSES } else { self.after.shared(error) }
    }
    /// The bill of the picture without photons.
    fn without_photons(&self) -> Bill {
        let mut sum = Bill::default();
        for rest in &self.rest {
            sum += Bill { error: rest[0], cost: self.candidates[0].cost };
        }
        sum.over(self.rest.len().max(1) as f64)
    }
}

impl Plan {
    /// Whether a room that makes no caustics is as well rendered by camera paths alone; if so, that is the plan. Gathers are
    /// judged by their noise, as if they did not blur. The look is too short to count beside a picture.
    pub(in super::super) fn needs_no_photons(prepared: &mut Prepared, spec: FilmSpec, seed: u64) -> bool {
        let glance = trial::small(spec, GLANCE);
        let radii = &prepared.radii;
        let ways = [Merge::Caustic, Merge::First]
            .map(|merge| Way { plan: Self::everywhere(spec, merge), radii: radii.clone() });
        let trials = trial::try_out(&ways, prepared, glance, seed);
        let light = prepared.paths as f64 / spec.pixels() as f64 * trials[1].path;
        let after = After::new(bandwidth::PASSES, prepared.engine.schedule);
        let choice = Choice::new(&trials, None, after, Self::everywhere(spec, Merge::Off), light);
        let needs_none = choice.without_photons().product() <= BETTER * choice.settle(1.0).1.product();
        if needs_none {
            prepared.paths = 0;
            prepared.plan = Some(choice.plan);
        }
        needs_none
    }
    /// Tries candidates on a small picture and keeps, tile by tile, the one with the least error for its cost, and its radii.
    /// Costs are counted, not timed, so the plan is a function of scene, picture and seed.
    pub(in super::super) fn train(prepared: &mut Prepared, fitted: Option<&Fitted>, spec: FilmSpec, seed: u64) {
        let small = trial::small(spec, PIXELS);
        let after = After::new(bandwidth::PASSES, prepared.engine.schedule);
        let ways = [(Merge::Caustic, 1), (Merge::First, 0)].map(|(merge, family)| {
            let best = |f: &Fitted| f.by(|tile, _| f.best(family, tile, after));
            Way { plan: Self::everywhere(spec, merge), radii: fitted.map_or(prepared.radii.clone(), best) }
        });
        let trials = trial::try_out(&ways, prepared, small, seed);
        prepared.radii = ways[1].radii.clone();
        let mut plan = Self::everywhere(spec, Merge::Caustic);
        let caustics = plan.finds_photons(prepared, small, seed);
        let light = prepared.paths as f64 / spec.pixels() as f64 * trials[1].path;
        let choice = Choice::new(&trials, fitted, after, plan.clone(), light);
        let shares: &[f64] = if prepared.engine.paths.is_some() || fitted.is_none() { &[1.0] } else { &SHARES };
        let (mut share, (mut prices, mut bill)) = (1.0, choice.settle(1.0));
        for &s in shares {
            let (p, b) = choice.settle(s);
            if b.product() < bill.product() {
                (share, prices, bill) = (s, p, b);
            }
        }
        if !caustics && choice.without_photons().product() <= bill.product() {
            plan.tiles.fill(Merge::Off);
            prepared.paths = 0;
        } else {
            for (i, tile) in plan.tiles.iter_mut().enumerate() {
                *tile = choice.candidates[choice.better(i, share, prices).0].merge;
            }
            prepared.paths = ((prepared.paths as f64 * share) as u64).max(1);
            if let Some(f) = fitted {
                prepared.radii = f.by(|ladder, middle| {
                    let i = plan.index(middle);
                    let family = usize::from(plan.tiles[i] == Merge::Caustic);
                    choice.best_rung(family, ladder, choice.light2[i], share, prices)
                });
            }
        }
        prepared.plan = Some(plan);
    }
}
