//! What red, green and blue see of interference.
use super::{Curve, Rgb};
use std::{f32::consts::TAU, sync::OnceLock};

/// Difference of optical path (nm) between the entries of the table, and how many there are: beyond them, fringes are so many
/// that no channel sees them.
const STEP: f32 = 10.0;
const ENTRIES: usize = 1281;

static TABLE: OnceLock<Vec<Rgb>> = OnceLock::new();

/// Colour of a reflectance `cos(2π·opd/λ)` under D65: the fringe of two waves that differ by `opd` nm, as channels see it. 1 at 0.
///
/// A reflectance that is a sum of such fringes is worked out channel by channel with it, as Belcour & Barla do with a fit (2017,
/// "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", section 4).
pub(crate) fn fringe(opd: f32) -> Rgb {
    let table = TABLE.get_or_init(|| {
        let one = |i: usize| Curve::new(|nm| (TAU * STEP * i as f32 / nm).cos()).reflectance_rgb();
        (0..ENTRIES).map(one).collect()
    });
    let x = opd / STEP;
    let i = x as usize;
    match table.get(i..i + 2) {
        Some([a, b]) => a.lerp(*b, x - i as f32),
        _ => Rgb::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fringes_begin_white_and_fade() {
        assert!((fringe(0.0) - 1.0).abs().max_element() < 1e-3, "{}", fringe(0.0));
        assert!(fringe(275.0).y < -0.7 && fringe(12_000.0).abs().max_element() < 0.05);
        for opd in [3.0, 447.0, 1234.5] {
            let exact = Curve::new(|nm| (TAU * opd / nm).cos()).reflectance_rgb();
            assert!((fringe(opd) - exact).abs().max_element() < 5e-3, "{opd}: {} {exact}", fringe(opd));
        }
    }
}
