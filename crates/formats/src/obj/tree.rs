//! What an `.obj` file says.

use super::MtlMaterial;
use crate::diagnostic::Span;
use std::collections::HashMap;

/// A file: shared arrays, and meshes that point into them.
#[derive(Clone, Debug, Default)]
pub struct ObjFile {
    /// Positions (`v`).
    pub positions: Vec<[f32; 3]>,
    /// Texture coordinates (`vt`); v runs upwards.
    pub uvs: Vec<[f32; 2]>,
    /// Normals (`vn`), not unit; zero where the file has no finite one.
    pub normals: Vec<[f32; 3]>,
    /// Meshes that have triangles, in the order of their first face.
    pub meshes: Vec<ObjMesh>,
    /// Names of `usemtl`, in the order of first use, and where.
    pub material_names: Vec<(String, Span)>,
    /// Files named by `mtllib`.
    pub libraries: Vec<Library>,
    /// Definitions from those files; filled by [`super::read_libraries`].
    pub materials: Vec<MtlMaterial>,
}

impl ObjFile {
    /// The definitions by name; of equal names the first one counts.
    pub fn material_by_name(&self) -> HashMap<&str, &MtlMaterial> {
        self.materials.iter().rev().map(|m| (m.name.as_str(), m)).collect()
    }

    /// The number of triangles of all meshes.
    pub fn triangle_count(&self) -> usize {
        self.meshes.iter().map(|m| m.triangles.len()).sum()
    }
}

/// A `mtllib` line.
#[derive(Clone, Debug)]
pub struct Library {
    /// The rest of the line: one file name with blanks, or several without.
    pub names: String,
    /// Its place.
    pub span: Span,
}

/// The faces of one object that share a material.
#[derive(Clone, Debug)]
pub struct ObjMesh {
    /// The name on the last `o` or `g` line; empty if there is none.
    pub object: String,
    /// Index into [`ObjFile::material_names`]; `None` before any `usemtl`.
    pub material: Option<usize>,
    /// The triangles; all indices are valid.
    pub triangles: Vec<[Corner; 3]>,
}

/// A corner of a face: indices into the arrays of [`ObjFile`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Corner {
    /// Position.
    pub position: u32,
    uv: u32,
    normal: u32,
}

/// Stands for an index that is not there.
const ABSENT: u32 = u32::MAX;

impl Corner {
    /// A corner from its indices.
    pub fn new(position: u32, uv: Option<u32>, normal: Option<u32>) -> Self {
        Self { position, uv: uv.unwrap_or(ABSENT), normal: normal.unwrap_or(ABSENT) }
    }

    /// Texture coordinate, if the face has one here.
    pub fn uv(self) -> Option<u32> {
        (self.uv != ABSENT).then_some(self.uv)
    }

    /// Normal, if the face has one here.
    pub fn normal(self) -> Option<u32> {
        (self.normal != ABSENT).then_some(self.normal)
    }
}
