//! Iridescence: a clear film so thin that the light reflected above and below it interferes.
use super::{Lookup, Scalar, fresnel::f0_to_ior};
use crate::spectrum::{Rgb, Spectrum, Wavelengths, fringe};
use std::f32::consts::TAU;

/// A thin film on a surface: soap, oil, the wing of a beetle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmMaterial {
    /// Share in [0, 1] of the surface under the film.
    pub share: Scalar,
    /// Index of refraction of the film, 1 to 3.55, in steps of 0.01.
    pub ior: f32,
    /// Nanometres, up to 6500.
    pub thickness: Scalar,
}

/// A film at a hit, in twelve bytes: wavelengths are kept with it, in steps of 1/128 nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Film {
    /// Above 359 nm; all 0 for red, green and blue.
    lambda: [u16; 4],
    /// Tenths of a nanometre.
    thickness: u16,
    /// Hundredths above 1.
    ior: u8,
    share: u8,
}

/// Where the count of wavelengths begins, nm, and its steps to one.
const FIRST: f32 = 359.0;
const STEPS: f32 = 128.0;
/// Times that light goes to and fro in the film, at most, where channels are worked out.
const ORDERS: usize = 4;

impl Film {
    /// Nothing.
    pub(super) const NONE: Self = Self { lambda: [0; 4], thickness: 0, ior: 0, share: 0 };

    pub(super) fn new(material: &FilmMaterial, at: &Lookup) -> Self {
        let lambda = match at.lambda {
            Wavelengths::Rgb => [0; 4],
            Wavelengths::Spectral(nm) => nm.to_array().map(|nm| ((nm - FIRST) * STEPS).round() as u16),
        };
        Self {
            lambda,
            thickness: (10.0 * at.scalar(material.thickness)).round() as u16,
            ior: (100.0 * (material.ior - 1.0)).round() as u8,
            share: (255.0 * at.scalar(material.share)).round() as u8,
        }
    }
    #[inline]
    pub(super) fn is_there(&self) -> bool {
        self.share > 0
    }
    fn eta(&self) -> f32 {
        1.0 + 0.01 * f32::from(self.ior)
    }
    /// The most that the film lets a surface reflect along the normal, which without it reflects `f0`, over all thicknesses. Never
    /// less than `f0`: a film of half a wave is not seen.
    pub(super) fn most(&self, f0: Spectrum) -> Spectrum {
        if !self.is_there() {
            return f0;
        }
        let n2 = self.eta();
        let r12 = (1.0 - n2) / (1.0 + n2);
        f0.map(|f0| {
            let n3 = f0_to_ior(f0);
            let r23 = (n2 - n3) / (n2 + n3);
            let out_of_phase = ((r12 - r23) / (1.0 - r12 * r23)).powi(2);
            out_of_phase.max(f0)
        })
    }
    /// What the surface reflects at `cos` with the micronormal: `bare` where there is no film, and elsewhere what interference leaves
    /// of `f0`, but no more than `cap`.
    pub(super) fn over(&self, bare: Spectrum, f0: Spectrum, cap: Spectrum, cos: f32) -> Spectrum {
        if !self.is_there() {
            return bare;
        }
        let share = f32::from(self.share) / 255.0;
        let film = self.reflectance(f0, cos).zip(cap, f32::min);
        bare * (1.0 - share) + film * share
    }
    /// Airy's sum for unpolarised light (Born & Wolf 1999, section 7.6; in powers of what one round trip leaves, Belcour & Barla 2017,
    /// eqs. 6 to 8): exact for each wavelength. The base is taken as clear, of the index that reflects `f0` along the normal.
    fn reflectance(&self, f0: Spectrum, cos: f32) -> Spectrum {
        let n2 = self.eta();
        let sin2 = (1.0 - cos * cos).max(0.0);
        let cos2 = (1.0 - sin2 / (n2 * n2)).max(0.0).sqrt();
        // Difference of optical path, nm.
        let opd = 2.0 * n2 * 0.1 * f32::from(self.thickness) * cos2;
        let above = [(cos - n2 * cos2) / (cos + n2 * cos2), (n2 * cos - cos2) / (n2 * cos + cos2)];
        let lane = |f0: f32, sum: &dyn Fn(f32) -> f32| {
            let n3 = f0_to_ior(f0);
            let cos3 = (1.0 - sin2 / (n3 * n3)).max(0.0).sqrt();
            let below =
                [(n2 * cos2 - n3 * cos3) / (n2 * cos2 + n3 * cos3), (n3 * cos2 - n2 * cos3) / (n3 * cos2 + n2 * cos3)];
            let of = |r12: f32, r23: f32| {
                // Left of an amplitude by a round trip, and of power by the way in and out.
                let (x, t) = (-r12 * r23, 1.0 - r12 * r12);
                let even = if x * x < 1.0 { t * t * r23 * r23 / (1.0 - x * x) } else { 0.0 };
                r12 * r12 + even + (even - t) * sum(x)
            };
            (0.5 * (of(above[0], below[0]) + of(above[1], below[1]))).clamp(0.0, 1.0)
        };
        let f0 = f0.lanes();
        if self.lambda == [0; 4] {
            let orders: [Rgb; ORDERS] = std::array::from_fn(|m| fringe((m + 1) as f32 * opd));
            let channel =
                |c: usize| lane(f0[c], &|x| orders.iter().rev().fold(0.0, |sum, fringe| x * (sum + 2.0 * fringe[c])));
            let [r, g, b] = [0, 1, 2].map(channel);
            return Spectrum::from_lanes([r, g, b, r.min(g).min(b)]);
        }
        Spectrum::from_lanes(std::array::from_fn(|i| {
            let phase = TAU * opd / (FIRST + f32::from(self.lambda[i]) / STEPS);
            // Σ 2 xᵐ cos mφ, all of it.
            lane(f0[i], &|x| (1.0 - x * x) / (1.0 - 2.0 * x * phase.cos() + x * x).max(1e-12) - 1.0)
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::ColorMode;
    use glam::{Vec2, Vec3, Vec4};

    fn film(nm: f32, ior: f32, lambda: Wavelengths) -> Film {
        let material = FilmMaterial { share: 1.0.into(), ior, thickness: nm.into() };
        Film::new(&material, &Lookup::new(&[], Vec2::ZERO, Vec3::ZERO, lambda))
    }

    fn at(nm: f32) -> Wavelengths {
        Wavelengths::Spectral(Vec4::splat(nm))
    }

    #[test]
    fn films_of_no_and_of_half_a_wave_are_not_seen_and_a_quarter_can_take_all_away() {
        for (f0, ior) in [(0.04, 1.3), (0.5, 1.8), (0.9, 2.5)] {
            for thickness in [0.0, 600.0 / (2.0 * ior)] {
                let seen = film(thickness, ior, at(600.0)).reflectance(Spectrum::splat(f0), 1.0).hero();
                assert!((seen - f0).abs() < 2e-3, "{f0} {ior} {thickness}: {seen}");
            }
        }
        // Of the square root of the base's index, as on lenses: 1.5 on 2.25.
        let f0 = (1.25f32 / 3.25).powi(2);
        let coated = film(100.0, 1.5, at(600.0)).reflectance(Spectrum::splat(f0), 1.0).hero();
        assert!(coated < 1e-4, "{coated}");
        let most = film(100.0, 1.8, at(600.0)).most(Spectrum::splat(0.04)).hero();
        let reached = film(600.0 / (4.0 * 1.8), 1.8, at(600.0)).reflectance(Spectrum::splat(0.04), 1.0).hero();
        assert!((most - reached).abs() < 2e-3, "{most} {reached}");
    }

    #[test]
    fn channels_see_what_all_wavelengths_together_show() {
        for (thickness, f0, cos) in [(300.0, 0.04, 1.0), (420.0, 0.3, 0.7), (700.0, 0.6, 0.4)] {
            let rgb =
                film(thickness, 1.6, Wavelengths::Rgb).reflectance(Spectrum::splat(f0), cos).to_rgb(Wavelengths::Rgb);
            let passes = 256;
            let mean = (0..passes).fold(Vec3::ZERO, |sum, pass| {
                let lambda = ColorMode::Spectral.wavelengths(1, pass);
                let lit = film(thickness, 1.6, lambda).reflectance(Spectrum::splat(f0), cos);
                sum + (lit * Spectrum::emission(Vec3::ONE, lambda)).to_rgb(lambda)
            }) / passes as f32;
            assert!((rgb - mean).abs().max_element() < 0.01, "{thickness} {f0} {cos}: {rgb} {mean}");
        }
    }

    #[test]
    fn films_are_small() {
        assert_eq!(size_of::<Film>(), 12);
    }
}
