//! A picture of the whole sphere, and directions drawn in proportion to how bright it is there.
use crate::{
    math::{Discrete2d, warp::square_to_sphere},
    spectrum::Rgb,
    texture::{ImageTexture, Wrap},
};
use glam::{DVec3, Mat3, Vec2, Vec3};
use rayon::prelude::*;
use std::f32::consts::PI;

/// Share of the directions drawn evenly from the whole sphere. Cells whose share of the table is lost in rounding keep a
/// density, and a direction next to a bright cell cannot weigh more than the picture's mean over this.
const EVEN: f32 = 1.0 / 64.0;

/// Cells of the table at least, so that those of a tiny picture are small against the blur between its pixels.
const MIN_CELLS: [usize; 2] = [256, 128];
/// Cells at most: beyond, several pixels share one.
const MAX_CELLS: [usize; 2] = [2048, 1024];

/// A latitude-longitude picture in the world.
#[derive(Clone, Debug)]
pub(super) struct Panorama {
    image: ImageTexture,
    world_from_map: Mat3,
    /// Cells of longitude and latitude, weighed by brightness times solid angle.
    table: Discrete2d,
    /// Cosine of the polar angle at the upper edge of each row, and −1.
    edges: Vec<f64>,
    integral: Rgb,
}

impl Panorama {
    pub(super) fn new(image: ImageTexture, world_from_map: Mat3) -> Self {
        let image = image.rounded().with_wrap(Wrap::Repeat, Wrap::Clamp);
        let (columns, steps_x) = cells(image.width(), MIN_CELLS[0], MAX_CELLS[0]);
        let (rows, steps_y) = cells(image.height(), MIN_CELLS[1], MAX_CELLS[1]);
        let edges: Vec<f64> = (0..=rows).map(|y| (std::f64::consts::PI * y as f64 / rows as f64).cos()).collect();
        let cell = |x: usize, y: usize| -> DVec3 {
            let points = (0..steps_x * steps_y).map(|i| {
                let u = x as f32 + ((i % steps_x) as f32 + 0.5) / steps_x as f32;
                let v = y as f32 + ((i / steps_x) as f32 + 0.5) / steps_y as f32;
                image.eval(Vec2::new(u / columns as f32, 1.0 - v / rows as f32)).as_dvec3()
            });
            let solid_angle = std::f64::consts::TAU / columns as f64 * (edges[y] - edges[y + 1]);
            points.sum::<DVec3>() * (solid_angle / (steps_x * steps_y) as f64)
        };
        let sums: Vec<Vec<DVec3>> =
            (0..rows).into_par_iter().map(|y| (0..columns).map(|x| cell(x, y)).collect()).collect();
        let weights: Vec<f32> = sums.iter().flatten().map(|s| s.element_sum() as f32).collect();
        let integral = sums.iter().flatten().sum::<DVec3>().as_vec3();
        Self { image, world_from_map, table: Discrete2d::new(&weights, columns), edges, integral }
    }
    /// The picture's value in the unit direction `d` of the world.
    #[inline]
    pub(super) fn eval(&self, d: Vec3) -> Rgb {
        let p = self.place(d);
        self.image.eval(Vec2::new(p.x, 1.0 - p.y))
    }
    /// The picture, and what takes its axes to the world's.
    pub(super) fn image(&self) -> (&ImageTexture, Mat3) {
        (&self.image, self.world_from_map)
    }
    /// Integral of [`Panorama::eval`] over all directions.
    pub(super) fn integral(&self) -> Rgb {
        self.integral
    }
    /// A unit direction of the world and its density (1/sr).
    #[inline]
    pub(super) fn sample(&self, u: Vec2) -> (Vec3, f32) {
        let d = if u.x < EVEN {
            square_to_sphere(Vec2::new(u.x / EVEN, u.y))
        } else {
            let (p, _) = self.table.sample(Vec2::new((u.x - EVEN) / (1.0 - EVEN), u.y));
            self.world_from_map * self.direction(p)
        };
        (d, self.pdf(d))
    }
    /// Density (1/sr) of [`Panorama::sample`] in direction `d`: even within a cell, and a little everywhere.
    #[inline]
    pub(super) fn pdf(&self, d: Vec3) -> f32 {
        let p = self.place(d);
        let (row, _) = self.row(p.y);
        let rows = self.edges.len() - 1;
        let solid_angle_of_row = 2.0 * PI * (self.edges[row] - self.edges[row + 1]) as f32;
        (1.0 - EVEN) * self.table.pdf(p) / (rows as f32 * solid_angle_of_row) + EVEN * 0.25 / PI
    }
    /// Longitude and latitude of a direction of the world: [0, 1]², from the left and from the top.
    #[inline]
    fn place(&self, d: Vec3) -> Vec2 {
        let m = self.world_from_map.transpose() * d;
        // The angle from the pole by its tangent: its cosine says little there.
        Vec2::new((m.z.atan2(m.x) + PI) / (2.0 * PI), m.x.hypot(m.z).atan2(m.y) / PI)
    }
    /// The row at `v`, and how far down in it.
    #[inline]
    fn row(&self, v: f32) -> (usize, f32) {
        let rows = self.edges.len() - 1;
        let at = v * rows as f32;
        let row = (at as usize).min(rows - 1);
        (row, at - row as f32)
    }
    /// The direction of the map at a place of the table. Within a row it moves evenly in solid angle, not in latitude, so
    /// that no density grows without bound toward the poles.
    #[inline]
    fn direction(&self, p: Vec2) -> Vec3 {
        let (row, down) = self.row(p.y);
        let y = self.edges[row] + f64::from(down) * (self.edges[row + 1] - self.edges[row]);
        let r = ((1.0 - y) * (1.0 + y)).max(0.0).sqrt() as f32;
        let (sin, cos) = (2.0 * PI * p.x - PI).sin_cos();
        Vec3::new(r * cos, y as f32, r * sin)
    }
}

/// Cells for an axis of `pixels`, and points to look at in each: the midpoints of the pieces on which the picture is linear.
fn cells(pixels: usize, min: usize, max: usize) -> (usize, usize) {
    if pixels < min { (pixels * min.div_ceil(pixels), 2) } else { (pixels.min(max), 2 * pixels.div_ceil(max)) }
}
