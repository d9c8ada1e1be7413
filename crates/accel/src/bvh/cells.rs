//! The one table that nodes and triangle blocks share, in half cache lines.
//!
//! What a ray needs in turn lies close together: a node, the blocks of its leaves, then the nodes below, page by page (see `emit`). So a visit
//! mostly finds its page translated and its lines on the way.

use super::{node::Node, triangle::Block};
use std::mem::MaybeUninit;

/// Bytes of a cell.
const BYTES: usize = 32;

/// A part of a node or of a block.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
pub(super) struct Cell([u32; BYTES / 4]);

/// What the table holds.
///
/// # Safety
/// Every bit pattern is a valid value without padding, the size is `CELLS` whole cells, and the alignment is no greater
/// than that of a cell.
pub(super) unsafe trait Stored: Copy {
    /// Cells that a value takes.
    const CELLS: u32 = (size_of::<Self>() / BYTES) as u32;
}

// SAFETY: 224 bytes of numbers, aligned as a cell.
unsafe impl Stored for Node {}
// SAFETY: 160 bytes of numbers, aligned as a cell.
unsafe impl Stored for Block {}

const _: () = assert!(size_of::<Node>() == 7 * BYTES && align_of::<Node>() == BYTES);
const _: () = assert!(size_of::<Block>() == 5 * BYTES && align_of::<Block>() == BYTES);

/// The value that starts at a cell.
///
/// # Safety
/// A value of this type was written there.
#[inline(always)]
pub(super) unsafe fn get<T: Stored>(table: &[Cell], cell: u32) -> &T {
    debug_assert!((cell + T::CELLS) as usize <= table.len());
    // SAFETY: as the caller says; cells are aligned for every stored type.
    unsafe { &*table.as_ptr().add(cell as usize).cast() }
}

/// As [`get`].
///
/// # Safety
/// A value of this type was written there.
pub(super) unsafe fn get_mut<T: Stored>(table: &mut [Cell], cell: u32) -> &mut T {
    debug_assert!((cell + T::CELLS) as usize <= table.len());
    // SAFETY: as the caller says; cells are aligned for every stored type.
    unsafe { &mut *table.as_mut_ptr().add(cell as usize).cast() }
}

/// Consecutive unwritten cells of the table.
pub(super) struct Places<'a> {
    first: u32,
    cells: &'a mut [MaybeUninit<Cell>],
}

impl<'a> Places<'a> {
    /// All of a table.
    pub(super) fn new(cells: &'a mut [MaybeUninit<Cell>]) -> Self {
        Self { first: 0, cells }
    }

    /// The number of the first cell.
    pub(super) fn first(&self) -> u32 {
        self.first
    }

    pub(super) fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// Takes the first `count` cells away.
    pub(super) fn take(&mut self, count: u32) -> Self {
        let (taken, rest) = std::mem::take(&mut self.cells).split_at_mut(count as usize);
        self.cells = rest;
        let first = self.first;
        self.first += count;
        Self { first, cells: taken }
    }

    /// Writes a value into the first cells, takes them away and returns the number of the first.
    pub(super) fn put<T: Stored>(&mut self, value: T) -> u32 {
        let place = self.take(T::CELLS);
        // SAFETY: the cells just taken are as many as the value is long, and no type of `Stored` asks for more alignment
        // than a cell has.
        unsafe { place.cells.as_mut_ptr().cast::<T>().write(value) };
        place.first
    }
}
