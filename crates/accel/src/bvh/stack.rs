//! The traversal stack: children still to visit, each with the distance at which the ray enters it.

use super::{build::MAX_DEPTH, node::Child};
use std::mem::MaybeUninit;

/// A node leaves at most seven siblings on the stack; world and object add up, and entering an instance costs one
/// entry. Vector stores may write one full vector past the top.
const CAPACITY: usize = 2 * 7 * (MAX_DEPTH + 1) + 1 + 8;

/// Entries above the top are uninitialised.
pub(super) struct Stack {
    keys: [MaybeUninit<f32>; CAPACITY],
    children: [MaybeUninit<Child>; CAPACITY],
    len: usize,
}

impl Stack {
    #[inline(always)]
    pub(super) const fn new() -> Self {
        Self { keys: [MaybeUninit::uninit(); CAPACITY], children: [MaybeUninit::uninit(); CAPACITY], len: 0 }
    }

    #[inline(always)]
    pub(super) fn push(&mut self, key: f32, child: Child) {
        debug_assert!(self.len < CAPACITY);
        // SAFETY: the builder bounds the depth of every hierarchy by MAX_DEPTH, hence the height of the stack.
        unsafe {
            self.keys.get_unchecked_mut(self.len).write(key);
            self.children.get_unchecked_mut(self.len).write(child);
        }
        self.len += 1;
    }

    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<(f32, Child)> {
        self.len = self.len.checked_sub(1)?;
        // SAFETY: entries below `len` have been written by `push` or `insert_sorted`.
        Some(unsafe {
            (self.keys.get_unchecked(self.len).assume_init(), self.children.get_unchecked(self.len).assume_init())
        })
    }

    /// Pushes so that the entries from `base` on stay in falling order of their keys.
    #[inline(always)]
    pub(super) fn insert_sorted(&mut self, base: usize, key: f32, child: Child) {
        debug_assert!(self.len < CAPACITY);
        let mut at = self.len;
        // SAFETY: `at` stays between `base` and `len`, which is within the capacity by the builder's depth bound,
        // and all entries below `len` are initialised.
        unsafe {
            while at > base && self.keys.get_unchecked(at - 1).assume_init() < key {
                *self.keys.get_unchecked_mut(at) = *self.keys.get_unchecked(at - 1);
                *self.children.get_unchecked_mut(at) = *self.children.get_unchecked(at - 1);
                at -= 1;
            }
            self.keys.get_unchecked_mut(at).write(key);
            self.children.get_unchecked_mut(at).write(child);
        }
        self.len += 1;
    }

    #[inline(always)]
    pub(super) const fn len(&self) -> usize {
        self.len
    }
}
