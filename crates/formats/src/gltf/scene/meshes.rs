//! Meshes at their places.

use super::super::document::Fields;
use super::Importer;
use super::geometry::Geometry;
use crate::diagnostic::Diagnostic;
use glam::{Affine3A, DAffine3, Vec2, Vec3};
use serde_json::Value;
use std::collections::BTreeMap;
use sunfleck::scene::SurfaceDef;
use sunfleck::shape::{Attributes, Mesh, Shape};

/// What happens to the vertices of a mesh.
pub(super) enum Pose<'p> {
    /// They stay in the space of the mesh.
    Own,
    /// They are moved into the world.
    Placed(DAffine3),
    /// They follow joints.
    Follows(&'p [DAffine3]),
}

impl Importer<'_> {
    /// Adds the meshes of all nodes; `world` is where each node of the file is.
    pub(super) fn meshes(&mut self, order: &[(usize, DAffine3)], world: &[DAffine3]) {
        let mut shared: BTreeMap<usize, Vec<DAffine3>> = BTreeMap::new();
        for (index, placed) in order {
            let node = &self.root.items("nodes")[*index];
            let Some(mesh) = node.index("mesh") else { continue };
            let weights = weights(node).or_else(|| weights(self.root.items("meshes").get(mesh)?));
            let weights = weights.unwrap_or_default();
            if let Some(skin) = node.index("skin") {
                let Some(joints) = self.joints(skin, world) else { continue };
                self.add(mesh, &weights, &Pose::Follows(&joints));
                continue;
            }
            let places = self.places(node, *index).into_iter().map(|p| *placed * p);
            if node.get("weights").is_none() {
                shared.entry(mesh).or_default().extend(places);
                continue;
            }
            for place in places {
                self.add(mesh, &weights, &Pose::Placed(place));
            }
        }
        for (mesh, places) in shared {
            let weights = self.root.items("meshes").get(mesh).and_then(weights).unwrap_or_default();
            match places[..] {
                [] => {}
                [place] => self.add(mesh, &weights, &Pose::Placed(place)),
                _ => self.share(mesh, &weights, &places),
            }
        }
    }

    /// Adds the surfaces of a mesh to the world.
    fn add(&mut self, mesh: usize, weights: &[f32], pose: &Pose) {
        for SurfaceDef { shape, material, emission } in self.surfaces(mesh, weights, pose) {
            self.target.surface(shape, material, emission);
        }
    }

    /// Makes one object of a mesh, for several places.
    fn share(&mut self, mesh: usize, weights: &[f32], places: &[DAffine3]) {
        let surfaces = self.surfaces(mesh, weights, &Pose::Own);
        if surfaces.is_empty() {
            return;
        }
        let inverse = |p: &&DAffine3| p.matrix3.determinant() != 0.0 && p.inverse().is_finite();
        let usable: Vec<Affine3A> = places.iter().filter(inverse).map(single).collect();
        if usable.len() < places.len() {
            let name = self.called("meshes", mesh);
            let flat = places.len() - usable.len();
            self.note(
                "gltf::flat-places",
                name,
                format_args!("it is flattened at {flat} of its places, and left out there"),
            );
        }
        self.target.bound_object(&surfaces, &usable);
        let object = self.target.object(surfaces);
        usable.into_iter().for_each(|place| self.target.place(object, place));
    }

    fn surfaces(&mut self, mesh: usize, weights: &[f32], pose: &Pose) -> Vec<SurfaceDef> {
        let Some(json) = self.root.items("meshes").get(mesh) else { return Vec::new() };
        let mut surfaces = Vec::new();
        for (i, primitive) in json.items("primitives").iter().enumerate() {
            let path = format!("meshes[{mesh}].primitives[{i}]");
            let Some(mut geometry) = self.geometry(primitive, weights, &path) else { continue };
            match pose {
                Pose::Own => {}
                Pose::Placed(place) => geometry.place(place),
                Pose::Follows(joints) => {
                    if let Err(reason) = geometry.follow(joints) {
                        self.error("gltf::skin", &path, reason);
                        continue;
                    }
                }
            }
            let geometry = self.clean(geometry, &path);
            if !geometry.triangles.is_empty() {
                self.dress(geometry, primitive.index("material"), &mut surfaces);
            }
        }
        surfaces
    }

    /// Leaves out triangles without area and those with coordinates that are no numbers, and the vertices of no triangle.
    fn clean(&mut self, mut geometry: Geometry, path: &str) -> Geometry {
        let before = geometry.triangles.len();
        let positions = &geometry.positions;
        geometry.triangles.retain(|t| {
            let [a, b, c] = t.map(|i| positions[i as usize]);
            let normal = (b - a).cross(c - a);
            normal != Vec3::ZERO && normal.is_finite() && (a + b + c).is_finite()
        });
        let lost = before - geometry.triangles.len();
        if lost > 0 {
            let told = self.told;
            self.target.sink.warn("gltf::flat-triangles", || {
                let message = format!("{path}: {lost} of {before} triangles have no area, or no place");
                Diagnostic::warning("gltf::flat-triangles", message).in_file(&told.file).help("they are left out")
            });
        }
        geometry.compact()
    }
}

fn weights(object: &Value) -> Option<Vec<f32>> {
    let list = object.get("weights")?.as_array()?;
    Some(list.iter().map(|w| w.as_f64().unwrap_or(0.0) as f32).collect())
}

fn single(place: &DAffine3) -> Affine3A {
    Affine3A::from_mat3_translation(place.matrix3.as_mat3(), place.translation.as_vec3())
}

impl Geometry {
    /// Without vertices that no triangle has: primitives often share the vertices of a whole file.
    fn compact(mut self) -> Self {
        let triangles = std::mem::take(&mut self.triangles);
        self.part(triangles, &mut vec![u32::MAX; self.positions.len()])
    }

    /// A mesh of these triangles and their vertices alone. `new` has an entry of `u32::MAX` for each vertex, before and after.
    pub(super) fn part(&self, mut triangles: Vec<[u32; 3]>, new: &mut [u32]) -> Self {
        let mut used = Vec::new();
        for corner in triangles.iter_mut().flatten() {
            let slot = &mut new[*corner as usize];
            if *slot == u32::MAX {
                *slot = used.len() as u32;
                used.push(*corner as usize);
            }
            *corner = *slot;
        }
        used.iter().for_each(|vertex| new[*vertex] = u32::MAX);
        let [first, second] = &self.uvs;
        Self {
            positions: pick(&self.positions, &used),
            normals: pick(&self.normals, &used),
            tangents: pick(&self.tangents, &used),
            uvs: [pick(first, &used), pick(second, &used)],
            colours: pick(&self.colours, &used),
            bones: Vec::new(),
            triangles,
        }
    }

    /// The mesh; texture coordinates grow upwards here.
    pub(super) fn into_shape(self) -> Option<Shape> {
        let up = |list: Vec<Vec2>| list.into_iter().map(|uv| Vec2::new(uv.x, 1.0 - uv.y)).collect();
        let [first, second] = self.uvs;
        let more = Attributes { uv2: up(second), colours: self.colours, tangents: self.tangents };
        let mesh = Mesh::new(self.positions, self.normals, up(first), self.triangles).ok()?;
        mesh.with_attributes(more).ok().map(Shape::Mesh)
    }
}

fn pick<T: Copy>(list: &[T], used: &[usize]) -> Vec<T> {
    if list.is_empty() { Vec::new() } else { used.iter().map(|i| list[*i]).collect() }
}
