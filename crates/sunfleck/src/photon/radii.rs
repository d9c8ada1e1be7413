//! How far a gather reaches, over the picture: from what its pixels cover, through mirrors and glass.
use super::{Span, sight::Sight};
use crate::{
    film::FilmSpec,
    sampler::{Domain, Sampler},
    scene::{MID_SHUTTER, Scene, World},
    spectrum::Wavelengths,
    walk::Limits,
};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

/// First radii by place on the picture: a function of raster coordinates alone, so that all samplers of a path agree on the
/// radius it is merged with.
#[derive(Clone, Debug)]
pub struct Radii {
    columns: usize,
    rows: usize,
    /// Natural logarithm of the radius (world units) in the middle of each tile, row by row.
    log: Vec<f32>,
    typical: f32,
}

/// Pixels along the edge of a tile, for pictures of up to [`MAX_TILES`] tiles a side.
const TILE: u32 = 8;
const MAX_TILES: u32 = 128;
/// Camera paths a tile.
const SAMPLES: u64 = 4;
/// A radius is no more than this many times larger or smaller than the median of the picture: far more than lies between a thing
/// on a table and the wall of a hall, and little enough for an index of a few levels.
const SPREAD: f32 = 1024.0;
/// A pixel seen through glass covers at most so many times more or less than what its distance alone says.
const LENS: f32 = 16.0;

impl Radii {
    /// The same radius (world units, positive) everywhere.
    pub fn fixed(radius: f32) -> Self {
        Self { columns: 1, rows: 1, log: vec![radius.ln()], typical: radius }
    }
    /// `scale` times the width of a pixel where its path first meets a connectible surface. `fallback` is the radius if
    /// the camera sees none.
    pub fn from_footprints(
        scene: &Scene,
        spec: FilmSpec,
        limits: &Limits,
        seed: u64,
        scale: f32,
        fallback: f32,
    ) -> Self {
        let (columns, rows) = (spec.width.div_ceil(TILE).min(MAX_TILES), spec.height.div_ceil(TILE).min(MAX_TILES));
        let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
        let tile = |i: u32| -> Option<f32> {
            let mut widths: Vec<f32> = (0..SAMPLES)
                .filter_map(|s| {
                    let mut sampler = Sampler::new(seed, Domain::Prepare, u64::MAX - 1, u64::from(i) * SAMPLES + s);
                    let u = sampler.next_2d();
                    let place = Vec2::new((i % columns) as f32 + u.x, (i / columns) as f32 + u.y);
                    footprint(&world, spec, *limits, place / Vec2::new(columns as f32, rows as f32), sampler)
                })
                .collect();
            widths.sort_by(f32::total_cmp);
            widths.get(widths.len() / 2).copied()
        };
        let widths: Vec<Option<f32>> = (0..columns * rows).into_par_iter().map(tile).collect();
        let seen: Vec<f32> = widths.iter().flatten().copied().collect();
        if seen.is_empty() {
            return Self::fixed(fallback);
        }
        let median = median(&seen);
        let log = |w: &Option<f32>| (scale * w.unwrap_or(median).clamp(median / SPREAD, median * SPREAD)).ln();
        let log = widths.iter().map(log).collect();
        Self { columns: columns as usize, rows: rows as usize, log, typical: scale * median }.smoothed()
    }
    /// The same radius (world units, positive) in each of these tiles.
    pub fn levelled(mut self, radius: f32) -> Self {
        self.log.fill(radius.ln());
        Self { typical: radius, ..self }
    }
    /// These radii, or `others` of the same tiles where `take` says so of a tile's middle.
    pub fn or(mut self, others: &Self, take: impl Fn(Vec2) -> bool) -> Self {
        for (i, (middle, _)) in self.centres().into_iter().enumerate() {
            if take(middle) {
                self.log[i] = others.log[i];
            }
        }
        Self { typical: median(&self.log).exp(), ..self }
    }
    /// Every radius times `factor`.
    pub fn scaled(mut self, factor: f32) -> Self {
        self.log.iter_mut().for_each(|l| *l += factor.ln());
        self.typical *= factor;
        self
    }
    /// Middle and size of each tile, in raster coordinates.
    pub(super) fn centres(&self) -> Vec<(Vec2, Vec2)> {
        let size = Vec2::new(1.0 / self.columns as f32, 1.0 / self.rows as f32);
        let middle = |i: usize| Vec2::new((i % self.columns) as f32 + 0.5, (i / self.columns) as f32 + 0.5);
        (0..self.log.len()).map(|i| (middle(i) * size, size)).collect()
    }
    /// Each tile's radius times a factor, smooth from tile to tile.
    pub(super) fn times(self, factors: &[f32]) -> Self {
        let log = self.log.iter().zip(factors).map(|(l, f)| l + f.ln()).collect();
        Self { log, ..self }.smoothed()
    }
    /// Tiles.
    pub(super) fn len(&self) -> usize {
        self.log.len()
    }
    /// Tile `i` and its neighbours.
    pub(super) fn around(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        let near = |at: usize, end: usize| at.saturating_sub(1)..(at + 2).min(end);
        let (x, y, columns) = (i % self.columns, i / self.columns, self.columns);
        let rows = near(y, self.rows);
        rows.flat_map(move |y| near(x, columns).map(move |x| y * columns + x))
    }
    /// The tile that holds `raster`.
    pub fn tile(&self, raster: Vec2) -> usize {
        let at = |r: f32, n: usize| ((r * n as f32) as usize).min(n - 1);
        at(raster.y, self.rows) * self.columns + at(raster.x, self.columns)
    }
    /// Each tile takes the mean of itself and its neighbours: what a handful of paths say of one tile is noisy.
    fn smoothed(self) -> Self {
        let mean = |i: usize| {
            let (sum, n) = self.around(i).fold((0.0, 0.0), |(s, n), j| (s + self.log[j], n + 1.0));
            // A narrow one is so for a reason.
            self.log[i].min(sum / n)
        };
        let log: Vec<f32> = (0..self.log.len()).map(mean).collect();
        Self { typical: median(&log).exp(), log, ..self }
    }
    /// The first radius (world units) at `raster` (see [`crate::camera`]): smooth over the picture, held at its edges.
    #[inline]
    pub fn at(&self, raster: Vec2) -> f32 {
        if self.log.len() == 1 {
            return self.typical;
        }
        let (w, h) = (self.columns as f32, self.rows as f32);
        let p = (raster * Vec2::new(w, h) - 0.5).clamp(Vec2::ZERO, Vec2::new(w - 1.0, h - 1.0));
        let (x, y) = (p.x as usize, p.y as usize);
        let (x1, y1) = ((x + 1).min(self.columns - 1), (y + 1).min(self.rows - 1));
        let t = p.fract();
        let row = |y: usize| self.log[y * self.columns + x] * (1.0 - t.x) + self.log[y * self.columns + x1] * t.x;
        (row(y) * (1.0 - t.y) + row(y1) * t.y).exp()
    }
    /// A radius in the middle of those in use.
    pub fn typical(&self) -> f32 {
        self.typical
    }
    /// The radii of nearly all of the picture, for the index of its photons.
    pub fn span(&self) -> Span {
        let logs = Span::of(self.log.clone());
        Span { typical: self.typical, least: logs.least.exp(), most: logs.most.exp() }
    }
}

/// The value in the middle of `values`, of which there are some.
fn median(values: &[f32]) -> f32 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f32::total_cmp);
    sorted[sorted.len() / 2]
}

/// Width (world units) across the path of what a pixel covers around `raster`: from two twins of a camera path, one pixel
/// aside and one below, that make the same choices at mirrors and glass. That is a ray differential (Igehy 1999) by
/// finite differences; where the twins part ways, the distance along the path stands in.
fn footprint(world: &World, spec: FilmSpec, limits: Limits, raster: Vec2, mut sampler: Sampler) -> Option<f32> {
    let u_lens = sampler.next_2d();
    let follow = |raster: Vec2| Sight::find(world, limits, raster, u_lens, &mut sampler.clone());
    let seen = follow(raster)?;
    let (at, width) = (seen.at, seen.width(spec));
    let pixel = Vec2::new(1.0 / spec.width as f32, 1.0 / spec.height as f32);
    let aside = |offset: Vec2| -> Option<Vec3> {
        let twin = follow(raster + offset)?.at;
        (twin.ng.dot(at.ng) > 0.5).then(|| twin.p - at.p)
    };
    let area = aside(Vec2::new(pixel.x, 0.0)).zip(aside(Vec2::new(0.0, pixel.y))).map(|(x, y)| x.cross(y).length());
    let across = area.map_or(width, |a| (a * at.true_cos(at.wo)).sqrt());
    let width = across.clamp(width / LENS, width * LENS);
    (width > 0.0 && width.is_finite()).then_some(width)
}
