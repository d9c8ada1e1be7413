//! Indices of refraction of glasses, gems and water.
//!
//! Those of Schott's glasses are the Sellmeier coefficients of its catalogue; the tests hold them to the catalogue's
//! index and Abbe number.
#![allow(clippy::unreadable_literal, clippy::excessive_precision, reason = "published coefficients, as published")]
use crate::spectrum::Ior;

/// Three terms with the squares of the resonances in µm², as glass catalogues give them.
const fn schott(b: [f32; 3], c: [f32; 3]) -> Ior {
    Ior::Sellmeier { b: [b[0], b[1], b[2], 0.0], c: [c[0], c[1], c[2], 0.0] }
}

/// Crown glass, the commonest of all.
pub(super) const N_BK7: Ior = schott([1.03961212, 0.231792344, 1.01046945], [0.00600069867, 0.0200179144, 103.560653]);
/// Barium flint.
pub(super) const N_BAF10: Ior = schott([1.5851495, 0.143559385, 1.08521269], [0.00926681282, 0.0424489805, 105.613573]);
/// Fluor crown: little dispersion.
pub(super) const N_FK51A: Ior =
    schott([0.971247817, 0.216901417, 0.904651666], [0.00472301995, 0.0153575612, 168.68133]);
/// Lanthanum flint.
pub(super) const N_LASF9: Ior = schott([2.00029547, 0.298926886, 1.80691843], [0.0121426017, 0.0538736236, 156.530829]);
/// Dense flint.
pub(super) const SF5: Ior = schott([1.46141885, 0.247713019, 0.949995832], [0.0111826126, 0.0508594669, 112.041888]);
/// Dense flint.
pub(super) const SF10: Ior = schott([1.62153902, 0.256287842, 1.64447552], [0.0122241457, 0.0595736775, 147.468793]);
/// Dense flint: much dispersion.
pub(super) const SF11: Ior = schott([1.73759695, 0.313747346, 1.89878101], [0.013188707, 0.0623068142, 155.23629]);

/// Malitson 1965, "Interspecimen Comparison of the Refractive Index of Fused Silica".
pub(super) const FUSED_SILICA: Ior =
    schott([0.696_166_3, 0.407_942_6, 0.897_479_4], [0.004_679_148, 0.013_512_063, 97.934]);
/// Peter 1923, "Über Brechungsindizes und Absorptionskonstanten des Diamanten".
pub(super) const DIAMOND: Ior = schott([0.3306, 4.3356, 0.0], [0.030_625, 0.011_236, 0.0]);
/// Distilled water at 20 °C: Daimon & Masumura 2007, "Measurement of the refractive index of distilled water", table 3.
pub(super) const WATER: Ior = Ior::Sellmeier {
    b: [0.5684027565, 0.1726177391, 0.02086189578, 0.1130748688],
    c: [0.005101829712, 0.01821153936, 0.02620722293, 10.69792721],
};
/// Ordinary ray; Malitson & Dodge 1972, "Refractive Index and Birefringence of Synthetic Sapphire".
pub(super) const SAPPHIRE: Ior =
    schott([1.431_349_3, 0.650_547_13, 5.341_402], [0.005_279_926, 0.014_238_265, 325.017_83]);
/// Rutile, ordinary ray; Devore 1951, "Refractive Indices of Rutile and Sphalerite": 5.913 + 0.2441/(λ² − 0.0803), whose
/// constant is a term with c = 0.
pub(super) const TITANIUM_DIOXIDE: Ior = schott([1.873_15, 3.039_850_6, 0.0], [0.0, 0.0803, 0.0]);
/// Stephens & Malitson 1952, "Index of Refraction of Magnesium Oxide": 2.956362 + 0.02195770/(λ² − 0.01428322) −
/// 0.01062387 λ², whose last term is a resonance far off.
pub(super) const MAGNESIUM_OXIDE: Ior = schott([0.419_054_5, 1.537_307_6, 1.062_387], [0.0, 0.014_283_22, 100.0]);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glasses_have_the_index_and_the_dispersion_of_their_catalogue() {
        // n_d and Abbe number: Schott 2019 (SF5, SF10, SF11: 2001); water at 20 °C, the others: by the
        // formulas of the sources.
        for (name, ior, n_d, abbe) in [
            ("N-BK7", N_BK7, 1.516_80, 64.17),
            ("N-BAF10", N_BAF10, 1.670_03, 47.11),
            ("N-FK51A", N_FK51A, 1.486_56, 84.47),
            ("N-LASF9", N_LASF9, 1.850_25, 32.17),
            ("SF5", SF5, 1.672_70, 32.21),
            ("SF10", SF10, 1.728_25, 28.41),
            ("SF11", SF11, 1.784_72, 25.76),
            ("fused silica", FUSED_SILICA, 1.458_46, 67.8),
            ("diamond", DIAMOND, 2.4175, 55.3),
            ("water", WATER, 1.333_36, 55.7),
            ("sapphire", SAPPHIRE, 1.768_2, 72.2),
            ("rutile", TITANIUM_DIOXIDE, 2.6143, 9.87),
            ("magnesium oxide", MAGNESIUM_OXIDE, 1.7375, 53.6),
        ] {
            assert!((ior.d() - n_d).abs() < 3e-4, "{name}: n_d {} but {n_d}", ior.d());
            assert!((ior.abbe() / abbe - 1.0).abs() < 0.01, "{name}: Abbe number {} but {abbe}", ior.abbe());
        }
        // N-BK7 line by line: r, C, d, F, g, h of Schott's data sheet.
        for (nm, n) in [
            (706.5, 1.512_89),
            (656.3, 1.514_32),
            (587.6, 1.516_80),
            (486.1, 1.522_38),
            (435.8, 1.526_68),
            (404.7, 1.530_24),
        ] {
            assert!((N_BK7.at_nm(nm) - n).abs() < 2e-5, "{nm}: {}", N_BK7.at_nm(nm));
        }
    }
}
