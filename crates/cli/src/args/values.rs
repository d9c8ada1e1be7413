//! Values with a range: each reader says what it expects.
use glam::Vec3;
use std::ops::RangeInclusive;
use std::str::FromStr;
use std::time::Duration;

/// Sides beyond this are refused.
const MAX_SIDE: u64 = 1 << 20;

fn number<T: FromStr + Copy>(text: &str, ok: impl Fn(T) -> bool, expected: &str) -> Result<T, String> {
    text.trim().parse().ok().filter(|v| ok(*v)).ok_or_else(|| format!("expected {expected}"))
}

fn whole(text: &str, range: RangeInclusive<u64>) -> Result<u64, String> {
    number(text, |v| range.contains(&v), &format!("a whole number from {} to {}", range.start(), range.end()))
}

fn triple(text: &str, ok: impl Fn(f32) -> bool, expected: &str) -> Result<Vec3, String> {
    let parts: Vec<f32> = text.split(',').filter_map(|t| t.trim().parse().ok().filter(|v| ok(*v))).collect();
    match (parts[..].try_into(), text.split(',').count()) {
        (Ok(v), 3) => Ok(Vec3::from_array(v)),
        _ => Err(format!("expected {expected}")),
    }
}

/// A point or direction.
pub(crate) fn vector(text: &str) -> Result<Vec3, String> {
    triple(text, f32::is_finite, "three finite numbers with commas between, such as 0,0,-3")
}

/// A radiance by channel.
pub(crate) fn radiance(text: &str) -> Result<Vec3, String> {
    triple(text, |v| v >= 0.0 && v.is_finite(), "three numbers of 0 or more with commas between, such as 0.5,0.5,0.5")
}

/// A field of view in degrees.
pub(crate) fn fov(text: &str) -> Result<f32, String> {
    number(text, |v: f32| v > 0.0 && v < 180.0, "an angle in degrees, more than 0 and less than 180")
}

/// Width over height.
pub(crate) fn aspect(text: &str) -> Result<f32, String> {
    number(text, |v: f32| (1e-3..=1e3).contains(&v), "width over height, from 0.001 to 1000")
}

/// More than nothing.
pub(crate) fn positive(text: &str) -> Result<f32, String> {
    number(text, |v: f32| v > 0.0 && v.is_finite(), "a number greater than 0")
}

/// Nothing or more.
pub(crate) fn non_negative(text: &str) -> Result<f32, String> {
    number(text, |v: f32| v >= 0.0 && v.is_finite(), "a number of 0 or more")
}

/// Nothing or more.
pub(crate) fn non_negative_f64(text: &str) -> Result<f64, String> {
    number(text, |v: f64| v >= 0.0 && v.is_finite(), "a number of 0 or more")
}

/// `2%` or `2` to 0.02.
pub(crate) fn percent(text: &str) -> Result<f64, String> {
    let digits = text.trim().strip_suffix('%').unwrap_or(text);
    number(digits, |v: f64| (0.0..=1e6).contains(&v), "a percentage of 0 or more, such as 2%").map(|v| v / 100.0)
}

/// As [`percent`], but more than nothing.
pub(crate) fn positive_percent(text: &str) -> Result<f64, String> {
    percent(text).ok().filter(|v| *v > 0.0).ok_or_else(|| "expected a percentage of more than 0, such as 50%".into())
}

/// As [`percent`], between nothing and all.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    let within = |v: &f64| *v > 0.0 && *v < 1.0;
    percent(text).ok().filter(within).ok_or_else(|| "expected a percentage between 0 and 100, such as 1%".into())
}

/// A side of the picture.
pub(crate) fn pixels(text: &str) -> Result<u32, String> {
    whole(text, 1..=MAX_SIDE).map(|v| v as u32)
}

/// Scatterings on a path.
pub(crate) fn scatterings(text: &str) -> Result<u32, String> {
    whole(text, 0..=10_000).map(|v| v as u32)
}

/// Passes.
pub(crate) fn passes(text: &str) -> Result<u64, String> {
    whole(text, 1..=1_000_000_000)
}

/// A seed.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    whole(text, 0..=u64::MAX)
}

/// Threads.
pub(crate) fn threads(text: &str) -> Result<usize, String> {
    whole(text, 1..=1024).map(|v| v as usize)
}

/// Stops of exposure.
pub(crate) fn exposure(text: &str) -> Result<f32, String> {
    number(text, |v: f32| (-32.0..=32.0).contains(&v), "a number of stops from -32 to 32")
}

/// A time to spend.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    const YEAR: Duration = Duration::from_secs(366 * 24 * 3600);
    let parsed = humantime::parse_duration(text).ok().filter(|d| !d.is_zero() && *d <= YEAR);
    parsed
        .ok_or_else(|| "expected a time with its unit, more than 0 and at most a year, such as 30s, 5m or 1h30m".into())
}

/// A size in memory, in bytes: `2GiB` is 2 · 1024³, `2GB` and `2G` are 2 · 1000³.
pub(crate) fn bytes(text: &str) -> Result<u64, String> {
    let text = text.trim();
    let (digits, unit) = text.split_at(text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len()));
    let unit = unit.to_ascii_lowercase();
    let base: f64 = if unit.ends_with("ib") { 1024.0 } else { 1000.0 };
    let power = ["", "k", "m", "g", "t"]
        .iter()
        .position(|p| [(*p).to_owned(), format!("{p}b"), format!("{p}ib")].contains(&unit));
    let size = power.and_then(|n| Some(digits.trim().parse::<f64>().ok()? * base.powi(n as i32)));
    let size = size.filter(|s| (1.0..=1e15).contains(s)).map(|s| s as u64);
    size.ok_or_else(|| "expected a size with its unit, such as 512MiB or 2GB".to_owned())
}

/// A setting and its value.
pub(crate) fn key_value(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err("expected KEY=VALUE".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_mean_nothing_are_refused() {
        for bad in ["nan", "inf", "-1", "", "1,2"] {
            assert!(positive(bad).is_err() && non_negative(bad).is_err() && fov(bad).is_err(), "{bad}");
            assert!(pixels(bad).is_err() && passes(bad).is_err() && threads(bad).is_err(), "{bad}");
        }
        assert!(fov("180").is_err() && fov("0").is_err() && pixels("0").is_err() && exposure("33").is_err());
        assert!(aspect("1e-9").is_err() && scatterings("10001").is_err() && percent("-1%").is_err());
    }

    #[test]
    fn triples_need_three_finite_numbers() {
        assert_eq!(vector("0, 0,-3"), Ok(Vec3::new(0.0, 0.0, -3.0)));
        for bad in ["1,2", "1,2,3,4", "1,,3", "1,nan,3", "1 2 3", "1,2,x,3", ""] {
            assert!(vector(bad).is_err(), "{bad}");
        }
        assert!(radiance("1,-1,1").is_err());
    }

    #[test]
    fn percentages_may_omit_their_sign_and_durations_need_a_unit() {
        assert_eq!((percent("2%"), percent("2")), (Ok(0.02), Ok(0.02)));
        assert_eq!(duration("1h30m"), Ok(Duration::from_secs(5400)));
        assert!(duration("30").is_err() && duration("0s").is_err() && duration("9999y").is_err());
    }

    #[test]
    fn sizes_in_memory_have_decimal_and_binary_units() {
        let sizes = ["2GiB", "2GB", "1.5 k", "4096", "1mib", "7B"].map(|s| bytes(s).unwrap());
        assert_eq!(sizes, [2 << 30, 2_000_000_000, 1500, 4096, 1 << 20, 7]);
        for bad in ["", "GiB", "0", "-1GB", "1XB", "1e99", "nan", "1GiBs", "ib"] {
            assert!(bytes(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn settings_are_split_at_the_first_equals_sign() {
        assert_eq!(key_value("a=b=c"), Ok(("a".into(), "b=c".into())));
        assert!(key_value("a").is_err() && key_value("=b").is_err());
    }
}
