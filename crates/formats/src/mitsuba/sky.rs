//! Daylight: the sky of Hosek & Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance", as Mitsuba has it, and the
//! sun through the air of Preetham, Shirley & Smits 1999, "A Practical Analytic Model for Daylight". Directions have y up, north
//! at -z and east at x.
//!
//! Values are luminances over 683 lm/W and the 106.86 nm under the eye's response curve: radiance in W/(m²·sr·nm), Mitsuba's.

use glam::{DVec3, Vec3};
use hw_skymodel::rgb::{Channel, SkyParams, SkyState};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use sunfleck::spectrum::{Curve, Illuminant};
use sunfleck::texture::{ImageTexture, Wrap};

/// nm under the eye's response curve.
const EYE: f64 = 106.86;
/// From cd/m² to the units of this room.
const PER_CANDELA: f64 = 1.0 / (683.0 * EYE);
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

/// The sky over a sun in the unit direction `sun`, in air of some turbidity (1 to 10; 3 is clear) over ground of an albedo, in
/// longitude and latitude; nothing below the horizon. `None` while the sun is down.
pub(super) fn panorama(sun: Vec3, turbidity: f64, ground: Vec3) -> Option<ImageTexture> {
    if sun.y <= 0.0 {
        return None;
    }
    let elevation = sun.y.asin().clamp(0.0, std::f32::consts::FRAC_PI_2);
    let albedo = ground.clamp(Vec3::ZERO, Vec3::ONE).to_array();
    let sky = SkyState::new(&SkyParams { elevation, turbidity: turbidity.clamp(1.0, 10.0) as f32, albedo }).ok()?;
    let pixel = |i: usize| {
        let theta = PI * ((i / COLUMNS) as f64 + 0.5) / ROWS as f64;
        let phi = TAU * ((i % COLUMNS) as f64 + 0.5) / COLUMNS as f64 - PI;
        let d = DVec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
        if theta >= FRAC_PI_2 {
            return Vec3::ZERO;
        }
        let gamma = d.dot(sun.as_dvec3()).clamp(-1.0, 1.0).acos();
        let value = |c| sky.radiance(theta as f32, gamma as f32, c).max(0.0) / EYE as f32;
        Vec3::new(value(Channel::R), value(Channel::G), value(Channel::B))
    };
    ImageTexture::new(COLUMNS, ROWS, (0..COLUMNS * ROWS).map(pixel).collect(), Wrap::Repeat)
}

/// Irradiance of the sun's light across its direction, in the units of this room, after air molecules and haze have scattered
/// some of it away (Preetham et al. 1999, appendix A.1; ozone and water, some percent, are left out). `None` while the sun is down.
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
        let map = panorama(sun, 3.0, Vec3::splat(0.3)).unwrap();
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
        assert!(panorama(sun, 3.0, Vec3::ONE).unwrap().pixel(0, 0).y > 1.05 * zenith.y, "the ground lights the air");
        assert!(zenith.z > 1.5 * zenith.x, "not blue: {zenith}");
        assert!(panorama(-sun, 3.0, Vec3::ZERO).is_none() && sunlight(-sun, 3.0).is_none());
    }
}
