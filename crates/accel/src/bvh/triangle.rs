//! Blocks of four triangles and the watertight test of a ray against them.
//!
//! Woop, Benthin & Wald 2013, "Watertight Ray/Triangle Intersection": vertices are moved to the ray's origin and
//! sheared so that the ray becomes the z axis; each vertex is treated alike whichever triangle it belongs to, so the
//! edge function of a shared edge has exactly opposite values in the two triangles. A value of zero counts as inside
//! for both.

use super::simd::Simd;
use crate::Hit;
use glam::Vec3;

/// Triangles per block.
pub(super) const LANES: usize = 4;

/// Four triangles in structure-of-arrays form; unused lanes hold a point at the origin, which no ray hits.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
pub(super) struct Block {
    /// Vertex, then axis, then lane.
    pub(super) vertices: [[[f32; LANES]; 3]; 3],
    /// The triangles' numbers among those of the table, see `names`.
    pub(super) numbers: [u32; LANES],
}

impl Block {
    pub(super) const EMPTY: Self = Self { vertices: [[[0.0; LANES]; 3]; 3], numbers: [u32::MAX; LANES] };

    pub(super) fn set(&mut self, lane: usize, corners: [Vec3; 3], number: u32) {
        for (vertex, corner) in self.vertices.iter_mut().zip(corners) {
            for axis in 0..3 {
                vertex[axis][lane] = corner[axis];
            }
        }
        self.numbers[lane] = number;
    }
}

/// The ray as the triangle test wants it: axes permuted so that z is the largest of |d|, and the shear.
#[derive(Clone, Copy)]
pub(super) struct Shear<S: Simd> {
    axes: [usize; 3],
    o: [S::F4; 3],
    /// d.x/d.z, d.y/d.z, 1/d.z in permuted axes.
    slopes: [S::F4; 3],
}

impl<S: Simd> Shear<S> {
    #[inline(always)]
    pub(super) fn new(s: S, o: Vec3, d: Vec3) -> Self {
        let a = d.abs();
        let z = if a.x > a.y && a.x > a.z {
            0
        } else if a.y > a.z {
            1
        } else {
            2
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let (o, d) = (o.to_array(), d.to_array());
        let inv_z = 1.0 / d[z];
        Self {
            axes,
            o: axes.map(|k| s.splat4(o[k])),
            slopes: [s.splat4(d[axes[0]] * inv_z), s.splat4(d[axes[1]] * inv_z), s.splat4(inv_z)],
        }
    }
}

/// The lanes a ray hits, with what is needed to finish the hit record.
pub(super) struct LaneHits {
    /// One bit per lane with a hit in the open interval.
    pub(super) mask: u32,
    pub(super) t: [f32; LANES],
    pub(super) u: [f32; LANES],
    pub(super) v: [f32; LANES],
}

/// Tests the ray against one block; hits are accepted for `tmin < t < tmax`. `None` if no lane is hit.
#[inline(always)]
pub(super) fn intersect<S: Simd>(s: S, block: &Block, ray: &Shear<S>, tmin: f32, tmax: f32) -> Option<LaneHits> {
    let [kx, ky, kz] = ray.axes;
    let mut x = [s.splat4(0.0); 3];
    let (mut y, mut z) = (x, x);
    for (i, vertex) in block.vertices.iter().enumerate() {
        // SAFETY: `axes` are 0, 1 and 2 in some order.
        let [vx, vy, vz] = unsafe { [vertex.get_unchecked(kx), vertex.get_unchecked(ky), vertex.get_unchecked(kz)] };
        z[i] = s.sub4(s.load4(vz), ray.o[2]);
        x[i] = s.fnmadd4(ray.slopes[0], z[i], s.sub4(s.load4(vx), ray.o[0]));
        y[i] = s.fnmadd4(ray.slopes[1], z[i], s.sub4(s.load4(vy), ray.o[1]));
    }
    // Each product is rounded on its own: a fused operation would break the antisymmetry of shared edges.
    let u = s.sub4(s.mul4(x[2], y[1]), s.mul4(y[2], x[1]));
    let v = s.sub4(s.mul4(x[0], y[2]), s.mul4(y[0], x[2]));
    let w = s.sub4(s.mul4(x[1], y[0]), s.mul4(y[1], x[0]));
    let zero = s.splat4(0.0);
    let inside = s.ge4(s.min4(u, s.min4(v, w)), zero) | s.ge4(zero, s.max4(u, s.max4(v, w)));
    if inside == 0 {
        return None;
    }
    let det = s.add4(s.add4(u, v), w);
    let scaled = s.add4(s.add4(s.mul4(u, z[0]), s.mul4(v, z[1])), s.mul4(w, z[2]));
    let inv = s.div4(s.splat4(1.0), det);
    let t = s.mul4(s.mul4(scaled, ray.slopes[2]), inv);
    // A zero determinant makes `t` infinite or NaN, and both comparisons are false for it.
    let mask = inside & s.gt4(t, s.splat4(tmin)) & s.gt4(s.splat4(tmax), t);
    if mask == 0 {
        return None;
    }
    Some(LaneHits { mask, t: s.store4(t), u: s.store4(s.mul4(v, inv)), v: s.store4(s.mul4(w, inv)) })
}

impl LaneHits {
    /// The hit record of one lane.
    #[inline(always)]
    pub(super) fn hit(&self, lane: usize, (geometry, primitive): (u32, u32), instance: u32) -> Hit {
        Hit { t: self.t[lane], u: self.u[lane], v: self.v[lane], geometry, primitive, instance }
    }
}
