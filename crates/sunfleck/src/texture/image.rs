//! A picture as a texture, with bilinear filtering.
use super::pixels::Pixels;
use crate::spectrum::Rgb;
use glam::Vec2;

/// What lies outside the unit square.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Wrap {
    /// The picture again and again.
    #[default]
    Repeat,
    /// The nearest edge pixel.
    Clamp,
    /// The picture and its mirror image in turn, as glTF's `MIRRORED_REPEAT`.
    Mirror,
}

/// Pictures with fewer pixels are not worth rounding.
const LARGE: usize = 1 << 20;

/// Linear RGB pixels; `v = 0` is the bottom edge, as in OBJ files, and rows are stored from the top.
#[derive(Clone, Debug)]
pub struct ImageTexture {
    width: usize,
    height: usize,
    pixels: Pixels,
    /// Across, then down.
    wrap: [Wrap; 2],
}

impl ImageTexture {
    /// Takes row-major linear pixels, top row first. `None` unless there are `width * height` > 0 of them.
    pub fn new(width: usize, height: usize, pixels: Vec<Rgb>, wrap: Wrap) -> Option<Self> {
        (width > 0 && height > 0 && width.checked_mul(height)? == pixels.len()).then(|| Self {
            width,
            height,
            pixels: Pixels::new(pixels),
            wrap: [wrap; 2],
        })
    }
    /// The same picture in half the memory, if it has 2²⁰ pixels or more that cannot be kept in less without a change: rounded
    /// to half floats times a power of two. A value `x` moves by at most 2⁻¹¹ `|x|`, and one of less than 2⁻²⁸ of the largest
    /// by at most 2⁻³⁹ of that.
    pub fn rounded(self) -> Self {
        match &self.pixels {
            Pixels::Full(p) if p.len() >= LARGE => match Pixels::rounded(p) {
                Some(pixels) => Self { pixels, ..self },
                None => self,
            },
            _ => self,
        }
    }
    /// Memory (bytes) that the pixels take: 1 each for grey 8-bit files, 3 for others of 8 bits, 4 for Radiance pictures, 6 for
    /// half floats and 12 for the rest.
    pub fn bytes(&self) -> usize {
        self.pixels.bytes()
    }
    /// Continues the picture differently across and down.
    pub fn with_wrap(self, across: Wrap, down: Wrap) -> Self {
        Self { wrap: [across, down], ..self }
    }
    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }
    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }
    /// How it goes on beyond its edges: across and down.
    pub fn wrap(&self) -> [Wrap; 2] {
        self.wrap
    }
    /// Pixel in column `x` of row `y`, the top row being 0.
    pub fn pixel(&self, x: usize, y: usize) -> Rgb {
        self.pixels.get(y * self.width + x)
    }
    /// Mean of all pixels.
    pub fn mean(&self) -> Rgb {
        let sum = (0..self.pixels.len()).fold(glam::DVec3::ZERO, |s, i| s + self.pixels.get(i).as_dvec3());
        (sum / self.pixels.len() as f64).as_vec3()
    }
    /// Bilinear interpolation between the four nearest pixel centres. Broken coordinates give the lower left corner.
    #[inline]
    pub fn eval(&self, uv: Vec2) -> Rgb {
        let p = Vec2::new(uv.x * self.width as f32 - 0.5, (1.0 - uv.y) * self.height as f32 - 0.5);
        let p = if p.is_finite() { p } else { Vec2::new(-0.5, self.height as f32 - 0.5) };
        let cell = p.floor();
        let x = [0, 1].map(|d| self.wrap[0].index((cell.x as i64).saturating_add(d), self.width));
        let row = [0, 1].map(|d| self.width * self.wrap[1].index((cell.y as i64).saturating_add(d), self.height));
        self.pixels.blend([row[0] + x[0], row[0] + x[1], row[1] + x[0], row[1] + x[1]], p - cell)
    }
}

impl Wrap {
    /// The pixel that stands at `i` of an axis of `n` pixels.
    #[inline]
    fn index(self, i: i64, n: usize) -> usize {
        let n = n as i64;
        (match self {
            Self::Repeat => i.rem_euclid(n),
            Self::Clamp => i.clamp(0, n - 1),
            Self::Mirror => {
                let i = i.rem_euclid(2 * n);
                i.min(2 * n - 1 - i)
            }
        }) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

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
    fn mirrored_pictures_meet_without_a_seam_and_axes_wrap_on_their_own() {
        let t = two_by_two(Wrap::Mirror);
        for u in [0.0f32, 0.1, 0.37, 0.8, 1.0] {
            let at = |x: f32, y: f32| t.eval(Vec2::new(x, y)).x;
            assert!((at(u, 0.3) - at(-u, 0.3)).abs() < 1e-5 && (at(u, 0.3) - at(2.0 - u, 0.3)).abs() < 1e-5);
            assert!((at(0.3, u) - at(0.3, 4.0 - u)).abs() < 1e-5);
        }
        let t = t.with_wrap(Wrap::Repeat, Wrap::Clamp);
        assert!((t.eval(Vec2::new(0.0, 0.75)).x - 0.5).abs() < 1e-6);
        assert!((t.eval(Vec2::new(0.25, 7.0)).x).abs() < 1e-6);
    }

    #[test]
    fn repeat_blends_across_the_seam_and_clamp_does_not() {
        assert!((two_by_two(Wrap::Repeat).eval(Vec2::new(0.0, 0.75)).x - 0.5).abs() < 1e-6);
        assert!((two_by_two(Wrap::Clamp).eval(Vec2::new(-3.0, 0.75)).x).abs() < 1e-6);
        assert!((two_by_two(Wrap::Repeat).eval(Vec2::new(1.25, 1.75)).x).abs() < 1e-5);
    }
}
