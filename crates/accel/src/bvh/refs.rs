//! What the builder sorts: references, a box and the name of the primitive inside.

use super::{Geometry, sphere::Sphere};
use glam::{BVec4A, Vec3, Vec4};
use rayon::prelude::*;

/// Coordinates beyond this count as infinite; products of three lengths must stay finite.
const MAX_COORDINATE: f32 = 1e18;
/// References that one thread looks at in turn.
pub(super) const CHUNK: usize = 1 << 12;

/// A primitive, or a part of one, with its box: the lower corner, the primitive's bits, the upper corner negated, the
/// owner's bits. So the smaller of each of two references' lanes makes the box around both.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
pub(super) struct Ref(pub(super) [f32; 8]);

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

/// Owners from here on are no geometries.
const SPHERE: u32 = u32::MAX - 1;
const INSTANCE: u32 = u32::MAX;

/// Clears the lane that carries an integer, whose bits may be a denormal number or NaN.
#[inline(always)]
fn xyz(v: Vec4) -> Vec4 {
    Vec4::select(BVec4A::new(true, true, true, false), v, Vec4::ZERO)
}

impl Ref {
    pub(super) fn new(lo: Vec3, hi: Vec3, owner: Owner) -> Self {
        let (owner, primitive) = match owner {
            Owner::Triangle { geometry, primitive } => (geometry, primitive),
            Owner::Sphere(index) => (SPHERE, index),
            Owner::Instance(index) => (INSTANCE, index),
        };
        let (primitive, owner) = (f32::from_bits(primitive), f32::from_bits(owner));
        Self([lo.x, lo.y, lo.z, primitive, -hi.x, -hi.y, -hi.z, owner])
    }

    pub(super) fn owner(&self) -> Owner {
        let primitive = self.0[3].to_bits();
        match self.0[7].to_bits() {
            SPHERE => Owner::Sphere(primitive),
            INSTANCE => Owner::Instance(primitive),
            geometry => Owner::Triangle { geometry, primitive },
        }
    }

    /// The same owner with another box.
    pub(super) fn moved_to(&self, bounds: &Bounds) -> Self {
        let (lo, hi) = (bounds.lo, -bounds.hi);
        Self([lo.x, lo.y, lo.z, self.0[3], hi.x, hi.y, hi.z, self.0[7]])
    }

    #[inline(always)]
    pub(super) fn bounds(&self) -> Bounds {
        let [lo, negated_hi] = self.corners();
        Bounds { lo: xyz(lo), hi: -xyz(negated_hi) }
    }

    /// Twice the midpoint.
    #[inline(always)]
    pub(super) fn centre2(&self) -> Vec4 {
        let [lo, negated_hi] = self.corners();
        xyz(lo) - xyz(negated_hi)
    }

    /// Whether no ray can hit it.
    fn is_empty(&self) -> bool {
        self.0[0] > -self.0[4]
    }

    #[inline(always)]
    fn corners(&self) -> [Vec4; 2] {
        let [a, b, c, d, e, f, g, h] = self.0;
        [Vec4::new(a, b, c, d), Vec4::new(e, f, g, h)]
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

/// A box as a reference has it: lower corner, negated upper corner; the fourth lanes mean nothing.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
pub(super) struct Corners(pub(super) [f32; 8]);

impl Corners {
    pub(super) const EMPTY: Self = Self([f32::INFINITY; 8]);

    #[inline(always)]
    pub(super) fn point(p: Vec4) -> Self {
        let [x, y, z, _] = p.to_array();
        Self([x, y, z, 0.0, -x, -y, -z, 0.0])
    }

    #[inline(always)]
    pub(super) fn grow(&mut self, other: &Self) {
        for i in 0..8 {
            self.0[i] = if other.0[i] < self.0[i] { other.0[i] } else { self.0[i] };
        }
    }

    /// Added to each lane, infinity makes the box empty.
    #[inline(always)]
    pub(super) fn plus(mut self, x: f32) -> Self {
        for lane in &mut self.0 {
            *lane += x;
        }
        self
    }

    #[inline(always)]
    pub(super) fn bounds(&self) -> Bounds {
        let [a, b, c, _, d, e, f, _] = self.0;
        Bounds { lo: Vec4::new(a, b, c, 0.0), hi: -Vec4::new(d, e, f, 0.0) }
    }

    /// Half the surface; NaN or infinite for an empty box.
    #[inline(always)]
    pub(super) fn half_area(&self) -> f32 {
        self.bounds().half_area()
    }
}

/// The references of one object's own geometry, its spheres, and how many primitives were dropped.
pub(super) struct Collected {
    pub(super) refs: Vec<Ref>,
    pub(super) spheres: Vec<Sphere>,
    pub(super) dropped: usize,
}

/// Makes a reference for each primitive that a ray could hit, behind those in `before`. There is room for `share` times as many
/// more.
pub(super) fn collect(geometries: &[Geometry], before: &[Ref], share: f32) -> Collected {
    let count = |shape: &Geometry| if let Geometry::Triangles { indices, .. } = shape { indices.len() } else { 1 };
    let most = before.len() + geometries.iter().map(count).sum::<usize>();
    let mut refs = Vec::with_capacity(most + (most as f32 * share) as usize);
    refs.extend_from_slice(before);
    let mut spheres = Vec::new();
    for (geometry, shape) in geometries.iter().enumerate() {
        let geometry = geometry as u32;
        match *shape {
            Geometry::Triangles { positions, indices } => {
                refs.par_extend(indices.par_iter().with_min_len(CHUNK).enumerate().map(|(primitive, corners)| {
                    let owner = Owner::Triangle { geometry, primitive: primitive as u32 };
                    triangle_ref(corners.map(|i| positions[i as usize]), owner)
                }));
            }
            Geometry::Sphere { centre, radius } => {
                if let Some(reference) = sphere_ref(centre, radius, spheres.len() as u32) {
                    refs.push(reference);
                    spheres.push(Sphere { centre, radius, geometry });
                }
            }
        }
    }
    if refs.par_iter().with_min_len(CHUNK).any(Ref::is_empty) {
        refs.retain(|reference| !reference.is_empty());
    }
    Collected { dropped: most - refs.len(), refs, spheres }
}

/// The box around all, and the sum of their half surfaces, which does not depend on the number of threads.
pub(super) fn measure(refs: &[Ref]) -> (Bounds, f64) {
    let measure = |chunk: &[Ref]| {
        let grow = |(all, sum): (Bounds, f64), reference: &Ref| {
            let bounds = reference.bounds();
            (all.union(&bounds), sum + f64::from(bounds.half_area()))
        };
        chunk.iter().fold((Bounds::EMPTY, 0.0), grow)
    };
    let parts: Vec<_> = refs.par_chunks(CHUNK).map(measure).collect();
    parts.iter().fold((Bounds::EMPTY, 0.0), |(all, sum), (bounds, more)| (all.union(bounds), sum + more))
}

/// Empty for triangles without area and for coordinates that are not usable.
#[inline(always)]
fn triangle_ref(corners: [Vec3; 3], owner: Owner) -> Ref {
    let [a, b, c] = corners;
    let (lo, hi) = (a.min(b).min(c), a.max(b).max(c));
    let usable = corners.iter().all(|p| p.abs().cmplt(Vec3::splat(MAX_COORDINATE)).all());
    let (along, across) = (b - a, c - a);
    // Rounded products that differ are those of different products.
    let has_area =
        || along.cross(across) != Vec3::ZERO || along.as_dvec3().cross(across.as_dvec3()) != glam::DVec3::ZERO;
    if usable && has_area() { Ref::new(lo, hi, owner) } else { Ref::new(Vec3::INFINITY, Vec3::NEG_INFINITY, owner) }
}

/// `None` for spheres without a positive finite radius or at unusable coordinates.
fn sphere_ref(centre: Vec3, radius: f32, index: u32) -> Option<Ref> {
    let slack = centre.abs() * f32::EPSILON + radius * (1.0 + 4.0 * f32::EPSILON);
    let (lo, hi) = (centre - slack, centre + slack);
    let usable = radius > 0.0 && lo.abs().max(hi.abs()).cmplt(Vec3::splat(MAX_COORDINATE)).all();
    usable.then(|| Ref::new(lo, hi, Owner::Sphere(index)))
}
