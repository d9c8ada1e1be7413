//! A picture as a texture: bilinear between its pixels, trilinear between smaller versions where a lookup covers more of it.
use super::{
    footprint::Footprint,
    pixels::Pixels,
    pyramid::{Level, levels},
};
use crate::spectrum::Rgb;
use glam::Vec2;
use std::sync::OnceLock;

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
    /// Smaller versions, made when they are first asked for.
    levels: OnceLock<Vec<Level>>,
}

impl ImageTexture {
    /// Takes row-major linear pixels, top row first. `None` unless there are `width * height` > 0 of them.
    pub fn new(width: usize, height: usize, pixels: Vec<Rgb>, wrap: Wrap) -> Option<Self> {
        (width > 0 && height > 0 && width.checked_mul(height)? == pixels.len()).then(|| Self {
            width,
            height,
            pixels: Pixels::new(pixels),
            wrap: [wrap; 2],
            levels: OnceLock::new(),
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
    ///
    /// Smaller versions take at most 2 more, from when they are first asked for.
    pub fn bytes(&self) -> usize {
        self.pixels.bytes() + self.levels.get().map_or(0, |levels| levels.iter().map(Level::bytes).sum())
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
        let (at, f) = place_between(uv, self.width, self.height, self.wrap);
        self.pixels.blend(at, f)
    }
    /// The mean over `footprint`, about: trilinear between smaller versions of the picture (Williams 1983), in several pieces
    /// where the footprint is long. The same as [`ImageTexture::eval`] where that is no longer than a pixel.
    #[inline]
    pub fn filtered(&self, uv: Vec2, footprint: &Footprint) -> Rgb {
        if footprint.is_point() {
            return self.eval(uv);
        }
        let size = Vec2::new(self.width as f32, self.height as f32);
        let in_pixels = Footprint { sides: footprint.sides.map(|s| s * size) };
        if in_pixels.sides.iter().all(|s| s.length_squared() <= 1.0) {
            self.eval(uv)
        } else {
            self.mean_over(uv, &in_pixels)
        }
    }
    #[inline(never)]
    fn mean_over(&self, uv: Vec2, in_pixels: &Footprint) -> Rgb {
        let size = Vec2::new(self.width as f32, self.height as f32);
        let pieces = in_pixels.pieces(1.0);
        // Levels have 2, 4, 8 ... pixels of the picture a side.
        let level = pieces.width.max(1.0).log2();
        pieces.mean(uv * size, |at| self.between_levels(at / size, level))
    }
    /// `level` 0 is the picture, 1 that of half its size.
    fn between_levels(&self, uv: Vec2, level: f32) -> Rgb {
        if level <= 0.0 {
            return self.eval(uv);
        }
        let levels = self.levels.get_or_init(|| levels(self.width, self.height, |i| self.pixels.get(i)));
        let value = |i: usize| match i.min(levels.len()).checked_sub(1) {
            None => self.eval(uv),
            Some(i) => levels[i].eval(uv, self.wrap),
        };
        value(level as usize).lerp(value(level as usize + 1), level.fract())
    }
}

/// The four pixels around a place, and how far it is from the first of them; as [`Pixels::blend`] wants them. Broken
/// coordinates give the lower left corner.
#[inline]
pub(super) fn place_between(uv: Vec2, width: usize, height: usize, wrap: [Wrap; 2]) -> ([usize; 4], Vec2) {
    let p = Vec2::new(uv.x * width as f32 - 0.5, (1.0 - uv.y) * height as f32 - 0.5);
    let p = if p.is_finite() { p } else { Vec2::new(-0.5, height as f32 - 0.5) };
    let cell = p.floor();
    let x = [0, 1].map(|d| wrap[0].index((cell.x as i64).saturating_add(d), width));
    let row = [0, 1].map(|d| width * wrap[1].index((cell.y as i64).saturating_add(d), height));
    ([row[0] + x[0], row[0] + x[1], row[1] + x[0], row[1] + x[1]], p - cell)
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
