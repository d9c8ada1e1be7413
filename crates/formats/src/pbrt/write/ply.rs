//! Meshes as binary PLY.

use glam::{Vec2, Vec3, Vec4};
use sunfleck::shape::{Attributes, Mesh};

/// A mesh with these normals, if there are any.
pub(super) fn encode(mesh: &Mesh, normals: &[Vec3]) -> Vec<u8> {
    let (positions, uvs, triangles) = (mesh.positions(), mesh.uvs(), mesh.indices());
    let none = Attributes::default();
    let Attributes { uv2, colours, tangents } = mesh.attributes().unwrap_or(&none);
    let mut names = vec!["x", "y", "z"];
    if !normals.is_empty() {
        names.extend(["nx", "ny", "nz"]);
    }
    if !uvs.is_empty() {
        names.extend(["u", "v"]);
    }
    // What pbrt passes over and only we read.
    if !uv2.is_empty() {
        names.extend(["u2", "v2"]);
    }
    if !colours.is_empty() {
        names.extend(["red", "green", "blue", "alpha"]);
    }
    if !tangents.is_empty() {
        names.extend(["tx", "ty", "tz", "tw"]);
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
        let all = all.chain(uv2.get(i).into_iter().flat_map(Vec2::to_array));
        let all = all.chain(colours.get(i).into_iter().flat_map(Vec4::to_array));
        let all = all.chain(tangents.get(i).into_iter().flat_map(Vec4::to_array));
        all.for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    for t in triangles {
        bytes.push(3);
        t.iter().for_each(|i| bytes.extend(i.to_le_bytes()));
    }
    bytes
}
