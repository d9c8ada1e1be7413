//! Which part of the picture is left to which samplers: decided before the first pass, then kept.
use super::{
    Job, Prepared,
    camera::Only,
    techniques::{Merge, Technique},
};
use crate::{
    film::{Counts, FilmSpec, PassImage},
    integrator::Pass,
    spectrum::Rgb,
};
use glam::Vec2;

/// What is merged in each tile of the picture. Camera paths of different tiles share nothing but photons, so each tile's
/// estimate is right by itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Plan {
    columns: usize,
    rows: usize,
    tiles: Vec<Merge>,
}

/// Candidates for a tile: photons only for what comes from mirrors and through glass, beside a path tracer; or for
/// everything that is not direct light, with camera paths that end where they gather.
const CANDIDATES: [Merge; 2] = [Merge::Caustic, Merge::First];
/// Tiles along the picture's longer side, at most, and pixels along a tile's edge, at least.
const TILES: u32 = 32;
const EDGE: u32 = 8;
/// Training passes: variances of a tile's pixels to about a third, of which neighbours then take the mean.
const PASSES: u64 = 6;
/// Pixels of the training's picture, at most.
const PIXELS: f64 = 16_384.0;
/// Training passes have this many times fewer light paths than those of the render, and gathers so many times more variance.
const TRAINING_SHARE: u64 = 8;
/// A gather costs as much as this many rays.
const GATHER: f64 = 2.0;

/// What a training saw of one candidate.
struct Trial {
    /// Relative variance of a pixel, by tile.
    variance: Vec<f64>,
    /// Mean cost of a pixel in rays, light paths not counted.
    cost: f64,
}

impl Plan {
    /// What is merged at `raster` (see [`crate::camera`]).
    #[inline]
    pub(super) fn at(&self, raster: Vec2) -> Merge {
        let x = ((raster.x * self.columns as f32) as usize).min(self.columns - 1);
        let y = ((raster.y * self.rows as f32) as usize).min(self.rows - 1);
        self.tiles[y * self.columns + x]
    }
    /// Which photons the tiles need between them.
    pub(super) fn needs(&self) -> Merge {
        if self.tiles.contains(&Merge::First) {
            Merge::First
        } else if self.tiles.contains(&Merge::Caustic) {
            Merge::Caustic
        } else {
            Merge::Off
        }
    }
    fn everywhere(spec: FilmSpec, merge: Merge) -> Self {
        let tile = (spec.width.max(spec.height).div_ceil(TILES)).max(EDGE);
        let (columns, rows) = (spec.width.div_ceil(tile) as usize, spec.height.div_ceil(tile) as usize);
        Self { columns, rows, tiles: vec![merge; columns * rows] }
    }

    /// Tries the candidates on a small picture and keeps, tile by tile, the one with less variance for its cost. Costs are
    /// counted, not timed, so the plan is a function of scene, picture and seed. Without any photon from a mirror or through
    /// glass within reach, tiles that need no others are left to the path tracer alone.
    pub(super) fn train(prepared: &Prepared, spec: FilmSpec, seed: u64) -> Self {
        let scale = (PIXELS / spec.pixels() as f64).sqrt().min(1.0);
        let shrunk = |n: u32| ((f64::from(n) * scale) as u32).max(1);
        let small = FilmSpec { width: shrunk(spec.width), height: shrunk(spec.height), ..spec };
        let mut plan = Self::everywhere(spec, Merge::Off);
        let trials = CANDIDATES.map(|merge| {
            plan.tiles.fill(merge);
            plan.try_out(prepared, small, seed)
        });
        let caustics = plan.sees_caustics(prepared, small, seed);
        let [traced, gathered] = &trials;
        let tiles = (0..plan.tiles.len()).map(|i| {
            let by_paths = plan.around(&traced.variance, i) * traced.cost;
            let by_photons = plan.around(&gathered.variance, i) / TRAINING_SHARE as f64 * (gathered.cost + GATHER);
            if by_photons < by_paths {
                Merge::First
            } else if caustics {
                Merge::Caustic
            } else {
                Merge::Off
            }
        });
        Self { tiles: tiles.collect(), ..plan }
    }
}

impl Plan {
    fn try_out(&self, prepared: &Prepared, small: FilmSpec, seed: u64) -> Trial {
        let pixels = small.pixels();
        let (mut sums, mut squares) = (vec![0.0f64; pixels], vec![0.0f64; pixels]);
        let mut counts = Counts::default();
        let mut image = PassImage::new(small);
        for index in 0..PASSES {
            image.clear();
            prepared.render(&self.job(prepared, seed, index), &mut image);
            for (i, p) in image.pixels().iter().enumerate() {
                let v = f64::from(p.element_sum()) / 3.0;
                sums[i] += v;
                squares[i] += v * v;
            }
            counts += image.counts;
        }
        let n = PASSES as f64;
        let mut tiles = vec![(0.0, 0.0, 0.0f64); self.tiles.len()];
        for i in 0..pixels {
            let (x, y) = (i % small.width as usize, i / small.width as usize);
            let tile = y * self.rows / small.height as usize * self.columns + x * self.columns / small.width as usize;
            let t = &mut tiles[tile];
            t.0 += sums[i] / n;
            t.1 += (squares[i] - sums[i] * sums[i] / n) / (n - 1.0);
            t.2 += 1.0;
        }
        let variance = tiles.iter().map(|(mean, variance, count)| {
            // Without light there is nothing to tell apart.
            if *mean > 0.0 { variance * count / (mean * mean) } else { 0.0 }
        });
        let camera_rays = counts.rays - counts.light_rays;
        Trial { variance: variance.collect(), cost: camera_rays as f64 / (n * pixels as f64) }
    }
    /// Whether gathers find any photon from a mirror or through glass.
    fn sees_caustics(&self, prepared: &Prepared, small: FilmSpec, seed: u64) -> bool {
        let caustics = Self { tiles: vec![Merge::Caustic; self.tiles.len()], ..self.clone() };
        let mut image = PassImage::new(small);
        let only = Some(Only { technique: Technique::Merge, weighted: false });
        prepared.render(&Job { only, ..caustics.job(prepared, seed, PASSES) }, &mut image);
        image.pixels().iter().any(|p| *p != Rgb::ZERO)
    }
    fn job<'p>(&'p self, prepared: &Prepared, seed: u64, index: u64) -> Job<'p> {
        // Numbers that no pass of the render draws again.
        let pass = Pass::new(seed ^ 0x706c_616e, index);
        let paths = 0..prepared.paths.div_ceil(TRAINING_SHARE);
        Job { pass, only: None, plan: Some(self), paths, sample: index, share: 1.0 }
    }
    /// Mean of `values` over tile `i` and its neighbours.
    fn around(&self, values: &[f64], i: usize) -> f64 {
        let near = |at: usize, end: usize| at.saturating_sub(1)..(at + 2).min(end);
        let (x, y) = (i % self.columns, i / self.columns);
        let tiles = near(y, self.rows).flat_map(|y| near(x, self.columns).map(move |x| y * self.columns + x));
        let (sum, n) = tiles.fold((0.0, 0.0), |(s, n), i| (s + values[i], n + 1.0));
        sum / n
    }
}
