//! `plymesh`: files are read once, however often they are used.

use super::directives::Importer;
use super::params::{Found, Params};
use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::first_of;
use crate::ply::{self, PlyMesh};
use glam::Vec3;
use std::collections::HashMap;
use std::path::PathBuf;
use std::rc::Rc;
use sunfleck::bsdf::DiffuseMaterial;
use sunfleck::scene::MaterialId;
use sunfleck::shape::Shape;

/// Vertices and triangles kept for another use, at most.
const MAX_KEPT: usize = 8_000_000;

/// Meshes by file.
#[derive(Default)]
pub(super) struct MeshCache {
    /// `None` for what is missing.
    read: HashMap<PathBuf, Option<Rc<PlyMesh>>>,
    kept: usize,
    /// What covers the substitute of a missing mesh.
    missing: Option<MaterialId>,
}

impl MeshCache {
    fn keep(&mut self, path: PathBuf, mesh: Option<Rc<PlyMesh>>) {
        let size = mesh.as_ref().map_or(0, |m| m.positions.len() + m.triangles.len());
        if self.kept + size <= MAX_KEPT {
            self.kept += size;
            self.read.insert(path, mesh);
        }
    }
}

impl Importer<'_> {
    /// The mesh of a file in the world; a cube that cannot be overlooked if it is missing.
    pub(super) fn ply_mesh(&mut self, params: &Params) -> Found<Option<Shape>> {
        let Some(name) = params.string("filename")? else {
            return Err(params.bad("pbrt::no-file", "a mesh needs a `filename`"));
        };
        let at = params.get("filename").map_or(&params.at, |p| &p.at).clone();
        let path = self.files.find(name, at.source.name());
        let known = self.meshes.read.get(&path).cloned();
        let mesh = if let Some(known) = known {
            known
        } else {
            let read = match self.files.read(&path) {
                Ok(bytes) => {
                    let source = SourceFile::from_bytes(path.display().to_string(), bytes);
                    self.target.input(source.bytes());
                    Some(Rc::new(ply::parse(&source, &mut self.target.sink)))
                }
                Err(error) => {
                    let told = Diagnostic { severity: crate::Severity::Warning, ..first_of(error) };
                    let told = Diagnostic { code: "pbrt::missing-mesh", ..at.tell(told, "a magenta cube stands here") };
                    self.target.sink.warn("pbrt::missing-mesh", || told);
                    None
                }
            };
            self.meshes.keep(path.clone(), read.clone());
            read
        };
        let Some(mesh) = mesh else {
            self.missing_mesh();
            return Ok(None);
        };
        let mesh = Rc::try_unwrap(mesh).unwrap_or_else(|shared| (*shared).clone());
        Ok(self.named_mesh(mesh, &path.display().to_string()))
    }

    /// A magenta cube of side 1 around the origin.
    fn missing_mesh(&mut self) {
        let corner = |i: u32| [i & 1, (i >> 1) & 1, (i >> 2) & 1].map(|b| b as f32 - 0.5);
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let cube = PlyMesh { positions: (0..8).map(corner).collect(), triangles, ..PlyMesh::default() };
        let Some(shape) = self.named_mesh(cube, "") else { return };
        let builder = self.target.builder();
        let material = *self.meshes.missing.get_or_insert_with(|| {
            let reflectance = builder.constant(Vec3::new(1.0, 0.0, 1.0));
            builder.material(DiffuseMaterial { reflectance })
        });
        self.add_covered(shape, material, None);
    }
}
