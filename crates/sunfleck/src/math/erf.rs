//! The error function, which the standard library lacks.

/// `2/√π ∫₀ˣ exp(−t²) dt`, with an error below 1.2·10⁻⁷ (the Chebyshev fit of the complement by Press et al. 2007, "Numerical
/// Recipes", section 6.2.2).
#[inline]
pub fn erf(x: f64) -> f64 {
    const FIT: [f64; 10] = [
        -1.265_512_23,
        1.000_023_68,
        0.374_091_96,
        0.096_784_18,
        -0.186_288_06,
        0.278_868_07,
        -1.135_203_98,
        1.488_515_87,
        -0.822_152_23,
        0.170_872_77,
    ];
    let t = 1.0 / (1.0 + 0.5 * x.abs());
    let fit = FIT.iter().rev().fold(0.0, |sum, c| sum * t + c);
    (1.0 - t * (fit - x * x).exp()).copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn erf_has_the_tabulated_values() {
        // Abramowitz & Stegun 1964, table 7.1.
        for (x, y) in
            [(0.0, 0.0), (0.1, 0.112_462_916), (0.5, 0.520_499_878), (1.0, 0.842_700_793), (2.0, 0.995_322_265)]
        {
            assert!((erf(x) - y).abs() < 1.3e-7 && (erf(-x) + y).abs() < 1.3e-7, "{x}: {}", erf(x));
        }
    }
}
