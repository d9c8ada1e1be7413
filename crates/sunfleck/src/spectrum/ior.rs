//! Indices of refraction of clear media, constant or by wavelength.
use super::{Spectrum, Wavelengths};
use glam::Vec4;

/// An index of refraction. With two or more wavelengths of different index, a boundary parts the colours of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ior {
    /// The same at every wavelength.
    Constant(f32),
    /// `a + b/λ² + c/λ⁴`, λ in µm (Cauchy 1836).
    Cauchy([f32; 3]),
    /// `n² = 1 + Σ bᵢ λ²/(λ² − cᵢ)`, λ in µm, c in µm² (Sellmeier 1871). Terms not needed have b = c = 0.
    Sellmeier {
        /// Strengths of the resonances.
        b: [f32; 4],
        /// Squares of their wavelengths, µm².
        c: [f32; 4],
    },
}

/// Fraunhofer's d line of helium, nm: where an index of refraction is given if nothing else is said.
const D_LINE: f32 = 587.56;

impl From<f32> for Ior {
    fn from(eta: f32) -> Self {
        Self::Constant(eta)
    }
}

impl Ior {
    /// Whether the index changes with the wavelength.
    #[inline]
    pub fn is_dispersive(&self) -> bool {
        !matches!(self, Self::Constant(_))
    }
    /// The index at `nm`.
    pub fn at_nm(&self, nm: f32) -> f32 {
        self.lanes(Vec4::splat(nm)).x
    }
    /// The index for yellow light, at the d line (587.6 nm).
    pub fn d(&self) -> f32 {
        self.at_nm(D_LINE)
    }
    /// Abbe's number `(n_d − 1)/(n_F − n_C)`: the smaller, the more dispersion. Infinite if there is none.
    pub fn abbe(&self) -> f32 {
        (self.d() - 1.0) / (self.at_nm(486.13) - self.at_nm(656.27))
    }
    /// The index at `lambda`; in RGB mode that of the d line.
    #[inline]
    pub fn at(&self, lambda: Wavelengths) -> Spectrum {
        match (self, lambda) {
            (Self::Constant(eta), _) => Spectrum::splat(*eta),
            (_, Wavelengths::Rgb) => Spectrum::splat(self.d()),
            (_, Wavelengths::Spectral(nm)) => Spectrum(self.lanes(nm)),
        }
    }
    fn lanes(&self, nm: Vec4) -> Vec4 {
        let l2 = (nm * nm) * 1e-6;
        match self {
            Self::Constant(eta) => Vec4::splat(*eta),
            Self::Cauchy([a, b, c]) => *a + (*b + *c / l2) / l2,
            Self::Sellmeier { b, c } => {
                let n2 = b.iter().zip(c).fold(Vec4::ONE, |n2, (b, c)| n2 + *b * l2 / (l2 - *c));
                Vec4::from_array(n2.max(Vec4::ZERO).to_array().map(f32::sqrt))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_index_is_the_same_by_lanes_and_by_one_wavelength() {
        let glass = Ior::Cauchy([1.5, 0.004, 0.0001]);
        let lanes = glass.at(Wavelengths::Spectral(Vec4::new(400.0, 500.0, 600.0, 700.0))).lanes();
        for (nm, got) in [400.0f32, 500.0, 600.0, 700.0].into_iter().zip(lanes) {
            let um = nm * 1e-3;
            assert!((got - (1.5 + 0.004 / (um * um) + 0.0001 / um.powi(4))).abs() < 1e-6);
            assert_eq!(got, glass.at_nm(nm));
        }
        assert_eq!(glass.at(Wavelengths::Rgb), Spectrum::splat(glass.d()));
        assert_eq!(Ior::from(1.5).at(Wavelengths::Rgb), Spectrum::splat(1.5));
        assert!(glass.is_dispersive() && !Ior::from(1.5).is_dispersive() && Ior::from(1.5).abbe().is_infinite());
    }
}
