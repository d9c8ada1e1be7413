//! Whether two noisy pictures can be of the same scene.

use super::{CompareError, check_sizes};
use crate::image::RgbImage32;

/// A picture with the variance of each of its values: the square of the error to expect.
#[derive(Clone, Copy, Debug)]
pub struct Noisy<'p> {
    /// The values.
    pub mean: &'p RgbImage32,
    /// Their variances.
    pub variance: &'p RgbImage32,
}

/// How many values of two pictures are as near to each other as their noise asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZTest {
    /// Values of pixels and channels that were compared.
    pub values: usize,
    /// Share of them that are accepted.
    pub accepted: f64,
    /// Standard deviations that a difference may have.
    pub limit: f64,
    /// The largest difference found, in standard deviations.
    pub worst: f64,
}

/// Compares value by value. Each may differ by so many standard deviations that of two pictures of the same scene one in
/// 1/`significance` has a value beyond (Šidák 1967).
///
/// # Errors
/// The sizes differ.
pub fn z_test(image: Noisy, reference: Noisy, significance: f64) -> Result<ZTest, CompareError> {
    for other in [image.variance, reference.mean, reference.variance] {
        check_sizes(image.mean, other)?;
    }
    let values = 3 * image.mean.data.len();
    let alone = -((1.0 - significance).ln() / values.max(1) as f64).exp_m1();
    let limit = two_sided_quantile(alone);
    let flat = |p: &RgbImage32| p.data.iter().flatten().map(|v| f64::from(*v)).collect::<Vec<_>>();
    let [x, vx, r, vr] = [image.mean, image.variance, reference.mean, reference.variance].map(flat);
    let z = |i: usize| {
        let deviation = (vx[i] + vr[i]).max(0.0).sqrt();
        // Rounding of 32-bit floats is no difference.
        let difference = ((x[i] - r[i]).abs() - 1e-6 * r[i].abs()).max(0.0);
        if difference == 0.0 { 0.0 } else { difference / deviation }
    };
    let all: Vec<f64> = (0..values).map(z).collect();
    let accepted = all.iter().filter(|z| **z <= limit).count() as f64 / values.max(1) as f64;
    Ok(ZTest { values, accepted, limit, worst: all.iter().copied().fold(0.0, f64::max) })
}

/// How many standard deviations a normal number is away from its mean, up or down, with probability `p` at most.
fn two_sided_quantile(p: f64) -> f64 {
    let (mut low, mut high) = (0.0, 40.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if beyond(middle) > p { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Probability that a normal number is farther than `z` from its mean (Abramowitz & Stegun 1964, 7.1.26 for small z, and the
/// continued fraction 26.2.14 for others).
fn beyond(z: f64) -> f64 {
    if z < 2.0 {
        let x = z / std::f64::consts::SQRT_2;
        let t = 1.0 / (1.0 + 0.327_591_1 * x);
        let sum =
            ((((1.061_405_429 * t - 1.453_152_027) * t + 1.421_413_741) * t - 0.284_496_736) * t + 0.254_829_592) * t;
        return sum * (-x * x).exp();
    }
    let fraction = (1..=40).rev().fold(z, |f, k| z + f64::from(k) / f);
    2.0 * (-0.5 * z * z).exp() / (std::f64::consts::TAU.sqrt() * fraction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_tables() {
        for (p, z) in [(0.05, 1.959_96), (0.01, 2.575_83), (0.317_31, 1.0), (1e-6, 4.891_64)] {
            assert!((two_sided_quantile(p) - z).abs() < 2e-5, "{p}: {}", two_sided_quantile(p));
        }
    }

    #[test]
    fn noise_is_accepted_and_a_shift_is_not() {
        // Sums of twelve uniform numbers are nearly normal with variance 1.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1_u64 << 24) as f32
        };
        let mut normal = || (0..12).map(|_| uniform()).sum::<f32>() - 6.0;
        let mut image = RgbImage32::filled(40, 40, [0.0; 3]);
        image.data.iter_mut().flatten().for_each(|v| *v = 5.0 + 0.3 * normal());
        let (variance, reference) = (RgbImage32::filled(40, 40, [0.09; 3]), RgbImage32::filled(40, 40, [5.0; 3]));
        let none = RgbImage32::filled(40, 40, [0.0; 3]);
        let test = |shift: f32| {
            let mut shifted = reference.clone();
            shifted.data.iter_mut().flatten().for_each(|v| *v += shift);
            z_test(Noisy { mean: &image, variance: &variance }, Noisy { mean: &shifted, variance: &none }, 0.01)
                .unwrap()
        };
        let same = test(0.0);
        assert!(same.accepted == 1.0 && same.worst > 2.5 && (same.limit - 4.744).abs() < 1e-3, "{same:?}");
        assert!(test(1.4).accepted < 0.6);
        let small = RgbImage32::filled(2, 2, [0.0; 3]);
        assert!(
            z_test(Noisy { mean: &image, variance: &small }, Noisy { mean: &reference, variance: &none }, 0.01)
                .is_err()
        );
    }
}
