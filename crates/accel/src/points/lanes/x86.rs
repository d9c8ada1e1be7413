//! Lanes in AVX2 and AVX-512.
//!
//! No closure may hold an intrinsic: it would be compiled without the features, and each intrinsic become a call.

use std::arch::x86_64::{
    __m256, __m512, _CMP_LE_OQ, _MM_HINT_T0, _mm_loadl_epi64, _mm_loadu_ps, _mm_prefetch, _mm_set1_ps,
    _mm256_add_epi32, _mm256_add_ps, _mm256_broadcast_ps, _mm256_cmp_ps, _mm256_cvtepu8_epi32, _mm256_loadu_ps,
    _mm256_max_ps, _mm256_movemask_ps, _mm256_mul_ps, _mm256_permutevar8x32_ps, _mm256_set_m128, _mm256_set1_epi32,
    _mm256_set1_ps, _mm256_setzero_ps, _mm256_storeu_ps, _mm256_storeu_si256, _mm256_sub_ps, _mm512_add_epi32,
    _mm512_add_ps, _mm512_broadcast_f32x4, _mm512_castps128_ps512, _mm512_cmp_ps_mask, _mm512_loadu_ps,
    _mm512_maskz_compress_epi32, _mm512_maskz_compress_ps, _mm512_max_ps, _mm512_mul_ps, _mm512_permutexvar_ps,
    _mm512_set1_epi32, _mm512_set1_ps, _mm512_setr_epi32, _mm512_setzero_ps, _mm512_storeu_ps, _mm512_storeu_si512,
    _mm512_sub_ps,
};

use glam::Vec3;

use super::{LANES, Lanes, Near, Row, Rows, Task};

/// Proof that the processor has AVX2 and the bit counts that came with it. Only [`Avx2::detect`] makes one.
#[derive(Clone, Copy)]
pub(in super::super) struct Avx2(());

/// Proof that the processor has AVX-512 F and all that [`Avx2`] proves. Only [`Avx512::detect`] makes one.
#[derive(Clone, Copy)]
pub(in super::super) struct Avx512(());

impl Avx2 {
    /// `None` where the processor lacks a part of it.
    pub(super) fn detect() -> Option<Self> {
        let has = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("lzcnt")
            && is_x86_feature_detected!("popcnt");
        has.then_some(Self(()))
    }

    /// Runs `task` in code compiled for this instruction set.
    #[inline]
    pub(super) fn run(self, task: impl Task) {
        #[target_feature(enable = "avx2,bmi1,lzcnt,popcnt")]
        fn compiled(lanes: Avx2, task: impl Task) {
            task.run(lanes);
        }
        // SAFETY: `self` proves that the processor has these features.
        unsafe { compiled(self, task) }
    }
}

impl Avx512 {
    /// `None` where the processor lacks a part of it.
    pub(super) fn detect() -> Option<Self> {
        let has = Avx2::detect().is_some() && is_x86_feature_detected!("avx512f");
        has.then_some(Self(()))
    }

    /// Runs `task` in code compiled for this instruction set.
    #[inline]
    pub(super) fn run(self, task: impl Task) {
        #[target_feature(enable = "avx512f,avx2,bmi1,lzcnt,popcnt")]
        fn compiled(lanes: Avx512, task: impl Task) {
            task.run(lanes);
        }
        // SAFETY: `self` proves that the processor has these features.
        unsafe { compiled(self, task) }
    }
}

impl Lanes for Avx2 {
    #[inline(always)]
    fn points(self, at: Rows, p: Vec3, bound: f32, d2: &mut Row) -> u32 {
        let mut mask = 0;
        for half in [0, 8] {
            // SAFETY: `self` proves the features; `half + 8` is within the sixteen values of each row.
            mask |= unsafe {
                let dx = _mm256_sub_ps(_mm256_set1_ps(p.x), _mm256_loadu_ps(at[0].as_ptr().add(half)));
                let dy = _mm256_sub_ps(_mm256_set1_ps(p.y), _mm256_loadu_ps(at[1].as_ptr().add(half)));
                let dz = _mm256_sub_ps(_mm256_set1_ps(p.z), _mm256_loadu_ps(at[2].as_ptr().add(half)));
                norm256(dx, dy, dz, bound, d2, half)
            };
        }
        mask
    }

    #[inline(always)]
    fn near(self, at: Rows, p: Vec3, bound: f32, valid: u32, first: u32, out: Near) -> usize {
        let mut d2 = [0.0; LANES];
        let near = self.points(at, p, bound, &mut d2) & valid;
        let mut count = 0;
        for half in [0, 8] {
            let bits = (near >> half & 0xFF) as usize;
            // SAFETY: `self` proves the features; `count` is at most `half`, so that both stores end within the rows.
            unsafe {
                let moves = _mm256_cvtepu8_epi32(_mm_loadl_epi64(PACK[bits].as_ptr().cast()));
                let kept = _mm256_permutevar8x32_ps(_mm256_loadu_ps(d2.as_ptr().add(half)), moves);
                _mm256_storeu_ps(out.d2.as_mut_ptr().add(count), kept);
                let numbers = _mm256_add_epi32(moves, _mm256_set1_epi32(first.wrapping_add(half as u32) as i32));
                _mm256_storeu_si256(out.numbers.as_mut_ptr().add(count).cast(), numbers);
            }
            count += bits.count_ones() as usize;
        }
        count
    }

    #[inline(always)]
    fn prefetch(self, p: *const f32) {
        // SAFETY: a prefetch may be given any address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(p.cast()) };
    }

    #[inline(always)]
    fn boxes(self, lo: Rows, hi: Rows, p: Vec3, bound: f32, d2: &mut Row) -> u32 {
        let mut mask = 0;
        for half in [0, 8] {
            // SAFETY: `self` proves the features; `half + 8` is within the sixteen values of each row.
            mask |= unsafe {
                let dx = gap256(lo[0], hi[0], p.x, half);
                let dy = gap256(lo[1], hi[1], p.y, half);
                let dz = gap256(lo[2], hi[2], p.z, half);
                norm256(dx, dy, dz, bound, d2, half)
            };
        }
        mask
    }

    #[inline(always)]
    fn cells(self, d2: &[[f32; 4]; 3], bound: f32) -> u64 {
        let mut cells = 0;
        // SAFETY: `self` proves the features; nothing is read but the four values of `d2[0]`.
        unsafe {
            let x = _mm256_broadcast_ps(&_mm_loadu_ps(d2[0].as_ptr()));
            for half in 0..2 {
                let y = _mm256_set_m128(_mm_set1_ps(d2[1][2 * half + 1]), _mm_set1_ps(d2[1][2 * half]));
                let xy = _mm256_add_ps(x, y);
                for (z, &dz2) in d2[2].iter().enumerate() {
                    let sum = _mm256_add_ps(xy, _mm256_set1_ps(dz2));
                    let near = _mm256_cmp_ps::<_CMP_LE_OQ>(sum, _mm256_set1_ps(bound));
                    cells |= u64::from(_mm256_movemask_ps(near) as u32) << (16 * z + 8 * half);
                }
            }
        }
        cells
    }
}

/// For each set of eight lanes, its members in order.
const PACK: [[u8; 8]; 256] = pack();

const fn pack() -> [[u8; 8]; 256] {
    let mut table = [[0; 8]; 256];
    let mut bits = 0;
    while bits < 256 {
        let (mut lane, mut count) = (0, 0);
        while lane < 8 {
            if bits >> lane & 1 == 1 {
                table[bits][count] = lane as u8;
                count += 1;
            }
            lane += 1;
        }
        bits += 1;
    }
    table
}

/// Distances from `p` to the intervals `lo..hi` of the lanes from `half`.
///
/// # Safety
/// The processor has AVX; `half` is at most 8.
#[inline(always)]
unsafe fn gap256(lo: &Row, hi: &Row, p: f32, half: usize) -> __m256 {
    // SAFETY: the caller's promises.
    unsafe {
        let p = _mm256_set1_ps(p);
        let below = _mm256_sub_ps(_mm256_loadu_ps(lo.as_ptr().add(half)), p);
        let above = _mm256_sub_ps(p, _mm256_loadu_ps(hi.as_ptr().add(half)));
        _mm256_max_ps(_mm256_max_ps(below, above), _mm256_setzero_ps())
    }
}

/// Stores the squared length of eight vectors at `d2[half..]`; returns which are at most `bound`, shifted by `half`.
///
/// # Safety
/// The processor has AVX; `half` is at most 8.
#[inline(always)]
unsafe fn norm256(dx: __m256, dy: __m256, dz: __m256, bound: f32, d2: &mut Row, half: usize) -> u32 {
    // SAFETY: the caller's promises.
    unsafe {
        let xy = _mm256_add_ps(_mm256_mul_ps(dx, dx), _mm256_mul_ps(dy, dy));
        let sum = _mm256_add_ps(xy, _mm256_mul_ps(dz, dz));
        _mm256_storeu_ps(d2.as_mut_ptr().add(half), sum);
        (_mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(sum, _mm256_set1_ps(bound))) as u32) << half
    }
}

impl Lanes for Avx512 {
    #[inline(always)]
    fn points(self, at: Rows, p: Vec3, bound: f32, d2: &mut Row) -> u32 {
        // SAFETY: `self` proves the features; each row has sixteen values.
        unsafe {
            let dx = _mm512_sub_ps(_mm512_set1_ps(p.x), _mm512_loadu_ps(at[0].as_ptr()));
            let dy = _mm512_sub_ps(_mm512_set1_ps(p.y), _mm512_loadu_ps(at[1].as_ptr()));
            let dz = _mm512_sub_ps(_mm512_set1_ps(p.z), _mm512_loadu_ps(at[2].as_ptr()));
            norm512(dx, dy, dz, bound, d2)
        }
    }

    #[inline(always)]
    fn near(self, at: Rows, p: Vec3, bound: f32, valid: u32, first: u32, out: Near) -> usize {
        let mut d2 = [0.0; LANES];
        let near = (self.points(at, p, bound, &mut d2) & valid) as u16;
        // SAFETY: `self` proves the features; each row has sixteen values.
        unsafe {
            let kept = _mm512_maskz_compress_ps(near, _mm512_loadu_ps(d2.as_ptr()));
            _mm512_storeu_ps(out.d2.as_mut_ptr(), kept);
            let lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
            let numbers = _mm512_maskz_compress_epi32(near, _mm512_add_epi32(lanes, _mm512_set1_epi32(first as i32)));
            _mm512_storeu_si512(out.numbers.as_mut_ptr().cast(), numbers);
        }
        near.count_ones() as usize
    }

    #[inline(always)]
    fn prefetch(self, p: *const f32) {
        // SAFETY: a prefetch may be given any address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(p.cast()) };
    }

    #[inline(always)]
    fn boxes(self, lo: Rows, hi: Rows, p: Vec3, bound: f32, d2: &mut Row) -> u32 {
        // SAFETY: `self` proves the features; each row has sixteen values.
        unsafe { norm512(gap512(lo[0], hi[0], p.x), gap512(lo[1], hi[1], p.y), gap512(lo[2], hi[2], p.z), bound, d2) }
    }

    #[inline(always)]
    fn cells(self, d2: &[[f32; 4]; 3], bound: f32) -> u64 {
        let mut cells = 0;
        // SAFETY: `self` proves the features; each row has four values.
        unsafe {
            let x = _mm512_broadcast_f32x4(_mm_loadu_ps(d2[0].as_ptr()));
            let row = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
            let y = _mm512_permutexvar_ps(row, _mm512_castps128_ps512(_mm_loadu_ps(d2[1].as_ptr())));
            let xy = _mm512_add_ps(x, y);
            for (z, &dz2) in d2[2].iter().enumerate() {
                let sum = _mm512_add_ps(xy, _mm512_set1_ps(dz2));
                let near = _mm512_cmp_ps_mask::<_CMP_LE_OQ>(sum, _mm512_set1_ps(bound));
                cells |= u64::from(near) << (16 * z);
            }
        }
        cells
    }
}

/// Distances from `p` to the intervals `lo..hi`.
///
/// # Safety
/// The processor has AVX-512 F.
#[inline(always)]
unsafe fn gap512(lo: &Row, hi: &Row, p: f32) -> __m512 {
    // SAFETY: the caller's promise; each row has sixteen values.
    unsafe {
        let p = _mm512_set1_ps(p);
        let below = _mm512_sub_ps(_mm512_loadu_ps(lo.as_ptr()), p);
        let above = _mm512_sub_ps(p, _mm512_loadu_ps(hi.as_ptr()));
        _mm512_max_ps(_mm512_max_ps(below, above), _mm512_setzero_ps())
    }
}

/// Stores the squared length of sixteen vectors; returns which are at most `bound`.
///
/// # Safety
/// The processor has AVX-512 F.
#[inline(always)]
unsafe fn norm512(dx: __m512, dy: __m512, dz: __m512, bound: f32, d2: &mut Row) -> u32 {
    // SAFETY: the caller's promise; `d2` has sixteen values.
    unsafe {
        let xy = _mm512_add_ps(_mm512_mul_ps(dx, dx), _mm512_mul_ps(dy, dy));
        let sum = _mm512_add_ps(xy, _mm512_mul_ps(dz, dz));
        _mm512_storeu_ps(d2.as_mut_ptr(), sum);
        u32::from(_mm512_cmp_ps_mask::<_CMP_LE_OQ>(sum, _mm512_set1_ps(bound)))
    }
}
