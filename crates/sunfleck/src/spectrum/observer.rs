//! The standard observer: how wavelengths look to the film, and what white is.
//!
//! A radiance that is 1 at every wavelength has luminance 1; [`Observer::d65`] is scaled to luminance 1 as well, and is
//! the film's white: linear sRGB (1, 1, 1).
use super::{
    NM_MAX, NM_MIN, Rgb,
    cie_tables::{D65, OBSERVER_1931},
    wavelengths::pdf_nm,
};
use glam::{DMat3, DVec3, Vec4};
use std::sync::OnceLock;

/// Whole nanometres from [`NM_MIN`] to [`NM_MAX`].
pub(super) const STEPS: usize = (NM_MAX - NM_MIN) as usize + 1;

/// Tables in steps of 1 nm from [`NM_MIN`].
pub(super) struct Observer {
    /// Matching functions of linear sRGB (1/nm) over the mean of four lanes' densities.
    film: Vec<Rgb>,
    /// Matching functions of linear sRGB, 1/nm; their sum times the D65 table is 1.
    pub(super) rgb: Vec<DVec3>,
    /// D65 of luminance 1.
    pub(super) d65: Vec<f32>,
}

/// The one observer, made on first use (some 20 µs).
#[inline]
pub(super) fn observer() -> &'static Observer {
    static OBSERVER: OnceLock<Observer> = OnceLock::new();
    OBSERVER.get_or_init(Observer::new)
}

/// Linear interpolation in a table of steps of 1 nm from [`NM_MIN`]; the ends hold beyond it.
#[inline]
pub(super) fn at_nm(table: &[f32], nm: f32) -> f32 {
    let (i, f) = place(nm);
    table[i] + f * (table[i + 1] - table[i])
}

/// Four lanes of [`at_nm`].
#[inline]
pub(super) fn at_lanes(table: &[f32], nm: Vec4) -> Vec4 {
    Vec4::from_array(nm.to_array().map(|nm| at_nm(table, nm)))
}

#[inline]
fn place(nm: f32) -> (usize, f32) {
    let x = (nm - NM_MIN).clamp(0.0, NM_MAX - NM_MIN);
    let i = (x as usize).min(STEPS - 2);
    (i, x - i as f32)
}

impl Observer {
    fn new() -> Self {
        // Steps of 5 nm to steps of 1 nm; the ends hold.
        let fine = |table: &dyn Fn(usize) -> f64, n: usize| -> Vec<f64> {
            let one = |i: usize| {
                let (k, f) = ((i / 5).min(n - 1), (i % 5) as f64 / 5.0);
                table(k) + f * (table((k + 1).min(n - 1)) - table(k))
            };
            (0..STEPS).map(one).collect()
        };
        let channel = |c: usize| fine(&|k| f64::from(OBSERVER_1931[k][c]), OBSERVER_1931.len());
        let (x, y, z) = (channel(0), channel(1), channel(2));
        let unit: f64 = y.iter().sum();
        let xyz: Vec<DVec3> = (0..STEPS).map(|i| DVec3::new(x[i], y[i], z[i]) / unit).collect();
        let d65 = fine(&|k| f64::from(D65[k]), D65.len());
        let luminance: f64 = xyz.iter().zip(&d65).map(|(w, d)| w.y * d).sum();
        let d65: Vec<f64> = d65.iter().map(|d| d / luminance).collect();
        let white = xyz.iter().zip(&d65).fold(DVec3::ZERO, |sum, (w, d)| sum + *w * *d);
        let rgb_from_xyz = rgb_from_xyz(white);
        let rgb: Vec<DVec3> = xyz.iter().map(|w| rgb_from_xyz * *w).collect();
        let film = |(i, w): (usize, &DVec3)| (*w / (4.0 * f64::from(pdf_nm(NM_MIN + i as f32)))).as_vec3();
        Self { film: rgb.iter().enumerate().map(film).collect(), rgb, d65: d65.into_iter().map(|d| d as f32).collect() }
    }
    /// What one lane of value 1 at `nm` adds to the film.
    #[inline]
    pub(super) fn film(&self, nm: f32) -> Rgb {
        let (i, f) = place(nm);
        self.film[i].lerp(self.film[i + 1], f)
    }
    /// The film's linear sRGB of a radiance given at each whole nanometre from [`NM_MIN`].
    pub(super) fn colour(&self, value: impl Fn(usize) -> f64) -> DVec3 {
        self.rgb.iter().enumerate().fold(DVec3::ZERO, |sum, (i, w)| sum + *w * value(i))
    }
}

/// To linear sRGB from XYZ, for the primaries of IEC 61966-2-1 and this white: white is exactly (1, 1, 1), whatever the
/// rounding of tables.
fn rgb_from_xyz(white: DVec3) -> DMat3 {
    let primary = |x: f64, y: f64| DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    let primaries = DMat3::from_cols(primary(0.64, 0.33), primary(0.3, 0.6), primary(0.15, 0.06));
    let scale = primaries.inverse() * white;
    (primaries * DMat3::from_diagonal(scale)).inverse()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn d65_is_white_and_of_luminance_one() {
        let o = observer();
        let white = o.colour(|i| f64::from(o.d65[i]));
        assert!((white - 1.0).abs().max_element() < 1e-6, "{white}");
        // An even spectrum is as bright and pinkish: sRGB of equal energy (CIE x = y = 1/3).
        let even = o.colour(|_| 1.0);
        let y = even.dot(DVec3::new(0.2126, 0.7152, 0.0722));
        assert!(
            (y - 1.0).abs() < 1e-3 && (even - DVec3::new(1.205, 0.948, 0.909)).abs().max_element() < 2e-3,
            "{even}"
        );
    }

    #[test]
    fn the_matrix_is_that_of_srgb() {
        // IEC 61966-2-1 for a D65 of x = 0.3127, y = 0.3290.
        let m = rgb_from_xyz(DVec3::new(0.3127 / 0.3290, 1.0, 0.3583 / 0.3290)).transpose();
        for (row, want) in [(m.x_axis, [3.2406, -1.5372, -0.4986]), (m.y_axis, [-0.9689, 1.8758, 0.0415])] {
            assert!((row - DVec3::from_array(want)).abs().max_element() < 1e-3, "{row}");
        }
    }
}
