//! Daylight: the sky of Preetham, Shirley & Smits 1999, "A Practical Analytic Model for Daylight", and the sun through the
//! same air. Directions have y up, north at -z and east at x.
//!
//! Values are luminances over 683 lm/W and the 106.86 nm under the eye's response curve: radiance in W/(m²·sr·nm), as
//! Mitsuba's `sunsky` has it (which follows the model of Hosek & Wilkie, in colours a little different).

use glam::{DVec3, Mat3, Vec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use sunfleck::spectrum::{Curve, Illuminant};
use sunfleck::texture::{ImageTexture, Wrap};

/// From cd/m² to the units of this room.
const PER_CANDELA: f64 = 1.0 / (683.0 * 106.86);
/// Illuminance of the sun outside of the air, lux (CIE 1978, "luminous solar constant").
const SUN: f64 = 128_000.0;
const SUN_KELVIN: f64 = 5778.0;

const COLUMNS: usize = 512;
const ROWS: usize = 256;

/// A place and a time.
pub(super) struct Moment {
    /// Degrees, north positive.
    pub(super) latitude: f64,
    /// Degrees, east positive.
    pub(super) longitude: f64,
    /// Hours ahead of Greenwich.
    pub(super) timezone: f64,
    /// Year, month and day, both from 1.
    pub(super) date: [i64; 3],
    /// Local time, hours.
    pub(super) hour: f64,
}

/// Where the sun is (Preetham et al. 1999, appendix A.6): right within about half a degree.
pub(super) fn sun_at(moment: &Moment) -> Vec3 {
    let [year, month, day] = moment.date;
    let leap = i64::from(month > 2 && (year % 4 == 0 && year % 100 != 0 || year % 400 == 0));
    let before = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];
    let j = (before[(month.clamp(1, 12) - 1) as usize] + day + leap) as f64;
    let equation = 0.170 * (4.0 * PI * (j - 80.0) / 373.0).sin() - 0.129 * (TAU * (j - 8.0) / 355.0).sin();
    let solar_hour = moment.hour + equation + moment.longitude / 15.0 - moment.timezone;
    let (sin_d, cos_d) = (0.4093 * (TAU * (j - 81.0) / 368.0).sin()).sin_cos();
    let (sin_h, cos_h) = ((solar_hour - 12.0) * PI / 12.0).sin_cos();
    let (sin_l, cos_l) = moment.latitude.to_radians().sin_cos();
    let (east, north) = (-cos_d * sin_h, cos_l * sin_d - sin_l * cos_d * cos_h);
    let up = sin_l * sin_d + cos_l * cos_d * cos_h;
    DVec3::new(east, up, -north).as_vec3()
}

/// The sky over a sun in the unit direction `sun` in air of some turbidity (1 to 10; 3 is clear), in longitude and
/// latitude; nothing below the horizon. `None` while the sun is down.
pub(super) fn panorama(sun: Vec3, turbidity: f64) -> Option<ImageTexture> {
    let sun = sun.as_dvec3();
    if sun.y <= 0.0 {
        return None;
    }
    let air = Air::new(turbidity, sun.y.acos());
    let pixel = |i: usize| {
        let theta = PI * ((i / COLUMNS) as f64 + 0.5) / ROWS as f64;
        let phi = TAU * ((i % COLUMNS) as f64 + 0.5) / COLUMNS as f64 - PI;
        let d = DVec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
        if theta < FRAC_PI_2 { air.colour(theta, d.dot(sun).clamp(-1.0, 1.0)) } else { Vec3::ZERO }
    };
    ImageTexture::new(COLUMNS, ROWS, (0..COLUMNS * ROWS).map(pixel).collect(), Wrap::Repeat)
}

/// The coefficients of one turbidity and one height of the sun.
struct Air {
    /// Perez's A to E for luminance Y and chromaticities x and y.
    perez: [[f64; 5]; 3],
    /// Y (cd/m²), x and y at the zenith over what Perez's function gives there.
    zenith: [f64; 3],
}

impl Air {
    fn new(t: f64, theta_sun: f64) -> Self {
        // Appendix A.2.
        let linear = |rows: [[f64; 2]; 5]| rows.map(|[slope, constant]| slope * t + constant);
        let perez = [
            linear([[0.1787, -1.4630], [-0.3554, 0.4275], [-0.0227, 5.3251], [0.1206, -2.5771], [-0.0670, 0.3703]]),
            linear([[-0.0193, -0.2592], [-0.0665, 0.0008], [-0.0004, 0.2125], [-0.0641, -0.8989], [-0.0033, 0.0452]]),
            linear([[-0.0167, -0.2608], [-0.0950, 0.0092], [-0.0079, 0.2102], [-0.0441, -1.6537], [-0.0109, 0.0529]]),
        ];
        let s = theta_sun;
        let cubic = |rows: [[f64; 4]; 3]| {
            let row = |c: [f64; 4]| ((c[0] * s + c[1]) * s + c[2]) * s + c[3];
            (row(rows[0]) * t + row(rows[1])) * t + row(rows[2])
        };
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * s);
        let at_zenith = [
            1000.0 * ((4.0453 * t - 4.9710) * chi.tan() - 0.2155 * t + 2.4192).max(0.0),
            cubic([
                [0.00166, -0.00375, 0.00209, 0.0],
                [-0.02903, 0.06377, -0.03202, 0.00394],
                [0.11693, -0.21196, 0.06052, 0.25886],
            ]),
            cubic([
                [0.00275, -0.00610, 0.00317, 0.0],
                [-0.04214, 0.08970, -0.04153, 0.00516],
                [0.15346, -0.26756, 0.06670, 0.26688],
            ]),
        ];
        let zenith = std::array::from_fn(|i| at_zenith[i] / distribution(&perez[i], 1.0, s.cos()));
        Self { perez, zenith }
    }

    /// Linear sRGB at the angle `theta` from the zenith, where `cos_gamma` is the cosine of the angle to the sun.
    fn colour(&self, theta: f64, cos_gamma: f64) -> Vec3 {
        let value = |i: usize| self.zenith[i] * distribution(&self.perez[i], theta.cos().max(1e-3), cos_gamma);
        let (luminance, x, y) = (value(0).max(0.0) * PER_CANDELA, value(1), value(2).max(1e-3));
        let xyz = luminance / y * DVec3::new(x, y, 1.0 - x - y);
        // IEC 61966-2-1.
        let rgb_from_xyz = Mat3::from_cols_array(&[
            3.240_97, -0.969_244, 0.055_630, -1.537_383, 1.875_968, -0.203_977, -0.498_611, 0.041_555, 1.056_972,
        ]);
        (rgb_from_xyz * xyz.as_vec3()).max(Vec3::ZERO)
    }
}

/// Perez's function of the sky (Perez et al. 1993), equation 3.
fn distribution([a, b, c, d, e]: &[f64; 5], cos_theta: f64, cos_gamma: f64) -> f64 {
    let gamma = cos_gamma.acos();
    (1.0 + a * (b / cos_theta).exp()) * (1.0 + c * (d * gamma).exp() + e * cos_gamma * cos_gamma)
}

/// Irradiance of the sun's light across its direction, in the units of this room, after air molecules and haze have scattered
/// some of it away (appendix A.1; ozone and water, some percent, are left out). `None` while the sun is down.
pub(super) fn sunlight(sun: Vec3, turbidity: f64) -> Option<Illuminant> {
    let cos = f64::from(sun.y);
    if cos <= 0.0 {
        return None;
    }
    let mass = 1.0 / (cos + 0.15 * (93.885 - cos.acos().to_degrees()).powf(-1.253));
    let haze = (0.04608 * turbidity - 0.04586).max(0.0);
    let planck = |nm: f32| {
        let m = f64::from(nm) * 1e-9;
        (1e-30 / (m.powi(5) * ((1.438_776_877e-2 / (m * SUN_KELVIN)).exp() - 1.0))) as f32
    };
    let whole = Curve::new(planck);
    let seen = Curve::new(|nm| {
        let um = f64::from(nm) * 1e-3;
        let passed = (-mass * (0.008_735 * um.powf(-4.08) + haze * um.powf(-1.3))).exp();
        whole.at(nm) * passed as f32
    });
    let scale = SUN * PER_CANDELA / f64::from(whole.luminance());
    Some(Illuminant::spectrum(seen.scaled(scale as f32)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sun_stands_where_almanacs_say() {
        let at =
            |date, latitude, hour| sun_at(&Moment { latitude, longitude: 0.0, timezone: 0.0, date, hour }).as_dvec3();
        // At the solstice the noon sun is overhead at 23.4 degrees north; at the equinox it rises in the east.
        assert!(at([2021, 6, 21], 23.44, 12.03).y > 0.9999);
        let rising = at([2021, 3, 20], 0.0, 6.13);
        assert!(rising.x > 0.999 && rising.y.abs() < 0.02, "{rising}");
        let noon = at([2021, 12, 21], 51.5, 11.97);
        assert!((noon.y.asin().to_degrees() - 15.1).abs() < 0.5 && noon.z > 0.9, "{noon}");
    }

    #[test]
    fn a_clear_sky_gives_what_is_measured_on_clear_days() {
        // Sun at 45 degrees, turbidity 3: some 10 to 35 klx from the sky, haze around the sun included, and 60 to 100 klx
        // across the sun's rays.
        let sun = Vec3::new(0.0, 1.0, -1.0).normalize();
        let map = panorama(sun, 3.0).unwrap();
        let mut sum = 0.0;
        for i in 0..COLUMNS * ROWS / 2 {
            let theta = PI * ((i / COLUMNS) as f64 + 0.5) / ROWS as f64;
            let solid = TAU / COLUMNS as f64 * PI / ROWS as f64 * theta.sin();
            let y = map.pixel(i % COLUMNS, i / COLUMNS).dot(Vec3::new(0.2126, 0.7152, 0.0722));
            sum += f64::from(y) / PER_CANDELA * theta.cos() * solid;
        }
        assert!((10_000.0..35_000.0).contains(&sum), "{sum} lx");
        let direct = sunlight(sun, 3.0).unwrap().rgb().dot(Vec3::new(0.2126, 0.7152, 0.0722));
        let direct = f64::from(direct) / PER_CANDELA;
        assert!((60_000.0..105_000.0).contains(&direct), "{direct} lx");
        let zenith = map.pixel(0, 0);
        // Appendix A.2 by hand: 7.32 kcd/m².
        let luminance = f64::from(zenith.dot(Vec3::new(0.2126, 0.7152, 0.0722))) / PER_CANDELA;
        assert!((luminance / 7320.0 - 1.0).abs() < 0.02, "{luminance}");
        assert!(zenith.z > 1.5 * zenith.x, "not blue: {zenith}");
        assert!(panorama(-sun, 3.0).is_none() && sunlight(-sun, 3.0).is_none());
    }
}
