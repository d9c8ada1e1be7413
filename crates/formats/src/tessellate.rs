//! Shapes cut into triangles.

use crate::ply::PlyMesh;
use glam::DVec3;
use std::f64::consts::TAU;

/// Turns a profile around z. There are so many pieces around a full turn and along v.
pub(crate) fn revolve(turn: f64, [around_turn, along]: [f64; 2], profile: &dyn Fn(f64) -> DVec3) -> PlyMesh {
    let (columns, rows) = (((around_turn * turn / TAU).ceil() as usize).max(3), along as usize);
    let around = |p: DVec3, phi: f64| {
        let (sin, cos) = phi.sin_cos();
        DVec3::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos, p.z)
    };
    let normal = |v: f64| {
        let step = 1e-5;
        let (a, b) = ((v - step).max(0.0), (v + step).min(1.0));
        let (pa, pb) = (profile(a), profile(b));
        // On the axis there is no direction around it; a little beside it there is.
        let middle = profile(v.clamp(1e-4, 1.0 - 1e-4));
        DVec3::Z.cross(middle).cross(pb - pa).normalize_or_zero()
    };
    grid(columns, rows, |u, v| (around(profile(v), u * turn), around(normal(v), u * turn)))
}

/// A rectangle of u and v in [0, 1], cut evenly: position and normal at each place.
pub(crate) fn grid(columns: usize, rows: usize, at: impl Fn(f64, f64) -> (DVec3, DVec3)) -> PlyMesh {
    let mut mesh = PlyMesh::default();
    for y in 0..=rows {
        for x in 0..=columns {
            let (u, v) = (x as f64 / columns as f64, y as f64 / rows as f64);
            let (p, n) = at(u, v);
            mesh.positions.push(p.as_vec3().to_array());
            mesh.normals.push(n.as_vec3().to_array());
            mesh.uvs.push([u as f32, v as f32]);
        }
    }
    let width = columns as u32 + 1;
    // At a pole, one side of each square is nothing.
    let has_area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| DVec3::from_array(mesh.positions[i as usize].map(f64::from)));
        (b - a).cross(c - a).length() > 1e-9 * (b - a).length().max((c - a).length()).powi(2)
    };
    let mut triangles = Vec::with_capacity(2 * rows * columns);
    for y in 0..rows as u32 {
        for x in 0..columns as u32 {
            let i = y * width + x;
            triangles.extend([[i, i + 1, i + width + 1], [i, i + width + 1, i + width]].into_iter().filter(has_area));
        }
    }
    PlyMesh { triangles, ..mesh }
}

/// The triangles that refer to existing vertices, and how many do not.
pub(crate) fn valid(all: impl Iterator<Item = [u32; 3]>, vertices: usize) -> (Vec<[u32; 3]>, usize) {
    let (good, bad): (Vec<_>, Vec<_>) = all.partition(|t| t.iter().all(|i| (*i as usize) < vertices));
    (good, bad.len())
}

/// Adds all of `part`.
pub(crate) fn append(mesh: &mut PlyMesh, part: PlyMesh) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(part.positions);
    mesh.normals.extend(part.normals);
    mesh.uvs.extend(part.uvs);
    let (triangles, _) = valid(part.triangles.into_iter().map(|t| t.map(|i| first + i)), mesh.positions.len());
    mesh.triangles.extend(triangles);
}
