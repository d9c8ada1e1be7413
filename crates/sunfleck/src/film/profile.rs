//! How much a place counts by its distance from a pixel's middle along one axis: the curves of pixel filters.
use std::f32::consts::PI;

/// A curve over the distance `x` (pixels) along one axis. Pixel filters are products of two, one for each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curve {
    /// The same everywhere.
    Box,
    /// Falls to nothing in a straight line.
    Tent,
    /// A bell less its value at the radius: max(0, exp(−x²/2σ²) − exp(−r²/2σ²)) (Pharr, Jakob & Humphreys 2023, 8.8.3).
    Gaussian {
        /// Standard deviation σ in pixels, > 0.
        sigma: f32,
    },
    /// The cubics of Mitchell & Netravali 1988, stretched so that they end at the radius. Negative near their end unless C
    /// is small.
    Cubic {
        /// Their B.
        b: f32,
        /// Their C.
        c: f32,
    },
    /// sinc x · sinc x/τ (Lanczos), with lobes below zero.
    Lanczos {
        /// Width τ of the window in pixels, > 0.
        tau: f32,
    },
}

impl Curve {
    /// The value at distance `x` ≥ 0 of a curve that ends at `radius`, up to a factor.
    pub(super) fn at(self, x: f32, radius: f32) -> f32 {
        if x > radius {
            return 0.0;
        }
        match self {
            Self::Box => 1.0,
            Self::Tent => 1.0 - x / radius,
            Self::Gaussian { sigma } => {
                let bell = |x: f32| (-0.5 * (x / sigma).powi(2)).exp();
                (bell(x) - bell(radius)).max(0.0)
            }
            Self::Cubic { b, c } => cubic(2.0 * x / radius, b, c),
            Self::Lanczos { tau } => sinc(x) * sinc(x / tau),
        }
    }
}

/// Mitchell & Netravali 1988, eq. 8, without the factor of 1/6.
fn cubic(x: f32, b: f32, c: f32) -> f32 {
    if x <= 1.0 {
        ((12.0 - 9.0 * b - 6.0 * c) * x + (-18.0 + 12.0 * b + 6.0 * c)) * x * x + (6.0 - 2.0 * b)
    } else {
        (((-b - 6.0 * c) * x + (6.0 * b + 30.0 * c)) * x + (-12.0 * b - 48.0 * c)) * x + (8.0 * b + 24.0 * c)
    }
}

/// sin πx / πx.
fn sinc(x: f32) -> f32 {
    if x < 1e-4 { 1.0 } else { (PI * x).sin() / (PI * x) }
}

/// Steps by which one half of a curve is drawn from.
const STEPS: usize = 16;
/// Places at which each step is measured.
const PLACES: usize = 16;

/// A curve with its end, to draw places from and to weigh them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Profile {
    curve: Curve,
    /// Where it ends (pixels).
    pub(super) radius: f32,
    /// One over its integral from end to end.
    per_integral: f32,
    /// Share of the magnitude before each step, and 1.
    shares: [f32; STEPS + 1],
}

impl Profile {
    /// `curve` as far as `radius` pixels; `None` if a number is out of its range, or too little of the curve is above zero.
    pub(super) fn new(curve: Curve, radius: f32) -> Option<Self> {
        let numbers = match curve {
            Curve::Box | Curve::Tent => true,
            Curve::Gaussian { sigma } => sigma > 0.0,
            Curve::Cubic { b, c } => b.is_finite() && c.is_finite(),
            Curve::Lanczos { tau } => tau > 0.0,
        };
        let fits = radius > 0.0 && radius <= super::MAX_FILTER_RADIUS;
        if !(numbers && fits) {
            return None;
        }
        let width = radius / STEPS as f32;
        let value = |i: usize, j: usize| {
            let x = (i as f32 + (j as f32 + 0.5) / PLACES as f32) * width;
            f64::from(curve.at(x, radius))
        };
        let (mut integral, mut magnitude, mut shares) = (0.0, 0.0, [0.0; STEPS + 1]);
        for i in 0..STEPS {
            let (sum, size) = (0..PLACES).fold((0.0, 0.0), |(s, m), j| (s + value(i, j), m + value(i, j).abs()));
            integral += sum;
            magnitude += size;
            shares[i + 1] = magnitude as f32;
        }
        let usable = integral > 0.1 * magnitude && magnitude.is_finite();
        shares.iter_mut().for_each(|s| *s /= magnitude as f32);
        shares[STEPS] = 1.0;
        let integral = 2.0 * integral * f64::from(width) / PLACES as f64;
        usable.then_some(Self { curve, radius, per_integral: (1.0 / integral) as f32, shares })
    }
    /// The curve.
    pub(super) fn curve(&self) -> Curve {
        self.curve
    }
    /// A distance from the middle (pixels, of either sign), and what a sample there counts: near 1 or, in lobes below zero,
    /// below −1 or so.
    #[inline]
    pub(super) fn sample(&self, u: f32) -> (f32, f32) {
        let (side, v) = if u < 0.5 { (-1.0, 1.0 - 2.0 * u) } else { (1.0, 2.0 * u - 1.0) };
        let step = self.shares[1..STEPS].partition_point(|s| *s <= v);
        let (below, share) = (self.shares[step], self.shares[step + 1] - self.shares[step]);
        if share <= 0.0 {
            return (0.0, 1.0);
        }
        let width = self.radius / STEPS as f32;
        let x = (step as f32 + ((v - below) / share).clamp(0.0, 1.0)) * width;
        (side * x, self.weight(x) * 2.0 * width / share)
    }
    /// Share (per pixel of length) of light at distance `x` (pixels, of either sign): the curve over its integral.
    #[inline]
    pub(super) fn weight(&self, x: f32) -> f32 {
        self.curve.at(x.abs(), self.radius) * self.per_integral
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CURVES: [(Curve, f32); 6] = [
        (Curve::Box, 0.7),
        (Curve::Tent, 1.0),
        (Curve::Gaussian { sigma: 0.5 }, 1.5),
        (Curve::Cubic { b: 1.0 / 3.0, c: 1.0 / 3.0 }, 2.0),
        (Curve::Cubic { b: 0.0, c: 0.5 }, 2.0),
        (Curve::Lanczos { tau: 3.0 }, 3.0),
    ];

    #[test]
    fn draws_times_weights_give_the_moments_of_the_curve() {
        for (curve, radius) in CURVES {
            let p = Profile::new(curve, radius).unwrap();
            let n = 100_000;
            let mean = |f: &dyn Fn(f32) -> f32| {
                (0..n).map(|i| p.sample((i as f32 + 0.5) / n as f32)).map(|(x, w)| f64::from(w * f(x))).sum::<f64>()
                    / f64::from(n)
            };
            let m = 4000;
            let by_sum = |f: &dyn Fn(f32) -> f32| {
                let place = |i: i32| ((i as f32 + 0.5) / m as f32 * 2.0 - 1.0) * radius;
                let all = |g: &dyn Fn(f32) -> f32| {
                    (0..m).map(place).map(|x| f64::from(curve.at(x.abs(), radius) * g(x))).sum::<f64>()
                };
                all(f) / all(&|_| 1.0)
            };
            for f in [&|_| 1.0, &|x: f32| x * x, &|x: f32| (3.0 * x + 0.4).cos()] as [&dyn Fn(f32) -> f32; 3] {
                assert!((mean(f) - by_sum(f)).abs() < 2e-3, "{curve:?}: {} {}", mean(f), by_sum(f));
            }
        }
    }

    #[test]
    fn weights_integrate_to_one_and_fall_below_zero_where_the_curve_does() {
        for (curve, radius) in CURVES {
            let p = Profile::new(curve, radius).unwrap();
            let n = 2000;
            let places = (0..n).map(|i| ((i as f32 + 0.5) / n as f32 * 2.0 - 1.0) * radius);
            let sum: f32 = places.clone().map(|x| p.weight(x)).sum::<f32>() * 2.0 * radius / n as f32;
            assert!((sum - 1.0).abs() < 1e-3, "{curve:?}: {sum}");
            let dips = matches!(curve, Curve::Cubic { .. } | Curve::Lanczos { .. });
            assert_eq!(places.map(|x| p.weight(x)).any(|w| w < -1e-4), dips, "{curve:?}");
        }
    }

    #[test]
    fn numbers_that_make_no_filter_are_refused() {
        for (curve, radius) in [
            (Curve::Box, 0.0),
            (Curve::Tent, f32::NAN),
            (Curve::Tent, 1e9),
            (Curve::Gaussian { sigma: 0.0 }, 1.0),
            (Curve::Cubic { b: f32::INFINITY, c: 0.0 }, 2.0),
            (Curve::Cubic { b: -30.0, c: 30.0 }, 2.0),
            (Curve::Lanczos { tau: -1.0 }, 2.0),
        ] {
            assert!(Profile::new(curve, radius).is_none(), "{curve:?} {radius}");
        }
    }
}
