//! Contributions that land anywhere, added in parallel and yet in one order.
use super::FilmSpec;
use crate::spectrum::Rgb;
use glam::Vec2;
use rayon::prelude::*;
use std::ops::Range;

/// A contribution that lands anywhere on the picture.
#[derive(Clone, Copy, Debug)]
pub struct Splat {
    /// Raster coordinates (see [`crate::camera`]).
    pub raster: Vec2,
    /// Radiance times raster area, i.e. what is added per unit of raster area.
    pub value: Rgb,
}

/// Bands of rows that a picture is cut into.
const BANDS: usize = 32;

/// Contributions of one task, sorted by the band of rows where they land. Broken ones are left out.
#[derive(Clone, Debug)]
pub struct Splats {
    splats: Vec<Splat>,
    /// Where each band begins, and the end.
    starts: [u32; BANDS + 1],
}

impl Default for Splats {
    fn default() -> Self {
        Self { splats: Vec::new(), starts: [0; BANDS + 1] }
    }
}

impl Splats {
    /// Sorts; within a band the order stays.
    pub fn new(spec: &FilmSpec, splats: &[Splat]) -> Self {
        let whole = || splats.iter().filter(|s| s.value.is_finite());
        let band = |s: &Splat| band(spec, place(spec, s).y.floor() as i32);
        let mut starts = [0; BANDS + 1];
        whole().for_each(|s| starts[band(s) + 1] += 1);
        (0..BANDS).for_each(|b| starts[b + 1] += starts[b]);
        let mut next = starts;
        let mut sorted = vec![Splat { raster: Vec2::ZERO, value: Rgb::ZERO }; starts[BANDS] as usize];
        for s in whole() {
            let slot = &mut next[band(s)];
            sorted[*slot as usize] = *s;
            *slot += 1;
        }
        Self { splats: sorted, starts }
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.splats.is_empty()
    }
    /// Those of some bands.
    fn of(&self, bands: Range<usize>) -> &[Splat] {
        &self.splats[self.starts[bands.start] as usize..self.starts[bands.end] as usize]
    }
}

/// Where it lands, in pixels; it need not be on the picture.
#[inline]
fn place(spec: &FilmSpec, s: &Splat) -> Vec2 {
    s.raster * Vec2::new(spec.width as f32, spec.height as f32)
}

/// The band of a row; rows off the picture count to the nearest.
#[inline]
fn band(spec: &FilmSpec, row: i32) -> usize {
    let row = row.clamp(0, spec.height as i32 - 1);
    row as usize * BANDS / spec.height as usize
}

/// Adds all to row-major `pixels`.
pub(super) fn add(parts: &[&Splats], spec: &FilmSpec, pixels: &mut [Rgb]) {
    let (width, height) = (spec.width as usize, spec.height as usize);
    let mut rest = pixels;
    let mut bands = Vec::with_capacity(BANDS);
    for b in 0..BANDS {
        let rows = (b * height).div_ceil(BANDS)..((b + 1) * height).div_ceil(BANDS);
        let pixels = rest.split_off_mut(..rows.len() * width).expect("rows of the picture");
        bands.push((rows, pixels));
    }
    bands.into_par_iter().for_each(|(rows, pixels)| add_to_rows(parts, spec, &rows, pixels));
}

/// Adds what reaches `rows`, whose pixels are given.
fn add_to_rows(parts: &[&Splats], spec: &FilmSpec, rows: &Range<usize>, pixels: &mut [Rgb]) {
    if rows.is_empty() {
        return;
    }
    let (size, per_pixel) = ([spec.width as i32, spec.height as i32], spec.pixels() as f32);
    let rows = rows.start as i32..rows.end as i32;
    let reach = spec.filter.reach();
    let from = band(spec, rows.start - reach)..band(spec, rows.end - 1 + reach) + 1;
    for s in parts.iter().flat_map(|p| p.of(from.clone())) {
        spec.filter.share(place(spec, s), size, |x, y, share| {
            if rows.contains(&y) {
                pixels[((y - rows.start) * size[0] + x) as usize] += s.value * (share * per_pixel);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Curve, Filter, PassImage};

    /// Contributions of values so unlike that their sums tell the order, on the picture and around it.
    fn scattered(seed: u32) -> Vec<Splat> {
        let number = |i: u32| ((i ^ seed).wrapping_mul(0x9E37_79B9) >> 8) as f32 / (1 << 24) as f32;
        let one = |i: u32| Splat {
            raster: Vec2::new(number(3 * i), number(3 * i + 1)) * 1.2 - 0.1,
            value: Rgb::splat((20.0 * number(3 * i + 2) - 10.0).exp2()),
        };
        (0..3000_u32).map(one).collect()
    }

    #[test]
    fn bands_give_the_sums_of_one_contribution_after_the_other() {
        let gaussian = Filter::shaped(Curve::Gaussian { sigma: 0.5 }, Vec2::new(1.5, 2.5)).expect("a filter");
        for (width, height) in [(7, 90), (16, 16), (5, 1), (3, 33)] {
            for filter in [Filter::Box, Filter::NRenderer, gaussian] {
                let spec = FilmSpec { width, height, filter };
                let parts = [1, 77].map(|seed| Splats::new(&spec, &scattered(seed)));
                let mut expected = vec![Rgb::ZERO; spec.pixels()];
                // Bands before rows: within a pixel that is the order of `add`.
                for s in parts.iter().flat_map(|p| &p.splats) {
                    filter.share(place(&spec, s), [width as i32, height as i32], |x, y, share| {
                        expected[y as usize * width as usize + x as usize] += s.value * (share * spec.pixels() as f32);
                    });
                }
                let mut image = PassImage::new(spec);
                image.splat(&[&parts[0], &parts[1]]);
                assert_eq!(image.pixels(), expected, "{width}×{height}, {filter:?}");
            }
        }
    }

    #[test]
    fn sorting_keeps_the_order_within_rows_and_drops_what_is_broken() {
        let spec = FilmSpec { width: 3, height: 100, filter: Filter::Box };
        let mut splats = scattered(5);
        let row = |s: &Splat| place(&spec, s).y.floor();
        let sorted = Splats::new(&spec, &splats).splats;
        for y in 0..100 {
            let of_row = |all: &[Splat]| all.iter().filter(|s| row(s) == y as f32).map(|s| s.value).collect::<Vec<_>>();
            assert_eq!(of_row(&sorted), of_row(&splats), "row {y}");
        }
        splats[7].value.x = f32::NAN;
        assert_eq!(Splats::new(&spec, &splats).splats.len(), splats.len() - 1);
    }
}
