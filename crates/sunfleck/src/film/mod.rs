//! The picture: what a pass writes, what passes add up to, and how uncertain the sum is.
mod accumulate;
mod filter;
mod pass_image;

pub use accumulate::Film;
pub use filter::Filter;
pub use pass_image::{Counts, PassImage, Splat};

/// Size and pixel filter of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// Raster coordinates (see [`crate::camera`]) of a draw `u` within the filter of pixel (`x`, `y`).
    #[inline]
    pub fn raster(&self, x: u32, y: u32, u: glam::Vec2) -> glam::Vec2 {
        let p = glam::Vec2::new(x as f32, y as f32) + self.filter.sample(u);
        p / glam::Vec2::new(self.width as f32, self.height as f32)
    }
}
