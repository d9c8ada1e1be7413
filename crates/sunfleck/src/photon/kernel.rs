//! What a photon at a distance counts in a density estimate.
use std::f32::consts::PI;

/// A radial weight over a disc. Each integrates to one over it, so that flux times weight is irradiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// The same everywhere: sharpest edges of its own, least noise.
    Constant,
    /// Falls linearly to zero at the edge (Jensen 2001, section 7.2.2, with k = 1).
    Cone,
    /// Falls with the square of the distance to zero at the edge (Silverman 1986, table 4.1, in two dimensions).
    Epanechnikov,
}

impl Kernel {
    /// Words for settings, in the order of the variants.
    pub const WORDS: [&str; 3] = ["constant", "cone", "epanechnikov"];
    /// By place in [`Kernel::WORDS`].
    pub const ALL: [Self; 3] = [Self::Constant, Self::Cone, Self::Epanechnikov];

    /// The weight at squared distance `d2` over its mean on the disc of squared radius `r2`; `d2 <= r2`.
    #[inline]
    pub fn shape(self, d2: f32, r2: f32) -> f32 {
        match self {
            Self::Constant => 1.0,
            Self::Cone => 3.0 * (1.0 - (d2 / r2).sqrt()),
            Self::Epanechnikov => 2.0 * (1.0 - d2 / r2),
        }
    }
    /// The weight (1/m²) at squared distance `d2` on the disc of squared radius `r2`; zero outside.
    #[inline]
    pub fn weight(self, d2: f32, r2: f32) -> f32 {
        if d2 <= r2 { self.shape(d2, r2) / (PI * r2) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kernel_integrates_to_one_over_its_disc() {
        for kernel in Kernel::ALL {
            for r in [0.01f32, 1.0, 300.0] {
                // Rings of width r/n: 2πd·(r/n) each.
                let n = 100_000;
                let sum: f64 = (0..2 * n)
                    .map(|i| {
                        let d = (f64::from(i) + 0.5) / f64::from(n) * f64::from(r);
                        let weight = kernel.weight((d * d) as f32, r * r);
                        f64::from(weight) * std::f64::consts::TAU * d * f64::from(r) / f64::from(n)
                    })
                    .sum();
                assert!((sum - 1.0).abs() < 1e-4, "{kernel:?} of radius {r}: {sum}");
            }
        }
    }

    #[test]
    fn words_and_variants_go_together() {
        for (word, kernel) in Kernel::WORDS.iter().zip(Kernel::ALL) {
            assert_eq!(format!("{kernel:?}").to_lowercase(), *word);
        }
    }
}
