//! Which wavelengths a pass carries, and how they are drawn.
use super::observer::observer;
use crate::sampler::pass_turn;
use glam::Vec4;

/// What the lanes of a [`super::Spectrum`] stand for. Drawn once per pass, so that photons and camera paths can meet.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Wavelengths {
    /// Linear sRGB in lanes 0..3.
    #[default]
    Rgb,
    /// Four wavelengths in nanometres, each within [`NM_MIN`] and [`NM_MAX`]. Lane 0 is the *hero*: where wavelengths part,
    /// the path follows it (Wilkie et al. 2014, "Hero Wavelength Spectral Sampling").
    Spectral(Vec4),
}

impl Wavelengths {
    /// Which of the two ways of carrying colours this is.
    pub fn mode(&self) -> ColorMode {
        match self {
            Self::Rgb => ColorMode::Rgb,
            Self::Spectral(_) => ColorMode::Spectral,
        }
    }
}

/// Whether colours are carried as RGB or by wavelength.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ColorMode {
    /// Red, green and blue; the fastest.
    #[default]
    Rgb,
    /// Wavelengths: dispersion, measured metals and lamps.
    Spectral,
}

/// Shortest wavelength carried, nm.
pub const NM_MIN: f32 = 360.0;
/// Longest wavelength carried, nm.
pub const NM_MAX: f32 = 830.0;

/// Sharpness (1/nm) and centre (nm) of the density of wavelengths.
const SHARPNESS: f32 = 0.0072;
const CENTRE: f32 = 538.0;

impl ColorMode {
    /// The wavelengths of pass `pass`: a pure function of (seed, pass).
    ///
    /// The four lanes are a quarter of the distribution apart. Over passes, all lanes together are even steps over the
    /// spectrum from the fourth pass on, and the hero alone from the sixteenth on (at powers of two).
    pub fn wavelengths(self, seed: u64, pass: u64) -> Wavelengths {
        match self {
            Self::Rgb => Wavelengths::Rgb,
            Self::Spectral => {
                let hero = pass_turn(seed, pass);
                let lanes = (Vec4::splat(hero) + Vec4::new(0.0, 0.25, 0.5, 0.75)).to_array();
                Wavelengths::Spectral(Vec4::from_array(lanes.map(|u| sample_nm(u.fract()))))
            }
        }
    }
    /// The mode's word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rgb => "rgb",
            Self::Spectral => "spectral",
        }
    }
}

/// `tanh` at both ends of the range, and their difference.
fn ends() -> (f32, f32) {
    let (low, high) = ((SHARPNESS * (NM_MIN - CENTRE)).tanh(), (SHARPNESS * (NM_MAX - CENTRE)).tanh());
    (low, high - low)
}

/// A wavelength (nm) for `u` in [0, 1), in proportion to `sech²`, which follows what the eye responds to (Radziszewski,
/// Boryczko & Alda 2009, "An Improved Technique for Full Spectral Rendering").
fn sample_nm(u: f32) -> f32 {
    let (low, span) = ends();
    (CENTRE + (low + u * span).atanh() / SHARPNESS).clamp(NM_MIN, NM_MAX)
}

/// Density (1/nm) of the wavelengths drawn by [`ColorMode::wavelengths`], each lane by itself.
pub(super) fn pdf_nm(nm: f32) -> f32 {
    let (_, span) = ends();
    SHARPNESS / (span * (SHARPNESS * (nm - CENTRE)).cosh().powi(2))
}

/// The film's linear sRGB of lanes `v` at the wavelengths `nm`: the mean over lanes of `v·r̄ḡb̄(λ)/pdf(λ)`.
#[inline]
pub(super) fn to_film(v: Vec4, nm: Vec4) -> super::Rgb {
    let o = observer();
    v.to_array().into_iter().zip(nm.to_array()).fold(super::Rgb::ZERO, |sum, (v, nm)| sum + v * o.film(nm))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wavelengths_follow_their_density() {
        // The share below each wavelength, by summing the density, against the inverse of the sampling.
        let (mut share, mut i) = (0.0f64, 0);
        for nm in 360..830 {
            share += f64::from(pdf_nm(nm as f32 + 0.5));
            i += 1;
            let back = sample_nm((share as f32).min(1.0));
            assert!((back - (nm + 1) as f32).abs() < 0.05, "{nm}: {back}");
        }
        assert!(i == 470 && (share - 1.0).abs() < 1e-5, "{share}");
    }

    #[test]
    fn few_passes_cover_the_spectrum_with_all_lanes_and_with_the_hero_alone() {
        let (low, span) = ends();
        let place = |nm: f32| (((nm - CENTRE) * SHARPNESS).tanh() - low) / span;
        // The largest gap between neighbours on the circle, times their number.
        let gap = |mut u: Vec<f32>| {
            u.sort_by(f32::total_cmp);
            let gaps = u.iter().zip(u.iter().cycle().skip(1)).map(|(a, b)| (b - a).rem_euclid(1.0));
            u.len() as f32 * gaps.fold(0.0, f32::max)
        };
        for seed in 0..20 {
            for first in [0u64, 16, 1008] {
                let lanes = |passes: u64, lanes: usize| -> Vec<f32> {
                    (first..first + passes)
                        .flat_map(|pass| match ColorMode::Spectral.wavelengths(seed, pass) {
                            Wavelengths::Spectral(nm) => nm.to_array().into_iter().take(lanes).map(place),
                            Wavelengths::Rgb => unreachable!("spectral mode"),
                        })
                        .collect()
                };
                assert!(gap(lanes(4, 4)) < 1.01, "seed {seed} from {first}");
                assert!(gap(lanes(16, 1)) < 1.01, "seed {seed} from {first}");
                assert!(gap(lanes(4, 1)) < 2.1, "seed {seed} from {first}");
            }
        }
        let heroes: Vec<f32> = (0..256)
            .map(|pass| match ColorMode::Spectral.wavelengths(1, pass) {
                Wavelengths::Spectral(nm) => place(nm.x),
                Wavelengths::Rgb => unreachable!("spectral mode"),
            })
            .collect();
        assert!(gap(heroes) < 1.05);
    }

    #[test]
    fn a_pass_has_wavelengths_of_its_own_and_a_seed_moves_them() {
        let of = |seed, pass| ColorMode::Spectral.wavelengths(seed, pass);
        assert_eq!(of(1, 5), of(1, 5));
        assert!(of(1, 5) != of(1, 6) && of(1, 5) != of(2, 5));
        assert_eq!(ColorMode::Rgb.wavelengths(1, 5), Wavelengths::Rgb);
    }
}
