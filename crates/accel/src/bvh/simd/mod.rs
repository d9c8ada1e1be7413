//! The vector operations that traversal needs, and the processors that offer them.
//!
//! A value of a type that implements [`Simd`] is a proof that the processor has the instructions: the x86 tokens can
//! only be made by an `unsafe` constructor, inside a function compiled for them. So the methods are safe to call.

pub(super) mod portable;
#[cfg(target_arch = "x86_64")]
pub(super) mod x86;

use super::{node::Child, stack::Stack};

/// The instruction sets that traversal is compiled for, in rising order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SimdLevel {
    /// Whatever the compilation target guarantees.
    Portable,
    /// AVX2 and FMA.
    Avx2,
    /// AVX-512 F, VL and DQ, on 256-bit registers.
    Avx512,
}

impl SimdLevel {
    /// The best level of the processor this runs on.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("fma")
                && is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("bmi2")
                && is_x86_feature_detected!("lzcnt")
                && is_x86_feature_detected!("popcnt");
            let avx512 = avx2
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq");
            if avx512 {
                return Self::Avx512;
            }
            if avx2 {
                return Self::Avx2;
            }
        }
        Self::Portable
    }
}

/// Vectors of 4 and 8 `f32`. Comparisons give one bit per lane and are false for NaN; `min` and `max` return their
/// second operand if either is NaN.
pub(super) trait Simd: Copy {
    type F4: Copy;
    type F8: Copy;

    fn splat4(self, x: f32) -> Self::F4;
    fn load4(self, x: &[f32; 4]) -> Self::F4;
    fn store4(self, x: Self::F4) -> [f32; 4];
    fn add4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn sub4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn mul4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn div4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    /// c - a b, fused where the processor can.
    fn fnmadd4(self, a: Self::F4, b: Self::F4, c: Self::F4) -> Self::F4;
    fn min4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn max4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn ge4(self, a: Self::F4, b: Self::F4) -> u32;
    fn gt4(self, a: Self::F4, b: Self::F4) -> u32;

    fn splat8(self, x: f32) -> Self::F8;
    fn load8(self, x: &[f32; 8]) -> Self::F8;
    fn store8(self, x: Self::F8) -> [f32; 8];
    /// a b + c, fused where the processor can.
    fn fmadd8(self, a: Self::F8, b: Self::F8, c: Self::F8) -> Self::F8;
    /// Where any of the values is negative, some negative value; so these two and the comparison can be done on integers,
    /// which is quicker.
    fn min8(self, a: Self::F8, b: Self::F8) -> Self::F8;
    /// Where none of the values is positive or zero, some negative value.
    fn max8(self, a: Self::F8, b: Self::F8) -> Self::F8;
    /// For an `a` that is positive or +0, a `b` that is not -0, and no NaN.
    fn le8(self, a: Self::F8, b: Self::F8) -> u32;

    /// Asks the caches for the line at `p`, which need not be a valid address.
    fn prefetch(self, p: *const u8);

    /// Pushes the children in `mask` (at least two) but the nearest, far ones first, and returns the nearest.
    fn push_sorted(self, stack: &mut Stack, children: &[Child; 8], near: Self::F8, mask: u32) -> Child;
    /// Pushes the children in `mask` (at least two) but the last, in the order of their slots, and returns the last.
    fn push_any(self, stack: &mut Stack, children: &[Child; 8], mask: u32) -> Child;
}
