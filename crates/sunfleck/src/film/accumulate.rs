//! The mean over passes, and its variance.
use super::{FilmSpec, PassImage, blank};
use crate::spectrum::Rgb;
use glam::DVec3;
use rayon::prelude::*;

/// Sums of passes. Every pass weighs the same, so films of separate sets of passes can be merged.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    spec: FilmSpec,
    sum: Vec<DVec3>,
    sum_of_squares: Vec<DVec3>,
    passes: u64,
}

impl Film {
    /// Nothing yet.
    pub fn new(spec: FilmSpec) -> Self {
        Self { spec, sum: blank(&spec), sum_of_squares: blank(&spec), passes: 0 }
    }
    /// Size and filter.
    pub fn spec(&self) -> FilmSpec {
        self.spec
    }
    /// Passes added.
    pub fn passes(&self) -> u64 {
        self.passes
    }
    /// Adds one estimate.
    ///
    /// # Panics
    /// If the estimate is of another size or filter.
    pub fn add(&mut self, image: &PassImage) {
        assert_eq!(self.spec, image.spec(), "a pass of another picture");
        let add = |((sum, sq), p): ((&mut DVec3, &mut DVec3), &Rgb)| {
            let p = p.as_dvec3();
            *sum += p;
            *sq += p * p;
        };
        self.sum
            .par_iter_mut()
            .zip(self.sum_of_squares.par_iter_mut())
            .zip(image.pixels().par_iter())
            .with_min_len(4096)
            .for_each(add);
        self.passes += 1;
    }
    /// Adds the passes of another film of the same picture.
    ///
    /// # Panics
    /// If the other film is of another size or filter.
    pub fn merge(&mut self, other: &Self) {
        assert_eq!(self.spec, other.spec, "a film of another picture");
        self.sum.iter_mut().zip(&other.sum).for_each(|(a, b)| *a += *b);
        self.sum_of_squares.iter_mut().zip(&other.sum_of_squares).for_each(|(a, b)| *a += *b);
        self.passes += other.passes;
    }
    /// The mean over passes, row-major from the top; black before the first.
    pub fn mean(&self) -> Vec<Rgb> {
        let k = 1.0 / self.passes.max(1) as f64;
        self.sum.par_iter().with_min_len(4096).map(|s| (*s * k).as_vec3()).collect()
    }
    /// Variance of that mean, by channel, from the spread of the passes; `None` before the second.
    pub fn variance_of_mean(&self) -> Option<Vec<Rgb>> {
        let n = self.passes as f64;
        (self.passes >= 2).then(|| {
            let one =
                |(s, sq): (&DVec3, &DVec3)| ((*sq / n - (*s / n) * (*s / n)).max(DVec3::ZERO) / (n - 1.0)).as_vec3();
            self.sum.iter().zip(&self.sum_of_squares).map(one).collect()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Filter;

    #[test]
    fn mean_and_variance_are_those_of_the_passes_and_merging_adds_up() {
        let spec = FilmSpec { width: 1, height: 1, filter: Filter::Box };
        let film = |values: &[f32]| {
            let mut f = Film::new(spec);
            for v in values {
                let mut image = PassImage::new(spec);
                image.fill(|_, _, _| Rgb::splat(*v));
                f.add(&image);
            }
            f
        };
        let mut a = film(&[1.0, 2.0]);
        a.merge(&film(&[3.0, 6.0]));
        assert_eq!(a, film(&[1.0, 2.0, 3.0, 6.0]));
        assert_eq!(a.mean()[0].x, 3.0);
        // Sample variance 14/3, over 4 passes.
        assert!((a.variance_of_mean().unwrap()[0].x - 14.0 / 12.0).abs() < 1e-6);
        assert!(film(&[1.0]).variance_of_mean().is_none());
    }
}
