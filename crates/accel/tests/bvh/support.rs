//! Scenes, random numbers and slow-but-sure answers for the tests of the hierarchy.

use accel::{Geometry, Hit, Ray};
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// A 64-bit linear congruential generator with an output hash.
pub(crate) struct Rng(pub(crate) u64);

impl Rng {
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

    /// Uniform on the unit sphere.
    pub(crate) fn direction(&mut self) -> Vec3 {
        loop {
            let p = self.cube();
            if (0.01..1.0).contains(&p.length_squared()) {
                return p.normalize();
            }
        }
    }
}

/// An indexed triangle mesh.
#[derive(Clone, Default)]
pub(crate) struct Mesh {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) indices: Vec<[u32; 3]>,
}

impl Mesh {
    pub(crate) fn geometry(&self) -> Geometry<'_> {
        Geometry::Triangles { positions: &self.positions, indices: &self.indices }
    }

    pub(crate) fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.indices[triangle].map(|i| self.positions[i as usize])
    }
}

/// Small triangles strewn in the cube [-1, 1]³.
pub(crate) fn triangle_soup(count: usize, size: f32, seed: u64) -> Mesh {
    let mut rng = Rng(seed);
    let mut mesh = Mesh::default();
    for _ in 0..count {
        let (centre, first) = (rng.cube(), mesh.positions.len() as u32);
        mesh.positions.extend([(); 3].map(|()| centre + rng.cube() * size));
        mesh.indices.push([first, first + 1, first + 2]);
    }
    mesh
}

/// A closed bumpy ball around the origin: a subdivided octahedron of `8 * 4^level` triangles.
pub(crate) fn bumpy_ball(level: usize, bump: f32) -> Mesh {
    let mut positions: Vec<Vec3> = vec![Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z];
    let mut indices: Vec<[u32; 3]> =
        vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..level {
        let mut middles = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]).normalize());
                positions.len() as u32 - 1
            })
        };
        indices = indices
            .iter()
            .flat_map(|&[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    for p in &mut positions {
        let waves = (7.0 * p.x + 1.0).sin() * (9.0 * p.y + 2.0).sin() * (8.0 * p.z + 3.0).sin();
        *p *= 1.0 + bump * waves;
    }
    Mesh { positions, indices }
}

/// The nearest hit over all triangles of `mesh`, by the textbook formula in f64.
pub(crate) fn brute_force(mesh: &Mesh, ray: &Ray) -> Option<Hit> {
    let mut best: Option<(f64, Hit)> = None;
    for primitive in 0..mesh.indices.len() {
        let Some((t, u, v)) = intersect_f64(mesh.corners(primitive), ray) else { continue };
        if t > f64::from(ray.tmin) && t < best.map_or(f64::from(ray.tmax), |b| b.0) {
            let hit = Hit {
                t: t as f32,
                u: u as f32,
                v: v as f32,
                geometry: 0,
                primitive: primitive as u32,
                instance: Hit::NO_INSTANCE,
            };
            best = Some((t, hit));
        }
    }
    best.map(|b| b.1)
}

/// Möller & Trumbore 1997, without bounds on t.
pub(crate) fn intersect_f64(corners: [Vec3; 3], ray: &Ray) -> Option<(f64, f64, f64)> {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (o, d) = (ray.o.as_dvec3(), ray.d.as_dvec3());
    let (e1, e2): (DVec3, DVec3) = (b - a, c - a);
    let p = d.cross(e2);
    let det = e1.dot(p);
    if det == 0.0 {
        return None;
    }
    let s = o - a;
    let u = s.dot(p) / det;
    let q = s.cross(e1);
    let v = d.dot(q) / det;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| (e2.dot(q) / det, u, v))
}
