//! All points within a radius: a sparse grid of bricks.
//!
//! Space is cut into cells, and 4x4x4 cells make a brick. Only bricks that hold points exist. They sit in a hash table
//! together with their coordinates, so that two bricks of one hash never mix, and each carries one bit per occupied
//! cell. Points are sorted by brick, then by cell: a run of cells is a run of slots. A query looks up the few bricks
//! that its sphere may touch, finds which of their cells it touches by one vector comparison, and tests the runs of
//! points in those cells sixteen at a time.
//!
//! A query of radius `r` is fastest with cells of about `r` to `1.5 r`, and right with any. Where radii differ much, a grid
//! may have several levels: the bricks of one are the cells of the next. All share one order of the points, in which
//! those of a cell, of whatever level, lie side by side; so a further level costs no more than a table of its bricks.

mod brick;
mod build;
mod levels;
mod query;

use glam::Vec3;

use super::lanes::Isa;
use brick::Bricks;
use query::Query;

/// Cells of one size.
struct Level {
    bricks: Bricks,
    /// First slot of each occupied cell, bricks and cells in the order of slots; then the number of points.
    starts: Vec<u32>,
}

/// A query takes the finest level whose cells are not so many times smaller than its radius: from one level to the next that is
/// cells of 0.75 to 3 radii, the middle of which is 1.5.
const FINE: f32 = 4.0 / 3.0;

/// Points sorted by grid cell, for queries of a fixed radius, or of radii that differ. Immutable once built.
pub struct PointGrid {
    /// Finest first; each has cells four times as wide as the one before. At least one.
    levels: Vec<Level>,
    /// The coordinates by slot, and padding so that sixteen values can be read from any slot.
    coords: [Vec<f32>; 3],
    order: Vec<u32>,
    isa: Isa,
}

impl PointGrid {
    /// Sorts `points` into cells of edge `cell` (world units). Points that are not finite are left out.
    ///
    /// # Panics
    /// If `cell` is not positive and finite, or if there are more than `u32::MAX` points.
    pub fn build(points: &[Vec3], cell: f32) -> Self {
        assert!(cell > 0.0 && cell.is_finite(), "a cell has a positive, finite edge, not {cell}");
        assert!(u32::try_from(points.len()).is_ok(), "more than u32::MAX points");
        build::build(points, cell)
    }

    /// As [`Self::build`] with the finest of `levels` levels of cells, each four times as wide as those before: for queries whose
    /// radii differ. It takes longer than one level does, and so do queries, if slightly, for points of neighbouring cells lie
    /// farther apart.
    ///
    /// # Panics
    /// As [`Self::build`], and if `levels` is not 1 to [`Self::MOST_LEVELS`].
    pub fn build_levels(points: &[Vec3], finest: f32, levels: usize) -> Self {
        assert!((1..=Self::MOST_LEVELS).contains(&levels), "a grid has 1 to 8 levels, not {levels}");
        if levels == 1 {
            return Self::build(points, finest);
        }
        assert!(finest > 0.0 && finest.is_finite(), "a cell has a positive, finite edge, not {finest}");
        assert!(u32::try_from(points.len()).is_ok(), "more than u32::MAX points");
        levels::build(points, finest, levels)
    }

    /// Levels that a grid may have: cells that differ by a factor of 16,384.
    pub const MOST_LEVELS: usize = 8;

    /// Calls `visit(index, d2)` once for each point with squared distance `d2 <= r * r` from `p`, in an order that
    /// depends only on the points, the cells, `p` and `r`. `index` counts in the slice given to `build`. A negative or
    /// NaN `r`, or a `p` that is not finite, finds nothing.
    #[inline]
    pub fn within(&self, p: Vec3, r: f32, mut visit: impl FnMut(u32, f32)) {
        self.within_slots(p, r, |slot, d2| visit(self.order[slot as usize], d2));
    }

    /// As [`Self::within`], but passes the slot, which is the point's place in [`Self::order`].
    #[inline]
    pub fn within_slots(&self, p: Vec3, r: f32, mut visit: impl FnMut(u32, f32)) {
        if p.is_finite() && r >= 0.0 {
            // One short loop over what was found, which the compiler sees as a whole.
            let visit_all = |slots: &[u32], d2: &[f32]| slots.iter().zip(d2).for_each(|(&slot, &d2)| visit(slot, d2));
            self.isa.run(Query::new(self, self.level(r), p, r, visit_all));
        }
    }

    /// The level whose cells suit queries of radius `r` best.
    #[inline]
    fn level(&self, r: f32) -> &Level {
        let (last, others) = self.levels.split_last().expect("a level");
        let suits = |level: &&Level| {
            let lattice = level.bricks.lattice();
            lattice.in_finest(r) <= FINE * lattice.width()
        };
        others.iter().find(suits).unwrap_or(last)
    }

    /// For each slot, the index of its point in the slice given to `build`. A caller that stores its payload in this
    /// order reads it nearly in sequence from [`Self::within_slots`].
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The number of points kept, which is the number of finite ones.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Whether no point was kept.
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// Heap memory held, in bytes.
    pub fn memory_bytes(&self) -> usize {
        let coords: usize = self.coords.iter().map(|c| size_of_val(c.as_slice())).sum();
        coords + size_of_val(self.order()) + self.levels.iter().map(Level::memory_bytes).sum::<usize>()
    }
}

impl Level {
    fn memory_bytes(&self) -> usize {
        size_of_val(self.starts.as_slice()) + self.bricks.memory_bytes()
    }
}
