//! White balance: what light the film takes for white.

use glam::{DMat3, DVec3, Mat3};

/// XYZ of linear sRGB (IEC 61966-2-1), column by column.
const XYZ_FROM_RGB: DMat3 = DMat3::from_cols(
    DVec3::new(0.412_456, 0.212_673, 0.019_334),
    DVec3::new(0.357_576, 0.715_152, 0.119_192),
    DVec3::new(0.180_438, 0.072_175, 0.950_304),
);
/// Cone responses of XYZ (Lam 1985, the Bradford transformation), column by column.
const LMS_FROM_XYZ: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);
/// Chromaticity of D65.
const D65: [f64; 2] = [0.312_71, 0.329_02];

/// What takes colours of light so that daylight of the temperature `kelvin` becomes white (von Kries 1902, in Bradford's
/// cone responses). Daylight as CIE 15 has it, from 4000 to 25000 K; beyond, that of the end.
pub(super) fn white_balance(kelvin: f64) -> Mat3 {
    let t = kelvin.clamp(4000.0, 25_000.0);
    let x = if t <= 7000.0 {
        -4.6070e9 / t.powi(3) + 2.9678e6 / t.powi(2) + 99.11 / t + 0.244_063
    } else {
        -2.0064e9 / t.powi(3) + 1.9018e6 / t.powi(2) + 247.48 / t + 0.237_040
    };
    let y = -3.0 * x * x + 2.87 * x - 0.275;
    let lms = |[x, y]: [f64; 2]| LMS_FROM_XYZ * DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    let gains = DMat3::from_diagonal(lms(D65) / lms([x, y]));
    let xyz = LMS_FROM_XYZ.inverse() * gains * LMS_FROM_XYZ;
    (XYZ_FROM_RGB.inverse() * xyz * XYZ_FROM_RGB).as_mat3()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn daylight_of_the_temperature_becomes_white_and_d65_stays() {
        assert!((white_balance(6504.0) * Vec3::ONE - 1.0).abs().max_element() < 2e-3);
        // Light of 4500 K is warmer than D65: what was white before turns blue.
        let seen = white_balance(4500.0) * Vec3::ONE;
        assert!(seen.z > 1.2 && seen.x < 0.95, "{seen}");
        // The chromaticity of D50 (0.3457, 0.3585) becomes a grey.
        let (x, y) = (0.3457, 0.3585);
        let rgb = XYZ_FROM_RGB.inverse() * DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
        let seen = white_balance(5003.0) * rgb.as_vec3();
        assert!((seen - seen.y).abs().max_element() < 5e-3, "{seen}");
    }
}
