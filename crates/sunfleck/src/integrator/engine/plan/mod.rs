//! Which part of the picture is left to which samplers: decided before the first pass, then kept.
//!
//! Neighbours: [`trial`] tries candidates on a small picture, [`choose`] weighs what they leave of noise and blur against what
//! they cost.
mod choose;
mod trial;

use super::techniques::Merge;
use crate::film::FilmSpec;
use glam::Vec2;

/// What is merged in each tile of the picture. Camera paths of different tiles share nothing but photons, so each tile's
/// estimate is right by itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Plan {
    columns: usize,
    rows: usize,
    tiles: Vec<Merge>,
}

/// Tiles along the picture's longer side, at most, and pixels along a tile's edge, at least.
const TILES: u32 = 32;
const EDGE: u32 = 8;

impl Plan {
    /// The same everywhere.
    fn everywhere(spec: FilmSpec, merge: Merge) -> Self {
        let tile = (spec.width.max(spec.height).div_ceil(TILES)).max(EDGE);
        let (columns, rows) = (spec.width.div_ceil(tile) as usize, spec.height.div_ceil(tile) as usize);
        Self { columns, rows, tiles: vec![merge; columns * rows] }
    }
    /// What is merged at `raster` (see [`crate::camera`]).
    #[inline]
    pub(super) fn at(&self, raster: Vec2) -> Merge {
        self.tiles[self.index(raster)]
    }
    /// The tile that holds `raster`.
    #[inline]
    fn index(&self, raster: Vec2) -> usize {
        let x = ((raster.x * self.columns as f32) as usize).min(self.columns - 1);
        let y = ((raster.y * self.rows as f32) as usize).min(self.rows - 1);
        y * self.columns + x
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
    /// Corner and size of tile `i`, in raster coordinates.
    fn area(&self, i: usize) -> (Vec2, Vec2) {
        let size = Vec2::new(1.0 / self.columns as f32, 1.0 / self.rows as f32);
        (Vec2::new((i % self.columns) as f32, (i / self.columns) as f32) * size, size)
    }
    /// Tile `i` and its neighbours.
    fn near(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        let near = |at: usize, end: usize| at.saturating_sub(1)..(at + 2).min(end);
        let (x, y, columns) = (i % self.columns, i / self.columns, self.columns);
        let rows = near(y, self.rows);
        rows.flat_map(move |y| near(x, columns).map(move |x| y * columns + x))
    }
    /// Sum over tile `i` and its neighbours.
    fn around_sum(&self, i: usize, value: impl Fn(usize) -> f64) -> f64 {
        self.near(i).map(value).sum()
    }
    /// Mean over tile `i` and its neighbours.
    fn around(&self, i: usize, value: impl Fn(usize) -> f64) -> f64 {
        self.around_sum(i, value) / self.near(i).count() as f64
    }
}
