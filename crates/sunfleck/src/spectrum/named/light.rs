//! Standard illuminants and glowing bodies.
use super::lamps::{DAYLIGHT, FLUORESCENT};
use crate::spectrum::{Curve, cie_tables::D65};

/// Pairs of wavelength and value of a table in even steps.
fn stepped(first: f32, step: f32, values: impl Iterator<Item = f32>) -> Curve {
    let pairs: Vec<(f32, f32)> = values.enumerate().map(|(i, v)| (first + step * i as f32, v)).collect();
    Curve::sampled(&pairs).unwrap_or_else(|e| unreachable!("a table of this room: {e}"))
}

/// Illuminant A (ISO/CIE 11664-2, eq. 1).
pub(super) fn illuminant_a() -> Curve {
    let planck = |nm: f64| ((1.435e7 / (2848.0 * nm)).exp() - 1.0).recip() * (560.0 / nm).powi(5);
    Curve::new(|nm| (planck(f64::from(nm)) / planck(560.0)) as f32)
}

/// Daylight of a nominal colour temperature from 4000 to 25000 K (CIE 15:2018, section 4.1.2); the temperature is
/// corrected for the change of Planck's constant since.
pub(super) fn daylight(kelvin: f32) -> Curve {
    let t = f64::from(kelvin) * 1.4388 / 1.4380;
    let (a, b, c, d) = if t <= 7000.0 {
        (-4.607_0e9, 2.967_8e6, 0.099_11e3, 0.244_063)
    } else {
        (-2.006_4e9, 1.901_8e6, 0.247_48e3, 0.237_040)
    };
    let x = a / t.powi(3) + b / t.powi(2) + c / t + d;
    let y = -3.0 * x * x + 2.870 * x - 0.275;
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    let m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
    let value = |s: &[f32; 3]| (f64::from(s[0]) + m1 * f64::from(s[1]) + m2 * f64::from(s[2])) as f32;
    stepped(360.0, 10.0, DAYLIGHT.iter().map(value))
}

/// Illuminant D65.
pub(super) fn d65() -> Curve {
    stepped(360.0, 5.0, D65.iter().copied())
}

/// Fluorescent lamp number `i` + 1.
pub(super) fn fluorescent(i: usize) -> Curve {
    stepped(380.0, 5.0, FLUORESCENT[i].iter().copied())
}

impl Curve {
    /// The spectrum of a black body of `kelvin` (> 0), of maximum 1 over all wavelengths (Planck's and Wien's laws, with the
    /// constants of CODATA 2018).
    pub fn blackbody(kelvin: f32) -> Self {
        // Second radiation constant, and Wien's: nm·K. At the peak, x = c₂/(λT) solves x = 5(1 − e⁻ˣ).
        const C2: f64 = 1.438_776_877e7;
        const PEAK: f64 = 4.965_114_231_744_276;
        let t = f64::from(kelvin);
        let planck = |x: f64| x.powi(5) / x.exp_m1();
        let top = planck(PEAK);
        Self::new(|nm| (planck((C2 / (f64::from(nm) * t)).min(700.0)) / top) as f32)
    }
}

/// CIE 1931 x and y.
#[cfg(test)]
pub(super) fn chromaticity(curve: &Curve) -> [f64; 2] {
    use crate::spectrum::cie_tables::OBSERVER_1931;
    let sum = |c: usize| -> f64 {
        let at = |(k, w): (usize, &[f32; 3])| f64::from(w[c] * curve.at(360.0 + 5.0 * k as f32));
        OBSERVER_1931.iter().enumerate().map(at).sum()
    };
    let xyz = [sum(0), sum(1), sum(2)];
    let all: f64 = xyz.iter().sum();
    [xyz[0] / all, xyz[1] / all]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::Illuminant;

    #[test]
    fn black_bodies_have_their_colours() {
        // Chromaticities of the Planckian locus (Wyszecki & Stiles 1982, table 1(3.11)).
        for (kelvin, x, y) in
            [(2000.0, 0.5267, 0.4133), (2856.0, 0.4476, 0.4074), (6500.0, 0.3135, 0.3237), (10000.0, 0.2807, 0.2883)]
        {
            let got = chromaticity(&Curve::blackbody(kelvin));
            assert!((got[0] - x).abs() < 6e-4 && (got[1] - y).abs() < 6e-4, "{kelvin} K: {got:?}");
        }
        // The peak of 5000 K is at 579.6 nm by Wien's law.
        let sun = Curve::blackbody(5000.0);
        assert!((sun.at(579.6) - 1.0).abs() < 1e-5 && sun.at(400.0) < 0.8 && sun.at(830.0) < 0.8);
        let candle = Illuminant::of_luminance(&Curve::blackbody(1900.0), 2.0).rgb();
        assert!(candle.x > 2.0 * candle.y && candle.y > 5.0 * candle.z, "{candle}");
    }
}
