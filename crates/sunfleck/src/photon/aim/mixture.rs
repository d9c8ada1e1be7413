//! The frozen distribution: rows of a light and where to, each with its probability.
use super::Target;
use crate::{
    light::{Emitter, EmitterHit, LeSample, LightEnd, LightId},
    math::Discrete,
    scene::World,
};
use glam::{Vec2, Vec3};
use std::ops::Range;

/// One way to start light paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The light.
    pub light: LightId,
    /// Where its rays are sent; `None`: in proportion to what it emits.
    pub target: Option<Target>,
}

/// The geometry of a start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// Where a ray of a local light starts, or a point of a line from infinity.
    pub(super) p: Vec3,
    /// Unit direction.
    pub(super) d: Vec3,
}

/// A ray that was drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drawn {
    pub(crate) light: LightId,
    /// Probability of the light.
    pub(crate) prob: f32,
    /// The ray with the densities that the light itself emits by.
    pub(super) plain: LeSample,
    /// The ray with the mixed densities, given the light.
    pub(crate) le: LeSample,
}

/// The rows of one light.
#[derive(Clone, Debug)]
struct Share {
    rows: Range<usize>,
    /// Their probability.
    prob: f32,
    /// Where a light without extent is.
    apex: Option<Vec3>,
    infinite: bool,
}

/// Rows to draw from.
#[derive(Clone, Debug)]
pub struct Mixture {
    rows: Vec<Row>,
    pick: Discrete,
    /// By light.
    shares: Vec<Share>,
}

impl Mixture {
    /// Weighs rows, which are sorted by light. Every light has some.
    pub(super) fn new(world: &World, rows: Vec<Row>, weights: &[f64]) -> Self {
        let pick = Discrete::new(weights.iter().map(|&w| w as f32));
        let share = |(id, light): (u32, &crate::light::Light)| {
            let rows = rows.partition_point(|r| r.light.0 < id)..rows.partition_point(|r| r.light.0 <= id);
            let prob = rows.clone().map(|i| pick.prob(i)).sum();
            let start = light.start_le(Vec2::splat(0.5));
            let apex = if let LightEnd::Point(p) = start { Some(p) } else { None };
            Share { rows, prob, apex, infinite: matches!(start, LightEnd::Infinite) }
        };
        let shares = (0..).zip(world.lights()).map(share).collect();
        Self { rows, pick, shares }
    }
    /// The rows, sorted by light.
    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }
    /// Places of the rows of `light`.
    pub(super) fn rows_of(&self, light: LightId) -> Range<usize> {
        self.shares[light.0 as usize].rows.clone()
    }

    /// Draws a light and a ray of it.
    #[inline]
    pub(crate) fn sample(&self, world: &World, u: f32, u_area: Vec2, u_dir: Vec2) -> Option<Drawn> {
        let (i, _, _) = self.pick.sample(u)?;
        let row = self.rows[i];
        let share = &self.shares[row.light.0 as usize];
        let (emitter, around) = (world.light(row.light), world.around());
        let le = match row.target {
            None => emitter.sample_le(u_area, u_dir, around)?,
            Some(target) if share.infinite => {
                let le = emitter.sample_le(u_area, u_dir, around)?;
                let d = le.ray.d;
                LeSample { ray: around.ray_from_outside_through(d, target.sample_across(d, u_area)), ..le }
            }
            Some(target) => {
                let start = emitter.start_le(u_area);
                emitter.le_along(&start, target.sample_direction(start.place()?, u_dir), around)?
            }
        };
        let line = Line { p: le.ray.o, d: le.ray.d };
        let (pdf_area, pdf_dir) = self.given_light(share, (le.pdf_area, le.pdf_dir), line, Some(i));
        Some(Drawn { light: row.light, prob: share.prob, plain: le, le: LeSample { pdf_area, pdf_dir, ..le } })
    }
    /// Density with which [`Mixture::sample`] draws the ray that leaves `light` in direction `d`, choice of light included.
    #[inline]
    pub(crate) fn pdf(&self, world: &World, light: LightId, hit: Option<&EmitterHit>, through: Vec3, d: Vec3) -> f32 {
        let share = &self.shares[light.0 as usize];
        let plain = world.light(light).pdf_le(hit, d, world.around());
        let p = hit.map(|h| h.p).or(share.apex).unwrap_or(through);
        let (pdf_area, pdf_dir) = self.given_light(share, plain, Line { p, d }, None);
        share.prob * pdf_area * pdf_dir
    }
    /// Mixes the `plain` densities of a ray (area, direction) with those of the targets. A ray that row `drawn` drew is
    /// in reach of that row, whatever rounding says.
    #[inline]
    fn given_light(&self, share: &Share, plain: (f32, f32), line: Line, drawn: Option<usize>) -> (f32, f32) {
        let mixed = |plain: f32| {
            let density =
                |i: usize| self.pick.prob(i) * self.rows[i].density(share.infinite, plain, line, drawn == Some(i));
            share.rows.clone().map(density).sum::<f32>() / share.prob
        };
        if share.infinite { (mixed(plain.0), plain.1) } else { (plain.0, mixed(plain.1)) }
    }
    /// Density of `line` by row `i` alone where `plain` is that of the light itself: of its place for light from infinity,
    /// else of its direction.
    pub(super) fn row_density(&self, i: usize, plain: f32, line: Line) -> f32 {
        let row = &self.rows[i];
        row.density(self.shares[row.light.0 as usize].infinite, plain, line, false)
    }
    /// The same by all rows of `light` together, choice of the light included.
    pub(super) fn density(&self, light: LightId, plain: f32, line: Line) -> f64 {
        self.rows_of(light).map(|i| f64::from(self.pick.prob(i) * self.row_density(i, plain, line))).sum()
    }
    /// The density of `le` that targets change.
    pub(super) fn changed(&self, light: LightId, le: &LeSample) -> f32 {
        if self.shares[light.0 as usize].infinite { le.pdf_area } else { le.pdf_dir }
    }
}

impl Row {
    #[inline]
    fn density(&self, infinite: bool, plain: f32, line: Line, inside: bool) -> f32 {
        let Some(t) = &self.target else { return plain };
        match (infinite, inside) {
            (true, true) => t.pdf_across_inside(),
            (true, false) => t.pdf_across(line.p, line.d),
            (false, true) => t.pdf_direction_inside(line.p),
            (false, false) => t.pdf_direction(line.p, line.d),
        }
    }
}
