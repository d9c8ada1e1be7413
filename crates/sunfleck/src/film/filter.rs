//! Pixel filters. All weights are equal, so a filter is where samples fall.
use glam::Vec2;

/// How a pixel sees the picture's plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Filter {
    /// The pixel's own square.
    #[default]
    Box,
    /// NRenderer's: a square two pixels wide around the pixel's lower left corner, which shifts the picture by half a
    /// pixel and blurs it. Kept for comparison with pictures made there.
    NRenderer,
    /// The pixel's middle alone. For trainings: what edges within a pixel make of its samples is no noise of an algorithm.
    Middle,
}

impl Filter {
    /// A place within the filter, in pixels from the pixel's upper left corner (x right, y down).
    #[inline]
    pub fn sample(self, u: Vec2) -> Vec2 {
        match self {
            Self::Box => u,
            Self::Middle => Vec2::splat(0.5),
            Self::NRenderer => Vec2::new(2.0 * u.x - 1.0, 2.0 * u.y),
        }
    }
    /// Pixels whose filter holds the place `p` (in pixels), as offsets of `floor(p)`, and the weight of each. The
    /// weights sum to one: a splat is shared, not multiplied.
    #[inline]
    pub fn holders(self) -> (&'static [(i32, i32)], f32) {
        match self {
            Self::Box | Self::Middle => (&[(0, 0)], 1.0),
            Self::NRenderer => (&[(0, -1), (1, -1), (0, 0), (1, 0)], 0.25),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_is_a_holder_of_every_place_it_samples() {
        for filter in [Filter::Box, Filter::NRenderer, Filter::Middle] {
            for i in 0..100 {
                let p = Vec2::new(7.0, 5.0) + filter.sample(Vec2::new(((i * 37) % 100) as f32, i as f32) / 100.0);
                let (x, y) = (p.x.floor() as i32, p.y.floor() as i32);
                let (offsets, weight) = filter.holders();
                assert!(offsets.iter().any(|(dx, dy)| (x + dx, y + dy) == (7, 5)), "{filter:?} {p}");
                assert_eq!(weight * offsets.len() as f32, 1.0);
            }
        }
    }
}
