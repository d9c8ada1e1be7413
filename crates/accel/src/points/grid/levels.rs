//! Sorting points into cells of several sizes at once.
//!
//! The key of a point is its finest cell, written in digits of six bits, coarsest first: two of each coordinate. That is a
//! Morton order whose step is four, not two. The digits from level `l` up name a cell of that level, and all but the last of
//! these its brick; so both are runs of the sorted keys, whatever the level.

use glam::Vec3;
use rayon::prelude::*;

use super::brick::{Brick, Bricks, Lattice, brick_of, hash, upper};
use super::build::{CHUNK, PARTITION};
use super::{Level, PointGrid};
use crate::memory::large_zeroed;
use crate::points::lanes::{Isa, LANES};

/// Place and number of a point, as one number: 96 bits of place, above 32 bits of the point's place in the input.
type Key = u128;

const INDEX_BITS: u32 = u32::BITS;

/// Bits of a digit: which of 4x4x4 cells.
const DIGIT: u32 = 6;

/// Parts of a level's table that are filled independently of each other.
const PARTS: usize = 64;

/// Every third pair of bits, from the lowest up: 16 bits become eight digits of one coordinate.
fn part_pairs(bits: u16) -> u64 {
    let bits = u64::from(bits);
    let bits = (bits | bits << 16) & 0xFF00_00FF;
    let bits = (bits | bits << 8) & 0x00F0_0F00_F00F;
    (bits | bits << 4) & 0x0C30_C30C_30C3
}

fn key(cell: [i32; 3], index: u32) -> Key {
    let digits = |half: u32| {
        let [x, y, z] = cell.map(|c| part_pairs((c as u32 >> half) as u16));
        Key::from(x | y << 2 | z << 4)
    };
    (digits(16) << (8 * DIGIT) | digits(0)) << INDEX_BITS | Key::from(index)
}

pub(super) fn build(points: &[Vec3], finest: f32, levels: usize) -> PointGrid {
    let lattice = Lattice::new(finest);
    let mut keys: Vec<Key> = points
        .par_iter()
        .enumerate()
        .filter(|(_, p)| p.is_finite())
        .map(|(i, p)| key(lattice.cell(*p), i as u32))
        .collect();
    // No two are alike, so the outcome does not depend on threads.
    keys.par_sort_unstable();
    let mut coords = [(); 3].map(|()| large_zeroed(keys.len() + LANES));
    let mut order = large_zeroed(keys.len());
    let [x, y, z] = &mut coords;
    let places = order.par_iter_mut().zip(x).zip(y).zip(z).zip(&keys);
    places.for_each(|((((index, x), y), z), key)| {
        *index = *key as u32;
        [*x, *y, *z] = points[*index as usize].to_array();
    });
    let level = |l| Runs { keys: &keys, level: l, lattice: lattice.coarser(l), points }.level();
    PointGrid { levels: (0..levels).into_par_iter().map(level).collect(), coords, order, isa: Isa::detect() }
}

/// Sorted keys as runs of one level's bricks and cells.
struct Runs<'k> {
    keys: &'k [Key],
    level: usize,
    lattice: Lattice,
    points: &'k [Vec3],
}

/// The bricks of a stretch of keys by part of the table, with `first` counting within `starts`.
struct Piece {
    parts: Vec<Vec<Brick>>,
    starts: Vec<u32>,
}

impl Runs<'_> {
    /// What the keys of one cell have in common.
    fn cell(&self, key: Key) -> Key {
        key >> (INDEX_BITS + DIGIT * self.level as u32)
    }
    fn brick(&self, key: Key) -> Key {
        self.cell(key) >> DIGIT
    }

    fn level(&self) -> Level {
        let parts = self.keys.len().div_ceil(PARTITION).next_power_of_two().min(PARTS);
        let cuts: Vec<usize> = (0..=self.keys.len().div_ceil(CHUNK)).map(|i| self.cut(i * CHUNK)).collect();
        let pieces: Vec<Piece> = cuts.par_windows(2).map(|cut| self.piece(cut[0], cut[1], parts)).collect();
        let mut starts = Vec::with_capacity(pieces.iter().map(|p| p.starts.len()).sum::<usize>() + 1);
        let firsts: Vec<u32> = pieces
            .iter()
            .map(|piece| {
                let first = starts.len() as u32;
                starts.extend_from_slice(&piece.starts);
                first
            })
            .collect();
        starts.push(self.keys.len() as u32);
        let part = |i: usize| -> Vec<Brick> {
            let bricks = pieces.iter().zip(&firsts).flat_map(|(piece, &first)| {
                piece.parts[i].iter().map(move |brick| Brick { first: brick.first + first, ..*brick })
            });
            bricks.collect()
        };
        let bricks: Vec<Vec<Brick>> = (0..parts).into_par_iter().map(part).collect();
        Level { bricks: Bricks::new(self.lattice, &bricks), starts }
    }

    /// The first slot from `slot` on where a brick begins.
    fn cut(&self, slot: usize) -> usize {
        let (before, after) = self.keys.split_at(slot.min(self.keys.len()));
        let Some(&last) = before.last() else { return 0 };
        before.len() + after.partition_point(|&key| self.brick(key) == self.brick(last))
    }

    fn piece(&self, from: usize, to: usize, parts: usize) -> Piece {
        let mut piece = Piece { parts: vec![Vec::new(); parts], starts: Vec::new() };
        let mut offset = 0;
        for keys in self.keys[from..to].chunk_by(|a, b| self.brick(*a) == self.brick(*b)) {
            let at = brick_of(self.lattice.cell(self.points[keys[0] as u32 as usize]));
            let (first, mut cells) = (piece.starts.len() as u32, 0);
            let mut slot = from + offset;
            for keys in keys.chunk_by(|a, b| self.cell(*a) == self.cell(*b)) {
                cells |= 1 << (self.cell(keys[0]) & 63);
                piece.starts.push(slot as u32);
                slot += keys.len();
            }
            offset += keys.len();
            piece.parts[upper(hash(at), parts)].push(Brick { at, first, cells });
        }
        piece
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_of_a_key_are_those_of_its_cell_coarsest_first() {
        for cell in [[0, 0, 0], [1, 2, 3], [-1, 7, i32::MIN], [i32::MAX, 0x1234_5678, -0x0765_4321]] {
            let key = key(cell, 77);
            assert_eq!(key as u32, 77);
            for level in 0..16 {
                let [x, y, z] = cell.map(|c| Key::from((c as u32 >> (2 * level)) & 3));
                let digit = key >> (INDEX_BITS + DIGIT * level) & 63;
                assert_eq!(digit, x + 4 * y + 16 * z, "{cell:?}, level {level}");
            }
        }
    }
}
