//! Vertex normals for meshes that have none.

use crate::ply::PlyMesh;
use glam::DVec3;
use std::collections::HashMap;

/// Gives a mesh normals that turn smoothly over its faces, each weighed by its angle at the vertex (Thürmer & Wüthrich 1998,
/// "Computing Vertex Normals from Polygonal Facets"). With `join`, vertices at the same place share theirs.
pub(super) fn add_normals(mesh: &mut PlyMesh, join: bool) {
    let mut group_of_place = HashMap::new();
    let groups: Vec<usize> = (0..mesh.positions.len())
        .map(|i| {
            // Adding 0 makes -0 the same as 0.
            let place = mesh.positions[i].map(|x| (x + 0.0).to_bits());
            if join { *group_of_place.entry(place).or_insert(i) } else { i }
        })
        .collect();
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    for t in &mesh.triangles {
        let p = t.map(|i| glam::Vec3::from_array(mesh.positions[i as usize]).as_dvec3());
        let Some(normal) = (p[1] - p[0]).cross(p[2] - p[0]).try_normalize() else { continue };
        for k in 0..3 {
            let (a, b) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            sums[groups[t[k] as usize]] += normal * a.angle_between(b);
        }
    }
    mesh.normals = groups.iter().map(|g| sums[*g].normalize_or_zero().as_vec3().to_array()).collect();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mitsuba::primitives;

    #[test]
    fn joined_corners_of_a_cube_point_outwards_along_their_diagonals() {
        let mut cube = primitives::cube();
        add_normals(&mut cube, true);
        for (p, n) in cube.positions.iter().zip(&cube.normals) {
            let (p, n) = (glam::Vec3::from_array(*p), glam::Vec3::from_array(*n));
            assert!((n - p.normalize()).length() < 1e-6, "{p} {n}");
        }
        add_normals(&mut cube, false);
        assert!(cube.normals.iter().all(|n| n.iter().filter(|x| x.abs() > 0.99).count() == 1));
    }
}
