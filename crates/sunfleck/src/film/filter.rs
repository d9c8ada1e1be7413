//! Pixel filters: where a pixel's samples fall, what they count, and what a pixel gets of light that lands elsewhere.
//!
//! Camera samples are drawn from the filter ("filter importance sampling", Ernst, Stamminger & Greiner 2006), so a pass
//! fills each pixel from its own paths alone. Where a filter is negative, samples count with a negative sign. Beyond its
//! edges the picture goes on as its own mirror image, for drawn places and for light that lands on it alike.
use super::profile::{Curve, Profile};
use glam::Vec2;

/// Filters reach no farther from a pixel's middle than this, in pixels.
pub const MAX_FILTER_RADIUS: f32 = 16.0;

/// How a pixel sees the picture's plane.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub enum Filter {
    /// The pixel's own square.
    #[default]
    Box,
    /// NRenderer's: a square two pixels wide around the pixel's lower left corner, which shifts the picture by half a
    /// pixel and blurs it. Kept for comparison with pictures made there.
    NRenderer,
    /// The pixel's middle alone. For trainings: what edges within a pixel make of its samples is no noise of an algorithm.
    Middle,
    /// Around the pixel's middle by curves.
    Shaped(Shaped),
}

/// A filter that is a product of two curves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaped {
    x: Profile,
    y: Profile,
}

/// A place on the picture that a pixel looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// In raster coordinates (see [`crate::camera`]).
    pub raster: Vec2,
    /// What is found there times this is an estimate of the pixel: 1, or what the filter's shape asks for, which may be
    /// negative.
    pub weight: f32,
}

impl Filter {
    /// The filter of `curve`, as far as `radius` (pixels along x and y) from a pixel's middle. `None` unless radii are
    /// positive and at most [`MAX_FILTER_RADIUS`], and the curve has more above zero than below.
    pub fn shaped(curve: Curve, radius: Vec2) -> Option<Self> {
        if curve == Curve::Box && radius == Vec2::splat(0.5) {
            return Some(Self::Box);
        }
        let (x, y) = (Profile::new(curve, radius.x)?, Profile::new(curve, radius.y)?);
        Some(Self::Shaped(Shaped { x, y }))
    }
    /// The curve and the radii (pixels) of a filter that has some.
    pub fn shape(&self) -> Option<(Curve, Vec2)> {
        match self {
            Self::Box => Some((Curve::Box, Vec2::splat(0.5))),
            Self::NRenderer | Self::Middle => None,
            Self::Shaped(s) => Some((s.x.curve(), Vec2::new(s.x.radius, s.y.radius))),
        }
    }
    /// A place within the filter, in pixels from the pixel's upper left corner (x right, y down), and its weight.
    #[inline]
    pub(super) fn sample(&self, u: Vec2) -> (Vec2, f32) {
        match self {
            Self::Box => (u, 1.0),
            Self::Middle => (Vec2::splat(0.5), 1.0),
            Self::NRenderer => (Vec2::new(2.0 * u.x - 1.0, 2.0 * u.y), 1.0),
            Self::Shaped(s) => {
                let ((x, wx), (y, wy)) = (s.x.sample(u.x), s.y.sample(u.y));
                (Vec2::new(0.5 + x, 0.5 + y), wx * wy)
            }
        }
    }
    /// Rows, up and down from that of a place, whose pixels may see it.
    pub(super) fn reach(&self) -> i32 {
        match self {
            Self::Box | Self::Middle => 0,
            Self::NRenderer => 1,
            Self::Shaped(s) => s.y.radius.ceil() as i32,
        }
    }
    /// Calls `give` with each pixel of a picture of `size` pixels that sees the place `p` (in pixels), and with its share of
    /// the light that lands there; on the mean over places the shares sum to one.
    #[inline]
    pub(super) fn share(&self, p: Vec2, size: [i32; 2], mut give: impl FnMut(i32, i32, f32)) {
        let [w, h] = size;
        let (column, line) = (p.x.floor() as i32, p.y.floor() as i32);
        let inside = |x: i32, y: i32| (0..w).contains(&x) && (0..h).contains(&y);
        match self {
            Self::Box | Self::Middle => {
                if inside(column, line) {
                    give(column, line, 1.0);
                }
            }
            Self::NRenderer => {
                for (x, y) in [(column, line - 1), (column + 1, line - 1), (column, line), (column + 1, line)] {
                    if inside(x, y) {
                        give(x, y, 0.25);
                    }
                }
            }
            Self::Shaped(s) => {
                if inside(column, line) {
                    s.share(p, |x, y, weight| give(mirrored(x, w), mirrored(y, h), weight));
                }
            }
        }
    }
}

impl Shaped {
    /// As [`Filter::share`], on a picture without edges.
    fn share(&self, p: Vec2, mut give: impl FnMut(i32, i32, f32)) {
        let reach = |p: f32, radius: f32| (p - 0.5 - radius).ceil() as i32..=(p - 0.5 + radius).floor() as i32;
        for y in reach(p.y, self.y.radius) {
            let across = self.y.weight(p.y - (y as f32 + 0.5));
            for x in reach(p.x, self.x.radius) {
                give(x, y, across * self.x.weight(p.x - (x as f32 + 0.5)));
            }
        }
    }
}

/// The pixel that stands for number `i` on a picture of `n`, mirrored at its edges.
fn mirrored(i: i32, n: i32) -> i32 {
    let i = i.rem_euclid(2 * n);
    if i < n { i } else { 2 * n - 1 - i }
}

/// The place that stands for `p` pixels on a picture of `n`, mirrored at its edges.
fn folded(p: f32, n: f32) -> f32 {
    let p = p.rem_euclid(2.0 * n);
    if p <= n { p } else { 2.0 * n - p }
}

impl super::FilmSpec {
    /// The place that pixel (`x`, `y`) looks at by the uniform numbers `u`.
    #[inline]
    pub fn sample(&self, x: u32, y: u32, u: Vec2) -> Sample {
        let (offset, weight) = self.filter.sample(u);
        let size = Vec2::new(self.width as f32, self.height as f32);
        let mut p = Vec2::new(x as f32, y as f32) + offset;
        if let Filter::Shaped(_) = self.filter {
            p = Vec2::new(folded(p.x, size.x), folded(p.y, size.y));
        }
        Sample { raster: p / size, weight }
    }
    /// The middle of pixel (`x`, `y`) in raster coordinates.
    #[inline]
    pub fn middle(&self, x: u32, y: u32) -> Vec2 {
        Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / Vec2::new(self.width as f32, self.height as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::FilmSpec;

    fn filters() -> Vec<Filter> {
        let shaped = |curve, x, y| Filter::shaped(curve, Vec2::new(x, y)).unwrap();
        vec![
            Filter::Box,
            Filter::NRenderer,
            shaped(Curve::Tent, 1.0, 1.0),
            shaped(Curve::Gaussian { sigma: 0.5 }, 1.5, 2.5),
            shaped(Curve::Cubic { b: 1.0 / 3.0, c: 1.0 / 3.0 }, 2.0, 2.0),
            shaped(Curve::Lanczos { tau: 3.0 }, 4.0, 4.0),
        ]
    }

    /// A picture of light over the plane: bright to the right and above.
    fn light(raster: Vec2) -> f32 {
        1.0 + raster.x * raster.x + (9.0 * raster.y).sin()
    }

    #[test]
    fn paths_from_the_eye_and_paths_from_the_lights_make_the_same_picture() {
        const N: u32 = 100_000;
        // Roberts 2018: multiples of the powers of the plastic number fill the square evenly.
        let even = |i: u32| {
            Vec2::new((f64::from(i) * 0.754_877_666_2).fract() as f32, (f64::from(i) * 0.569_840_291).fract() as f32)
        };
        for filter in filters().into_iter().filter(|f| *f != Filter::NRenderer) {
            let spec = FilmSpec { width: 7, height: 5, filter };
            let mut splatted = [0.0; 35];
            for raster in (0..N).map(even) {
                let value = light(raster) * 35.0 / N as f32;
                filter.share(raster * Vec2::new(7.0, 5.0), [7, 5], |x, y, share| {
                    splatted[(y * 7 + x) as usize] += f64::from(share * value);
                });
            }
            for (i, from_lights) in splatted.into_iter().enumerate() {
                let looked = (0..N).map(|j| spec.sample(i as u32 % 7, i as u32 / 7, even(j)));
                let from_eye = looked.map(|s| f64::from(s.weight * light(s.raster))).sum::<f64>() / f64::from(N);
                assert!((from_eye - from_lights).abs() < 0.01, "{filter:?} {i}: {from_eye} {from_lights}");
            }
        }
    }

    #[test]
    fn no_light_is_lost_or_won() {
        for filter in filters() {
            let mut sum = 0.0;
            for i in 0..10_000 {
                let p = Vec2::new(10.0 + (i % 100) as f32 / 100.0, 12.0 + (i / 100) as f32 / 100.0);
                filter.share(p, [40, 40], |_, _, share| sum += share / 10_000.0);
            }
            assert!((sum - 1.0).abs() < 2e-3, "{filter:?}: {sum}");
        }
    }

    #[test]
    fn a_shaped_filter_never_looks_beyond_the_picture() {
        for filter in filters().into_iter().filter(|f| matches!(f, Filter::Shaped(_))) {
            let spec = FilmSpec { width: 2, height: 1, filter };
            for i in 0..1000 {
                let u = Vec2::new((i as f32 + 0.5) / 1000.0, ((i * 37) % 1000) as f32 / 1000.0);
                let Sample { raster, .. } = spec.sample(i % 2, 0, u);
                assert!(raster.min_element() >= 0.0 && raster.max_element() <= 1.0, "{filter:?} {raster}");
            }
        }
    }
}
