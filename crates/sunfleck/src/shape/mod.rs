//! Geometry: where a surface is, how it is oriented, and points drawn from it.
//!
//! Intersection itself is the work of the crate `accel`, which knows triangles and spheres; a shape tells it what it is
//! made of and turns a hit into a point with normals. To add one: write `shape/<name>.rs` and one variant of [`Shape`].
mod attributes;
mod mesh;
mod parallelogram;
mod sphere;

pub use attributes::{Attributes, Tangents};
pub use mesh::{Mesh, MeshError};
pub use parallelogram::Parallelogram;
pub use sphere::Sphere;

use crate::texture::VertexAttributes;
use accel::{Aabb, Hit};
use glam::{Affine3A, Vec2, Vec3};

/// One of the shapes of this room.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Indexed triangles.
    Mesh(Mesh),
    /// A full sphere.
    Sphere(Sphere),
    /// A flat four-sided patch.
    Parallelogram(Parallelogram),
}

/// A point on a surface, before materials.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Position.
    pub p: Vec3,
    /// Bound on each coordinate's absolute error.
    pub p_error: Vec3,
    /// Geometric normal, unit, on the outer side.
    pub ng: Vec3,
    /// Shading normal, unit, in the hemisphere of `ng`.
    pub n: Vec3,
    /// Texture coordinates, if they were asked for.
    pub uv: Vec2,
}

/// A point drawn from a surface's area.
#[derive(Clone, Copy, Debug)]
pub struct AreaSample {
    /// Position.
    pub p: Vec3,
    /// Bound on each coordinate's absolute error.
    pub p_error: Vec3,
    /// Geometric normal, unit, on the outer side.
    pub ng: Vec3,
}

/// `n * EPSILON / (1 - n * EPSILON)`: relative error bound of `n` roundings (Higham 2002, lemma 3.1).
#[inline]
pub(crate) fn gamma(n: f32) -> f32 {
    let e = n * f32::EPSILON * 0.5;
    e / (1.0 - e)
}

/// Error to add to a point of a triangle with edges `e1` and `e2` from one corner, unit normal `ng` and half of `twice_area`,
/// so that a ray started beyond it is not found to hit the triangle at a small positive distance.
///
/// The ray index computes distances from barycentrics, of which each edge function is off by some roundings of L², L being
/// the longest edge. Seen along the normal that moves the plane by about ε·L·(L²/2A), however the ray grazes.
#[inline]
pub(crate) fn plane_error(e1: Vec3, e2: Vec3, ng: Vec3, twice_area: f32) -> Vec3 {
    let l2 = e1.length_squared().max(e2.length_squared()).max((e1 - e2).length_squared());
    let elongation = (l2 / twice_area.max(f32::MIN_POSITIVE)).min(MAX_ELONGATION);
    gamma(PLANE_ROUNDINGS) * l2.sqrt() * elongation * ng.abs()
}

/// `v` as a unit vector (`Z` if it is too short for one) and its length.
#[inline]
pub(crate) fn unit_and_length(v: Vec3) -> (Vec3, f32) {
    let length = v.length();
    let scale = length.recip();
    (if scale.is_finite() && scale > 0.0 { scale * v } else { Vec3::Z }, length)
}

/// Roundings that [`plane_error`] allows for: four times what `tests/shape_self_hits.rs` needs.
const PLANE_ROUNDINGS: f32 = 4.0;
/// The distance that a thinner needle needs is more than its width; there, light would leak past its neighbours.
const MAX_ELONGATION: f32 = 2000.0;

impl Shape {
    /// The point that `hit` describes, in the shape's own space; `at` is the hit for shapes that need it. Texture
    /// coordinates, which cost more than the rest, are right only with `wants_uv`.
    #[inline]
    pub fn surface_point(&self, hit: &Hit, at: Vec3, wants_uv: bool) -> SurfacePoint {
        match self {
            Self::Mesh(m) => m.surface_point(hit, wants_uv),
            Self::Sphere(s) => s.surface_point(at, wants_uv),
            Self::Parallelogram(q) => q.surface_point(hit),
        }
    }
    /// What the surface knows at `hit` beside its point.
    #[inline]
    pub fn attributes(&self, hit: &Hit) -> VertexAttributes {
        match self {
            Self::Mesh(m) => m.attributes_at(hit),
            Self::Sphere(_) | Self::Parallelogram(_) => VertexAttributes::default(),
        }
    }
    /// How the point `s` of `hit`, in the shape's own space, moves with its texture coordinates. `None` where they do not
    /// say: at the poles of a sphere, and where a mesh has none of its own.
    pub fn tangents(&self, hit: &Hit, s: &SurfacePoint) -> Option<Tangents> {
        match self {
            Self::Mesh(m) => m.tangents(hit, s.n),
            Self::Sphere(ball) => ball.tangents(s.n),
            Self::Parallelogram(q) => Some([q.u(), q.v()]),
        }
    }
    /// The box around it.
    pub fn bounds(&self) -> Aabb {
        match self {
            Self::Mesh(m) => m.positions().iter().fold(Aabb::EMPTY, |all, &p| all.with_point(p)),
            Self::Parallelogram(q) => q.corners().into_iter().fold(Aabb::EMPTY, |all, p| all.with_point(p)),
            Self::Sphere(s) => Aabb { min: s.centre - s.radius, max: s.centre + s.radius },
        }
    }
    /// Surface area (m²).
    pub fn area(&self) -> f32 {
        match self {
            Self::Mesh(m) => m.area(),
            Self::Sphere(s) => s.area(),
            Self::Parallelogram(q) => q.area(),
        }
    }
    /// A point uniform in area: density 1/area.
    #[inline]
    pub fn sample_area(&self, u: Vec2) -> AreaSample {
        match self {
            Self::Mesh(m) => m.sample_area(u),
            Self::Sphere(s) => s.sample_area(u),
            Self::Parallelogram(q) => q.sample_area(u),
        }
    }
    /// The same shape moved by `world_from_local`. `None` where the shape cannot follow (a sphere under shear or
    /// uneven scaling).
    pub fn transformed(&self, world_from_local: &Affine3A) -> Option<Self> {
        match self {
            Self::Mesh(m) => Some(Self::Mesh(m.transformed(world_from_local))),
            Self::Sphere(s) => s.transformed(world_from_local).map(Self::Sphere),
            Self::Parallelogram(q) => Some(Self::Parallelogram(q.transformed(world_from_local))),
        }
    }
}
