//! One query of a fixed radius.

use glam::Vec3;

use super::PointGrid;
use super::brick::{At, Brick, brick_of};
use crate::points::lanes::{LANES, Lanes, Task};

/// A relative margin far above the rounding of a few f32 operations, far below what would cost time.
const MARGIN: f32 = 1e-6;

/// A sphere, and what to do with each point in it.
pub(super) struct Query<'g, F> {
    grid: &'g PointGrid,
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
    visit: F,
}

impl<'g, F: FnMut(u32, f32)> Query<'g, F> {
    #[inline(always)]
    pub(super) fn new(grid: &'g PointGrid, p: Vec3, r: f32, visit: F) -> Self {
        let r2 = r * r;
        // Squares of distances below 1e-22 underflow, squares of those above 1e19 overflow.
        let reach = if r2.is_finite() { r + r * MARGIN + 1e-22 } else { f32::INFINITY };
        let per_unit = grid.bricks.lattice().per_unit;
        let end = i32::MAX as f32;
        let center = (p * per_unit).clamp(Vec3::splat(-end), Vec3::splat(end));
        let cells = reach * per_unit;
        // Whole numbers above 2^24 round as well, hence all that is as large as a cell's coordinate counts.
        let slack = (center.abs().max_element() + cells + 8.0) * MARGIN;
        let reach2 = cells * cells * (1.0 + 4.0 * MARGIN);
        Self { grid, p, r2, reach, center, slack, reach2, visit }
    }

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

    /// Visits those points of `brick` that are within the radius.
    #[inline(always)]
    fn brick<L: Lanes>(&mut self, lanes: L, brick: &Brick, layers: &[[f32; 4]; 3]) {
        let near = lanes.cells(layers, self.reach2);
        let mut rest = brick.cells & near;
        while rest != 0 {
            let from = rest & rest.wrapping_neg();
            // The run of slots ends at the next occupied cell that is not near.
            let stop = brick.cells & !near & from.wrapping_neg();
            let below_stop = (stop & stop.wrapping_neg()).wrapping_sub(1);
            let first = brick.first + (brick.cells & (from - 1)).count_ones();
            let end = first + (rest & below_stop).count_ones();
            self.slots(lanes, self.grid.starts[first as usize], self.grid.starts[end as usize]);
            rest &= !below_stop;
        }
    }

    /// Visits those points of the slots `start..end` that are within the radius.
    #[inline(always)]
    fn slots<L: Lanes>(&mut self, lanes: L, start: u32, end: u32) {
        let mut slot = start;
        while slot < end {
            let at = self.grid.coords.each_ref().map(|c| c[slot as usize..].first_chunk::<LANES>().expect("padding"));
            let mut d2 = [0.0; LANES];
            let near = lanes.points(at, self.p, self.r2, &mut d2);
            let mut near = near & (u32::MAX >> (31 - (end - slot - 1).min(31)));
            while near != 0 {
                let i = near.trailing_zeros();
                (self.visit)(slot + i, d2[i as usize]);
                near &= near - 1;
            }
            slot = slot.saturating_add(LANES as u32);
        }
    }

    #[inline(always)]
    fn look_up<L: Lanes>(&mut self, lanes: L, lo: At, hi: At) {
        for z in lo[2]..=hi[2] {
            let z2 = self.layers(2, z);
            for y in lo[1]..=hi[1] {
                let y2 = self.layers(1, y);
                for x in lo[0]..=hi[0] {
                    if let Some(brick) = self.grid.bricks.find([x, y, z]) {
                        self.brick(lanes, brick, &[self.layers(0, x), y2, z2]);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn all<L: Lanes>(&mut self, lanes: L) {
        for brick in self.grid.bricks.iter() {
            let layers = [0, 1, 2].map(|axis| self.layers(axis, brick.at[axis]));
            self.brick(lanes, brick, &layers);
        }
    }
}

impl<F: FnMut(u32, f32)> Task for Query<'_, F> {
    #[inline(always)]
    fn run<L: Lanes>(mut self, lanes: L) {
        let lattice = self.grid.bricks.lattice();
        let lo = brick_of(lattice.cell(self.p - self.reach));
        let hi = brick_of(lattice.cell(self.p + self.reach));
        let touched: f32 = (0..3).map(|a| hi[a] as f32 - lo[a] as f32 + 1.0).product();
        if touched > self.grid.bricks.places() as f32 {
            self.all(lanes);
        } else {
            self.look_up(lanes, lo, hi);
        }
    }
}
