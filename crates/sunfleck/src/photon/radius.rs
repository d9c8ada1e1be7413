//! How far a gather reaches: a first radius from what a pixel covers, and how it shrinks from pass to pass.
use super::Sighting;

/// The memoryless schedule of Knaus & Zwicker 2011 (eqs. 20 and 21): `r²ₙ₊₁ / r²ₙ = (n + α) / (n + 1)` with n = 1, 2, …
/// The radius of a pass depends on its number alone, falls as `n^((α − 1) / 2)`, and makes noise and bias of the mean
/// over passes vanish together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schedule {
    /// α in (0, 1]: noise falls as n^(−α), squared bias as n^(2α − 2). At 1 the radius stays, and so does the bias.
    pub alpha: f64,
}

impl Default for Schedule {
    /// α = 2/3, where both vanish equally fast.
    fn default() -> Self {
        Self { alpha: 2.0 / 3.0 }
    }
}

/// Factors multiplied one by one before the asymptotic form takes over.
const EXACT: u64 = 32;

impl Schedule {
    /// Squared radius of pass `index` (0, 1, …) over that of pass 0.
    pub fn squared(self, index: u64) -> f64 {
        let product: f64 = (1..=index.min(EXACT)).map(|n| (n as f64 + self.alpha) / (n as f64 + 1.0)).product();
        // ∏ (n + α) / (n + 1) over n = m + 1 … i is Γ(i + 1 + α) Γ(m + 2) / (Γ(i + 2) Γ(m + 1 + α)).
        product * if index > EXACT { self.gamma_ratio(index) / self.gamma_ratio(EXACT) } else { 1.0 }
    }
    /// Radius of pass `index` over that of pass 0.
    pub fn radius(self, index: u64) -> f32 {
        self.squared(index).sqrt() as f32
    }
    /// What the mean of `passes` passes has of the variance of the first pass, and of its bias, if those go as one over the
    /// squared radius and as the squared radius.
    pub fn of_mean(self, passes: u64) -> (f64, f64) {
        let n = passes as f64;
        let (variance, bias) = (0..passes).fold((0.0, 0.0), |(variance, bias), i| {
            let r2 = self.squared(i);
            (variance + 1.0 / r2, bias + r2)
        });
        (variance / (n * n), bias / n)
    }
    /// Γ(i + 1 + α) / Γ(i + 2), up to a relative error of about i⁻⁴ / 100 (Stirling's series, DLMF 5.11.1).
    fn gamma_ratio(self, i: u64) -> f64 {
        let (a, b) = (i as f64 + 1.0 + self.alpha, i as f64 + 2.0);
        let tail = |x: f64| 1.0 / (12.0 * x) - 1.0 / (360.0 * x * x * x);
        // (a − ½) ln a − (b − ½) ln b, in a form where the large terms cancel first.
        let d = self.alpha - 1.0;
        let main = (a - 0.5) * (d / b).ln_1p() + d * b.ln();
        (main - d + tail(a) - tail(b)).exp()
    }
}

/// The first radius of gathers, by what a pixel covers where they happen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Radius over pixel width.
    scale: f32,
    /// Least and largest radius.
    bounds: (f32, f32),
    /// A radius in the middle of those in use.
    typical: f32,
}

/// No radius is so many times smaller or larger than the median of the picture: a far background or a speck right
/// before the lens must not make the index's cells wrong for everything else.
const SPREAD: f32 = 8.0;

impl Reach {
    /// The same radius (world units, positive) everywhere.
    pub fn fixed(radius: f32) -> Self {
        Self { scale: 0.0, bounds: (radius, radius), typical: radius }
    }
    /// `scale` pixel widths, within a factor of the median over `sightings`. `fallback` is the radius where the camera
    /// saw nothing to go by.
    pub fn from_footprints(sightings: &[Sighting], scale: f32, fallback: f32) -> Self {
        let mut widths: Vec<f32> = sightings.iter().map(|s| s.width).filter(|w| *w > 0.0 && w.is_finite()).collect();
        widths.sort_by(f32::total_cmp);
        let typical = widths.get(widths.len() / 2).map_or(fallback, |w| scale * w);
        Self { scale, bounds: (typical / SPREAD, typical * SPREAD), typical }
    }
    /// The radius where a pixel is `width` wide (world units).
    #[inline]
    pub fn at(&self, width: f32) -> f32 {
        (self.scale * width).clamp(self.bounds.0, self.bounds.1)
    }
    /// A radius in the middle of those in use.
    pub fn typical(&self) -> f32 {
        self.typical
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn the_closed_form_is_the_recurrence() {
        for alpha in [0.1, 2.0 / 3.0, 0.9, 1.0] {
            let schedule = Schedule { alpha };
            let mut squared = 1.0;
            for index in 0..5000u64 {
                let closed = schedule.squared(index);
                assert!((closed / squared - 1.0).abs() < 1e-8, "alpha {alpha}, pass {index}: {closed} {squared}");
                let n = index as f64 + 1.0;
                squared *= (n + alpha) / (n + 1.0);
            }
        }
    }

    #[test]
    fn the_squared_radius_falls_as_a_power_of_the_pass() {
        let schedule = Schedule::default();
        assert_eq!(schedule.squared(0), 1.0);
        assert!((schedule.radius(9).powi(2) / schedule.squared(9) as f32 - 1.0).abs() < 1e-6);
        for i in [1000u64, 1_000_000, 1_000_000_000_000] {
            let slope = (schedule.squared(2 * i) / schedule.squared(i)).log2();
            assert!((slope + 1.0 / 3.0).abs() < 1e-3, "pass {i}: {slope}");
        }
    }

    #[test]
    fn far_and_near_pixels_stay_within_a_factor_of_the_median() {
        let sightings: Vec<Sighting> = [0.001, 1.0, 1.0, 1.1, 1000.0, f32::NAN, 0.0]
            .into_iter()
            .map(|width| Sighting { p: Vec3::ZERO, width })
            .collect();
        let reach = Reach::from_footprints(&sightings, 2.0, 7.0);
        assert_eq!((reach.typical(), reach.at(1.1)), (2.0, 2.2));
        assert_eq!((reach.at(0.0), reach.at(1e9)), (0.25, 16.0));
        assert_eq!(Reach::from_footprints(&[], 2.0, 7.0).at(3.5), 7.0);
        assert_eq!(Reach::fixed(3.0).at(100.0), 3.0);
    }
}
