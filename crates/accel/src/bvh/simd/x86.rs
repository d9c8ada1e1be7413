//! AVX2 with FMA, and AVX-512 on 256-bit registers.

use super::{
    Simd,
    portable::{push_any, push_sorted},
};
use crate::bvh::{node::Child, stack::Stack};
#[allow(clippy::wildcard_imports)] // some sixty intrinsics
use std::arch::x86_64::*;

/// A proof that the processor has AVX2, FMA and BMI.
#[derive(Clone, Copy)]
pub(in crate::bvh) struct Avx2(());

/// A proof that the processor has AVX-512 F, VL, DQ and everything of [`Avx2`].
#[derive(Clone, Copy)]
pub(in crate::bvh) struct Avx512(());

impl Avx2 {
    /// # Safety
    /// The processor must be of [`super::SimdLevel::Avx2`] or above.
    #[inline(always)]
    pub(in crate::bvh) const unsafe fn new_unchecked() -> Self {
        Self(())
    }
}

impl Avx512 {
    /// # Safety
    /// The processor must be of [`super::SimdLevel::Avx512`].
    #[inline(always)]
    pub(in crate::bvh) const unsafe fn new_unchecked() -> Self {
        Self(())
    }
}

macro_rules! ops {
    ($($name:ident($($arg:ident: $type:ty),*) -> $out:ty { $body:expr })*) => {
        $(#[inline(always)]
        fn $name(self, $($arg: $type),*) -> $out {
            // SAFETY: `self` proves that the processor has the instruction; pointers come from references of the
            // size of the vector.
            unsafe { $body }
        })*
    };
}

/// What is the same with and without AVX-512.
macro_rules! shared_ops {
    () => {
        type F4 = __m128;
        type F8 = __m256;
        ops! {
            splat4(x: f32) -> __m128 { _mm_set1_ps(x) }
            load4(x: &[f32; 4]) -> __m128 { _mm_loadu_ps(x.as_ptr()) }
            store4(x: __m128) -> [f32; 4] { std::mem::transmute::<__m128, [f32; 4]>(x) }
            add4(a: __m128, b: __m128) -> __m128 { _mm_add_ps(a, b) }
            sub4(a: __m128, b: __m128) -> __m128 { _mm_sub_ps(a, b) }
            mul4(a: __m128, b: __m128) -> __m128 { _mm_mul_ps(a, b) }
            div4(a: __m128, b: __m128) -> __m128 { _mm_div_ps(a, b) }
            fnmadd4(a: __m128, b: __m128, c: __m128) -> __m128 { _mm_fnmadd_ps(a, b, c) }
            min4(a: __m128, b: __m128) -> __m128 { _mm_min_ps(a, b) }
            max4(a: __m128, b: __m128) -> __m128 { _mm_max_ps(a, b) }
            ge4(a: __m128, b: __m128) -> u32 { _mm_movemask_ps(_mm_cmpge_ps(a, b)) as u32 }
            gt4(a: __m128, b: __m128) -> u32 { _mm_movemask_ps(_mm_cmpgt_ps(a, b)) as u32 }
            splat8(x: f32) -> __m256 { _mm256_set1_ps(x) }
            load8(x: &[f32; 8]) -> __m256 { _mm256_loadu_ps(x.as_ptr()) }
            store8(x: __m256) -> [f32; 8] { std::mem::transmute::<__m256, [f32; 8]>(x) }
            fmadd8(a: __m256, b: __m256, c: __m256) -> __m256 { _mm256_fmadd_ps(a, b, c) }
            min8(a: __m256, b: __m256) -> __m256 {
                _mm256_castsi256_ps(_mm256_min_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)))
            }
            max8(a: __m256, b: __m256) -> __m256 {
                _mm256_castsi256_ps(_mm256_max_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)))
            }
            le8(a: __m256, b: __m256) -> u32 {
                !_mm256_movemask_ps(_mm256_castsi256_ps(
                    _mm256_cmpgt_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b))
                )) as u32 & 0xff
            }
            prefetch(p: *const u8) -> () { _mm_prefetch::<_MM_HINT_T0>(p.cast()) }
        }
    };
}

impl Simd for Avx2 {
    shared_ops!();

    #[inline(always)]
    fn push_sorted(self, stack: &mut Stack, children: &[Child; 8], near: __m256, mask: u32) -> Child {
        push_sorted(stack, children, &self.store8(near), mask)
    }

    #[inline(always)]
    fn push_any(self, stack: &mut Stack, children: &[Child; 8], mask: u32) -> Child {
        push_any(stack, children, mask)
    }
}

impl Simd for Avx512 {
    shared_ops!();

    #[inline(always)]
    fn push_sorted(self, stack: &mut Stack, children: &[Child; 8], near: __m256, mask: u32) -> Child {
        // SAFETY: `self` proves that the processor has the instructions.
        unsafe { push_sorted_avx512(stack, children, near, mask) }
    }

    #[inline(always)]
    fn push_any(self, stack: &mut Stack, children: &[Child; 8], mask: u32) -> Child {
        // SAFETY: `self` proves that the processor has the instructions, and `slot` gives room for a vector.
        unsafe {
            let all = _mm256_loadu_si256(children.as_ptr().cast());
            let (keys, slots) = stack.slot(stack.len());
            _mm256_storeu_ps(keys, _mm256_setzero_ps());
            _mm256_storeu_si256(slots.cast(), _mm256_maskz_compress_epi32(mask as __mmask8, all));
            stack.grow(mask.count_ones() as usize - 1);
        }
        children[(31 - mask.leading_zeros() as usize) & 7]
    }
}

/// Sorts with a network. Distances are not negative, so their bits sort as integers; the lowest three bits are replaced
/// by the slot of the child, which a permutation can then use as its index.
#[inline(always)]
unsafe fn push_sorted_avx512(stack: &mut Stack, children: &[Child; 8], near: __m256, mask: u32) -> Child {
    // SAFETY: the caller's token proves that the processor has the instructions, and `slot` gives room for a vector.
    unsafe {
        let slots = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
        let distances = _mm256_andnot_si256(_mm256_set1_epi32(7), _mm256_castps_si256(near));
        let tagged = _mm256_or_si256(distances, slots);
        let all = _mm256_loadu_si256(children.as_ptr().cast());
        let count = mask.count_ones() as usize;
        // Unused lanes are -1: the largest when compared without sign, for the minimum; the smallest with sign, so
        // that they sort behind everything.
        let packed = _mm256_mask_compress_epi32(_mm256_set1_epi32(-1), mask as __mmask8, tagged);
        let low = _mm256_castsi256_si128(packed);
        let (keys, slots) = stack.slot(stack.len());
        let nearest = if count <= 4 {
            let sorted = sort4_falling(low);
            _mm_storeu_si128(keys.cast(), _mm_andnot_si128(_mm_set1_epi32(7), sorted));
            let ordered = _mm256_permutevar8x32_epi32(all, _mm256_castsi128_si256(sorted));
            _mm_storeu_si128(slots.cast(), _mm256_castsi256_si128(ordered));
            least(low)
        } else {
            let sorted = sort8_falling(packed);
            _mm256_storeu_si256(keys.cast(), _mm256_andnot_si256(_mm256_set1_epi32(7), sorted));
            _mm256_storeu_si256(slots.cast(), _mm256_permutevar8x32_epi32(all, sorted));
            least(_mm_min_epu32(low, _mm256_extracti128_si256::<1>(packed)))
        };
        stack.grow(count - 1);
        *children.get_unchecked(nearest as usize & 7)
    }
}

/// The least of four integers without sign.
#[inline]
#[target_feature(enable = "avx2,avx512f,avx512vl")]
fn least(x: __m128i) -> u32 {
    let x = _mm_min_epu32(x, _mm_shuffle_epi32::<0b01_00_11_10>(x));
    _mm_cvtsi128_si32(_mm_min_epu32(x, _mm_shuffle_epi32::<0b10_11_00_01>(x))) as u32
}

/// A sorting network of three layers.
#[inline]
#[target_feature(enable = "avx2,avx512f,avx512vl")]
fn sort4_falling(x: __m128i) -> __m128i {
    let y = _mm_shuffle_epi32::<0b01_00_11_10>(x);
    let x = _mm_blend_epi32::<0b1100>(_mm_max_epi32(x, y), _mm_min_epi32(x, y));
    let y = _mm_shuffle_epi32::<0b10_11_00_01>(x);
    let x = _mm_blend_epi32::<0b1010>(_mm_max_epi32(x, y), _mm_min_epi32(x, y));
    let y = _mm_shuffle_epi32::<0b11_01_10_00>(x);
    let swapped = _mm_blend_epi32::<0b0100>(_mm_max_epi32(x, y), _mm_min_epi32(x, y));
    _mm_blend_epi32::<0b0110>(x, swapped)
}

/// A sorting network of six layers (the 19 comparators of Knuth, The Art of Computer Programming 3, 5.3.4).
#[inline]
#[target_feature(enable = "avx2,avx512f,avx512vl")]
fn sort8_falling(x: __m256i) -> __m256i {
    // A lane without a partner is its own partner.
    let layer = |x: __m256i, y: __m256i, low: __mmask8| _mm256_mask_max_epi32(_mm256_min_epi32(x, y), low, x, y);
    let x = layer(x, _mm256_shuffle_epi32::<0b01_00_11_10>(x), 0b0011_0011);
    let x = layer(x, _mm256_permute2x128_si256::<1>(x, x), 0b0000_1111);
    let x = layer(x, _mm256_shuffle_epi32::<0b10_11_00_01>(x), 0b0101_0101);
    let x = layer(x, _mm256_permutevar8x32_epi32(x, _mm256_setr_epi32(0, 1, 4, 5, 2, 3, 6, 7)), 0b0000_1100);
    let x = layer(x, _mm256_permutevar8x32_epi32(x, _mm256_setr_epi32(0, 4, 2, 6, 1, 5, 3, 7)), 0b0000_1010);
    layer(x, _mm256_permutevar8x32_epi32(x, _mm256_setr_epi32(0, 2, 1, 4, 3, 6, 5, 7)), 0b0010_1010)
}
