//! Meshes as binary PLY.

use glam::{Vec2, Vec3};

/// A mesh: positions, normals and texture coordinates by vertex (the latter two may be missing), and triangles.
pub(super) fn encode(positions: &[Vec3], normals: &[Vec3], uvs: &[Vec2], triangles: &[[u32; 3]]) -> Vec<u8> {
    let mut names = vec!["x", "y", "z"];
    if !normals.is_empty() {
        names.extend(["nx", "ny", "nz"]);
    }
    if !uvs.is_empty() {
        names.extend(["u", "v"]);
    }
    let properties: Vec<String> = names.iter().map(|n| format!("property float {n}")).collect();
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n{}\nelement face {}\n\
         property list uchar int vertex_indices\nend_header\n",
        positions.len(),
        properties.join("\n"),
        triangles.len()
    );
    let mut bytes = header.into_bytes();
    for (i, p) in positions.iter().enumerate() {
        let all = p.to_array().into_iter();
        let all = all.chain(normals.get(i).into_iter().flat_map(Vec3::to_array));
        let all = all.chain(uvs.get(i).into_iter().flat_map(Vec2::to_array));
        all.for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    for t in triangles {
        bytes.push(3);
        t.iter().for_each(|i| bytes.extend(i.to_le_bytes()));
    }
    bytes
}
