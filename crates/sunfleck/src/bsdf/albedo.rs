//! How much of the light a rough boundary or a sheen gives back in all, by angle: integrals that have no closed form, tabulated when
//! they are first needed.
//!
//! With Schlick's Fresnel factor, `F = f0 + (f90 − f0)(1 − cos)⁵`, the albedo of a GGX landscape is linear in `f0` and `f90` (Karis 2013,
//! "Real Shading in Unreal Engine 4"): two tables serve all. Between their nodes it is interpolated, and the means over the
//! hemisphere are those of the interpolated function, so that what layers keep and pass on sums to one.
use super::{
    ggx::{Ggx, reflect_up},
    sheen::Sheen,
};
use crate::{math::Local, spectrum::Spectrum};
use glam::{Vec2, Vec3};
use std::sync::LazyLock;

/// Nodes over the cosine, and over the perceived roughness (the root of alpha).
const COSINES: usize = 64;
const ROUGHNESSES: usize = 32;
/// Samples of an integral: around, and from the middle out.
const LATTICE: [u32; 2] = [16, 64];

/// One row a roughness: values at the nodes over the cosine, and their mean over the hemisphere.
struct Table {
    values: Vec<[f32; COSINES]>,
    means: Vec<f32>,
}

struct Tables {
    /// Albedo with F = 1.
    whole: Table,
    /// Albedo with F = (1 − cos)⁵.
    edge: Table,
    sheen: Table,
    /// What a sheen is multiplied by, one a row, so that its albedo is below 1.
    sheen_scales: Vec<f32>,
}

/// The most that a sheen gives back: something is left for what is below.
const MOST_SHEEN: f32 = 0.99;

static TABLES: LazyLock<Tables> = LazyLock::new(Tables::new);

/// The cosine of node `i`. Nodes are denser at grazing angles.
fn node(i: usize) -> f32 {
    let x = i as f32 / (COSINES - 1) as f32;
    (x * x).max(1e-4)
}

/// The roughness of a row.
fn alpha(row: usize) -> f32 {
    let r = row as f32 / (ROUGHNESSES - 1) as f32;
    r * r
}

/// Points of the unit square, evenly spread.
fn lattice() -> impl Iterator<Item = Vec2> {
    let [nx, ny] = LATTICE;
    (0..nx * ny).map(move |i| Vec2::new((i % nx) as f32 + 0.5, (i / nx) as f32 + 0.5) / Vec2::new(nx as f32, ny as f32))
}

fn direction(cos: f32) -> Local {
    Local(Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos))
}

impl Table {
    fn new(value: impl Fn(usize, f32) -> f32) -> Self {
        let row = |row| std::array::from_fn(|i| value(row, node(i)));
        let values: Vec<[f32; COSINES]> = (0..ROUGHNESSES).map(row).collect();
        let means = values.iter().map(mean).collect();
        Self { values, means }
    }
    /// At the root `r` of alpha and the cosine `cos`, both in [0, 1].
    #[inline]
    fn at(&self, r: f32, cos: f32) -> f32 {
        let (row, f) = place(r, ROUGHNESSES);
        let (column, g) = place(cos.clamp(0.0, 1.0).sqrt(), COSINES);
        // Linear in the cosine, not in its root.
        let (a, b) = (node(column), node(column + 1));
        let g = if g > 0.0 { ((cos - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
        let along = |v: &[f32; COSINES]| v[column] + g * (v[column + 1] - v[column]);
        let (low, high) = (along(&self.values[row]), along(&self.values[row + 1]));
        low + f * (high - low)
    }
    #[inline]
    fn mean(&self, r: f32) -> f32 {
        let (row, f) = place(r, ROUGHNESSES);
        self.means[row] + f * (self.means[row + 1] - self.means[row])
    }
}

/// The interval of `x` in [0, 1] between `n` even nodes, and the place in it.
#[inline]
fn place(x: f32, n: usize) -> (usize, f32) {
    let x = x.clamp(0.0, 1.0) * (n - 1) as f32;
    let i = (x as usize).min(n - 2);
    (i, x - i as f32)
}

/// `2 ∫ v cos d(cos)` of the interpolated row.
fn mean(values: &[f32; COSINES]) -> f32 {
    let mut sum = 0.5 * f64::from(node(0) * node(0)) * f64::from(values[0]);
    for i in 0..COSINES - 1 {
        let [a, b, x, y] = [node(i), node(i + 1), values[i], values[i + 1]].map(f64::from);
        // Of two linear functions: Simpson's rule is exact.
        sum += (b - a) / 6.0 * (a * x + (a + b) * (x + y) + b * y);
    }
    (2.0 * sum) as f32
}

impl Tables {
    fn new() -> Self {
        let ggx = |row, cos: f32, f: fn(f32) -> f32| {
            let (ggx, wo) = (Ggx::new(alpha(row)), direction(cos));
            let one = |u| {
                let m = ggx.sample_visible(wo, u);
                reflect_up(wo, m).map_or(0.0, |wi| f(wo.dot(m).clamp(0.0, 1.0)) * ggx.shadowing(wo, wi))
            };
            lattice().map(one).sum::<f32>() / lattice().count() as f32
        };
        let whole = Table::new(|row, cos| ggx(row, cos, |_| 1.0));
        let edge = Table::new(|row, cos| ggx(row, cos, |c| (1.0 - c).powi(5)));
        let sheen = Table::new(|row, cos| {
            let (lobe, wo) = (Sheen::new(alpha(row)), direction(cos));
            let one = |u: Vec2| {
                // Denser at grazing angles, where the light is: density 1/(2π · 2√z).
                let ((y, x), z) = ((std::f32::consts::TAU * u.x).sin_cos(), u.y * u.y);
                let r = (1.0 - z * z).sqrt();
                lobe.f(wo, Local(Vec3::new(r * x, r * y, z))) * z * std::f32::consts::TAU * 2.0 * u.y
            };
            lattice().map(one).sum::<f32>() / lattice().count() as f32
        });
        let scale = |row: &[f32; COSINES]| MOST_SHEEN / row.iter().copied().fold(MOST_SHEEN, f32::max);
        let sheen_scales: Vec<f32> = sheen.values.iter().map(scale).collect();
        let values: Vec<_> = sheen.values.iter().zip(&sheen_scales).map(|(row, s)| row.map(|v| v * s)).collect();
        let means = values.iter().map(mean).collect();
        Self { whole, edge, sheen: Table { values, means }, sheen_scales }
    }
}

/// A GGX landscape of roughness `alpha` as layers need it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Albedo {
    /// Root of alpha.
    r: f32,
}

impl Albedo {
    #[inline]
    pub(super) fn new(alpha: f32) -> Self {
        Self { r: alpha.sqrt() }
    }
    /// Of a perfect metal, light that is scattered once: 1 but for what facets keep from each other.
    #[inline]
    pub(super) fn whole(self, cos: f32) -> f32 {
        TABLES.whole.at(self.r, cos)
    }
    /// Mean of [`Albedo::whole`] over the hemisphere.
    #[inline]
    pub(super) fn whole_mean(self) -> f32 {
        TABLES.whole.mean(self.r)
    }
    /// Of a boundary that reflects from `f0` along the normal to `f90` at grazing angles.
    #[inline]
    pub(super) fn of(self, f0: Spectrum, f90: f32, cos: f32) -> Spectrum {
        let (whole, edge) = (self.whole(cos), TABLES.edge.at(self.r, cos));
        f0 * (whole - edge).max(0.0) + Spectrum::splat(f90 * edge)
    }
    /// Mean of [`Albedo::of`] over the hemisphere.
    #[inline]
    pub(super) fn mean_of(self, f0: Spectrum, f90: f32) -> Spectrum {
        let (whole, edge) = (self.whole_mean(), TABLES.edge.mean(self.r));
        f0 * (whole - edge).max(0.0) + Spectrum::splat(f90 * edge)
    }
}

/// A sheen, of a roughness that is in the tables.
#[derive(Clone, Copy, Debug)]
pub(super) struct TabulatedSheen {
    row: usize,
}

impl TabulatedSheen {
    /// Of the tabulated roughness next to `alpha`, in [0, 1].
    #[inline]
    pub(super) fn new(alpha: f32) -> Self {
        Self { row: (alpha.clamp(0.0, 1.0).sqrt() * (ROUGHNESSES - 1) as f32).round() as usize }
    }
    /// Scattering function, 1/sr, between directions above the surface.
    #[inline]
    pub(super) fn f(self, wo: Local, wi: Local) -> f32 {
        TABLES.sheen_scales[self.row] * Sheen::new(alpha(self.row)).f(wo, wi)
    }
    /// Its albedo, below 1.
    #[inline]
    pub(super) fn albedo(self, cos: f32) -> f32 {
        TABLES.sheen.at(alpha(self.row).sqrt(), cos)
    }
}
