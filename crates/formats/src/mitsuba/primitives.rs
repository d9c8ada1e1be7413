//! Shapes of a formula as meshes, in their own space, with Mitsuba's texture coordinates.

use crate::ply::PlyMesh;
use crate::tessellate::grid;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Pieces around a full turn, and from pole to pole.
const TURN: usize = 256;
const RINGS: usize = 128;

/// [-1, 1]² in the plane z = 0; its outer side is up.
pub(super) fn rectangle() -> PlyMesh {
    grid(1, 1, |u, v| (DVec3::new(2.0 * u - 1.0, 2.0 * v - 1.0, 0.0), DVec3::Z))
}

/// [-1, 1]³.
pub(super) fn cube() -> PlyMesh {
    // Corners counter-clockwise from outside; bit k of a number tells the side along axis k.
    const FACES: [[u32; 4]; 6] = [[1, 5, 4, 0], [3, 2, 6, 7], [1, 3, 7, 5], [5, 7, 6, 4], [4, 6, 2, 0], [3, 1, 0, 2]];
    const UVS: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    let mut mesh = PlyMesh::default();
    for (first, face) in (0..).step_by(4).zip(FACES) {
        let corner = |c: u32| [0, 1, 2].map(|axis| if c >> axis & 1 == 1 { 1.0 } else { -1.0 });
        let corners = face.map(corner);
        // The sum of a face's corners lies on its axis.
        let normal = [0, 1, 2].map(|axis| corners.iter().map(|c: &[f32; 3]| c[axis]).sum::<f32>() * 0.25);
        mesh.positions.extend(corners);
        mesh.normals.extend([normal; 4]);
        mesh.uvs.extend(UVS);
        mesh.triangles.extend([[first, first + 1, first + 2], [first + 3, first, first + 2]]);
    }
    mesh
}

/// The unit sphere.
pub(super) fn sphere() -> PlyMesh {
    grid(TURN, RINGS, |u, v| {
        let ((sin_phi, cos_phi), (sin, cos)) = ((TAU * u).sin_cos(), (PI * v).sin_cos());
        let n = DVec3::new(sin * cos_phi, sin * sin_phi, cos);
        (n, n)
    })
}

/// The unit disk in the plane z = 0; its outer side is up.
pub(super) fn disk() -> PlyMesh {
    let mut mesh = grid(TURN, 1, |u, v| {
        let (sin, cos) = (TAU * u).sin_cos();
        (DVec3::new(v * cos, v * sin, 0.0), DVec3::Z)
    });
    mesh.uvs.iter_mut().for_each(|uv| uv.swap(0, 1));
    mesh
}

/// An open cylinder around the line from `p0` to `p1`. `None` if that is a point.
pub(super) fn cylinder(p0: DVec3, p1: DVec3, radius: f64) -> Option<PlyMesh> {
    let axis = (p1 - p0).try_normalize()?;
    let s = axis.any_orthonormal_vector();
    let t = axis.cross(s);
    Some(grid(TURN, 1, |u, v| {
        let (sin, cos) = (TAU * u).sin_cos();
        let n = s * cos + t * sin;
        (p0.lerp(p1, v) + radius * n, n)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ply;
    use sunfleck::shape::Shape;

    fn area(mesh: &PlyMesh) -> f64 {
        let shape = ply::shape(mesh, "test", &mut crate::diagnostic::Sink::default());
        f64::from(shape.as_ref().map_or(0.0, Shape::area))
    }

    #[test]
    fn shapes_have_their_area_and_look_outwards() {
        let cylinder = cylinder(DVec3::ZERO, DVec3::new(0.0, 0.0, 3.0), 0.5).unwrap();
        for (mesh, want) in
            [(rectangle(), 4.0), (cube(), 24.0), (sphere(), 4.0 * PI), (disk(), PI), (cylinder, 3.0 * PI)]
        {
            assert!((area(&mesh) / want - 1.0).abs() < 5e-4, "{} {want}", area(&mesh));
            for t in &mesh.triangles {
                let p = t.map(|i| glam::Vec3::from_array(mesh.positions[i as usize]));
                let n: glam::Vec3 = t.iter().map(|i| glam::Vec3::from_array(mesh.normals[*i as usize])).sum();
                let ng = (p[1] - p[0]).cross(p[2] - p[0]);
                assert!(ng.dot(n).abs() > 0.99 * ng.length() * n.length());
            }
        }
        assert!(self::cylinder(DVec3::X, DVec3::X, 1.0).is_none());
    }
}
