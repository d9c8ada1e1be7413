//! Radii that leave the least error: a wide gather blurs, a narrow one is noisy, and a training measures both.
//!
//! Each spot of the training gathers with a ladder of radii, each half the one before, from several sets of photons that share
//! nothing. The scatter from set to set is the variance of each rung. Let `D` be the difference between a rung and
//! the next: its mean is (for smooth light) three quarters of the rung's bias, and the product of `D` from two sets has the mean
//! of `D` squared for its own mean, free of noise. So both parts of the mean squared error are estimated without bias, and
//! radii are chosen by their sum, pooled over a tile and its neighbours (the idea of weighing the two is in Kaplanyan & Dachsbacher 2013,
//! "Adaptive Progressive Photon Mapping", who find the second derivatives of light instead). With α = 2/3 noise and bias
//! fall alike from pass to pass (Knaus & Zwicker 2011, eqs. 17 and 20), so what is best for one number of passes is best for all.
//!
//! Neighbours: [`super::uniformity`] asks another question of the same photons; [`super::radii`] has the radii to begin with.
mod ladder;
mod spots;
#[cfg(test)]
mod tests;

use super::{Keep, Kernel, Radii, Schedule, Source};
use crate::{
    film::FilmSpec,
    scene::{MID_SHUTTER, Scene, World},
    spectrum::Wavelengths,
    walk::Limits,
};
use glam::Vec2;
pub use ladder::{CANDIDATES, Rung, Rungs};
use ladder::{Ladder, STEP, Sets};
use spots::Spots;

/// What a training of radii needs.
#[derive(Clone, Copy)]
pub struct Bandwidth<'s> {
    /// Where light paths start.
    pub source: &'s Source,
    /// The picture.
    pub spec: FilmSpec,
    /// When whole paths end.
    pub limits: Limits,
    /// Which photons are gathered.
    pub keep: Keep,
    /// What a photon counts.
    pub kernel: Kernel,
    /// How radii shrink.
    pub schedule: Schedule,
    /// The user's seed.
    pub seed: u64,
    /// Light paths of a pass of the render, > 0.
    pub paths: u64,
}

/// Error of a gather in a pass of the render, before radii shrink, as radiance squared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GatherError {
    /// Variance.
    pub variance: f64,
    /// Square of what is expected off the truth, by blur.
    pub bias2: f64,
}

/// The price of errors after some passes.
///
/// It is the mean squared error of a pixel, and several times that of the mean of a block of pixels: a blotch is seen where
/// as much noise is not. Blur is shared by a block, and so is the noise of gathers that are as wide.
#[derive(Clone, Copy, Debug)]
pub struct After {
    variance: f64,
    bias2: f64,
}

/// How much the mean of a block counts beside its pixels.
const BLOCKS: f64 = 6.0;
/// Pixels of a block.
const BLOCK: f64 = 256.0;

impl After {
    /// After `passes` passes with shrinking radii.
    pub fn new(passes: u64, schedule: Schedule) -> Self {
        let (variance, bias) = schedule.of_mean(passes);
        Self { variance, bias2: bias * bias }
    }
    /// The price of an error (squared) that whole blocks share and that passes do not lessen.
    pub fn shared(self, error2: f64) -> f64 {
        (1.0 + BLOCKS) * error2
    }
    /// What is left of the error of one pass, by gathers that cover so many pixels.
    #[inline]
    pub fn of(self, e: GatherError, pixels: f64) -> f64 {
        let shared = pixels / (pixels + BLOCK);
        (1.0 + BLOCKS * shared) * self.variance * e.variance + self.shared(self.bias2 * e.bias2)
    }
}

/// What a training found.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// Radii that suit the picture as a whole.
    pub radii: Radii,
    /// What other radii would leave, by family (see [`FAMILIES`]) and tile of [`Radii::tile`], neighbours included.
    pub ladders: [Vec<Rungs>; FAMILIES],
    /// The rungs of the ladders over `radii`, widest first.
    pub factors: [f32; CANDIDATES],
}

/// Photons that are gathered together: all that are kept, and those that came from a mirror or through glass last.
pub const FAMILIES: usize = 2;
/// Passes that a picture is judged after.
pub const PASSES: u64 = 64;
/// Spots in all for the search, and in each tile for the fit.
const SEARCHED: usize = 1024;
const SPOTS: u64 = 4;
/// A tile's own spots count so many times more than those of a neighbour: seams are narrow.
const OWN: usize = 4;
/// Moves of the search at most.
const MOVES: u64 = 8;
/// Sets of photons in the search and in the fit.
const SETS: [u64; 2] = [4, 6];
/// Photons at the top of the ladder in the mean that the search wants to judge by; with fewer in a whole pass, radii are too
/// narrow.
const ENOUGH: f64 = 32.0;
/// Radii that the search begins with, in widths of a pixel.
const WIDTHS: [f32; 2] = [1.0, 8.0];
/// The widest it can try: at most so many, and in small pictures this part of the shorter side.
const WIDEST: f32 = 32.0;
const PART: f32 = 1.0 / 16.0;
/// Light paths of a set: at least, at most, and in the fit this part of a pass.
const LEAST: u64 = 4096;
const MOST: u64 = 1 << 19;
const SHARE: u64 = 4;

impl Fitted {
    /// The radius of each tile by the rung that `choose` takes for it; in between, smooth.
    pub fn by(&self, choose: impl Fn(usize, Vec2) -> usize) -> Radii {
        let middles = self.radii.centres().into_iter();
        let factors: Vec<f32> = middles.enumerate().map(|(i, (middle, _))| self.factors[choose(i, middle)]).collect();
        self.radii.clone().times(&factors)
    }
    /// The rung with the least error in `tile`.
    pub fn best(&self, family: usize, tile: usize, after: After) -> usize {
        self.ladders[family][tile].least(|rung| after.of(rung.error, rung.pixels))
    }
}

impl Bandwidth<'_> {
    /// What radii leave of noise and blur, around those that suit the whole picture, whatever `start` was; it only says where
    /// the search for them begins. A function of scene, settings and `start`.
    pub fn fit(&self, scene: &Scene, start: Radii) -> Fitted {
        let world = &scene.world(Wavelengths::Rgb, MID_SHUTTER);
        let (factor, mut sets) = self.search(world, &start);
        let radii = start.scaled(factor);
        let spots = Spots::every_tile(world, &radii, self, SPOTS);
        if sets.paths < self.usual() {
            sets = Sets::shoot(self, world, SETS[1], self.usual());
        }
        sets.add(self, world, SETS[1]);
        let ladder = Ladder { bandwidth: self, top: STEP, sets: &sets };
        let measured = ladder.climb(&radii, &spots);
        let ladders = std::array::from_fn(|family| {
            let mut sums = vec![Rungs::default(); radii.len()];
            for (spot, rungs) in spots.iter().zip(&measured.spots) {
                sums[spot.tile] += rungs[family];
            }
            let pooled = |i: usize| radii.around(i).chain([i; OWN]).map(|j| sums[j]).sum();
            (0..sums.len()).map(pooled).collect()
        });
        Fitted { radii, ladders, factors: std::array::from_fn(|rung| ladder.factor(rung)) }
    }

    /// Light paths of a set, if they find enough.
    fn usual(&self) -> u64 {
        self.paths.div_ceil(SHARE).clamp(LEAST, MOST)
    }
    /// The factor over `radii` that is best for the picture as a whole, and the photons that told.
    fn search(&self, world: &World, radii: &Radii) -> (f32, Sets) {
        let spots = Spots::some(world, radii, self, SEARCHED);
        let after = After::new(PASSES, self.schedule);
        let mut sets = Sets::shoot(self, world, SETS[0], LEAST);
        let Some(width) = Spots::typical_width(&spots, self.spec) else { return (1.0, sets) };
        let side = self.spec.width.min(self.spec.height) as f32;
        let widest = (PART * side).clamp(WIDTHS[0], WIDEST) / width;
        let mut factor = (width.clamp(WIDTHS[0], WIDTHS[1]) / width).min(widest);
        for _ in 0..MOVES {
            let ladder = Ladder { bandwidth: self, top: factor * STEP, sets: &sets };
            let measured = ladder.climb(radii, &spots);
            let in_a_pass = measured.found * self.paths as f64 / sets.paths as f64;
            if in_a_pass < ENOUGH {
                // Too narrow to find much, whatever the blur.
                if factor == widest {
                    break;
                }
                factor = (factor * STEP * STEP).min(widest);
                continue;
            }
            if measured.found < ENOUGH {
                // Those that the fit wants anyway, if they will do.
                let enough = (ENOUGH / in_a_pass * self.paths as f64) as u64;
                let more = if enough <= self.usual() { self.usual() } else { enough + enough / 4 };
                let paths = more.min(self.paths).min(MOST);
                if paths > sets.paths {
                    sets = Sets::shoot(self, world, SETS[0], paths);
                    continue;
                }
            }
            let sum = measured.relative();
            let rung = sum.least(|rung| after.of(rung.error, rung.pixels));
            let was = factor;
            factor = ladder.factor(rung).min(widest);
            if factor == was || (rung > 0 && rung + 1 < CANDIDATES) {
                break;
            }
        }
        (factor, sets)
    }
}
