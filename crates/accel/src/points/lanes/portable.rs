//! Lanes in plain Rust, for any processor.

use glam::Vec3;

use super::{LANES, Lanes, Near, Row, Rows};

/// Plain loops, which the compiler turns into whatever the target has.
#[derive(Clone, Copy)]
pub(in super::super) struct Portable;

impl Lanes for Portable {
    #[inline(always)]
    fn points(self, at: Rows, p: Vec3, bound: f32, d2: &mut Row) -> u32 {
        for i in 0..LANES {
            let (dx, dy, dz) = (p.x - at[0][i], p.y - at[1][i], p.z - at[2][i]);
            d2[i] = dx * dx + dy * dy + dz * dz;
        }
        mask(d2, bound)
    }

    #[inline(always)]
    fn near(self, at: Rows, p: Vec3, bound: f32, valid: u32, first: u32, out: Near) -> usize {
        let mut d2 = [0.0; LANES];
        let near = self.points(at, p, bound, &mut d2) & valid;
        let mut count = 0;
        for (i, &d2) in d2.iter().enumerate() {
            (out.numbers[count], out.d2[count]) = (first.wrapping_add(i as u32), d2);
            count += (near >> i & 1) as usize;
        }
        count
    }

    #[inline(always)]
    fn prefetch(self, _: *const f32) {}

    #[inline(always)]
    fn boxes(self, lo: Rows, hi: Rows, p: Vec3, bound: f32, d2: &mut Row) -> u32 {
        for i in 0..LANES {
            let dx = (lo[0][i] - p.x).max(p.x - hi[0][i]).max(0.0);
            let dy = (lo[1][i] - p.y).max(p.y - hi[1][i]).max(0.0);
            let dz = (lo[2][i] - p.z).max(p.z - hi[2][i]).max(0.0);
            d2[i] = dx * dx + dy * dy + dz * dz;
        }
        mask(d2, bound)
    }

    #[inline(always)]
    fn cells(self, d2: &[[f32; 4]; 3], bound: f32) -> u64 {
        let mut cells = 0;
        for z in 0..4 {
            let mut layer = [0.0; LANES];
            for i in 0..LANES {
                layer[i] = d2[0][i % 4] + d2[1][i / 4] + d2[2][z];
            }
            cells |= u64::from(mask(&layer, bound)) << (16 * z);
        }
        cells
    }
}

#[inline(always)]
fn mask(d2: &Row, bound: f32) -> u32 {
    let mut mask = 0;
    for (i, &d2) in d2.iter().enumerate() {
        mask |= u32::from(d2 <= bound) << i;
    }
    mask
}
