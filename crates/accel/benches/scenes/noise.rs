//! Value noise on the integer lattice.

use glam::{IVec3, Vec3};

/// Six octaves, about in [-1, 1].
pub(super) fn fractal(p: Vec3) -> f32 {
    let (mut sum, mut amplitude, mut scale) = (0.0, 0.5, 3.0);
    for _ in 0..6 {
        sum += amplitude * (2.0 * value(p * scale + Vec3::new(17.0, 5.0, 31.0)) - 1.0);
        amplitude *= 0.5;
        scale *= 2.07;
    }
    sum
}

/// Smoothly interpolated random values in [0, 1].
fn value(p: Vec3) -> f32 {
    let (cell, t) = (p.floor(), p.fract_gl());
    let cell = cell.as_ivec3();
    let t = t * t * (3.0 - 2.0 * t);
    let row = |y, z| {
        let ends = [0, 1].map(|x| hash(cell + IVec3::new(x, y, z)));
        ends[0] + (ends[1] - ends[0]) * t.x
    };
    let plane = |z| row(0, z) + (row(1, z) - row(0, z)) * t.y;
    plane(0) + (plane(1) - plane(0)) * t.z
}

fn hash(p: IVec3) -> f32 {
    let p = p.as_uvec3();
    let mut h = p.x.wrapping_mul(0x9e37_79b1) ^ p.y.wrapping_mul(0x85eb_ca77) ^ p.z.wrapping_mul(0xc2b2_ae3d);
    h = (h ^ h >> 15).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ h >> 12).wrapping_mul(0x297a_2d39);
    (h ^ h >> 15) as f32 / u32::MAX as f32
}
