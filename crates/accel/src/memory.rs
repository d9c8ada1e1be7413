//! Large tables, on large pages where the system has them.

/// An empty vector with room for `capacity` items. On Linux the kernel is asked for huge pages: rays jump about in these
/// tables, and with small pages the address translation costs as much as the memory itself.
pub(crate) fn large_vec<T>(capacity: usize) -> Vec<T> {
    let table: Vec<T> = Vec::with_capacity(capacity);
    #[cfg(target_os = "linux")]
    advise_huge_pages(table.as_ptr().cast(), capacity * size_of::<T>());
    table
}

/// `count` zeros (or what `T` has for zero), likewise on huge pages. Memory that the system gives as zeros is not written to,
/// so whoever writes first, on whichever thread, takes the cost.
pub(crate) fn large_zeroed<T: Copy + Default>(count: usize) -> Vec<T> {
    let table = vec![T::default(); count];
    #[cfg(target_os = "linux")]
    advise_huge_pages(table.as_ptr().cast(), count * size_of::<T>());
    table
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
