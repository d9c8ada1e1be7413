//! Indices of refraction of clear media, constant or by wavelength.
use super::{Curve, Spectrum, Wavelengths};
use glam::{DMat3, DVec3, Vec4};

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
    /// The formula of Cauchy that comes nearest to a measured curve between 400 and 700 nm (least squares); constant if the
    /// curve is.
    pub fn fitted(curve: &Curve) -> Self {
        let samples = || (400..=700).step_by(5).map(|nm| nm as f32);
        let first = curve.at(400.0);
        if samples().all(|nm| (curve.at(nm) - first).abs() < 1e-6) {
            return Self::Constant(first);
        }
        let (mut normal, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for nm in samples() {
            let x = 1e6 / f64::from(nm * nm);
            let row = DVec3::new(1.0, x, x * x);
            normal += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
            right += row * f64::from(curve.at(nm));
        }
        Self::Cauchy((normal.inverse() * right).as_vec3().to_array())
    }
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
    fn a_measured_curve_is_followed_by_its_fit() {
        let glass = Ior::Sellmeier { b: [1.7376, 0.3137, 1.8988, 0.0], c: [0.013_189, 0.062_307, 155.236, 0.0] };
        let fit = Ior::fitted(&Curve::new(|nm| glass.at_nm(nm)));
        for nm in [400.0, 450.0, 500.0, 587.6, 650.0, 700.0] {
            assert!((fit.at_nm(nm) - glass.at_nm(nm)).abs() < 1.5e-3, "{nm}: {} {}", fit.at_nm(nm), glass.at_nm(nm));
        }
        assert_eq!(Ior::fitted(&Curve::new(|_| 1.5)), Ior::Constant(1.5));
    }

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
