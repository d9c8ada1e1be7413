//! `PixelFilter`, with the defaults of each version.

use super::directives::{Importer, unknown};
use super::params::{Found, Params};
use glam::Vec2;
use sunfleck::film::{Curve, Filter, MAX_FILTER_RADIUS};

const FILTERS: [&str; 5] = ["box", "gaussian", "mitchell", "sinc", "triangle"];

/// What pbrt does when the file says nothing.
pub(super) fn unsaid(is_version_3: bool) -> Filter {
    let gaussian = Filter::shaped(Curve::Gaussian { sigma: 0.5 }, Vec2::splat(1.5));
    gaussian.filter(|_| !is_version_3).unwrap_or_default()
}

impl Importer<'_> {
    pub(super) fn filter(&mut self, name: &str, params: &Params) -> Found<Filter> {
        if !FILTERS.contains(&name) {
            return Err(unknown(&params.at, "pixel filter", name, FILTERS));
        }
        let is_version_3 = self.picture.is_version_3;
        let number = |name, default: f32| params.number(name, f64::from(default)).map(|v| v as f32);
        let (curve, radius) = match name {
            "box" => (Curve::Box, 0.5),
            "triangle" => (Curve::Tent, 2.0),
            "mitchell" => (Curve::Cubic { b: number("B", 1.0 / 3.0)?, c: number("C", 1.0 / 3.0)? }, 2.0),
            "sinc" => (Curve::Lanczos { tau: number("tau", 3.0)? }, 4.0),
            // Version 3 has exp(−αx²) where version 4 has a standard deviation.
            _ if is_version_3 => (Curve::Gaussian { sigma: (0.5 / number("alpha", 2.0)?).sqrt() }, 2.0),
            _ => (Curve::Gaussian { sigma: number("sigma", 0.5)? }, 1.5),
        };
        let radius = Vec2::new(number("xradius", radius)?, number("yradius", radius)?);
        self.tell_unused(params);
        Filter::shaped(curve, radius).ok_or_else(|| {
            let range = format!("more than 0 and at most {MAX_FILTER_RADIUS} pixels");
            params.bad("pbrt::value", &format!("a filter's radii must be {range}, and its curve positive on the whole"))
        })
    }
}
