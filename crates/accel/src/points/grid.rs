//! Fixed-radius queries: a sparse grid of bricks of 4x4x4 cells.

use std::collections::HashMap;

use glam::Vec3;

/// Points sorted by grid cell, for queries of a fixed radius. Immutable once built.
pub struct PointGrid {
    inv_cell: f32,
    sorted: Vec<Vec3>,
    order: Vec<u32>,
    cells: HashMap<[i32; 3], (u32, u32)>,
}

fn cell_of(p: Vec3, inv_cell: f32) -> [i32; 3] {
    (p * inv_cell).to_array().map(|v| v.floor() as i32)
}

impl PointGrid {
    /// Sorts `points` into cells of edge `cell` (world units). Points that are not finite are left out.
    ///
    /// # Panics
    /// If `cell` is not positive and finite, or if there are more than `u32::MAX` points.
    pub fn build(points: &[Vec3], cell: f32) -> Self {
        assert!(cell > 0.0 && cell.is_finite(), "a cell has a positive, finite edge, not {cell}");
        let inv_cell = cell.recip().min(f32::MAX);
        let count = u32::try_from(points.len()).expect("at most u32::MAX points");
        let mut order: Vec<u32> = (0..count).filter(|&i| points[i as usize].is_finite()).collect();
        order.sort_by_key(|&i| cell_of(points[i as usize], inv_cell));
        let sorted: Vec<Vec3> = order.iter().map(|&i| points[i as usize]).collect();
        let mut cells: HashMap<[i32; 3], (u32, u32)> = HashMap::new();
        for (slot, &p) in sorted.iter().enumerate() {
            cells.entry(cell_of(p, inv_cell)).or_insert((slot as u32, 0)).1 = slot as u32 + 1;
        }
        Self { inv_cell, sorted, order, cells }
    }

    /// Calls `visit(index, d2)` once for each point with squared distance `d2 <= r * r` from `p`, in an order that
    /// depends only on the input. `index` counts in the slice given to `build`. A negative or NaN `r`, or a `p` that
    /// is not finite, finds nothing.
    pub fn within(&self, p: Vec3, r: f32, mut visit: impl FnMut(u32, f32)) {
        self.within_slots(p, r, |slot, d2| visit(self.order[slot as usize], d2));
    }

    /// As [`Self::within`], but passes the slot: the point's place in [`Self::order`].
    pub fn within_slots(&self, p: Vec3, r: f32, mut visit: impl FnMut(u32, f32)) {
        if !p.is_finite() || r.is_nan() || r < 0.0 {
            return;
        }
        let r2 = r * r;
        let mut test = |slot: u32| {
            let d2 = p.distance_squared(self.sorted[slot as usize]);
            if d2 <= r2 {
                visit(slot, d2);
            }
        };
        let reach = if r2.is_finite() { r * 1.000_001 + 1e-22 } else { f32::INFINITY };
        let (lo, hi) = (cell_of(p - reach, self.inv_cell), cell_of(p + reach, self.inv_cell));
        let count: f64 = (0..3).map(|a| f64::from(hi[a]) - f64::from(lo[a]) + 1.0).product();
        if count > self.sorted.len() as f64 {
            (0..self.sorted.len() as u32).for_each(test);
            return;
        }
        for z in lo[2]..=hi[2] {
            for y in lo[1]..=hi[1] {
                for x in lo[0]..=hi[0] {
                    if let Some(&(start, end)) = self.cells.get(&[x, y, z]) {
                        (start..end).for_each(&mut test);
                    }
                }
            }
        }
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
        self.sorted.capacity() * 12 + self.order.capacity() * 4 + self.cells.capacity() * 20
    }
}
