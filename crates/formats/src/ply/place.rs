//! A mesh in the world.

use super::PlyMesh;
use crate::diagnostic::{Diagnostic, Sink};
use glam::{DAffine3, Vec3};

/// Moves a mesh into the world, its outer side where the normals point if there are any, else where the corners turn
/// counter-clockwise in the space of the object; with `reverse`, on the other side.
pub(crate) fn place(mesh: &mut PlyMesh, world: &DAffine3, reverse: bool, name: &str, sink: &mut Sink) {
    let to_world = |p: &[f32; 3]| world.transform_point3(Vec3::from_array(*p).as_dvec3()).as_vec3().to_array();
    mesh.positions.iter_mut().for_each(|p| *p = to_world(p));
    turn_normals(&mut mesh.normals, world, reverse);
    let side = if world.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
    for t in &mut mesh.extra.tangents {
        let moved = (world.matrix3 * t.truncate().as_dvec3()).normalize_or_zero().as_vec3();
        *t = moved.extend(side * t.w);
    }
    drop_false_normals(mesh, name, sink);
    let inside_out = (world.matrix3.determinant() < 0.0) != reverse;
    let PlyMesh { positions, normals, triangles, .. } = mesh;
    for t in triangles.iter_mut() {
        let turned = if normals.is_empty() { inside_out } else { against_normals(*t, positions, normals) };
        if turned {
            t.swap(1, 2);
        }
    }
}

/// Leaves out normals that cannot be meant, with a warning.
pub(crate) fn drop_false_normals(mesh: &mut PlyMesh, name: &str, sink: &mut Sink) {
    let message = if lie_in_surface(mesh) {
        "the normals of most faces lie in them"
    } else if are_one_and_the_same(mesh) {
        "all normals are the same, but the faces are not"
    } else {
        return;
    };
    sink.warn("mesh::normals", || {
        let warning = Diagnostic::warning("mesh::normals", message).in_file(name);
        warning.help("the faces' own normals take their place")
    });
    mesh.normals.clear();
}

/// Whether there is one normal for all vertices though more than half of the faces are tilted against it: converters write such.
fn are_one_and_the_same(mesh: &PlyMesh) -> bool {
    let Some(first) = mesh.normals.first().copied().filter(|f| mesh.normals.iter().all(|n| n == f)) else {
        return false;
    };
    let n = Vec3::from_array(first).normalize_or_zero();
    let is_tilted = |t: &&[u32; 3]| {
        let [a, b, c] = t.map(|i| Vec3::from_array(mesh.positions[i as usize]));
        let ng = (b - a).cross(c - a).normalize_or_zero();
        ng != Vec3::ZERO && ng.dot(n).abs() < 0.999
    };
    2 * mesh.triangles.iter().filter(is_tilted).count() > mesh.triangles.len()
}

/// Whether the normals of most faces are nearly at right angles to what the corners say: such files exist.
fn lie_in_surface(mesh: &PlyMesh) -> bool {
    if mesh.normals.is_empty() {
        return false;
    }
    let lies = |t: &&[u32; 3]| {
        let [a, b, c] = t.map(|i| Vec3::from_array(mesh.positions[i as usize]));
        let ng = (b - a).cross(c - a).normalize_or_zero();
        let n: Vec3 = t.iter().map(|i| Vec3::from_array(mesh.normals[*i as usize])).sum();
        ng != Vec3::ZERO && ng.dot(n.normalize_or_zero()).abs() < 0.05
    };
    2 * mesh.triangles.iter().filter(lies).count() > mesh.triangles.len()
}

/// Whether the corners turn against the normals at them.
fn against_normals(t: [u32; 3], positions: &[[f32; 3]], normals: &[[f32; 3]]) -> bool {
    let [a, b, c] = t.map(|i| Vec3::from_array(positions[i as usize]));
    let n: Vec3 = t.iter().map(|i| Vec3::from_array(normals[*i as usize])).sum();
    (b - a).cross(c - a).dot(n) < 0.0
}

/// Normals to the world, and to the other side.
fn turn_normals(normals: &mut [[f32; 3]], world: &DAffine3, reverse: bool) {
    let turn = world.matrix3.inverse().transpose() * if reverse { -1.0 } else { 1.0 };
    for n in normals {
        let moved = (turn * Vec3::from_array(*n).as_dvec3()).normalize_or_zero();
        *n = moved.as_vec3().to_array();
    }
}
