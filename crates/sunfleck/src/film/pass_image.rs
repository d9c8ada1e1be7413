//! What one pass writes.
use super::{FilmSpec, blank, splats, splats::Splats};
use crate::spectrum::Rgb;
use rayon::prelude::*;
use std::ops::AddAssign;

/// Work done, for rates and summaries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Rays traced, shadow rays included.
    pub rays: u64,
    /// Those of them that light paths took.
    pub light_rays: u64,
    /// Light paths started.
    pub emitted: u64,
    /// Photons stored.
    pub stored: u64,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, o: Self) {
        self.rays += o.rays;
        self.light_rays += o.light_rays;
        self.emitted += o.emitted;
        self.stored += o.stored;
    }
}

/// One estimate of the whole picture, W/(m²·sr); buffers are reused from pass to pass.
#[derive(Clone, Debug)]
pub struct PassImage {
    spec: FilmSpec,
    pixels: Vec<Rgb>,
    /// Work done.
    pub counts: Counts,
}

impl PassImage {
    /// A black picture.
    pub fn new(spec: FilmSpec) -> Self {
        Self { spec, pixels: blank(&spec), counts: Counts::default() }
    }
    /// Size and filter.
    pub fn spec(&self) -> FilmSpec {
        self.spec
    }
    /// Row-major pixels, top row first.
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }
    /// Makes it black again.
    pub fn clear(&mut self) {
        self.pixels.par_chunks_mut(1 << 14).for_each(|part| part.fill(Rgb::ZERO));
        self.counts = Counts::default();
    }
    /// Adds `render(x, y)` to every pixel, rows in parallel. A non-finite value counts as black: one broken path must not
    /// spoil a pixel for good.
    pub fn fill(&mut self, render: impl Fn(u32, u32, &mut Counts) -> Rgb + Sync) {
        self.fill_with(|| (), |(), x, y, counts| render(x, y, counts));
    }
    /// As [`PassImage::fill`], with a scratch space made anew for each row. What is left in it may change how fast a
    /// pixel is computed and in which order it is summed up, nothing else; rows are the same for any number of threads.
    pub fn fill_with<S>(
        &mut self,
        scratch: impl Fn() -> S + Sync,
        render: impl Fn(&mut S, u32, u32, &mut Counts) -> Rgb + Sync,
    ) {
        let width = self.spec.width as usize;
        let row = |(y, row): (usize, &mut [Rgb])| {
            let (mut counts, mut scratch) = (Counts::default(), scratch());
            for (x, pixel) in row.iter_mut().enumerate() {
                let value = render(&mut scratch, x as u32, y as u32, &mut counts);
                if value.is_finite() {
                    *pixel += value;
                }
            }
            counts
        };
        let rows: Vec<Counts> = self.pixels.par_chunks_mut(width).enumerate().map(row).collect();
        rows.into_iter().for_each(|c| self.counts += c);
    }
    /// Adds contributions, bands of rows in parallel. Each pixel takes them part by part, and in the order that a part has:
    /// the sum does not depend on threads.
    pub fn splat(&mut self, parts: &[&Splats]) {
        if parts.iter().any(|p| !p.is_empty()) {
            splats::add(parts, &self.spec, &mut self.pixels);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Filter, Splat};
    use glam::Vec2;

    #[test]
    fn a_splat_keeps_its_energy_and_falls_into_its_pixel() {
        for filter in [Filter::Box, Filter::NRenderer] {
            let mut image = PassImage::new(FilmSpec { width: 4, height: 2, filter });
            let splat = Splat { raster: Vec2::new(0.6, 0.8), value: Rgb::ONE };
            image.splat(&[&Splats::new(&image.spec(), &[splat])]);
            let mean = image.pixels().iter().map(|p| p.x).sum::<f32>() / 8.0;
            assert!((mean - 1.0).abs() < 1e-6, "{filter:?}");
            assert!(image.pixels()[4 + 2].x > 0.0);
        }
    }

    #[test]
    fn broken_values_are_dropped() {
        let mut image = PassImage::new(FilmSpec { width: 2, height: 1, filter: Filter::Box });
        image.fill(|x, _, _| if x == 0 { Rgb::splat(f32::NAN) } else { Rgb::ONE });
        let splat = Splat { raster: Vec2::splat(0.1), value: Rgb::splat(f32::INFINITY) };
        image.splat(&[&Splats::new(&image.spec(), &[splat])]);
        assert_eq!(image.pixels(), [Rgb::ZERO, Rgb::ONE]);
    }
}
