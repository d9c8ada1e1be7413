//! A slide projector without a lens: a point that shines through a picture.
use super::{Emitter, EmitterHit, LeOrigin, LeSample, LiSample, LightEnd, Surroundings};
use crate::{
    math::{Discrete2d, Ray},
    spectrum::{Illuminant, Rgb, Spectrum, Wavelengths},
    texture::{ImageTexture, Wrap},
};
use glam::{DVec3, Mat3, Vec2, Vec3};

/// Share of the directions drawn evenly over the picture: what rounding leaves no share keeps a density.
const EVEN: f32 = 1.0 / 64.0;
/// Cells of the table along each side, at least and at most.
const CELLS: [usize; 2] = [64, 1024];

/// A point that projects a picture.
#[derive(Clone, Debug)]
pub struct ProjectionLight {
    p: Vec3,
    /// Columns: to the right in the picture, up in it, and the way the light goes.
    axes: Mat3,
    /// Width and height of the picture at distance 1.
    size: Vec2,
    /// Radiant intensity (W/sr) where the picture is white.
    intensity: Illuminant,
    picture: ImageTexture,
    table: Discrete2d,
    /// Integral of the picture over the directions it covers.
    integral: Rgb,
}

/// Why a picture cannot be projected.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ProjectionError {
    /// The axes are no turn.
    #[error("a projector can be turned and mirrored, but its axes are stretched or sheared: {0}")]
    Axes(Mat3),
    /// The angles are none.
    #[error("a projected picture must have a positive width and height, but these are {0}")]
    Size(Vec2),
    /// A pixel that is no light.
    #[error("a pixel of the projected picture is {0}: light must be finite and not negative")]
    Pixel(Rgb),
}

impl ProjectionLight {
    /// From `p` along the last of the `axes` (to the right and up in the picture, and forward; unit, at right angles), with
    /// `intensity` (W/sr) where the picture is white, which is `size` (width and height) large at distance 1.
    ///
    /// # Errors
    /// Axes that are stretched, a size that is not positive, or a negative or non-finite pixel.
    pub fn new(
        p: Vec3,
        axes: Mat3,
        size: Vec2,
        intensity: impl Into<Illuminant>,
        picture: ImageTexture,
    ) -> Result<Self, ProjectionError> {
        if !(axes * axes.transpose()).abs_diff_eq(Mat3::IDENTITY, 1e-3) {
            return Err(ProjectionError::Axes(axes));
        }
        if !(size.is_finite() && size.min_element() > 0.0) {
            return Err(ProjectionError::Size(size));
        }
        let pixels = (0..picture.height()).flat_map(|y| (0..picture.width()).map(move |x| (x, y)));
        for (x, y) in pixels {
            let v = picture.pixel(x, y);
            if !(v.is_finite() && v.min_element() >= 0.0) {
                return Err(ProjectionError::Pixel(v));
            }
        }
        let picture = picture.with_wrap(Wrap::Clamp, Wrap::Clamp);
        let (table, integral) = tabulate(&picture, size);
        Ok(Self { p, axes, size, intensity: intensity.into(), picture, table, integral })
    }
    /// Position.
    pub fn position(&self) -> Vec3 {
        self.p
    }
    /// To the right and up in the picture, and the way the light goes.
    pub fn axes(&self) -> Mat3 {
        self.axes
    }
    /// Width and height of the picture at distance 1.
    pub fn size(&self) -> Vec2 {
        self.size
    }
    /// Radiant intensity (W/sr) where the picture is white.
    pub fn intensity(&self) -> &Illuminant {
        &self.intensity
    }
    /// What is projected.
    pub fn picture(&self) -> &ImageTexture {
        &self.picture
    }
    /// Place in the picture, from the left and from the top, and cosine with the axis; `None` outside of it.
    #[inline]
    fn place(&self, d: Vec3) -> Option<(Vec2, f32)> {
        let local = self.axes.transpose() * d;
        if local.z <= 0.0 {
            return None;
        }
        let at = local.truncate() / local.z / self.size;
        let p = Vec2::new(0.5 + at.x, 0.5 - at.y);
        (p.min_element() >= 0.0 && p.max_element() <= 1.0).then_some((p, local.z))
    }
    /// Density (1/sr) at a place under the cosine `cos`.
    #[inline]
    fn pdf(&self, p: Vec2, cos: f32) -> f32 {
        ((1.0 - EVEN) * self.table.pdf(p) + EVEN) / (self.size.x * self.size.y * cos * cos * cos)
    }
    #[inline]
    fn at(&self, p: Vec2, lambda: Wavelengths) -> Spectrum {
        self.intensity.filtered(self.picture.eval(Vec2::new(p.x, 1.0 - p.y)), lambda)
    }
}

/// Cells weighed by brightness times solid angle, and the integral over all.
fn tabulate(picture: &ImageTexture, size: Vec2) -> (Discrete2d, Rgb) {
    let cells = |pixels: usize| {
        if pixels < CELLS[0] { pixels * CELLS[0].div_ceil(pixels) } else { pixels.min(CELLS[1]) }
    };
    let (columns, rows) = (cells(picture.width()), cells(picture.height()));
    // Points to look at in each cell, so that no pixel is passed over.
    let steps = |pixels: usize, cells: usize| 2 * pixels.div_ceil(cells);
    let (sx, sy) = (steps(picture.width(), columns), steps(picture.height(), rows));
    let share = size.x * size.y / (columns * rows * sx * sy) as f32;
    let cell = |i: usize| -> DVec3 {
        let (x, y) = (i % columns, i / columns);
        let point = |k: usize| {
            let u = (x as f32 + ((k % sx) as f32 + 0.5) / sx as f32) / columns as f32;
            let v = (y as f32 + ((k / sx) as f32 + 0.5) / sy as f32) / rows as f32;
            let at = (Vec2::new(u, v) - 0.5) * size;
            let cos = 1.0 / (1.0 + at.length_squared()).sqrt();
            (picture.eval(Vec2::new(u, 1.0 - v)) * (share * cos * cos * cos)).as_dvec3()
        };
        (0..sx * sy).map(point).sum()
    };
    let sums: Vec<DVec3> = (0..columns * rows).map(cell).collect();
    let weights: Vec<f32> = sums.iter().map(|s| s.element_sum() as f32).collect();
    (Discrete2d::new(&weights, columns), sums.iter().sum::<DVec3>().as_vec3())
}

impl Emitter for ProjectionLight {
    fn name(&self) -> &'static str {
        "projection"
    }
    fn power(&self, _: &Surroundings) -> Rgb {
        self.intensity.rgb() * self.integral
    }
    #[inline]
    fn sample_li(&self, from: Vec3, _: Vec2, around: &Surroundings) -> Option<LiSample> {
        let to = self.p - from;
        let wi = to.try_normalize()?;
        let li = self.at(self.place(-wi)?.0, around.lambda) / to.length_squared();
        (!li.is_black()).then_some(LiSample { wi, li, pdf: 1.0, delta: true, end: LightEnd::Point(self.p) })
    }
    #[inline]
    fn sample_le(&self, _: Vec2, u_dir: Vec2, around: &Surroundings) -> Option<LeSample> {
        let place = if u_dir.x < EVEN {
            Vec2::new(u_dir.x / EVEN, u_dir.y)
        } else {
            self.table.sample(Vec2::new((u_dir.x - EVEN) / (1.0 - EVEN), u_dir.y)).0
        };
        let at = Vec2::new(place.x - 0.5, 0.5 - place.y) * self.size;
        self.le_along(&LightEnd::Point(self.p), self.axes * at.extend(1.0).normalize(), around)
    }
    #[inline]
    fn start_le(&self, _: Vec2) -> LightEnd {
        LightEnd::Point(self.p)
    }
    #[inline]
    fn le_along(&self, _: &LightEnd, d: Vec3, around: &Surroundings) -> Option<LeSample> {
        let (p, cos) = self.place(d)?;
        let (le, pdf_dir) = (self.at(p, around.lambda), self.pdf(p, cos));
        let ray = Ray { o: self.p, d, tmin: 0.0, tmax: f32::INFINITY };
        (!le.is_black()).then_some(LeSample { ray, le, pdf_area: 1.0, pdf_dir, cos: 1.0, origin: LeOrigin::Point })
    }
    #[inline]
    fn pdf_le(&self, hit: Option<&EmitterHit>, d: Vec3, _: &Surroundings) -> (f32, f32) {
        match self.place(d) {
            Some((p, cos)) if hit.is_none() => (1.0, self.pdf(p, cos)),
            // Drawn from no other direction.
            _ if hit.is_none() => (1.0, 0.0),
            _ => (0.0, 0.0),
        }
    }
    fn is_delta(&self) -> bool {
        true
    }
}
