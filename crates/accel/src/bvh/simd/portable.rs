//! Plain Rust on arrays: for processors without the vector instructions we know, and as the yardstick for the others.

use super::Simd;
use crate::bvh::{node::Child, stack::Stack};

/// Needs nothing of the processor.
#[derive(Clone, Copy)]
pub(in crate::bvh) struct Portable;

#[inline(always)]
fn zip<const N: usize>(a: [f32; N], b: [f32; N], f: impl Fn(f32, f32) -> f32) -> [f32; N] {
    std::array::from_fn(|i| f(a[i], b[i]))
}

#[inline(always)]
fn mask<const N: usize>(a: [f32; N], b: [f32; N], f: impl Fn(f32, f32) -> bool) -> u32 {
    (0..N).fold(0, |bits, i| bits | u32::from(f(a[i], b[i])) << i)
}

#[inline(always)]
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

impl Simd for Portable {
    type F4 = [f32; 4];
    type F8 = [f32; 8];

    #[inline(always)]
    fn splat4(self, x: f32) -> [f32; 4] {
        [x; 4]
    }
    #[inline(always)]
    fn load4(self, x: &[f32; 4]) -> [f32; 4] {
        *x
    }
    #[inline(always)]
    fn store4(self, x: [f32; 4]) -> [f32; 4] {
        x
    }
    #[inline(always)]
    fn add4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        zip(a, b, |a, b| a + b)
    }
    #[inline(always)]
    fn sub4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        zip(a, b, |a, b| a - b)
    }
    #[inline(always)]
    fn mul4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        zip(a, b, |a, b| a * b)
    }
    #[inline(always)]
    fn div4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        zip(a, b, |a, b| a / b)
    }
    #[inline(always)]
    fn fnmadd4(self, a: [f32; 4], b: [f32; 4], c: [f32; 4]) -> [f32; 4] {
        std::array::from_fn(|i| c[i] - a[i] * b[i])
    }
    #[inline(always)]
    fn min4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        zip(a, b, min)
    }
    #[inline(always)]
    fn max4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        zip(a, b, max)
    }
    #[inline(always)]
    fn ge4(self, a: [f32; 4], b: [f32; 4]) -> u32 {
        mask(a, b, |a, b| a >= b)
    }
    #[inline(always)]
    fn gt4(self, a: [f32; 4], b: [f32; 4]) -> u32 {
        mask(a, b, |a, b| a > b)
    }

    #[inline(always)]
    fn splat8(self, x: f32) -> [f32; 8] {
        [x; 8]
    }
    #[inline(always)]
    fn load8(self, x: &[f32; 8]) -> [f32; 8] {
        *x
    }
    #[inline(always)]
    fn store8(self, x: [f32; 8]) -> [f32; 8] {
        x
    }
    #[inline(always)]
    fn fmadd8(self, a: [f32; 8], b: [f32; 8], c: [f32; 8]) -> [f32; 8] {
        std::array::from_fn(|i| a[i] * b[i] + c[i])
    }
    #[inline(always)]
    fn min8(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        zip(a, b, min)
    }
    #[inline(always)]
    fn max8(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        zip(a, b, max)
    }
    #[inline(always)]
    fn le8(self, a: [f32; 8], b: [f32; 8]) -> u32 {
        mask(a, b, |a, b| a <= b)
    }

    #[inline(always)]
    fn prefetch(self, _: *const u8) {}

    #[inline(always)]
    fn push_sorted(self, stack: &mut Stack, children: &[Child; 8], near: [f32; 8], mask: u32) -> Child {
        push_sorted(stack, children, &near, mask)
    }

    #[inline(always)]
    fn push_any(self, stack: &mut Stack, children: &[Child; 8], mask: u32) -> Child {
        push_any(stack, children, mask)
    }
}

/// Insertion sort of the children in `mask`; also what AVX2 does, which has no cheap way to compress a vector.
#[inline(always)]
pub(super) fn push_sorted(stack: &mut Stack, children: &[Child; 8], near: &[f32; 8], mut mask: u32) -> Child {
    let base = stack.len();
    let mut nearest = mask.trailing_zeros() as usize;
    mask &= mask - 1;
    while mask != 0 {
        let mut other = mask.trailing_zeros() as usize;
        mask &= mask - 1;
        if near[other & 7] < near[nearest & 7] {
            std::mem::swap(&mut other, &mut nearest);
        }
        stack.insert_sorted(base, near[other & 7], children[other & 7]);
    }
    children[nearest & 7]
}

/// Pushes the children in `mask` in rising order of their slots and returns the last.
#[inline(always)]
pub(super) fn push_any(stack: &mut Stack, children: &[Child; 8], mut mask: u32) -> Child {
    let last = 31 - mask.leading_zeros() as usize;
    mask ^= 1 << last;
    while mask != 0 {
        stack.push(0.0, children[mask.trailing_zeros() as usize & 7]);
        mask &= mask - 1;
    }
    children[last & 7]
}
