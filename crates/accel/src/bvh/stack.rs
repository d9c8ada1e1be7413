//! The traversal stack: children still to visit, each with the distance at which the ray enters it.

use super::{build::MAX_DEPTH, node::Child};
use std::mem::MaybeUninit;

/// A node leaves at most seven siblings on the stack; world and object add up, and entering an instance costs one
/// entry. Vector stores may write one full vector past the top.
const CAPACITY: usize = 2 * 7 * (MAX_DEPTH + 1) + 1 + 8;

/// Entries above the top are uninitialised.
pub(super) struct Stack {
    keys: MaybeUninit<[f32; CAPACITY]>,
    children: MaybeUninit<[Child; CAPACITY]>,
    len: usize,
}

impl Stack {
    #[inline(always)]
    pub(super) fn new() -> Self {
        let mut stack = MaybeUninit::<Self>::uninit();
        // SAFETY: the length is the only field that must be initialised. (Built from its fields, the compiler would
        // fill the whole stack with zeros for each ray.)
        unsafe {
            (&raw mut (*stack.as_mut_ptr()).len).write(0);
            stack.assume_init()
        }
    }

    /// Where entry `at` lives. A vector of entries can be written there if `at` is at most the length.
    #[inline(always)]
    pub(super) const fn slot(&mut self, at: usize) -> (*mut f32, *mut Child) {
        debug_assert!(at + 8 <= CAPACITY);
        // SAFETY: the builder bounds the depth of every hierarchy by MAX_DEPTH, hence the height of the stack.
        unsafe { (self.keys.as_mut_ptr().cast::<f32>().add(at), self.children.as_mut_ptr().cast::<Child>().add(at)) }
    }

    /// Takes over `count` entries that were written at the top.
    ///
    /// # Safety
    /// They were written.
    #[inline(always)]
    pub(super) const unsafe fn grow(&mut self, count: usize) {
        self.len += count;
    }

    #[inline(always)]
    pub(super) const fn push(&mut self, key: f32, child: Child) {
        let (key_slot, child_slot) = self.slot(self.len);
        // SAFETY: `slot` gives valid places.
        unsafe {
            key_slot.write(key);
            child_slot.write(child);
        }
        self.len += 1;
    }

    #[inline(always)]
    pub(super) const fn pop(&mut self) -> Option<(f32, Child)> {
        if self.len == 0 {
            return None;
        }
        self.len -= 1;
        let (key, child) = self.slot(self.len);
        // SAFETY: entries below the length have been written.
        Some(unsafe { (key.read(), child.read()) })
    }

    /// Pushes so that the entries from `base` on stay in falling order of their keys.
    #[inline(always)]
    pub(super) fn insert_sorted(&mut self, base: usize, key: f32, child: Child) {
        let mut at = self.len;
        while at > base {
            let (below_key, below_child) = self.slot(at - 1);
            let (key_slot, child_slot) = self.slot(at);
            // SAFETY: entries below the length have been written, and `slot` gives valid places.
            unsafe {
                if below_key.read() >= key {
                    break;
                }
                key_slot.write(below_key.read());
                child_slot.write(below_child.read());
            }
            at -= 1;
        }
        let (key_slot, child_slot) = self.slot(at);
        // SAFETY: `slot` gives valid places.
        unsafe {
            key_slot.write(key);
            child_slot.write(child);
        }
        self.len += 1;
    }

    #[inline(always)]
    pub(super) const fn len(&self) -> usize {
        self.len
    }
}
