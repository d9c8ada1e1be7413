//! What the machine has.

/// Taken for the memory of a machine that does not tell.
const USUAL: u64 = 4 << 30;

/// Bytes of memory.
pub(crate) fn memory() -> u64 {
    std::fs::read_to_string("/proc/meminfo").ok().as_deref().and_then(total).unwrap_or(USUAL)
}

/// The line `MemTotal:` of Linux's `/proc/meminfo`, which counts units of 1024 bytes (`proc_meminfo(5)`).
fn total(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|l| l.strip_prefix("MemTotal:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kib.checked_mul(1024).filter(|n| *n > 0)
}

#[cfg(test)]
mod tests {
    use super::total;

    #[test]
    fn the_total_is_read_and_anything_else_is_not() {
        assert_eq!(total("MemTotal:       16384 kB\nMemFree: 1 kB\n"), Some(16 << 20));
        for other in ["", "MemFree: 1 kB", "MemTotal: x kB", "MemTotal: 5", "MemTotal: 0 kB"] {
            assert_eq!(total(other), None, "{other}");
        }
    }
}
