//! Shapes, objects and where they are placed.

use super::Writer;
use super::text::{float, light, matrix, numbers, param, quoted, string};
use super::{ply, text};
use crate::Error;
use glam::{Vec2, Vec3};
use sunfleck::light::Sides;
use sunfleck::scene::{Instance, MaterialId, SurfaceDef};
use sunfleck::shape::{Mesh, Parallelogram, Shape};

/// Meshes of so many triangles at most are told in the text.
const INLINE: usize = 8;

impl Writer<'_> {
    pub(super) fn shapes(&mut self) -> Result<(), Error> {
        let parts = self.scene.parts;
        let mut last = None;
        for s in parts.surfaces {
            self.surface(s, &mut last)?;
        }
        for (i, object) in parts.objects.iter().enumerate() {
            self.line(&format!("ObjectBegin \"object {i}\""));
            let mut last = None;
            for s in object.iter().filter(|s| s.emission.is_none()) {
                self.surface(s, &mut last)?;
            }
            self.line("ObjectEnd");
        }
        for instance in parts.instances {
            self.instance(instance)?;
        }
        Ok(())
    }

    fn instance(&mut self, instance: &Instance) -> Result<(), Error> {
        let object = &self.scene.parts.objects[instance.object.0 as usize];
        let place = match instance.to {
            None => format!("Transform {}", matrix(&instance.from)),
            Some(to) => format!(
                "ActiveTransform StartTime Transform {} ActiveTransform EndTime Transform {} ActiveTransform All",
                matrix(&instance.from),
                matrix(&to)
            ),
        };
        // Lights in objects do not shine in pbrt: they are placed one by one.
        if object.iter().any(|s| s.emission.is_none()) {
            let name = quoted(&format!("object {}", instance.object.0));
            self.line(&format!("AttributeBegin {place} ObjectInstance {name} AttributeEnd"));
        }
        for s in object.iter().filter(|s| s.emission.is_some()) {
            if instance.to.is_some() {
                self.line(&format!("AttributeBegin {place}"));
                self.surface(s, &mut None)?;
                self.line("AttributeEnd");
            } else if let Some(shape) = s.shape.transformed(&instance.from) {
                self.surface(&SurfaceDef { shape, ..s.clone() }, &mut None)?;
            } else {
                self.note("a light is stretched in a way that has no exact shape, and is left out");
            }
        }
        Ok(())
    }

    /// A surface; `last` is the material that was named before it.
    fn surface(&mut self, s: &SurfaceDef, last: &mut Option<MaterialId>) -> Result<(), Error> {
        let (material, alpha) = self.of_shape(s.material)?;
        if let Some((radiance, sides)) = &s.emission {
            let two = if *sides == Sides::Two { " \"bool twosided\" true" } else { "" };
            self.line(&format!("AttributeBegin\n  AreaLightSource \"diffuse\"{}{two}", light("L", radiance)));
        }
        if *last != Some(s.material) {
            self.interface(s.material);
            self.line(&format!("NamedMaterial {material}"));
            *last = s.emission.is_none().then_some(s.material);
        }
        match &s.shape {
            Shape::Sphere(ball) => {
                let centre = numbers(ball.centre.to_array());
                let shape = format!("Shape \"sphere\"{}{alpha}", float("radius", ball.radius));
                self.line(&format!("AttributeBegin Translate {centre} {shape} AttributeEnd"));
            }
            Shape::Parallelogram(patch) => {
                let uvs = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
                let line = inline(&patch.corners(), &[], &uvs, &Parallelogram::TRIANGLES);
                self.line(&(line + &alpha));
            }
            Shape::Mesh(mesh) => self.mesh(mesh, &alpha)?,
        }
        if s.emission.is_some() {
            self.line("AttributeEnd");
        }
        Ok(())
    }

    fn mesh(&mut self, mesh: &Mesh, alpha: &str) -> Result<(), Error> {
        let normals = outward(mesh);
        let line = if mesh.indices().len() <= INLINE && mesh.attributes().is_none() {
            inline(mesh.positions(), &normals, mesh.uvs(), mesh.indices())
        } else {
            let bytes = ply::encode(mesh, &normals);
            format!("Shape \"plymesh\"{}", string("filename", &self.files.add("ply", &bytes)?))
        };
        self.line(&(line + alpha));
        Ok(())
    }
}

/// The normals on the side to which the corners turn counter-clockwise, as pbrt has the outer side.
fn outward(mesh: &Mesh) -> Vec<Vec3> {
    let normals = mesh.normals();
    if normals.is_empty() {
        return Vec::new();
    }
    let against = |t: &&[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.positions()[i as usize]);
        let n: Vec3 = t.iter().map(|i| normals[*i as usize]).sum();
        (b - a).cross(c - a).dot(n) < 0.0
    };
    let turned = mesh.indices().iter().filter(against).count();
    if 2 * turned > mesh.indices().len() { normals.iter().map(|n| -*n).collect() } else { normals.to_vec() }
}

/// A mesh in the text.
fn inline(positions: &[Vec3], normals: &[Vec3], uvs: &[Vec2], triangles: &[[u32; 3]]) -> String {
    let of = |v: &[Vec3]| text::numbers(v.iter().flat_map(Vec3::to_array));
    let mut line = format!("Shape \"trianglemesh\"{}", param("point3", "P", &of(positions)));
    if !normals.is_empty() {
        line += &param("normal", "N", &of(normals));
    }
    if !uvs.is_empty() {
        line += &param("point2", "uv", &numbers(uvs.iter().flat_map(Vec2::to_array)));
    }
    let indices = triangles.iter().flatten().map(u32::to_string).collect::<Vec<_>>().join(" ");
    line + &param("integer", "indices", &indices)
}
