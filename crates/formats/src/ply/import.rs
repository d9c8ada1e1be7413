//! From a `.ply` file to a mesh of a scene.

use super::{PlyMesh, parse};
use crate::diagnostic::{Diagnostic, Error, Sink, SourceFile};
use crate::load::{LoadOptions, SceneFormat, Target};
use glam::{Vec2, Vec3};
use std::path::Path;
use sunfleck::bsdf::DiffuseMaterial;
use sunfleck::shape::{Mesh, Shape};

/// The entry in the list of scene formats.
pub(crate) const FORMAT: SceneFormat = SceneFormat {
    name: "PLY",
    extensions: &["ply", "ply.gz"],
    about: "a mesh, as text or binary, with normals and texture coordinates",
    is_mesh: true,
    load,
};

fn load(path: &Path, _: &LoadOptions, target: &mut Target) -> Result<(), Error> {
    let source = SourceFile::from_bytes(path.display().to_string(), crate::packed::read(path)?);
    target.input(source.bytes());
    let mesh = parse(&source, &mut target.sink);
    target.sink.finish(())?;
    let Some(shape) = shape(&mesh, source.name(), &mut target.sink) else {
        let message = "there are no faces in this file, so there is nothing to see";
        return Err(Diagnostic::error("ply::no-faces", message).in_file(source.name()).into());
    };
    let reflectance = target.builder().constant(Vec3::splat(0.5));
    let material = target.builder().material(DiffuseMaterial { reflectance });
    target.surface(shape, material, None);
    Ok(())
}

/// The mesh without faces that show nothing, which are told of in one line each; `None` if nothing is left.
pub(crate) fn shape(mesh: &PlyMesh, name: &str, sink: &mut Sink) -> Option<Shape> {
    let at = |i: u32| Vec3::from_array(mesh.positions[i as usize]);
    let shows = |t: &&[u32; 3]| {
        let [a, b, c] = t.map(at);
        let normal = (b - a).cross(c - a);
        normal != Vec3::ZERO && normal.is_finite()
    };
    let indices: Vec<[u32; 3]> = mesh.triangles.iter().filter(shows).copied().collect();
    let mut left_out = |code, count: usize, why: &str| {
        if count > 0 {
            sink.warn(code, || {
                let message = format!("{count} of {} faces {why}", mesh.triangles.len() + mesh.bad_faces);
                Diagnostic::warning(code, message).in_file(name).help("they are left out")
            });
        }
    };
    left_out("ply::flat-triangles", mesh.triangles.len() - indices.len(), "have no area");
    left_out("ply::bad-index", mesh.bad_faces, "refer to vertices that do not exist");
    if indices.is_empty() {
        return None;
    }
    let positions = mesh.positions.iter().map(|p| Vec3::from_array(*p)).collect();
    let normals = mesh.normals.iter().map(|n| Vec3::from_array(*n).normalize_or(Vec3::ZERO)).collect();
    let uvs = mesh.uvs.iter().map(|uv| Vec2::from_array(*uv)).collect();
    let made = Mesh::new(positions, normals, uvs, indices).and_then(|m| m.with_attributes(mesh.extra.clone()));
    made.ok().map(Shape::Mesh)
}
