//! Photons beside an index of their positions.
use super::{Catch, Photon};
use accel::{KdTree, Neighbours, PointGrid};
use glam::Vec3;
use rayon::prelude::*;

/// Finds all photons within a radius.
pub struct RadiusMap<P = Photon> {
    grid: PointGrid,
    /// In the order of the grid's slots, so that neighbours in space are neighbours in memory.
    photons: Vec<P>,
}

/// Radii (world units, positive and finite) of queries, as an index of photons wants to know them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// In the middle.
    pub typical: f32,
    /// Hardly any is smaller: there, cells would hold too many photons.
    pub least: f32,
    /// None is larger: among cells that are far too narrow, a single query takes as long as a thousand.
    pub most: f32,
}

impl Span {
    /// The span of `radii`, of which there are some; all positive and finite.
    pub fn of(mut radii: Vec<f32>) -> Self {
        let last = radii.len() - 1;
        let few = (FEW * last as f32) as usize;
        let mut at = |i: usize| *radii.select_nth_unstable_by(i, f32::total_cmp).1;
        Self { typical: at(last.div_ceil(2)), least: at(few), most: at(last) }
    }
    /// One radius.
    pub fn only(radius: f32) -> Self {
        Self { typical: radius, least: radius, most: radius }
    }
    /// The typical radius alone where so many photons serve so few gathers that sorting them for several levels takes longer than
    /// these save, unless radii differ too much for one level.
    pub fn if_worth_it(self, photons: usize, gathers: usize) -> Self {
        let alike = self.most.max(self.typical * self.typical / self.least) <= ALIKE * self.typical;
        if alike && photons > PHOTONS_A_GATHER * gathers { Self::only(self.typical) } else { self }
    }
    /// Every radius times `factor`.
    pub fn scaled(self, factor: f32) -> Self {
        Self { typical: self.typical * factor, least: self.least * factor, most: self.most * factor }
    }
    /// Width of the finest cells, and levels of cells, each [`WIDER`] times as wide as the one before. One level is for the
    /// typical radius; there are more only for radii which that one suits badly, for they cost time where they do not save any.
    fn levels(self) -> (f32, usize) {
        let most = PointGrid::MOST_LEVELS as i32 - 1;
        let steps = |ratio: f32| (((ratio.ln() / WIDER.ln()) + SLACK).floor() as i32).clamp(0, most);
        let down = steps(self.typical / self.least);
        let up = steps(self.most / self.typical).min(most - down);
        (CELL * self.typical * WIDER.powi(-down), (down + up + 1) as usize)
    }
}

/// With one photon for each gather, levels saved 15 to 20 % of a pass whose radii differed by a factor of 256; with 30 and narrow
/// radii, they cost up to 32 %.
const PHOTONS_A_GATHER: usize = 4;
/// Radii that differ by no more than this from the typical one get along with its cells.
const ALIKE: f32 = 16.0;
/// Part of the radii that may be smaller than a [`Span`] says.
const FEW: f32 = 0.02;
/// Width of a cell over the radius of a query.
const CELL: f32 = 1.5;
/// From level to level.
const WIDER: f32 = 4.0;
/// Another level is worth it if radii differ by so much less than one from those of the last, in levels.
const SLACK: f32 = 0.5;

impl<P: Copy + Send + Sync> RadiusMap<P> {
    /// Sorts `photons` at `positions` for queries of about `radius` (world units, positive and finite); others work, but
    /// slower.
    pub fn new(positions: &[Vec3], photons: &[P], radius: f32) -> Self {
        Self::spanning(positions, photons, Span::only(radius))
    }
    /// The same for queries of about the radii of `span`.
    pub fn spanning(positions: &[Vec3], photons: &[P], span: Span) -> Self {
        let (finest, levels) = span.levels();
        let grid = PointGrid::build_levels(positions, finest, levels);
        let photons = grid.order().par_iter().map(|&i| photons[i as usize]).collect();
        Self { grid, photons }
    }
    /// Calls `visit(photon, d2)` for every photon at squared distance `d2 <= r·r` from `p`.
    #[inline]
    pub fn within(&self, p: Vec3, r: f32, mut visit: impl FnMut(&P, f32)) {
        self.grid.within_slots(p, r, |slot, d2| visit(&self.photons[slot as usize], d2));
    }
    /// Photons held.
    pub fn len(&self) -> usize {
        self.photons.len()
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.photons.is_empty()
    }
}

/// Photons asked for [`NearestMap::spacing`]: the median to about 5 %.
const SPACING_SAMPLES: usize = 256;

/// Finds the photons nearest to a place.
pub struct NearestMap {
    tree: KdTree,
    positions: Vec<Vec3>,
    photons: Vec<Photon>,
}

impl NearestMap {
    /// Indexes a catch.
    pub fn new(catch: Catch) -> Self {
        Self { tree: KdTree::build(&catch.positions), positions: catch.positions, photons: catch.photons }
    }
    /// Fills `out` with the up to `k` photons nearest to `p` among those within `r_max`, nearest first.
    #[inline]
    pub fn nearest(&self, p: Vec3, k: usize, r_max: f32, out: &mut Neighbours) {
        self.tree.nearest(p, k, r_max, out);
    }
    /// As [`NearestMap::nearest`], but only the farthest has its place, at the end; for sums over all of them.
    #[inline]
    pub fn nearest_unordered(&self, p: Vec3, k: usize, r_max: f32, out: &mut Neighbours) {
        self.tree.nearest_unordered(p, k, r_max, out);
    }
    /// The median distance from a photon to the `k`-th nearest (itself counted; to the farthest if there are fewer), over
    /// an even choice of photons. `None` without photons, or where most of them coincide.
    pub fn spacing(&self, k: usize) -> Option<f32> {
        let step = self.positions.len().div_ceil(SPACING_SAMPLES).max(1);
        let mut distances: Vec<f32> = self
            .positions
            .par_iter()
            .step_by(step)
            .map_init(Neighbours::new, |found, &p| {
                self.nearest(p, k, f32::MAX, found);
                found.farthest().map_or(0.0, |(_, d2)| d2.sqrt())
            })
            .collect();
        distances.sort_by(f32::total_cmp);
        distances.get(distances.len() / 2).copied().filter(|d| *d > 0.0)
    }
    /// The photon that an answer of [`NearestMap::nearest`] calls `index`.
    #[inline]
    pub fn photon(&self, index: u32) -> &Photon {
        &self.photons[index as usize]
    }
    /// Photons held.
    pub fn len(&self) -> usize {
        self.photons.len()
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.photons.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_radius_has_one_level_and_many_have_one_for_each_of_them() {
        assert_eq!(Span::only(2.0).levels(), (3.0, 1));
        let span = |least, most| Span { typical: 2.0, least, most }.levels();
        assert_eq!(span(1.1, 3.9), (3.0, 1));
        assert_eq!(span(0.9, 4.1), (0.75, 3));
        assert_eq!(span(2.0, 32.0), (3.0, 3));
        assert_eq!(span(2.0 / 64.0, 2.0), (3.0 / 64.0, 4));
        let (_, levels) = span(1e-9, 1e9);
        assert_eq!(levels, PointGrid::MOST_LEVELS);
    }

    #[test]
    fn many_photons_for_few_gathers_are_sorted_for_one_radius() {
        let span = Span { typical: 2.0, least: 0.13, most: 31.0 };
        assert_eq!(span.if_worth_it(1000, 250), span);
        assert_eq!(span.if_worth_it(1001, 250), Span::only(2.0));
        for unlike in [Span { least: 0.12, ..span }, Span { most: 33.0, ..span }] {
            assert_eq!(unlike.if_worth_it(1001, 250), unlike);
        }
    }

    #[test]
    fn a_span_leaves_out_the_few_that_are_small() {
        let radii = (0..1000).map(|i| match i % 100 {
            0 => 1e-6,
            1 => 1e6,
            i => i as f32,
        });
        assert_eq!(Span::of(radii.collect()), Span { typical: 51.0, least: 2.0, most: 1e6 });
        assert_eq!(Span::of(vec![7.0]), Span::only(7.0));
    }
}
