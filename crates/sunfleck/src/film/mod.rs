//! The picture: what a pass writes, what passes add up to, and how uncertain the sum is.
mod accumulate;
mod filter;
mod pass_image;
mod profile;
mod splats;

use rayon::prelude::*;

pub use accumulate::Film;
pub use filter::{Filter, MAX_FILTER_RADIUS, Sample, Shaped};
pub use pass_image::{Counts, PassImage};
pub use profile::Curve;
pub use splats::{Splat, Splats};

/// As many zeros as the picture has pixels. All threads write them: in a large picture, touching new memory for the first time
/// is most of the work.
fn blank<T: Default + Send>(spec: &FilmSpec) -> Vec<T> {
    (0..spec.pixels()).into_par_iter().with_min_len(1 << 14).map(|_| T::default()).collect()
}

/// Size and pixel filter of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSpec {
    /// Width in pixels, > 0.
    pub width: u32,
    /// Height in pixels, > 0.
    pub height: u32,
    /// How a pixel sees the picture's plane.
    pub filter: Filter,
}

impl FilmSpec {
    /// Number of pixels.
    pub fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }
}
