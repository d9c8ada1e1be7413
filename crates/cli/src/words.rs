//! Numbers as people say them.
use std::time::Duration;

/// A duration: `0.43s`, `12.3s`, `2m 05s`, `1h 02m`.
pub(crate) fn time(t: Duration) -> String {
    let s = t.as_secs();
    match s {
        0..10 => format!("{:.2}s", t.as_secs_f64()),
        10..60 => format!("{:.1}s", t.as_secs_f64()),
        60..3600 => format!("{}m {:02}s", s / 60, s % 60),
        _ => format!("{}h {:02}m", s / 3600, s / 60 % 60),
    }
}

/// A count: up to 9999 as it is, beyond with three digits and a metric prefix.
pub(crate) fn count(n: f64) -> String {
    let (scaled, prefix) = match n {
        ..1e4 => return format!("{n:.0}"),
        ..1e6 => (n / 1e3, "k"),
        ..1e9 => (n / 1e6, "M"),
        _ => (n / 1e9, "G"),
    };
    let decimals = if scaled < 10.0 { 2 } else { usize::from(scaled < 100.0) };
    format!("{scaled:.decimals$}{prefix}")
}

/// A measured quantity with three digits: `0.0123`, `1.23`, `123`, `1.23e9`.
pub(crate) fn quantity(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        a @ 1e-3..1e5 => format!("{x:.*}", (2 - a.log10().floor() as i32).max(0) as usize),
        _ => format!("{x:.2e}"),
    }
}

/// A number of things: `1 pass`, `3 passes`.
pub(crate) fn things(n: u64, one: &str, many: &str) -> String {
    format!("{} {}", count(n as f64), if n == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_counts_read_well() {
        let times = [0.434, 12.34, 125.0, 3725.0].map(|s| time(Duration::from_secs_f64(s)));
        assert_eq!(times, ["0.43s", "12.3s", "2m 05s", "1h 02m"]);
        let counts = [0.0, 999.0, 9999.0, 12_345.0, 1.234e8, 5e9].map(count);
        assert_eq!(counts, ["0", "999", "9999", "12.3k", "123M", "5.00G"]);
        let quantities = [0.0, 0.012_34, 1.234, 99.99, 12_345.6, 5e9, -2.5].map(quantity);
        assert_eq!(quantities, ["0", "0.0123", "1.23", "100.0", "12346", "5.00e9", "-2.50"]);
        assert_eq!((things(1, "pass", "passes"), things(2, "pass", "passes")), ("1 pass".into(), "2 passes".into()));
    }
}
