//! What the builder sorts: references, a box and the name of the primitive inside.

use super::{Geometry, sphere::Sphere};
use glam::{BVec4A, Vec3, Vec4};
use rayon::prelude::*;

/// Coordinates beyond this count as infinite; products of three lengths must stay finite.
const MAX_COORDINATE: f32 = 1e18;

/// A primitive, or a part of one, with its box. The fourth lanes of the corners carry integers.
#[derive(Clone, Copy)]
pub(super) struct Ref {
    lo_and_primitive: Vec4,
    hi_and_owner: Vec4,
}

/// Whom a reference belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    /// Triangle `primitive` of a geometry.
    Triangle { geometry: u32, primitive: u32 },
    /// A sphere of the object's table of spheres.
    Sphere(u32),
    /// An instance of the table of instances.
    Instance(u32),
}

/// Owners above these are no geometries.
const SPHERE: u32 = u32::MAX - 1;
const INSTANCE: u32 = u32::MAX;

/// Clears the lane that carries an integer, whose bits may be a denormal number or NaN.
#[inline(always)]
pub(super) fn xyz(v: Vec4) -> Vec4 {
    Vec4::select(BVec4A::new(true, true, true, false), v, Vec4::ZERO)
}

impl Ref {
    pub(super) fn new(lo: Vec3, hi: Vec3, owner: Owner) -> Self {
        let (owner, primitive) = match owner {
            Owner::Triangle { geometry, primitive } => (geometry, primitive),
            Owner::Sphere(index) => (SPHERE, index),
            Owner::Instance(index) => (INSTANCE, index),
        };
        Self { lo_and_primitive: lo.extend(f32::from_bits(primitive)), hi_and_owner: hi.extend(f32::from_bits(owner)) }
    }

    pub(super) fn owner(&self) -> Owner {
        let primitive = self.lo_and_primitive.w.to_bits();
        match self.hi_and_owner.w.to_bits() {
            SPHERE => Owner::Sphere(primitive),
            INSTANCE => Owner::Instance(primitive),
            geometry => Owner::Triangle { geometry, primitive },
        }
    }

    /// The same owner with another box.
    pub(super) fn moved_to(&self, bounds: &Bounds) -> Self {
        Self {
            lo_and_primitive: bounds.lo.with_w(self.lo_and_primitive.w),
            hi_and_owner: bounds.hi.with_w(self.hi_and_owner.w),
        }
    }

    /// A box that carries a number instead of an owner.
    pub(super) fn numbered(bounds: &Bounds, number: u32) -> Self {
        Self { lo_and_primitive: bounds.lo, hi_and_owner: bounds.hi.with_w(f32::from_bits(number)) }
    }

    /// The number of a box made by [`Ref::numbered`].
    pub(super) fn number(&self) -> u32 {
        self.hi_and_owner.w.to_bits()
    }

    #[inline(always)]
    pub(super) fn bounds(&self) -> Bounds {
        Bounds { lo: xyz(self.lo_and_primitive), hi: xyz(self.hi_and_owner) }
    }

    /// Twice the midpoint.
    #[inline(always)]
    pub(super) fn centre2(&self) -> Vec4 {
        xyz(self.lo_and_primitive) + xyz(self.hi_and_owner)
    }
}

/// A box in vector registers; the fourth lane is zero.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) lo: Vec4,
    pub(super) hi: Vec4,
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { lo: Vec4::INFINITY, hi: Vec4::NEG_INFINITY };

    #[inline(always)]
    pub(super) fn grow(&mut self, other: &Self) {
        self.lo = self.lo.min(other.lo);
        self.hi = self.hi.max(other.hi);
    }

    #[inline(always)]
    pub(super) fn grow_point(&mut self, p: Vec4) {
        self.lo = self.lo.min(p);
        self.hi = self.hi.max(p);
    }

    #[inline(always)]
    pub(super) fn union(mut self, other: &Self) -> Self {
        self.grow(other);
        self
    }

    /// Half the surface; NaN or infinite for an empty box.
    #[inline(always)]
    pub(super) fn half_area(&self) -> f32 {
        let d = self.hi - self.lo;
        d.x * d.y + d.y * d.z + d.z * d.x
    }
}

/// The references of one object's own geometry, its spheres, and how many primitives were dropped.
pub(super) struct Collected {
    pub(super) refs: Vec<Ref>,
    pub(super) spheres: Vec<Sphere>,
    pub(super) dropped: usize,
}

/// Makes a reference for each primitive that a ray could hit.
pub(super) fn collect(geometries: &[Geometry]) -> Collected {
    let mut all = Collected { refs: Vec::new(), spheres: Vec::new(), dropped: 0 };
    for (geometry, shape) in geometries.iter().enumerate() {
        let geometry = geometry as u32;
        match *shape {
            Geometry::Triangles { positions, indices } => {
                let before = all.refs.len();
                all.refs.par_extend(indices.par_iter().enumerate().filter_map(|(primitive, corners)| {
                    let owner = Owner::Triangle { geometry, primitive: primitive as u32 };
                    triangle_ref(corners.map(|i| positions[i as usize]), owner)
                }));
                all.dropped += indices.len() - (all.refs.len() - before);
            }
            Geometry::Sphere { centre, radius } => {
                let index = all.spheres.len() as u32;
                match sphere_ref(centre, radius, index) {
                    Some(reference) => {
                        all.refs.push(reference);
                        all.spheres.push(Sphere { centre, radius, geometry });
                    }
                    None => all.dropped += 1,
                }
            }
        }
    }
    all
}

/// `None` for triangles without area and for coordinates that are not usable.
fn triangle_ref(corners: [Vec3; 3], owner: Owner) -> Option<Ref> {
    let [a, b, c] = corners;
    let (lo, hi) = (a.min(b).min(c), a.max(b).max(c));
    let usable = corners.iter().all(|p| p.abs().cmplt(Vec3::splat(MAX_COORDINATE)).all());
    let normal = (b - a).as_dvec3().cross((c - a).as_dvec3());
    (usable && normal != glam::DVec3::ZERO).then(|| Ref::new(lo, hi, owner))
}

/// `None` for spheres without a positive finite radius or at unusable coordinates.
fn sphere_ref(centre: Vec3, radius: f32, index: u32) -> Option<Ref> {
    let slack = centre.abs() * f32::EPSILON + radius * (1.0 + 4.0 * f32::EPSILON);
    let (lo, hi) = (centre - slack, centre + slack);
    let usable = radius > 0.0 && lo.abs().max(hi.abs()).cmplt(Vec3::splat(MAX_COORDINATE)).all();
    usable.then(|| Ref::new(lo, hi, Owner::Sphere(index)))
}
