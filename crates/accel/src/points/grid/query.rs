//! One query of a fixed radius, in three steps that each keep the processor busy: find the runs of slots that the sphere may
//! touch, and ask for their memory; test their points sixteen at a time, and pack those found; visit these.

use glam::Vec3;

use super::brick::{Brick, Touched};
use super::{Level, PointGrid};
use crate::points::lanes::{LANES, Lanes, Near, Task};

/// A relative margin far above the rounding of a few f32 operations, far below what would cost time.
const MARGIN: f32 = 1e-6;

/// Runs of slots noted before their points are tested: at least what one brick may have, every other of its cells.
const RUNS: usize = 64;
const OF_BRICK: usize = 32;

/// Points found before they are visited.
const FOUND: usize = 64;

/// A sphere, in world units and in cells.
#[derive(Clone, Copy)]
struct Sphere<'g> {
    grid: &'g PointGrid,
    level: &'g Level,
    p: Vec3,
    /// The squared radius that points are held against.
    r2: f32,
    /// No point farther than this along an axis can pass the test, rounding and underflow included.
    reach: f32,
    /// `p` in cells, within the range of `i32`.
    center: Vec3,
    /// `center` may be off by this many cells.
    slack: f32,
    /// The squared reach in cells.
    reach2: f32,
}

/// A sphere, and what to do with the slots and squared distances of points in it, some at a time.
pub(super) struct Query<'g, F> {
    sphere: Sphere<'g>,
    visit: F,
}

impl<'g, F: FnMut(&[u32], &[f32])> Query<'g, F> {
    #[inline(always)]
    pub(super) fn new(grid: &'g PointGrid, level: &'g Level, p: Vec3, r: f32, visit: F) -> Self {
        let r2 = r * r;
        // Squares of distances below 1e-22 underflow, squares of those above 1e19 overflow.
        let reach = if r2.is_finite() { r + r * MARGIN + 1e-22 } else { f32::INFINITY };
        let (center, cells) = level.bricks.lattice().in_cells(p, reach);
        // Whole numbers above 2^24 round as well, hence all that is as large as a cell's coordinate counts.
        let slack = (center.abs().max_element() + cells + 8.0) * MARGIN;
        let reach2 = cells * cells * (1.0 + 4.0 * MARGIN);
        Self { sphere: Sphere { grid, level, p, r2, reach, center, slack, reach2 }, visit }
    }
}

impl Sphere<'_> {
    /// Squared distance in cells to the four layers of cells of brick coordinate `at` along `axis`; never too large.
    #[inline(always)]
    fn layers(&self, axis: usize, at: i32) -> [f32; 4] {
        let to_brick = at as f32 * 4.0 - self.center[axis];
        [0.0, 1.0, 2.0, 3.0].map(|layer| {
            let below = to_brick + layer;
            let d = (below - self.slack).max(-1.0 - below - self.slack).max(0.0);
            d * d
        })
    }
}

/// A query under way.
struct Search<'g, F> {
    sphere: Sphere<'g>,
    /// Runs of slots to test, each by its first slot and the one behind its last.
    runs: [(u32, u32); RUNS],
    run_count: usize,
    /// Slots of points to visit, and room for as many as one step may add.
    slots: [u32; FOUND + LANES],
    d2: [f32; FOUND + LANES],
    found: usize,
    visit: F,
}

impl<F: FnMut(&[u32], &[f32])> Search<'_, F> {
    /// Notes cells of the bricks that come, until none comes or there is no room; true in the latter case.
    #[inline(always)]
    fn note<L: Lanes>(&mut self, lanes: L, bricks: &mut Touched) -> bool {
        while self.run_count <= RUNS - OF_BRICK {
            let Some(brick) = bricks.next() else { return false };
            self.note_brick(lanes, brick);
        }
        true
    }

    /// Notes those cells of `brick` that the sphere may touch.
    #[inline(always)]
    fn note_brick<L: Lanes>(&mut self, lanes: L, brick: &Brick) {
        let Sphere { grid, level, reach2, .. } = self.sphere;
        let near = lanes.cells(&[0, 1, 2].map(|axis| self.sphere.layers(axis, brick.at[axis])), reach2);
        let mut rest = brick.cells & near;
        while rest != 0 {
            let from = rest & rest.wrapping_neg();
            // The run of slots ends at the next occupied cell that is not near.
            let stop = brick.cells & !near & from.wrapping_neg();
            let below_stop = (stop & stop.wrapping_neg()).wrapping_sub(1);
            let first = brick.first + (brick.cells & (from - 1)).count_ones();
            let end = first + (rest & below_stop).count_ones();
            let (start, end) = (level.starts[first as usize], level.starts[end as usize]);
            for c in &grid.coords {
                lanes.prefetch(&raw const c[start as usize]);
            }
            self.runs[self.run_count] = (start, end);
            self.run_count += 1;
            rest &= !below_stop;
        }
    }

    /// Finds those points of the noted slots that are within the radius.
    #[inline(always)]
    fn test<L: Lanes>(&mut self, lanes: L) {
        let Sphere { grid, p, r2, .. } = self.sphere;
        for &(start, end) in &self.runs[..self.run_count] {
            let mut slot = start;
            while slot < end {
                if self.found > FOUND {
                    visit_all(&self.slots, &self.d2, &mut self.found, &mut self.visit);
                }
                let at = grid.coords.each_ref().map(|c| c[slot as usize..].first_chunk::<LANES>().expect("padding"));
                let numbers = self.slots[self.found..].first_chunk_mut().expect("room");
                let d2 = self.d2[self.found..].first_chunk_mut().expect("room");
                let valid = u32::MAX >> (31 - (end - slot - 1).min(31));
                self.found += lanes.near(at, p, r2, valid, slot, Near { numbers, d2 });
                slot = slot.saturating_add(LANES as u32);
            }
        }
        self.run_count = 0;
    }
}

/// Visits what was found, and forgets it.
#[inline(always)]
fn visit_all(slots: &[u32], d2: &[f32], found: &mut usize, visit: &mut impl FnMut(&[u32], &[f32])) {
    visit(&slots[..*found], &d2[..*found]);
    *found = 0;
}

impl<F: FnMut(&[u32], &[f32])> Task for Query<'_, F> {
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let Self { sphere, visit } = self;
        let mut search = Search {
            sphere,
            runs: [(0, 0); RUNS],
            run_count: 0,
            slots: [0; FOUND + LANES],
            d2: [0.0; FOUND + LANES],
            found: 0,
            visit,
        };
        let mut bricks = sphere.level.bricks.touched(sphere.p - sphere.reach, sphere.p + sphere.reach);
        while search.note(lanes, &mut bricks) {
            search.test(lanes);
        }
        search.test(lanes);
        visit_all(&search.slots, &search.d2, &mut search.found, &mut search.visit);
    }
}
