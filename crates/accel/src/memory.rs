//! Large tables, on large pages where the system has them.

use rayon::prelude::*;

/// An empty vector with room for `capacity` items. On Linux the kernel is asked for huge pages: rays jump about in these
/// tables, and with small pages the address translation costs as much as the memory itself.
pub(crate) fn large_vec<T>(capacity: usize) -> Vec<T> {
    let table: Vec<T> = Vec::with_capacity(capacity);
    #[cfg(target_os = "linux")]
    advise_huge_pages(table.as_ptr().cast(), capacity * size_of::<T>());
    table
}

/// The parts one after the other, copied in parallel.
pub fn concat<T: Copy + Send + Sync>(parts: &[&[T]]) -> Vec<T> {
    let count = parts.iter().map(|part| part.len()).sum();
    let mut all = large_vec(count);
    let mut rest = &mut all.spare_capacity_mut()[..count];
    let mut pairs = Vec::with_capacity(parts.len());
    for &part in parts {
        let (room, more) = std::mem::take(&mut rest).split_at_mut(part.len());
        pairs.push((part, room));
        rest = more;
    }
    pairs.into_par_iter().for_each(|(part, room)| {
        for (item, place) in part.iter().zip(room) {
            place.write(*item);
        }
    });
    // SAFETY: the parts have `count` items together, and each was written to its place.
    unsafe { all.set_len(count) };
    all
}

/// `count` zeros (or what `T` has for zero), likewise on huge pages. Memory that the system gives as zeros is not written to,
/// so whoever writes first, on whichever thread, takes the cost.
pub(crate) fn large_zeroed<T: Copy + Default>(count: usize) -> Vec<T> {
    let table = vec![T::default(); count];
    #[cfg(target_os = "linux")]
    advise_huge_pages(table.as_ptr().cast(), count * size_of::<T>());
    table
}

/// Asks the caches for a value that will be read soon.
#[inline(always)]
pub(crate) fn prefetch<T>(value: &T) {
    #[cfg(target_arch = "x86_64")]
    // SAFETY: every processor of this architecture has the instruction, which only takes an address.
    unsafe {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        _mm_prefetch::<_MM_HINT_T0>((&raw const *value).cast());
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = value;
}

#[cfg(target_os = "linux")]
fn advise_huge_pages(start: *const u8, bytes: usize) {
    const PAGE: usize = 4096;
    const WORTH_IT: usize = 4 << 20;
    if bytes < WORTH_IT {
        return;
    }
    let skip = start.align_offset(PAGE);
    let whole_pages = (bytes - skip) / PAGE * PAGE;
    // SAFETY: the range lies inside one live allocation, and the advice does not change what memory holds. It may be
    // refused, which is as good as not asking.
    unsafe { libc::madvise(start.add(skip).cast_mut().cast(), whole_pages, libc::MADV_HUGEPAGE) };
}

#[cfg(test)]
mod tests {
    use super::concat;

    #[test]
    fn parts_come_one_after_the_other() {
        let parts: Vec<Vec<u16>> = (0..300).map(|n| (0..n % 7 * 900).map(|i| i ^ n).collect()).collect();
        let slices: Vec<&[u16]> = parts.iter().map(Vec::as_slice).collect();
        assert_eq!(concat(&slices), parts.concat());
        assert_eq!(concat::<u16>(&[]), []);
    }
}
