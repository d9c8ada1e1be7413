//! Which wavelengths a pass carries, and how they are drawn.
use super::observer::observer;
use crate::sampler::pass_pair;
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
    /// The four lanes are a quarter of the distribution apart. From pass to pass their common offset walks a lattice
    /// (so 2ᵏ passes are 4·2ᵏ even steps over the spectrum) and the hero walks the quarters so that alone, too, it is even.
    pub fn wavelengths(self, seed: u64, pass: u64) -> Wavelengths {
        match self {
            Self::Rgb => Wavelengths::Rgb,
            Self::Spectral => {
                let u = pass_pair(seed, pass);
                let hero = 0.25 * ((4.0 * u.y).floor() + u.x);
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
        for seed in 0..20 {
            for first in [0u64, 16, 1008] {
                let (mut all, mut hero) = ([0; 64], [0; 16]);
                for pass in first..first + 16 {
                    let Wavelengths::Spectral(nm) = ColorMode::Spectral.wavelengths(seed, pass) else { unreachable!() };
                    let (low, span) = ends();
                    let place = |nm: f32| (((nm - CENTRE) * SHARPNESS).tanh() - low) / span;
                    nm.to_array().iter().for_each(|&nm| all[(64.0 * place(nm)) as usize % 64] += 1);
                    hero[(16.0 * place(nm.x)) as usize % 16] += 1;
                }
                assert!(all.iter().all(|&n| n <= 2), "seed {seed} from {first}: {all:?}");
                assert!(hero.iter().all(|&n| n <= 3), "seed {seed} from {first}: {hero:?}");
                assert!(hero.iter().filter(|&&n| n == 0).count() <= 6, "seed {seed} from {first}: {hero:?}");
            }
        }
    }

    #[test]
    fn a_pass_has_wavelengths_of_its_own_and_a_seed_moves_them() {
        let of = |seed, pass| ColorMode::Spectral.wavelengths(seed, pass);
        assert_eq!(of(1, 5), of(1, 5));
        assert!(of(1, 5) != of(1, 6) && of(1, 5) != of(2, 5));
        assert_eq!(ColorMode::Rgb.wavelengths(1, 5), Wavelengths::Rgb);
    }
}
