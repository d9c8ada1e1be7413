//! `Shape`: surfaces in world space, or in the object that is being defined.

use super::curved;
use super::directives::{Importer, bad, unknown, warning};
use super::params::{Found, Params, single};
use super::state::Cover;
use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::first_of;
use crate::ply::{self, PlyMesh};
use crate::tessellate::valid;
use glam::{Affine3A, DAffine3, Vec2, Vec3};
use sunfleck::bsdf::BlackMaterial;
use sunfleck::math::Motion;
use sunfleck::scene::{MaterialId, SurfaceDef};
use sunfleck::shape::{Shape, Sphere};

const SHAPES: [&str; 13] = [
    "bilinearmesh",
    "cone",
    "curve",
    "cylinder",
    "disk",
    "heightfield",
    "hyperboloid",
    "loopsubdiv",
    "nurbs",
    "paraboloid",
    "plymesh",
    "sphere",
    "trianglemesh",
];

impl Importer<'_> {
    pub(super) fn shape(&mut self, name: &str, params: Params) -> Found<()> {
        let params = self.with_defaults("shape", params);
        let shape = self.geometry(name, &params)?;
        params.ignore(&["facenormals", "edgelength", "displacement", "shadowalpha"]);
        let visible = self.is_visible(&params);
        self.tell_unused(&params);
        if let Some(Shape::Mesh(mesh)) = &shape
            && name != "plymesh"
            && name != "trianglemesh"
        {
            self.cut += mesh.indices().len();
        }
        if visible && let Some(shape) = shape {
            self.add(shape, &params)?;
        }
        Ok(())
    }

    /// Whether something of the shape is to be seen. What we cannot show is told of.
    fn is_visible(&mut self, params: &Params) -> bool {
        let Some(param) = params.get("alpha") else { return true };
        let message = match param.numbers().and_then(|n| n.first().copied()) {
            Some(alpha) if alpha >= 1.0 => return true,
            Some(alpha) if alpha <= 0.0 && self.state.area_light.is_none() => return false,
            Some(alpha) if alpha <= 0.0 => "a light that its file hides is shown",
            _ => "what `alpha` makes partly transparent is opaque",
        };
        let at = param.at.clone();
        self.warn_once("pbrt::alpha", message, || at.tell(warning("pbrt::alpha", message), ""));
        true
    }

    /// The shape in world space; `None` if there is nothing to see of it, which is told of.
    fn geometry(&mut self, name: &str, params: &Params) -> Found<Option<Shape>> {
        let world = self.state.world_from_object();
        match name {
            "trianglemesh" => {
                let mesh = triangle_mesh(params)?;
                Ok(self.mesh(mesh, params))
            }
            "plymesh" => self.ply_mesh(params),
            "sphere" => {
                let whole = curved::whole_sphere(params)?;
                let moved = whole.and_then(|radius| {
                    let sphere = Shape::Sphere(Sphere { centre: Vec3::ZERO, radius: radius as f32 });
                    sphere.transformed(&rounded(&world))
                });
                if moved.is_some() && !self.state.reverse {
                    return Ok(moved);
                }
                let mesh = curved::mesh(name, params, self.detail())?;
                Ok(mesh.and_then(|m| self.mesh(m, params)))
            }
            _ if SHAPES.contains(&name) => {
                if let Some(mesh) = curved::mesh(name, params, self.detail())? {
                    return Ok(self.mesh(mesh, params));
                }
                let message = format!("shapes of the kind `{name}` are left out");
                self.warn_once("pbrt::shape", name, || params.at.tell(warning("pbrt::shape", message), ""));
                Ok(None)
            }
            _ => Err(unknown(&params.at, "shape", name, SHAPES)),
        }
    }

    /// How finely to cut what is not made of triangles: coarser, the more of it there is.
    fn detail(&self) -> f64 {
        match self.cut {
            0..500_000 => 1.0,
            500_000..4_000_000 => 0.25,
            _ => 0.0625,
        }
    }

    fn ply_mesh(&mut self, params: &Params) -> Found<Option<Shape>> {
        let Some(name) = params.string("filename")? else {
            return Err(params.bad("pbrt::no-file", "a mesh needs a `filename`"));
        };
        let at = params.get("filename").map_or(&params.at, |p| &p.at).clone();
        let path = self.files.find(name, at.source.name());
        let source = match self.files.read(&path) {
            Ok(bytes) => SourceFile::from_bytes(path.display().to_string(), bytes),
            Err(error) => {
                let told = Diagnostic { severity: crate::Severity::Warning, ..first_of(error) };
                self.target.sink.warn("pbrt::missing-mesh", || Diagnostic {
                    code: "pbrt::missing-mesh",
                    ..at.tell(told, "left out")
                });
                return Ok(None);
            }
        };
        self.target.input(source.bytes());
        let mesh = ply::parse(&source, &mut self.target.sink);
        Ok(self.named_mesh(mesh, source.name()))
    }

    fn mesh(&mut self, mesh: PlyMesh, params: &Params) -> Option<Shape> {
        let name = params.at.source.name().to_owned();
        self.named_mesh(mesh, &name)
    }

    fn named_mesh(&mut self, mut mesh: PlyMesh, name: &str) -> Option<Shape> {
        ply::place(&mut mesh, &self.state.world_from_object(), self.state.reverse, name, &mut self.target.sink);
        ply::shape(&mesh, name, &mut self.target.sink)
    }

    /// Adds a shape with what covers it and what it emits.
    fn add(&mut self, shape: Shape, params: &Params) -> Found<()> {
        let emission = match self.state.area_light.clone() {
            Some(light) => self.emission(&light, shape.area())?,
            None => None,
        };
        let Some(material) = self.cover_of(emission.is_some()) else { return Ok(()) };
        if self.object.is_some() {
            if emission.is_some() {
                let message = "lights in objects do not shine, as in pbrt";
                self.warn_once("pbrt::light-in-object", "", || {
                    params.at.tell(warning("pbrt::light-in-object", message), "")
                });
            }
            if let Some((_, surfaces)) = &mut self.object {
                surfaces.push(SurfaceDef { shape, material, emission: None });
            }
            return Ok(());
        }
        if let Some([from, to]) = self.motion()
            && let Some(shape) = shape.transformed(&from.inverse())
            && shape.transformed(&to).is_some()
        {
            let object = self.target.object(vec![SurfaceDef { shape, material, emission }]);
            self.target.place_moving(object, from, to);
            return Ok(());
        }
        self.target.surface(shape, material, emission);
        Ok(())
    }

    /// The way of what moves, as two placements of what is turned and stretched already as the shutter opens, but lies
    /// around the origin of its own space: about that point pbrt turns things.
    fn motion(&self) -> Option<[Affine3A; 2]> {
        let [open, close] = self.state.ctm;
        let from = DAffine3::from_translation(open.translation);
        let [from, to] = [from, close * open.inverse() * from].map(|m| rounded(&m));
        (self.state.moves() && Motion::new(&from, &to).is_some()).then_some([from, to])
    }

    /// `None` for what is a boundary between media only.
    fn cover_of(&mut self, emits: bool) -> Option<MaterialId> {
        match self.state.cover {
            Some(Cover::Material(material)) => Some(material),
            Some(Cover::Nothing) if emits => Some(self.target.builder().material(BlackMaterial)),
            Some(Cover::Nothing) => None,
            None => Some(self.default_material()),
        }
    }

    pub(super) fn object_begin(&mut self, at: super::tokens::At) -> Found<()> {
        let name = self.string(&at)?;
        if self.object.is_some() {
            return Err(bad(&at, "pbrt::object", "an object inside of another"));
        }
        self.begin("ObjectBegin", at)?;
        self.object = Some((name, Vec::new()));
        Ok(())
    }

    pub(super) fn object_end(&mut self, at: &super::tokens::At) -> Found<()> {
        self.end("ObjectBegin", at)?;
        if let Some((name, surfaces)) = self.object.take() {
            let object = if surfaces.is_empty() { None } else { Some(self.target.object(surfaces)) };
            self.objects.insert(name, object);
        }
        Ok(())
    }

    pub(super) fn object_instance(&mut self, at: &super::tokens::At) -> Found<()> {
        let name = self.string(at)?;
        if self.object.is_some() {
            return Err(bad(at, "pbrt::object", "an object cannot be placed inside of another"));
        }
        let Some(object) = self.objects.get(&name) else {
            return Err(unknown(at, "object", &name, self.objects.keys().map(String::as_str)));
        };
        if let Some(object) = *object {
            let [open, close] = self.state.ctm.each_ref().map(rounded);
            if [open, close].iter().all(|m| m.is_finite() && m.matrix3.determinant() != 0.0) {
                if open == close || Motion::new(&open, &close).is_none() {
                    self.target.place(object, open);
                } else {
                    self.target.place_moving(object, open, close);
                }
            } else {
                let message = "an object squeezed flat is left out";
                self.target.sink.warn("pbrt::flat-instance", || at.tell(warning("pbrt::flat-instance", message), ""));
            }
        }
        Ok(())
    }
}

/// In the precision of the scene.
fn rounded(m: &DAffine3) -> Affine3A {
    Affine3A::from_mat3_translation(m.matrix3.as_mat3(), m.translation.as_vec3())
}

fn triangle_mesh(params: &Params) -> Found<PlyMesh> {
    let positions: Vec<[f32; 3]> = params.triples("P")?.into_iter().map(|p| single(p).to_array()).collect();
    let per_vertex = |numbers: usize| numbers == positions.len();
    let normals: Vec<[f32; 3]> = params.triples("N")?.into_iter().map(|n| single(n).to_array()).collect();
    let mut uvs = params.pairs("uv")?;
    if uvs.is_empty() {
        uvs = params.pairs("st")?;
    }
    params.ignore(&["S", "faceIndices"]);
    let indices = match params.indices("indices")? {
        Some(indices) => indices,
        None if positions.len() == 3 => vec![0, 1, 2],
        None => return Err(params.bad("pbrt::no-indices", "a mesh needs `indices`")),
    };
    let (triangles, bad_faces) = valid(indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]), positions.len());
    Ok(PlyMesh {
        normals: if per_vertex(normals.len()) { normals } else { Vec::new() },
        uvs: if per_vertex(uvs.len()) { uvs.iter().map(Vec2::to_array).collect() } else { Vec::new() },
        positions,
        triangles,
        bad_faces,
    })
}
