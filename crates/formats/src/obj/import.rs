//! From the tree of an `.obj` file to meshes of a scene.

use super::appearance::{Appearances, Glow};
use super::{Corner, ObjFile, ObjMesh, parse, read_libraries};
use crate::diagnostic::{Diagnostic, Error, Sink, SourceFile};
use crate::load::{LoadOptions, SceneFormat, Target};
use crate::ply::PlyMesh;
use foldhash::fast::RandomState;
use glam::{Vec2, Vec3};
use std::collections::HashMap;
use std::path::Path;
use sunfleck::light::Sides;
use sunfleck::scene::MaterialId;
use sunfleck::shape::{Mesh, Shape};
use sunfleck::texture::ImageTexture;

/// The entry in the list of scene formats.
pub(crate) const FORMAT: SceneFormat = SceneFormat {
    name: "Wavefront OBJ",
    extensions: &["obj"],
    about: "Wavefront meshes with MTL materials: one mesh per object and material",
    is_mesh: true,
    load,
};

fn load(path: &Path, _: &LoadOptions, target: &mut Target) -> Result<(), Error> {
    let source = SourceFile::read(path)?;
    target.input(source.bytes());
    let mut tree = parse(&source, &mut target.sink);
    target.sink.finish(())?;
    let folder = path.parent().unwrap_or(Path::new(""));
    for library in read_libraries(&mut tree, &source, folder, &mut target.sink) {
        target.input(library.bytes());
    }
    target.sink.finish(())?;
    if tree.meshes.is_empty() {
        let message = "there are no faces in this file, so there is nothing to see";
        return Err(Diagnostic::error("obj::no-faces", message).in_file(source.name()).into());
    }
    import(&tree, &source, folder, target);
    Ok(())
}

fn import(tree: &ObjFile, source: &SourceFile, folder: &Path, target: &mut Target) {
    let mut appearances = Appearances::new(tree, folder);
    for mesh in &tree.meshes {
        let (material, glow) = appearances.of(mesh.material, source, target);
        let Some(vertices) = vertices(tree, mesh, source, &mut target.sink) else { continue };
        let emission = match glow {
            Glow::Nothing => None,
            Glow::Even(radiance) => Some((radiance.into(), Sides::One)),
            Glow::Picture(picture) => {
                shine(vertices.into_mesh(), &picture, material, source, target);
                continue;
            }
        };
        if let Some(shape) = vertices.into_shape() {
            target.surface(shape, material, emission);
        }
    }
}

/// Adds a mesh in pieces that each send out what the picture shows there.
fn shine(mesh: PlyMesh, picture: &ImageTexture, material: MaterialId, source: &SourceFile, target: &mut Target) {
    for (radiance, piece) in crate::gltf::pieces(upended(mesh), picture) {
        let emission = (radiance != Vec3::ZERO).then(|| (radiance.into(), Sides::One));
        if let Some(shape) = crate::ply::shape(&upended(piece), source.name(), &mut target.sink) {
            target.surface(shape, material, emission);
        }
    }
}

/// With texture coordinates from the top instead of from the bottom, or the other way round.
fn upended(mut mesh: PlyMesh) -> PlyMesh {
    mesh.uvs.iter_mut().for_each(|uv| uv[1] = 1.0 - uv[1]);
    mesh
}

/// The mesh with one index per corner; `None` if all its triangles are without area.
fn vertices<'t>(tree: &'t ObjFile, mesh: &ObjMesh, source: &SourceFile, sink: &mut Sink) -> Option<Vertices<'t>> {
    let mut vertices = Vertices::new(tree, mesh);
    let point = |c: &Corner| Vec3::from_array(tree.positions[c.position as usize]);
    let mut flat = 0_usize;
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.each_ref().map(point);
        let normal = (b - a).cross(c - a);
        if normal == Vec3::ZERO || !normal.is_finite() {
            flat += 1;
            continue;
        }
        let indices = triangle.map(|corner| vertices.index(corner, normal));
        vertices.triangles.push(indices);
    }
    if flat > 0 {
        sink.warn("obj::flat-triangles", || {
            let object = if mesh.object.is_empty() { String::new() } else { format!(" of `{}`", mesh.object) };
            let message = format!("{flat} of {} triangles{object} have no area", mesh.triangles.len());
            Diagnostic::warning("obj::flat-triangles", message).in_file(source.name()).help("they are left out")
        });
    }
    (!vertices.triangles.is_empty()).then_some(vertices)
}

/// All faces of a file as one mesh, whatever their materials.
pub(crate) fn merged(tree: &ObjFile) -> PlyMesh {
    let triangles = tree.meshes.iter().flat_map(|m| m.triangles.iter().copied()).collect();
    let all = ObjMesh { object: String::new(), material: None, triangles };
    let mut vertices = Vertices::new(tree, &all);
    for triangle in &all.triangles {
        let [a, b, c] = triangle.each_ref().map(|c| Vec3::from_array(tree.positions[c.position as usize]));
        let normal = (b - a).cross(c - a);
        let indices = triangle.map(|corner| vertices.index(corner, normal));
        vertices.triangles.push(indices);
    }
    vertices.into_mesh()
}

/// Corners of a mesh, made unique.
struct Vertices<'t> {
    tree: &'t ObjFile,
    /// Whether some corner has a normal; then those without take that of their triangle.
    has_normals: bool,
    has_uvs: bool,
    index_of: HashMap<Corner, u32, RandomState>,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
}

impl<'t> Vertices<'t> {
    fn new(tree: &'t ObjFile, mesh: &ObjMesh) -> Self {
        let mut corners = mesh.triangles.iter().flatten();
        Self {
            tree,
            has_normals: corners.clone().any(|c| normal(tree, *c).is_some()),
            has_uvs: corners.any(|c| c.uv().is_some()),
            // In a closed mesh there are half as many vertices as triangles.
            index_of: HashMap::with_capacity_and_hasher(mesh.triangles.len() / 2, RandomState::default()),
            positions: Vec::new(),
            normals: Vec::new(),
            uvs: Vec::new(),
            triangles: Vec::new(),
        }
    }

    fn index(&mut self, corner: Corner, face_normal: Vec3) -> u32 {
        let own_normal = normal(self.tree, corner);
        let next = self.positions.len() as u32;
        if self.has_normals && own_normal.is_none() {
            // Belongs to one triangle only.
            self.push(corner, face_normal);
            return next;
        }
        let index = *self.index_of.entry(corner).or_insert(next);
        if index == next {
            self.push(corner, own_normal.unwrap_or(face_normal));
        }
        index
    }

    fn push(&mut self, corner: Corner, normal: Vec3) {
        self.positions.push(Vec3::from_array(self.tree.positions[corner.position as usize]));
        if self.has_normals {
            self.normals.push(normal.normalize_or(Vec3::Z));
        }
        if self.has_uvs {
            self.uvs.push(corner.uv().map_or(Vec2::ZERO, |i| Vec2::from_array(self.tree.uvs[i as usize])));
        }
    }

    fn into_mesh(self) -> PlyMesh {
        PlyMesh {
            positions: self.positions.iter().map(Vec3::to_array).collect(),
            normals: self.normals.iter().map(Vec3::to_array).collect(),
            uvs: self.uvs.iter().map(Vec2::to_array).collect(),
            triangles: self.triangles,
            ..PlyMesh::default()
        }
    }

    fn into_shape(self) -> Option<Shape> {
        Mesh::new(self.positions, self.normals, self.uvs, self.triangles).ok().map(Shape::Mesh)
    }
}

/// The normal of the file at a corner, if there is one of some length.
fn normal(tree: &ObjFile, corner: Corner) -> Option<Vec3> {
    Vec3::from_array(tree.normals[corner.normal()? as usize]).try_normalize()
}
