//! How much of a surface one lookup stands for: the cone of a pixel, and what it covers in texture coordinates.
//!
//! A cone starts as wide as the camera's pixel and goes on past flat mirrors and panes (Amanatides 1984, "Ray Tracing with
//! Cones"; Akenine-Möller et al. 2021, "Improved Shader and Texture Level of Detail Using Ray Cones"). At curved ones and at the
//! first scattering that is not from a delta lobe it ends: lookups beyond are points. In pass `i` it is 1/√(i + 1) of a pixel
//! wide, as n samples of a pixel are that far apart, so the mean over passes goes to what points alone find.
use glam::{Mat2, Vec2, Vec3};

/// A ray as wide as a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Cone {
    /// Width (world units) where it starts.
    pub width: f32,
    /// By how much that grows per unit of the way.
    pub spread: f32,
}

impl Cone {
    /// A mere ray.
    pub const RAY: Self = Self { width: 0.0, spread: 0.0 };

    /// Whether it is a mere ray.
    #[inline]
    pub fn is_ray(&self) -> bool {
        self.width == 0.0 && self.spread == 0.0
    }
    /// Width (world units) after the way `distance`.
    #[inline]
    pub fn width_at(&self, distance: f32) -> f32 {
        self.width + self.spread * distance
    }
    /// The cone behind a flat mirror or boundary that was met after `distance`; `eta` is the index of refraction there over
    /// that before. Angles become 1/`eta` as wide (Snell's law for small angles; at grazing ones a little less in one direction).
    #[inline]
    pub fn beyond(&self, distance: f32, eta: f32) -> Self {
        Self { width: self.width_at(distance), spread: self.spread / eta }
    }
}

/// What a lookup covers: a parallelogram of texture coordinates around its point.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Footprint {
    /// Its sides, whole widths.
    pub sides: [Vec2; 2],
}

/// The least cosine that counts: beyond, footprints are no longer than a hundred times their width.
const GRAZING: f32 = 0.01;

impl Footprint {
    /// A point.
    pub const POINT: Self = Self { sides: [Vec2::ZERO; 2] };

    /// Where a cone of `width` (world units) that goes in direction `d` meets a surface of normal `n`, whose point moves by
    /// `tangents` as its coordinates grow. A point where these are degenerate.
    pub fn new(width: f32, d: Vec3, n: Vec3, tangents: [Vec3; 2]) -> Self {
        let cos = d.dot(n);
        let across = d.cross(n).try_normalize().unwrap_or_else(|| n.any_orthonormal_vector());
        let along = across.cross(n) * (width / cos.abs().max(GRAZING));
        let [u, v] = tangents;
        // Least squares: exact in the plane of the tangents.
        let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
        let det = uu * vv - uv * uv;
        let side = |w: Vec3| {
            let (wu, wv) = (w.dot(u), w.dot(v));
            Vec2::new(wu * vv - wv * uv, wv * uu - wu * uv) / det
        };
        let sides = [side(across * width), side(along)];
        if sides[0].is_finite() && sides[1].is_finite() { Self { sides } } else { Self::POINT }
    }
    /// Whether it is a point.
    #[inline]
    pub fn is_point(&self) -> bool {
        *self == Self::POINT
    }
    /// In other coordinates.
    #[inline]
    pub fn mapped(&self, map: Mat2) -> Self {
        Self { sides: self.sides.map(|s| map * s) }
    }
    /// Smaller footprints along its longer side that make it up, as long as they are wide or `least`: how wide they are, how
    /// many, and the way from each to the next. There are at most [`MOST`]; where that leaves gaps, they are left to the many
    /// rays of a pixel: wider pieces would blur what the pixel tells apart.
    #[inline]
    pub(super) fn pieces(&self, least: f32) -> Pieces {
        let [a, b] = self.sides;
        let (la, lb) = (a.length(), b.length());
        let (long, length, width) = if la > lb { (a, la, lb) } else { (b, lb, la) };
        let count = (length / width.max(least)).ceil().clamp(1.0, MOST);
        Pieces { width, count, step: long / count }
    }
}

/// Pieces of a footprint at most.
const MOST: f32 = 16.0;

/// See [`Footprint::pieces`].
pub(super) struct Pieces {
    pub(super) width: f32,
    count: f32,
    step: Vec2,
}

impl Pieces {
    /// The mean of a value over the pieces around `at`.
    #[inline]
    pub(super) fn mean<V: std::ops::Add<Output = V> + std::ops::Mul<f32, Output = V>>(
        &self,
        at: Vec2,
        value: impl Fn(Vec2) -> V,
    ) -> V {
        let first = at - self.step * (0.5 * (self.count - 1.0));
        let mut sum = value(first);
        for i in 1..self.count as u32 {
            sum = sum + value(first + i as f32 * self.step);
        }
        sum * self.count.recip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_footprint_is_as_wide_as_its_cone_and_longer_by_the_slant() {
        // Coordinates sheared and stretched over the floor.
        let tangents = [Vec3::new(2.0, 0.0, 0.5), Vec3::new(0.0, 0.0, -4.0)];
        let world = |uv: Vec2| uv.x * tangents[0] + uv.y * tangents[1];
        for (cos, width) in [(1.0f32, 0.1f32), (0.5, 0.1), (0.2, 3.0)] {
            let d = Vec3::new((1.0 - cos * cos).sqrt(), -cos, 0.0);
            let [across, along] = Footprint::new(width, d, Vec3::Y, tangents).sides.map(world);
            assert!((across.length() - width).abs() < 1e-5 && (along.length() - width / cos).abs() < 1e-4, "{cos}");
            assert!(across.dot(d).abs() < 1e-6 && (cos == 1.0 || along.x.abs() > 0.99 * along.length()));
        }
        assert!(Footprint::new(0.1, Vec3::NEG_Y, Vec3::Y, [Vec3::X, Vec3::X]).is_point());
    }

    #[test]
    fn a_cone_through_a_pane_goes_on_as_if_it_were_not_there() {
        let cone = Cone { width: 0.0, spread: 0.01 };
        let behind = cone.beyond(2.0, 1.0).beyond(1.0, 1.5).beyond(0.0, 1.0 / 1.5);
        assert!((behind.spread - cone.spread).abs() < 1e-9 && (behind.width - 0.03).abs() < 1e-6);
        let inside = cone.beyond(2.0, 1.5);
        assert!((inside.width_at(3.0) - (0.02 + 0.02)).abs() < 1e-6);
    }
}
