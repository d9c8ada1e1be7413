//! A picture as a texture, with bilinear filtering.
use crate::spectrum::Rgb;
use glam::{Vec2, Vec3};

/// What lies outside the unit square.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Wrap {
    /// The picture again and again.
    #[default]
    Repeat,
    /// The nearest edge pixel.
    Clamp,
}

/// Linear RGB pixels; `v = 0` is the bottom edge, as in OBJ files, and rows are stored from the top.
#[derive(Clone, Debug)]
pub struct ImageTexture {
    width: usize,
    height: usize,
    pixels: Vec<Rgb>,
    wrap: Wrap,
}

impl ImageTexture {
    /// Takes row-major linear pixels, top row first. `None` unless there are `width * height` > 0 of them.
    pub fn new(width: usize, height: usize, pixels: Vec<Rgb>, wrap: Wrap) -> Option<Self> {
        (width > 0 && height > 0 && width.checked_mul(height)? == pixels.len()).then_some(Self {
            width,
            height,
            pixels,
            wrap,
        })
    }
    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }
    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }
    /// Pixel in column `x` of row `y`, the top row being 0.
    pub fn pixel(&self, x: usize, y: usize) -> Rgb {
        self.pixels[y * self.width + x]
    }
    /// Mean of all pixels.
    pub fn mean(&self) -> Rgb {
        let sum = self.pixels.iter().fold(glam::DVec3::ZERO, |s, p| s + p.as_dvec3());
        (sum / self.pixels.len() as f64).as_vec3()
    }
    /// Bilinear interpolation between the four nearest pixel centres.
    #[inline]
    pub fn eval(&self, uv: Vec2) -> Rgb {
        let p = Vec2::new(uv.x * self.width as f32 - 0.5, (1.0 - uv.y) * self.height as f32 - 0.5);
        let cell = p.floor();
        let f = p - cell;
        let at = |dx: i64, dy: i64| -> Vec3 {
            let x = self.index(cell.x as i64 + dx, self.width);
            let y = self.index(cell.y as i64 + dy, self.height);
            self.pixels[y * self.width + x]
        };
        at(0, 0).lerp(at(1, 0), f.x).lerp(at(0, 1).lerp(at(1, 1), f.x), f.y)
    }
    #[inline]
    fn index(&self, i: i64, n: usize) -> usize {
        let n = n as i64;
        (match self.wrap {
            Wrap::Repeat => i.rem_euclid(n),
            Wrap::Clamp => i.clamp(0, n - 1),
        }) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_by_two(wrap: Wrap) -> ImageTexture {
        ImageTexture::new(2, 2, [0.0, 1.0, 2.0, 3.0].map(Vec3::splat).to_vec(), wrap).unwrap()
    }

    #[test]
    fn pixel_centres_are_exact_and_the_first_row_is_on_top() {
        let t = two_by_two(Wrap::Clamp);
        for (uv, want) in
            [((0.25, 0.75), 0.0), ((0.75, 0.75), 1.0), ((0.25, 0.25), 2.0), ((0.75, 0.25), 3.0), ((0.5, 0.5), 1.5)]
        {
            assert!((t.eval(Vec2::new(uv.0, uv.1)).x - want).abs() < 1e-6, "{uv:?}");
        }
    }

    #[test]
    fn repeat_blends_across_the_seam_and_clamp_does_not() {
        assert!((two_by_two(Wrap::Repeat).eval(Vec2::new(0.0, 0.75)).x - 0.5).abs() < 1e-6);
        assert!((two_by_two(Wrap::Clamp).eval(Vec2::new(-3.0, 0.75)).x).abs() < 1e-6);
        assert!((two_by_two(Wrap::Repeat).eval(Vec2::new(1.25, 1.75)).x).abs() < 1e-5);
    }
}
