//! Bricks of 4x4x4 cells, and the hash table of those that hold points.

use glam::Vec3;
use rayon::prelude::*;

/// From world units to cells and bricks. Cells are anchored at the world's origin, where floats are finest.
#[derive(Clone, Copy)]
pub(super) struct Lattice {
    /// Finest cells per world unit.
    per_unit: f32,
    /// A cell is as wide as 2 to this power of the finest ones.
    shift: u32,
}

/// Integer coordinates of a brick.
pub(super) type At = [i32; 3];

impl Lattice {
    pub(super) fn new(cell: f32) -> Self {
        Self { per_unit: cell.recip().min(f32::MAX), shift: 0 }
    }

    /// The same space in cells that are the bricks of the level before, `level` times over.
    pub(super) fn coarser(self, level: usize) -> Self {
        Self { shift: self.shift + 2 * level as u32, ..self }
    }

    /// Width of a cell in finest cells.
    #[inline(always)]
    pub(super) fn width(self) -> f32 {
        (1_u32 << self.shift) as f32
    }

    /// `length` (world units) in finest cells.
    #[inline(always)]
    pub(super) fn in_finest(self, length: f32) -> f32 {
        length * self.per_unit
    }

    /// `p` and `length` (world units) in cells, the former within the range of whole coordinates.
    #[inline(always)]
    pub(super) fn in_cells(self, p: Vec3, length: f32) -> (Vec3, f32) {
        let end = Vec3::splat(i32::MAX as f32);
        let per_cell = self.width().recip();
        ((p * self.per_unit).clamp(-end, end) * per_cell, length * self.per_unit * per_cell)
    }

    /// The cell of `p`. Each coordinate is monotone in `p`'s, also where it saturates at the ends of the range.
    #[inline(always)]
    pub(super) fn cell(self, p: Vec3) -> [i32; 3] {
        (p * self.per_unit).to_array().map(|v| {
            let toward_zero = v as i32;
            toward_zero.saturating_sub(i32::from(toward_zero as f32 > v)) >> self.shift
        })
    }
}

/// The brick of a cell.
#[inline(always)]
pub(super) fn brick_of(cell: [i32; 3]) -> At {
    cell.map(|c| c >> 2)
}

/// The bit of a cell in its brick's `cells`.
#[inline(always)]
pub(super) fn bit_of(cell: [i32; 3]) -> u32 {
    let [x, y, z] = cell.map(|c| (c & 3) as u32);
    x + 4 * y + 16 * z
}

/// 32 well-mixed bits; tables and partitions use the upper ones.
#[inline(always)]
pub(super) fn hash(at: At) -> u32 {
    let [x, y, z] = at.map(|c| u64::from(c as u32));
    // Odd constants: fractional parts of the golden ratio and of the square roots of 2, 3 and 5.
    let mixed = x.wrapping_mul(0x9E37_79B9_7F4A_7C15)
        ^ y.wrapping_mul(0x6A09_E667_F3BC_C909).rotate_left(21)
        ^ z.wrapping_mul(0xBB67_AE85_84CA_A73B).rotate_left(42);
    ((mixed ^ (mixed >> 32)).wrapping_mul(0x3C6E_F372_FE94_F82B) >> 32) as u32
}

/// The upper bits of `hash` as a number below `count`, a power of two.
#[inline(always)]
pub(super) fn upper(hash: u32, count: usize) -> usize {
    ((u64::from(hash) * count as u64) >> 32) as usize
}

/// One brick.
#[derive(Clone, Copy, Default)]
pub(super) struct Brick {
    pub(super) at: At,
    /// Where its cells begin in the grid's `starts`.
    pub(super) first: u32,
    /// One bit per occupied cell; 0 marks an empty place of the table.
    pub(super) cells: u64,
}

/// An open-addressing table of bricks, in parts that are filled independently of each other.
pub(super) struct Bricks {
    lattice: Lattice,
    places: Vec<Brick>,
    /// Places per part, less one; parts are a power of two long.
    part_mask: usize,
}

impl Bricks {
    /// Fills a table from bricks grouped by part: group `g` of `n` holds those with `upper(hash, n) == g`.
    pub(super) fn new(lattice: Lattice, groups: &[Vec<Brick>]) -> Self {
        let most = groups.iter().map(Vec::len).max().unwrap_or(0);
        let part = (2 * most).next_power_of_two();
        let mut places = vec![Brick::default(); part * groups.len()];
        let count = places.len();
        places.par_chunks_mut(part).zip(groups).for_each(|(places, bricks)| {
            for brick in bricks {
                let mut i = upper(hash(brick.at), count) & (part - 1);
                while places[i].cells != 0 {
                    i = (i + 1) & (part - 1);
                }
                places[i] = *brick;
            }
        });
        Self { lattice, places, part_mask: part - 1 }
    }

    /// How space is cut.
    #[inline(always)]
    pub(super) fn lattice(&self) -> Lattice {
        self.lattice
    }

    /// The brick at these coordinates, if it holds points.
    #[inline(always)]
    pub(super) fn find(&self, at: At) -> Option<&Brick> {
        let mut i = upper(hash(at), self.places.len());
        loop {
            let brick = &self.places[i];
            if brick.cells == 0 {
                return None;
            }
            if brick.at == at {
                return Some(brick);
            }
            i = (i & !self.part_mask) | ((i + 1) & self.part_mask);
        }
    }

    /// Bricks that hold points, among them all that touch the box from `min` to `max`.
    #[inline(always)]
    pub(super) fn touched(&self, min: Vec3, max: Vec3) -> Touched<'_> {
        let (lo, hi) = (brick_of(self.lattice.cell(min)), brick_of(self.lattice.cell(max)));
        let count: f32 = (0..3).map(|a| hi[a] as f32 - lo[a] as f32 + 1.0).product();
        Touched { bricks: self, lo, hi, at: lo, all: (count > self.places.len() as f32).then(|| self.places.iter()) }
    }

    /// Heap memory held, in bytes.
    pub(super) fn memory_bytes(&self) -> usize {
        size_of_val(self.places.as_slice())
    }
}

/// See [`Bricks::touched`].
pub(super) struct Touched<'b> {
    bricks: &'b Bricks,
    lo: At,
    hi: At,
    /// The next to look up.
    at: At,
    /// Set where it is cheaper to go through all places than to look up each brick.
    all: Option<std::slice::Iter<'b, Brick>>,
}

impl<'b> Iterator for Touched<'b> {
    type Item = &'b Brick;

    #[inline(always)]
    fn next(&mut self) -> Option<&'b Brick> {
        if let Some(all) = &mut self.all {
            return all.find(|brick| brick.cells != 0);
        }
        while self.at[2] <= self.hi[2] {
            let at = self.at;
            self.at[0] += 1;
            for axis in [0, 1] {
                if self.at[axis] > self.hi[axis] {
                    self.at[axis] = self.lo[axis];
                    self.at[axis + 1] += 1;
                }
            }
            if let Some(brick) = self.bricks.find(at) {
                return Some(brick);
            }
        }
        None
    }
}
