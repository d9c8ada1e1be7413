//! Measured spectra by name: metals, glasses, lamps. The names are those that pbrt scenes use, and a few more.
mod glasses;
mod lamps;
mod light;
mod metals;

use super::{Colour, Curve, Illuminant, Ior};
use glasses as g;
use metals::Row;

/// A measured spectrum.
#[derive(Clone, Copy, Debug)]
pub struct Named {
    /// Its word, such as `metal-Au-eta`.
    pub name: &'static str,
    /// What it is of, in a few words.
    pub about: &'static str,
    data: Data,
}

#[derive(Clone, Copy, Debug)]
enum Data {
    /// η of a metal.
    Eta(&'static [Row]),
    /// k of a metal.
    Extinction(&'static [Row]),
    /// η of something clear.
    Clear(Ior),
    /// k of something clear.
    None,
    /// Relative power of a lamp.
    Lamp(Lamp),
}

#[derive(Clone, Copy, Debug)]
enum Lamp {
    Even,
    A,
    Daylight(f32),
    D65,
    Fluorescent(usize),
}

/// The spectrum called `name`.
pub fn named(name: &str) -> Option<&'static Named> {
    NAMED.iter().find(|n| n.name == name)
}

impl Named {
    /// The values by wavelength; those of a lamp have luminance 1.
    pub fn curve(&self) -> Curve {
        let column = |rows: &[Row], c: usize| {
            let pairs: Vec<(f32, f32)> = rows.iter().map(|r| (r[0], r[c])).collect();
            Curve::sampled(&pairs).unwrap_or_else(|e| unreachable!("{}: {e}", self.name))
        };
        match self.data {
            Data::Eta(rows) => column(rows, 1),
            Data::Extinction(rows) => column(rows, 2),
            Data::Clear(ior) => Curve::new(|nm| ior.at_nm(nm)),
            Data::None => Curve::new(|_| 0.0),
            Data::Lamp(lamp) => {
                let curve = match lamp {
                    Lamp::Even => Curve::new(|_| 1.0),
                    Lamp::A => light::illuminant_a(),
                    Lamp::Daylight(kelvin) => light::daylight(kelvin),
                    Lamp::D65 => light::d65(),
                    Lamp::Fluorescent(i) => light::fluorescent(i),
                };
                curve.scaled(1.0 / curve.luminance())
            }
        }
    }
    /// As an index of refraction of something clear; `None` for metals and lamps.
    pub fn ior(&self) -> Option<Ior> {
        if let Data::Clear(ior) = self.data { Some(ior) } else { None }
    }
    /// Whether it is light, not matter.
    pub fn is_lamp(&self) -> bool {
        matches!(self.data, Data::Lamp(_))
    }
    /// As a property of matter, η or k.
    pub fn colour(&self) -> Colour {
        Colour::index(self.curve())
    }
    /// As light of luminance 1.
    pub fn illuminant(&self) -> Illuminant {
        Illuminant::spectrum(self.curve())
    }
}

const fn entry(name: &'static str, about: &'static str, data: Data) -> Named {
    Named { name, about, data }
}
const fn lamp(name: &'static str, about: &'static str, lamp: Lamp) -> Named {
    Named { name, about, data: Data::Lamp(lamp) }
}

/// Every named spectrum.
pub const NAMED: &[Named] = &[
    entry("metal-Ag-eta", "silver", Data::Eta(metals::SILVER)),
    entry("metal-Ag-k", "silver", Data::Extinction(metals::SILVER)),
    entry("metal-Al-eta", "aluminium", Data::Eta(metals::ALUMINIUM)),
    entry("metal-Al-k", "aluminium", Data::Extinction(metals::ALUMINIUM)),
    entry("metal-Au-eta", "gold", Data::Eta(metals::GOLD)),
    entry("metal-Au-k", "gold", Data::Extinction(metals::GOLD)),
    entry("metal-Cu-eta", "copper", Data::Eta(metals::COPPER)),
    entry("metal-Cu-k", "copper", Data::Extinction(metals::COPPER)),
    entry("metal-CuZn-eta", "brass", Data::Eta(metals::BRASS)),
    entry("metal-CuZn-k", "brass", Data::Extinction(metals::BRASS)),
    entry("metal-MgO-eta", "magnesium oxide", Data::Clear(g::MAGNESIUM_OXIDE)),
    entry("metal-MgO-k", "magnesium oxide, which is clear", Data::None),
    entry("metal-TiO2-eta", "rutile", Data::Clear(g::TITANIUM_DIOXIDE)),
    entry("metal-TiO2-k", "rutile, which is clear", Data::None),
    entry("glass-BK7", "Schott N-BK7, crown glass", Data::Clear(g::N_BK7)),
    entry("glass-BAF10", "Schott N-BAF10, barium flint", Data::Clear(g::N_BAF10)),
    entry("glass-FK51A", "Schott N-FK51A, little dispersion", Data::Clear(g::N_FK51A)),
    entry("glass-LASF9", "Schott N-LASF9, lanthanum flint", Data::Clear(g::N_LASF9)),
    entry("glass-F5", "Schott SF5, dense flint", Data::Clear(g::SF5)),
    entry("glass-F10", "Schott SF10, dense flint", Data::Clear(g::SF10)),
    entry("glass-F11", "Schott SF11, much dispersion", Data::Clear(g::SF11)),
    entry("glass-SF5", "Schott SF5, dense flint", Data::Clear(g::SF5)),
    entry("glass-SF10", "Schott SF10, dense flint", Data::Clear(g::SF10)),
    entry("glass-SF11", "Schott SF11, much dispersion", Data::Clear(g::SF11)),
    entry("glass-fused-silica", "fused silica", Data::Clear(g::FUSED_SILICA)),
    entry("diamond", "diamond", Data::Clear(g::DIAMOND)),
    entry("water", "water at 20 °C", Data::Clear(g::WATER)),
    entry("sapphire", "sapphire, its ordinary ray", Data::Clear(g::SAPPHIRE)),
    lamp("stdillum-E", "equal energy at every wavelength", Lamp::Even),
    lamp("stdillum-A", "a light bulb of 2856 K", Lamp::A),
    lamp("stdillum-D50", "daylight of 5000 K", Lamp::Daylight(5000.0)),
    lamp("stdillum-D55", "daylight of 5500 K", Lamp::Daylight(5500.0)),
    lamp("stdillum-D65", "noon daylight", Lamp::D65),
    lamp("stdillum-D75", "north sky, 7500 K", Lamp::Daylight(7500.0)),
    lamp("stdillum-F1", "fluorescent, daylight", Lamp::Fluorescent(0)),
    lamp("stdillum-F2", "fluorescent, cool white", Lamp::Fluorescent(1)),
    lamp("stdillum-F3", "fluorescent, white", Lamp::Fluorescent(2)),
    lamp("stdillum-F4", "fluorescent, warm white", Lamp::Fluorescent(3)),
    lamp("stdillum-F5", "fluorescent, daylight", Lamp::Fluorescent(4)),
    lamp("stdillum-F6", "fluorescent, light white", Lamp::Fluorescent(5)),
    lamp("stdillum-F7", "fluorescent, like D65", Lamp::Fluorescent(6)),
    lamp("stdillum-F8", "fluorescent, like D50", Lamp::Fluorescent(7)),
    lamp("stdillum-F9", "fluorescent, cool white de luxe", Lamp::Fluorescent(8)),
    lamp("stdillum-F10", "fluorescent, three bands, 5000 K", Lamp::Fluorescent(9)),
    lamp("stdillum-F11", "fluorescent, three bands, 4000 K", Lamp::Fluorescent(10)),
    lamp("stdillum-F12", "fluorescent, three bands, 3000 K", Lamp::Fluorescent(11)),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::fresnel;
    use crate::spectrum::{Rgb, Spectrum};
    use std::collections::BTreeSet;

    #[test]
    fn every_name_is_there_once_and_gives_a_sensible_curve() {
        assert_eq!(NAMED.iter().map(|n| n.name).collect::<BTreeSet<_>>().len(), NAMED.len());
        for n in NAMED {
            let curve = n.curve();
            assert!((360..=830).all(|nm| (0.0..10.0).contains(&curve.at(nm as f32))), "{}", n.name);
            if n.is_lamp() {
                assert!((curve.luminance() - 1.0).abs() < 1e-5, "{}", n.name);
            }
            assert!(!(n.is_lamp() && n.ior().is_some()));
        }
        assert!(named("glass-BK7").and_then(Named::ior).is_some_and(|g| (g.d() - 1.5168).abs() < 1e-4));
        assert!(named("glass-BK8").is_none());
    }

    #[test]
    fn metals_have_their_colours() {
        let look = |metal: &str| {
            let [eta, k] = ["eta", "k"].map(|p| named(&format!("metal-{metal}-{p}")).unwrap().curve());
            let one = |nm: f32| fresnel::conductor(1.0, Spectrum::splat(eta.at(nm)), Spectrum::splat(k.at(nm))).hero();
            Curve::new(one).reflectance_rgb()
        };
        // Akenine-Möller et al. 2018, "Real-Time Rendering", table 9.2, clipped to 1; measurements differ by some percent.
        for (metal, want) in [
            ("Au", [1.00, 0.77, 0.34]),
            ("Ag", [0.97, 0.96, 0.92]),
            ("Cu", [0.96, 0.64, 0.54]),
            ("Al", [0.91, 0.92, 0.92]),
        ] {
            let got = look(metal);
            assert!((got - Rgb::from_array(want)).abs().max_element() < 0.07, "{metal}: {got}");
        }
    }

    #[test]
    fn lamps_have_the_chromaticity_that_the_cie_gives_them() {
        // CIE 15:2018, tables 3, 8.1 and 10.1: x, y.
        for (name, x, y) in [
            ("stdillum-A", 0.4476, 0.4074),
            ("stdillum-D50", 0.3457, 0.3585),
            ("stdillum-D65", 0.3127, 0.3290),
            ("stdillum-E", 0.3333, 0.3333),
            ("stdillum-F2", 0.3721, 0.3751),
            ("stdillum-F7", 0.3129, 0.3292),
            ("stdillum-F11", 0.3805, 0.3769),
        ] {
            let got = light::chromaticity(&named(name).unwrap().curve());
            assert!((got[0] - x).abs() < 6e-4 && (got[1] - y).abs() < 6e-4, "{name}: {got:?}");
        }
    }
}
