//! Candidates tried on a small picture.
use super::{
    super::{Job, Prepared, camera::Only, techniques::Technique},
    Plan,
};
use crate::{
    film::{Counts, FilmSpec, Filter, PassImage},
    integrator::Pass,
    photon::Radii,
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

/// A way to render: what is merged, with which radii.
pub(super) struct Way {
    pub(super) plan: Plan,
    pub(super) radii: Radii,
}

/// Sums over the training passes of one way.
struct Tally {
    sums: Vec<f64>,
    squares: Vec<f64>,
    /// Number of the tile that each pixel is in.
    tile_of: Vec<usize>,
    tiles: Vec<Seen>,
    rays: u64,
}

impl Tally {
    fn new(plan: &Plan, spec: FilmSpec) -> Self {
        let (width, height) = (spec.width as usize, spec.height as usize);
        let tile_of = |i: usize| i / width * plan.rows / height * plan.columns + i % width * plan.columns / width;
        let zeros = vec![0.0; spec.pixels()];
        let (tile_of, tiles) = ((0..spec.pixels()).map(tile_of).collect(), vec![Seen::default(); plan.tiles.len()]);
        Self { sums: zeros.clone(), squares: zeros, tile_of, tiles, rays: 0 }
    }
    fn add(&mut self, index: u64, image: &PassImage) {
        for (i, p) in image.pixels().iter().enumerate() {
            let v = f64::from(p.element_sum()) / 3.0;
            self.sums[i] += v;
            self.squares[i] += v * v;
            self.tiles[self.tile_of[i]].passes[index as usize] += v;
        }
        self.rays += image.counts.rays;
    }
    /// `path`: mean cost of a light path.
    fn finish(mut self, path: f64) -> Trial {
        let n = PASSES as f64;
        let mut pixels = vec![0.0f64; self.tiles.len()];
        for ((sum, square), &tile) in self.sums.iter().zip(&self.squares).zip(&self.tile_of) {
            let seen = &mut self.tiles[tile];
            seen.mean += sum / n;
            seen.variance += ((square - sum * sum / n) / (n - 1.0)).max(0.0);
            pixels[tile] += 1.0;
        }
        for (seen, n) in self.tiles.iter_mut().zip(pixels) {
            seen.mean /= n.max(1.0);
            seen.variance /= n.max(1.0);
            seen.samples = n * PASSES as f64;
            seen.passes = seen.passes.map(|sum| sum / n.max(1.0));
        }
        Trial { pixel: self.rays as f64 / (n * self.sums.len() as f64), tiles: self.tiles, path }
    }
}

/// Renders a few passes of a picture of `spec` by each of two ways. Both meet the same light paths; the second needs all photons
/// that the first one does.
pub(super) fn try_out(ways: &[Way; 2], prepared: &Prepared, spec: FilmSpec, seed: u64) -> [Trial; 2] {
    let mut tallies = ways.each_ref().map(|way| Tally::new(&way.plan, spec));
    let mut image = PassImage::new(spec);
    let mut light = Counts::default();
    for index in 0..PASSES {
        let [first, second] = ways.each_ref().map(|way| way.plan.job(prepared, seed, index));
        let world = prepared.scene.world(second.pass.lambda, second.pass.time);
        let shrink = prepared.engine.schedule.radius(index);
        image.clear();
        let all = prepared.walk_light(&second, &world, prepared.rule(second.count()), shrink, &mut image);
        light += image.counts;
        let some = all.gathered_by(ways[0].plan.needs());
        for (i, (job, subpaths)) in [(first, some), (second, all)].into_iter().enumerate() {
            image.clear();
            prepared.look(&job, &world, subpaths, &ways[i].radii, &mut image);
            tallies[i].add(index, &image);
        }
    }
    tallies.map(|tally| tally.finish(light.light_rays as f64 / light.emitted.max(1) as f64))
}

impl Plan {
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
