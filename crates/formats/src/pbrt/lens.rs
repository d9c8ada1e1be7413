//! The barrel of lenses of pbrt's `realistic` camera, as one thin lens.

use super::cameras::focused;
use super::params::{Found, Params};
use super::picture::Film;
use crate::load::CameraSettings;
use glam::{DAffine3, DVec2, DVec3};

/// Metres in the millimetres that lens files and films are measured in.
const MM: f64 = 1e-3;

/// What a barrel comes down to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Barrel {
    /// Focal length, millimetres.
    focal_length: f64,
    /// Diameter of its stop, millimetres, if the file tells.
    stop: Option<f64>,
}

impl Default for Barrel {
    fn default() -> Self {
        Self { focal_length: 50.0, stop: None }
    }
}

impl Barrel {
    /// From the text of a lens file: a surface a line, front first, as radius of curvature, distance to the next one, index
    /// behind it and diameter. Follows a ray near the axis (`n' u' = n u − y (n' − n) / R`).
    pub(super) fn read(text: &str) -> Option<Self> {
        let numbers: Option<Vec<f64>> = text
            .lines()
            .map(|line| line.split('#').next().unwrap_or_default())
            .flat_map(str::split_whitespace)
            .map(|word| word.parse::<f64>().ok().filter(|x| x.is_finite()))
            .collect();
        let (surfaces, []) = numbers.as_deref()?.as_chunks::<4>() else { return None };
        let (mut height, mut slope, mut index) = (1.0, 0.0, 1.0);
        let mut stop = None;
        for &[radius, thickness, behind, diameter] in surfaces {
            let behind = if behind == 0.0 { 1.0 } else { behind };
            if radius == 0.0 {
                stop = Some(diameter);
            } else {
                slope = (index * slope - height * (behind - index) / radius) / behind;
                index = behind;
            }
            height += thickness * slope;
        }
        // A ray that came in at height 1 crosses the axis at the focus.
        let focal_length = -1.0 / slope;
        (focal_length > 0.0 && focal_length.is_finite()).then_some(Self { focal_length, stop })
    }

    /// The camera with a thin lens in its place. Camera space is in metres.
    pub(super) fn settings(&self, params: &Params, film: &Film, world_from_camera: DAffine3) -> Found<CameraSettings> {
        let diameter = params.number("aperturediameter", 1.0)?;
        let aperture = self.stop.map_or(diameter, |stop| diameter.min(stop)) * MM;
        let focus = params.number("focusdistance", 10.0)?;
        let focal_length = self.focal_length * MM;
        if !(aperture > 0.0 && focus > 1.01 * focal_length) {
            return Err(params.bad("pbrt::value", "the lens needs an aperture, and a focus beyond its focal length"));
        }
        // 1/f = 1/s + 1/s'.
        let film_distance = focal_length * focus / (focus - focal_length);
        let [width, height] = film.size.map(f64::from);
        let corner = DVec2::new(width, height) / width.hypot(height) * (0.5 * film.diagonal * MM / film_distance);
        // A window at unit distance is that of a field of 90 degrees.
        let settings = film.look(world_from_camera, [-corner, corner], Some(90.0));
        let scale = world_from_camera.transform_vector3(DVec3::Z).length();
        Ok(focused(settings, (aperture * scale) as f32, (focus * scale) as f32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_focal_length_is_that_of_the_lensmaker() {
        // A thick lens of glass: 1/f = (n − 1)(1/R1 − 1/R2 + (n − 1)d / (n R1 R2)).
        let (r1, r2, n, d) = (50.0f64, -70.0f64, 1.5f64, 8.0f64);
        let text = format!("# a lens\n{r1} {d} {n} 20\n{r2} 4 1 20\n0 3 0 5 # the stop\n");
        let barrel = Barrel::read(&text).unwrap();
        let power = (n - 1.0) * (1.0 / r1 - 1.0 / r2 + (n - 1.0) * d / (n * r1 * r2));
        assert!((barrel.focal_length * power - 1.0).abs() < 1e-12, "{barrel:?}");
        assert_eq!(barrel.stop, Some(5.0));
        for bad in ["", "1 2 3", "a b c d", "0 1 0 5", "-50 8 1.5 20"] {
            assert_eq!(Barrel::read(bad), None, "{bad}");
        }
    }
}
