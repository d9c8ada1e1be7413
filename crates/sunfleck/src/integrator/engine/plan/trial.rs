//! Candidates tried on a small picture.
use super::{
    super::{Job, Prepared, camera::Only, techniques::Technique},
    Plan,
};
use crate::{
    film::{Counts, FilmSpec, Filter, PassImage},
    integrator::Pass,
    spectrum::Rgb,
};

/// Training passes: variances of a tile's pixels to about a third, of which neighbours then take the mean.
pub(super) const PASSES: u64 = 6;
/// Training passes have this many times fewer light paths than those of the render, and gathers so many times more variance.
pub(super) const SHARE: u64 = 8;

/// What a training saw of one candidate.
pub(super) struct Trial {
    /// By tile.
    pub(super) tiles: Vec<Seen>,
    /// Mean cost of a pixel in rays, light paths not counted.
    pub(super) pixel: f64,
    /// Mean cost of a light path in rays.
    pub(super) path: f64,
}

/// Radiance in the pixels of a tile.
#[derive(Clone, Copy, Default)]
pub(super) struct Seen {
    pub(super) mean: f64,
    /// Of one pass.
    pub(super) variance: f64,
    /// Samples it was seen by.
    pub(super) samples: f64,
    /// Mean of each pass.
    pub(super) passes: [f64; PASSES as usize],
}

/// A picture of the same shape with at most about `pixels` pixels.
pub(super) fn small(spec: FilmSpec, pixels: f64) -> FilmSpec {
    let scale = (pixels / spec.pixels() as f64).sqrt().min(1.0);
    let shrunk = |n: u32| ((f64::from(n) * scale) as u32).max(1);
    FilmSpec { width: shrunk(spec.width), height: shrunk(spec.height), filter: Filter::Middle }
}

impl Plan {
    /// Renders a few passes of a picture of `spec` by this plan.
    pub(super) fn try_out(&self, prepared: &Prepared, spec: FilmSpec, seed: u64) -> Trial {
        let pixels = spec.pixels();
        let (mut sums, mut squares) = (vec![0.0f64; pixels], vec![0.0f64; pixels]);
        let tile_of = |i: usize| {
            let (x, y) = (i % spec.width as usize, i / spec.width as usize);
            y * self.rows / spec.height as usize * self.columns + x * self.columns / spec.width as usize
        };
        let mut tiles = vec![(Seen::default(), 0.0f64); self.tiles.len()];
        let mut counts = Counts::default();
        let mut image = PassImage::new(spec);
        for index in 0..PASSES {
            image.clear();
            prepared.render(&self.job(prepared, seed, index), &mut image);
            for (i, p) in image.pixels().iter().enumerate() {
                let v = f64::from(p.element_sum()) / 3.0;
                sums[i] += v;
                squares[i] += v * v;
                tiles[tile_of(i)].0.passes[index as usize] += v;
            }
            counts += image.counts;
        }
        let n = PASSES as f64;
        for i in 0..pixels {
            let (seen, count) = &mut tiles[tile_of(i)];
            seen.mean += sums[i] / n;
            seen.variance += ((squares[i] - sums[i] * sums[i] / n) / (n - 1.0)).max(0.0);
            *count += 1.0;
        }
        let mean = |(s, n): (Seen, f64)| Seen {
            mean: s.mean / n.max(1.0),
            variance: s.variance / n.max(1.0),
            samples: n * PASSES as f64,
            passes: s.passes.map(|sum| sum / n.max(1.0)),
        };
        Trial {
            tiles: tiles.into_iter().map(mean).collect(),
            pixel: (counts.rays - counts.light_rays) as f64 / (n * pixels as f64),
            path: counts.light_rays as f64 / counts.emitted.max(1) as f64,
        }
    }
    /// Whether gathers by this plan find any photon.
    pub(super) fn finds_photons(&self, prepared: &Prepared, spec: FilmSpec, seed: u64) -> bool {
        let mut image = PassImage::new(spec);
        let only = Some(Only { technique: Technique::Merge, weighted: false });
        prepared.render(&Job { only, ..self.job(prepared, seed, PASSES) }, &mut image);
        image.pixels().iter().any(|p| *p != Rgb::ZERO)
    }
    fn job<'p>(&'p self, prepared: &Prepared, seed: u64, index: u64) -> Job<'p> {
        // Numbers that no pass of the render draws again.
        let pass = Pass::new(seed ^ 0x706c_616e, index);
        let paths = 0..prepared.paths.div_ceil(SHARE);
        Job { pass, only: None, plan: Some(self), paths, sample: index, share: 1.0 }
    }
}
