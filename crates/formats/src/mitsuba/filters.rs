//! `rfilter`: how a pixel sees the picture's plane.

use super::document::Found;
use super::scene::Importer;
use glam::Vec2;
use sunfleck::film::{Curve, Filter, MAX_FILTER_RADIUS};

const FILTERS: [&str; 7] = ["box", "catmullrom", "gaussian", "lanczos", "mitchell", "tent", "whitenoise"];

/// Mitsuba's bell of standard deviation `sigma` pixels, cut at four of them; `None` if that is no filter.
pub(super) fn gaussian(sigma: f32) -> Option<Filter> {
    Filter::shaped(Curve::Gaussian { sigma }, Vec2::splat(4.0 * sigma))
}

impl Importer<'_, '_> {
    pub(super) fn filter(&mut self, number: usize) -> Found<Filter> {
        let props = self.props(number);
        let (kind, at) = props.element.plugin()?;
        let float = |name, default: f32| props.float(name, f64::from(default)).map(|v| v as f32);
        let shaped = |curve, radius| Filter::shaped(curve, Vec2::splat(radius));
        let third = 1.0 / 3.0;
        let filter = match kind {
            "box" => shaped(Curve::Box, float("radius", 0.5)?),
            "tent" => shaped(Curve::Tent, float("radius", 1.0)?),
            "gaussian" => gaussian(float("stddev", 0.5)?),
            "mitchell" => shaped(Curve::Cubic { b: float("b", third)?, c: float("c", third)? }, 2.0),
            "catmullrom" => shaped(Curve::Cubic { b: 0.0, c: 0.5 }, 2.0),
            "lanczos" => {
                let lobes = props.integer("lobes", 1..=16)?.unwrap_or(3) as f32;
                shaped(Curve::Lanczos { tau: lobes }, lobes)
            }
            _ if FILTERS.contains(&kind) => {
                self.warn_once("mitsuba::filter", "", &props, "each pixel is the mean over its own square");
                Some(Filter::Box)
            }
            _ => return Err(at.unknown("filter", kind, FILTERS)),
        };
        self.tell_unused(&props);
        filter.ok_or_else(|| {
            props.bad(&format!(
                "a filter must reach more than 0 and at most {MAX_FILTER_RADIUS} pixels, and be positive on the whole"
            ))
        })
    }
}
