//! Sorting points into bricks and cells.
//!
//! Two rounds, both parallel and both free of races by shape: chunks of the input are sorted by partition (the upper
//! bits of the brick's hash), then each partition gathers its pieces from all chunks and sorts them by brick and cell
//! into its own stretch of the output. Every count depends on the points alone, so the result does not depend on the
//! number of threads. Within a cell, points keep the order of the input.

use glam::Vec3;
use rayon::prelude::*;

use super::brick::{At, Brick, Bricks, Lattice, bit_of, brick_of, hash, upper};
use super::{Level, PointGrid};
use crate::memory::large_zeroed;
use crate::points::lanes::{Isa, LANES};

/// Points per chunk of the input.
pub(super) const CHUNK: usize = 1 << 15;

/// Points that a partition holds on average, at most: few enough to sort within a core's own cache.
pub(super) const PARTITION: usize = 1 << 12;

/// A point and its place in the input.
#[derive(Clone, Copy, Default)]
struct Item {
    p: Vec3,
    index: u32,
}

/// A chunk of the input sorted by partition; partition `i` lies at `starts[i]..starts[i + 1]`.
struct Chunk {
    items: Vec<Item>,
    starts: Vec<u32>,
}

/// The stretch of the output that belongs to one partition.
struct Stretch<'a> {
    first_slot: u32,
    coords: [&'a mut [f32]; 3],
    order: &'a mut [u32],
}

/// The bricks of one partition. Their `first` counts within `starts`.
struct Sorted {
    bricks: Vec<Brick>,
    starts: Vec<u32>,
}

pub(super) fn build(points: &[Vec3], cell: f32) -> PointGrid {
    let lattice = Lattice::new(cell);
    let partitions = points.len().div_ceil(PARTITION).next_power_of_two().min(1 << 14);
    let chunks: Vec<Chunk> = points
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(i, points)| Chunk::new(points, i * CHUNK, lattice, partitions))
        .collect();
    let count = chunks.iter().map(|chunk| chunk.items.len()).sum();
    let mut coords = [(); 3].map(|()| large_zeroed(count + LANES));
    let mut order = large_zeroed(count);
    let sorted: Vec<Sorted> = stretches(&chunks, partitions, &mut coords, &mut order)
        .into_par_iter()
        .enumerate()
        .map(|(i, stretch)| {
            let items = chunks.iter().flat_map(|chunk| chunk.partition(i)).copied().collect::<Vec<_>>();
            sort(&items, lattice, stretch)
        })
        .collect();
    let (bricks, starts) = join(sorted, count);
    let level = Level { bricks: Bricks::new(lattice, &bricks), starts };
    PointGrid { levels: vec![level], coords, order, isa: Isa::detect() }
}

impl Chunk {
    fn new(points: &[Vec3], first: usize, lattice: Lattice, partitions: usize) -> Self {
        let partition = |p: &Vec3| upper(hash(brick_of(lattice.cell(*p))), partitions);
        // The last key is for points that are not finite; they are cut off below.
        let keys: Vec<u32> =
            points.iter().map(|p| if p.is_finite() { partition(p) } else { partitions } as u32).collect();
        let mut starts = vec![0; partitions + 2];
        for &key in &keys {
            starts[key as usize + 1] += 1;
        }
        prefix_sum(&mut starts);
        let mut next = starts.clone();
        let mut items = vec![Item::default(); points.len()];
        for (i, (&key, &p)) in keys.iter().zip(points).enumerate() {
            let slot = &mut next[key as usize];
            items[*slot as usize] = Item { p, index: (first + i) as u32 };
            *slot += 1;
        }
        items.truncate(starts[partitions] as usize);
        Self { items, starts }
    }

    fn partition(&self, i: usize) -> &[Item] {
        &self.items[self.starts[i] as usize..self.starts[i + 1] as usize]
    }
}

fn prefix_sum(counts: &mut [u32]) {
    let mut sum = 0;
    for count in counts {
        sum += *count;
        *count = sum;
    }
}

/// Cuts the output into one stretch per partition.
fn stretches<'a>(
    chunks: &[Chunk],
    partitions: usize,
    coords: &'a mut [Vec<f32>; 3],
    order: &'a mut [u32],
) -> Vec<Stretch<'a>> {
    let mut coords = coords.each_mut().map(Vec::as_mut_slice);
    let mut order = order;
    let mut first_slot = 0;
    let mut stretches = Vec::with_capacity(partitions);
    for i in 0..partitions {
        let len = chunks.iter().map(|chunk| chunk.partition(i).len()).sum();
        stretches.push(Stretch {
            first_slot,
            coords: coords.each_mut().map(|rest| rest.split_off_mut(..len).expect("room for every point")),
            order: order.split_off_mut(..len).expect("room for every point"),
        });
        first_slot += len as u32;
    }
    stretches
}

/// Numbers the bricks of one partition as they come; `places` is an open-addressing table of number plus one.
struct Numbering {
    places: Vec<u32>,
    at: Vec<At>,
}

impl Numbering {
    fn new(items: usize) -> Self {
        Self { places: vec![0; (2 * items).next_power_of_two()], at: Vec::new() }
    }

    #[inline]
    fn number(&mut self, at: At) -> u32 {
        // The upper bits are alike within a partition.
        let mask = self.places.len() - 1;
        let mut i = hash(at) as usize & mask;
        loop {
            match self.places[i] {
                0 => {
                    self.at.push(at);
                    self.places[i] = self.at.len() as u32;
                    return self.places[i] - 1;
                }
                n if self.at[n as usize - 1] == at => return n - 1,
                _ => i = (i + 1) & mask,
            }
        }
    }
}

/// Sorts the points of one partition by brick and cell into `out`.
fn sort(items: &[Item], lattice: Lattice, out: Stretch) -> Sorted {
    let mut numbering = Numbering::new(items.len());
    let mut next: Vec<u32> = Vec::new();
    let cell_numbers: Vec<u32> = items
        .iter()
        .map(|item| {
            let cell = lattice.cell(item.p);
            let number = numbering.number(brick_of(cell)) * 64 + bit_of(cell);
            next.resize(numbering.at.len() * 64, 0);
            next[number as usize] += 1;
            number
        })
        .collect();
    let (mut slot, mut bricks, mut starts) = (0, Vec::with_capacity(numbering.at.len()), Vec::new());
    for (&at, counts) in numbering.at.iter().zip(next.chunks_exact_mut(64)) {
        let first = starts.len() as u32;
        let mut cells = 0;
        for (bit, count) in counts.iter_mut().enumerate().filter(|(_, count)| **count > 0) {
            cells |= 1 << bit;
            starts.push(out.first_slot + slot);
            slot += std::mem::replace(count, slot);
        }
        bricks.push(Brick { at, first, cells });
    }
    let [x, y, z] = out.coords;
    for (item, &number) in items.iter().zip(&cell_numbers) {
        let slot = &mut next[number as usize];
        let i = *slot as usize;
        (x[i], y[i], z[i], out.order[i]) = (item.p.x, item.p.y, item.p.z, item.index);
        *slot += 1;
    }
    Sorted { bricks, starts }
}

/// Joins the partitions: the bricks of each, with `first` counting in the joint list of starts.
fn join(sorted: Vec<Sorted>, count: usize) -> (Vec<Vec<Brick>>, Vec<u32>) {
    let mut starts = Vec::with_capacity(sorted.iter().map(|s| s.starts.len()).sum::<usize>() + 1);
    let groups = sorted
        .into_iter()
        .map(|mut part| {
            for brick in &mut part.bricks {
                brick.first += starts.len() as u32;
            }
            starts.extend_from_slice(&part.starts);
            part.bricks
        })
        .collect();
    starts.push(count as u32);
    (groups, starts)
}
