//! Splits of the few triangles that fit one block: every way to divide them is tried.

use super::{refs::Ref, simd::SimdLevel, triangle::LANES};

/// Two blocks in the place of one must have at most this share of its surface: each takes room in a node and memory.
const WORTH_A_SPLIT: f32 = 1.0;

/// Sets of references, which are the bits of an index.
const SETS: usize = 1 << LANES;

/// Moves the left side of the best split to the front and returns its length; `None` if one block is better. For at most
/// [`LANES`] references.
pub(super) fn divide(refs: &mut [Ref], level: SimdLevel) -> Option<usize> {
    if refs.len() < 2 {
        return None;
    }
    let half_areas = match level {
        SimdLevel::Portable => half_areas(refs),
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the builder takes the level from `SimdLevel::detect`.
        SimdLevel::Avx2 | SimdLevel::Avx512 => unsafe { half_areas_avx2(refs) },
        #[cfg(not(target_arch = "x86_64"))]
        _ => half_areas(refs),
    };
    let (mut best, mut least) = (None, half_areas[SETS - 1] * WORTH_A_SPLIT);
    for left in (1..(1 << refs.len()) - 1).step_by(2) {
        let surface = half_areas[left] + half_areas[SETS - 1 - left];
        if surface < least {
            (best, least) = (Some(left), surface);
        }
    }
    let left = best?;
    let mut middle = 0;
    for i in 0..refs.len() {
        if left >> i & 1 != 0 {
            refs.swap(middle, i);
            middle += 1;
        }
    }
    Some(middle)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn half_areas_avx2(refs: &[Ref]) -> [f32; SETS] {
    half_areas(refs)
}

/// The half surface of the box around each set; bits beyond the references do not count.
#[inline(always)]
fn half_areas(refs: &[Ref]) -> [f32; SETS] {
    let [x0, y0, z0] = [least(refs, 0), least(refs, 1), least(refs, 2)];
    let [x1, y1, z1] = [least(refs, 4), least(refs, 5), least(refs, 6)];
    let mut half_areas = [0.0; SETS];
    for set in 0..SETS {
        let (x, y, z) = (x0[set] + x1[set], y0[set] + y1[set], z0[set] + z1[set]);
        half_areas[set] = x * y + y * z + z * x;
    }
    half_areas
}

/// The least value of a lane in each set.
#[inline(always)]
fn least(refs: &[Ref], lane: usize) -> [f32; SETS] {
    let mut least = [f32::INFINITY; SETS];
    for i in 0..LANES {
        let value = if i < refs.len() { refs[i].0[lane] } else { f32::INFINITY };
        for set in 0..1 << i {
            least[set + (1 << i)] = if value < least[set] { value } else { least[set] };
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::refs::Owner;
    use glam::Vec3;

    #[test]
    fn near_ones_stay_together_and_a_row_stays_whole() {
        let unit = |x: f32| Ref::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1.0, 1.0, 1.0), Owner::Sphere(x as u32));
        for level in [SimdLevel::Portable, SimdLevel::detect()] {
            let mut refs = [9.0, 1.0, 8.0, 0.0].map(unit);
            assert_eq!(divide(&mut refs, level), Some(2));
            assert_eq!(refs.map(|r| r.bounds().lo.x), [9.0, 8.0, 1.0, 0.0]);
            let mut refs = [0.0, 50.0, 1.0].map(unit);
            assert_eq!(divide(&mut refs, level), Some(2));
            assert_eq!(refs.map(|r| r.bounds().lo.x), [0.0, 1.0, 50.0]);
            assert_eq!(divide(&mut [0.0, 1.0, 2.0, 3.0].map(unit), level), None);
            assert_eq!(divide(&mut [unit(0.0)], level), None);
        }
    }
}
