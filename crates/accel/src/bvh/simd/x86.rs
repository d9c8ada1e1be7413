//! AVX2 with FMA, and AVX-512 on 256-bit registers.

use super::{
    Simd,
    portable::{push_any, push_sorted},
};
use crate::bvh::{node::Child, stack::Stack};
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
            min8(a: __m256, b: __m256) -> __m256 { _mm256_min_ps(a, b) }
            max8(a: __m256, b: __m256) -> __m256 { _mm256_max_ps(a, b) }
            le8(a: __m256, b: __m256) -> u32 { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a, b)) as u32 }
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
        push_sorted(stack, children, &self.store8(near), mask)
    }

    #[inline(always)]
    fn push_any(self, stack: &mut Stack, children: &[Child; 8], mask: u32) -> Child {
        push_any(stack, children, mask)
    }
}
