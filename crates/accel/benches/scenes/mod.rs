//! The benchmark scenes and the seven ray sets.
//!
//! S1, "ball": a noisy icosphere of 1.3 M triangles in a Cornell box. S2, "clutter": 160 small noisy spheres and
//! 100 000 long thin slivers in the same box. Rays are those of a path tracer's first bounces.

mod noise;
mod rays;

pub(crate) use rays::*;

use glam::Vec3;
use std::collections::HashMap;

/// An indexed triangle mesh.
#[derive(Default)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) indices: Vec<[u32; 3]>,
}

/// A small linear congruential generator with an output hash.
pub(crate) struct Rng(u64);

impl Rng {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in [0, 1).
    pub(crate) fn uniform(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        let x = (self.0 ^ self.0 >> 29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (x >> 40) as f32 / 16_777_216.0
    }

    /// Uniform in the cube [-1, 1)³.
    pub(crate) fn cube(&mut self) -> Vec3 {
        Vec3::new(self.uniform(), self.uniform(), self.uniform()) * 2.0 - 1.0
    }
}

/// Scene S1, with `20 * 4^level` triangles in the ball.
pub(crate) fn ball(level: u32) -> Mesh {
    let mut mesh = noisy_sphere(level);
    for p in &mut mesh.positions {
        p.y -= 0.25;
    }
    mesh.add_room();
    mesh
}

/// Scene S2.
pub(crate) fn clutter() -> Mesh {
    let sphere = noisy_sphere(4);
    let mut mesh = Mesh::default();
    let mut rng = Rng::new(99);
    for _ in 0..160 {
        let centre = rng.cube() * 0.9;
        let size = 0.05 + 0.25 * rng.uniform() * rng.uniform();
        mesh.append(&sphere, |p| p * size + centre);
    }
    for _ in 0..100_000 {
        let (a, along, across) = (rng.cube(), rng.cube() * 0.15, rng.cube() * 0.001);
        mesh.add_polygon(&[a, a + along, a + along + across]);
    }
    mesh.add_room();
    mesh
}

impl Mesh {
    /// The normal of the triangle that was hit, of either side.
    pub(crate) fn normal(&self, hit: &accel::Hit) -> Vec3 {
        let [a, b, c] = self.indices[hit.primitive as usize].map(|i| self.positions[i as usize]);
        (b - a).cross(c - a).normalize()
    }

    fn append(&mut self, other: &Self, map: impl Fn(Vec3) -> Vec3) {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions.iter().map(|&p| map(p)));
        self.indices.extend(other.indices.iter().map(|t| t.map(|i| i + first)));
    }

    /// A convex polygon as a fan.
    fn add_polygon(&mut self, corners: &[Vec3]) {
        let first = self.positions.len() as u32;
        self.positions.extend_from_slice(corners);
        self.indices.extend((2..corners.len() as u32).map(|i| [first, first + i - 1, first + i]));
    }

    /// The rectangle at `corner` with the given sides.
    fn add_rectangle(&mut self, corner: Vec3, u: Vec3, v: Vec3) {
        self.add_polygon(&[corner, corner + u, corner + u + v, corner + v]);
    }

    /// A Cornell box without its front, a lamp below the ceiling, and two boxes on the floor.
    pub(crate) fn add_room(&mut self) {
        let (x, y, z) = (Vec3::X * 2.0, Vec3::Y * 2.0, Vec3::Z * 2.0);
        self.add_rectangle(Vec3::NEG_ONE, x, z);
        self.add_rectangle(Vec3::new(-1.0, 1.0, -1.0), z, x);
        self.add_rectangle(Vec3::NEG_ONE, y, x);
        self.add_rectangle(Vec3::NEG_ONE, z, y);
        self.add_rectangle(Vec3::new(1.0, -1.0, -1.0), y, z);
        self.add_rectangle(Vec3::new(-0.25, 0.995, -0.25), z * 0.25, x * 0.25);
        for (cx, cz, height) in [(-0.65, -0.6, 0.9), (0.65, 0.6, 0.4)] {
            let (w, top) = (Vec3::new(0.4, 0.0, 0.0), Vec3::new(0.0, height, 0.0));
            let (corner, d) = (Vec3::new(cx - 0.2, -1.0, cz - 0.2), Vec3::new(0.0, 0.0, 0.4));
            self.add_rectangle(corner + top, w, d);
            for (at, side) in [(corner, w), (corner + d, w), (corner, d), (corner + w, d)] {
                self.add_rectangle(at, side, top);
            }
        }
    }
}

/// A subdivided icosahedron of radius about 0.55, displaced by six octaves of noise.
pub(crate) fn noisy_sphere(level: u32) -> Mesh {
    let golden = f32::midpoint(1.0, 5_f32.sqrt());
    let mut positions = Vec::new();
    for (a, b) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        positions.extend([Vec3::new(a, b, 0.0), Vec3::new(0.0, a, b), Vec3::new(b, 0.0, a)].map(Vec3::normalize));
    }
    let mut indices = hull_of_icosahedron(&positions);
    for _ in 0..level {
        subdivide(&mut positions, &mut indices);
    }
    for p in &mut positions {
        *p *= 0.55 + 0.35 * noise::fractal(*p);
    }
    Mesh { positions, indices }
}

/// The 20 triples of vertices at edge distance from each other.
fn hull_of_icosahedron(positions: &[Vec3]) -> Vec<[u32; 3]> {
    let near = |a: u32, b: u32| positions[a as usize].distance(positions[b as usize]) < 1.1;
    let count = positions.len() as u32;
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))).filter(|&(a, b)| near(a, b));
    pairs.flat_map(|(a, b)| (b + 1..count).filter(move |&c| near(a, c) && near(b, c)).map(move |c| [a, b, c])).collect()
}

fn subdivide(positions: &mut Vec<Vec3>, indices: &mut Vec<[u32; 3]>) {
    let mut middles = HashMap::with_capacity(indices.len() * 2);
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            positions.push((positions[a as usize] + positions[b as usize]).normalize());
            positions.len() as u32 - 1
        })
    };
    let split = |&[a, b, c]: &[u32; 3]| {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
    };
    *indices = indices.iter().flat_map(split).collect();
}
