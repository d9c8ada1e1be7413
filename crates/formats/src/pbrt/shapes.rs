//! `Shape`: surfaces in world space, or in the object that is being defined.

use super::curved;
use super::directives::{Importer, bad, unknown, warning};
use super::params::{Found, Params, single};
use super::state::Cover;
use crate::ply::{self, PlyMesh};
use crate::tessellate::valid;
use glam::{Affine3A, DAffine3, Vec2, Vec3};
use sunfleck::bsdf::{BlackMaterial, NullMaterial, Scalar};
use sunfleck::light::Sides;
use sunfleck::math::Motion;
use sunfleck::scene::{MaterialId, SurfaceDef};
use sunfleck::shape::{Parallelogram, Shape, Sphere};
use sunfleck::spectrum::Illuminant;

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
        let alpha = self.alpha_of(&params)?;
        self.tell_unused(&params);
        if let Some(Shape::Mesh(mesh)) = &shape
            && name != "plymesh"
            && name != "trianglemesh"
        {
            self.cut += mesh.indices().len();
        }
        if let (Some(alpha), Some(shape)) = (alpha, shape) {
            self.add(shape, alpha, &params)?;
        }
        Ok(())
    }

    /// What is to be seen of a shape by its `alpha`; `None` for nothing.
    fn alpha_of(&mut self, params: &Params) -> Found<Option<Scalar>> {
        let all = Some(Scalar::Constant(1.0));
        let Some(param) = params.get("alpha").cloned() else { return Ok(all) };
        let opacity = self.opacity(&param)?;
        if opacity.is_some() && self.state.area_light.is_some() {
            let message = "a light that its file hides, or that has holes, is shown whole";
            self.warn_once("pbrt::alpha", message, || param.at.tell(warning("pbrt::alpha", message), ""));
            return Ok(all);
        }
        Ok(match opacity {
            None => all,
            Some(Scalar::Constant(alpha)) if alpha <= 0.0 => None,
            Some(opacity) => Some(opacity),
        })
    }

    /// The shape in world space; `None` if there is nothing to see of it, which is told of.
    fn geometry(&mut self, name: &str, params: &Params) -> Found<Option<Shape>> {
        let world = self.state.world_from_object();
        match name {
            "trianglemesh" => {
                let mesh = triangle_mesh(params)?;
                let patch = parallelogram(&mesh).filter(|_| !self.state.reverse && world.matrix3.determinant() > 0.0);
                match patch.and_then(|patch| Shape::Parallelogram(patch).transformed(&rounded(&world))) {
                    Some(patch) => Ok(Some(patch)),
                    None => Ok(self.mesh(mesh, params)),
                }
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

    fn mesh(&mut self, mesh: PlyMesh, params: &Params) -> Option<Shape> {
        let name = params.at.source.name().to_owned();
        self.named_mesh(mesh, &name)
    }

    /// Moves a mesh into the world.
    pub(super) fn named_mesh(&mut self, mut mesh: PlyMesh, name: &str) -> Option<Shape> {
        ply::place(&mut mesh, &self.state.world_from_object(), self.state.reverse, name, &mut self.target.sink);
        ply::shape(&mesh, name, &mut self.target.sink)
    }

    /// Adds a shape with what covers it and what it emits.
    fn add(&mut self, shape: Shape, alpha: Scalar, params: &Params) -> Found<()> {
        let emission = match self.state.area_light.clone() {
            Some(light) => self.emission(&light, shape.area())?,
            None => None,
        };
        let filling = self.filling();
        let Some(material) = self.cover_of(emission.is_some(), filling.is_some()) else { return Ok(()) };
        let material = if alpha == Scalar::Constant(1.0) { material } else { self.masked(material, alpha) };
        let material = filling.map_or(material, |interior| self.filled(material, interior));
        if self.object.is_some() && emission.is_some() {
            let message = "lights in objects do not shine, as in pbrt";
            self.warn_once("pbrt::light-in-object", "", || {
                params.at.tell(warning("pbrt::light-in-object", message), "")
            });
        }
        self.add_covered(shape, material, emission);
        Ok(())
    }

    fn nothing(&mut self) -> MaterialId {
        let Self { nothing, target, .. } = self;
        *nothing.get_or_insert_with(|| target.builder().material(NullMaterial))
    }

    /// Adds a shape to the world or to the object that is being defined.
    pub(super) fn add_covered(&mut self, shape: Shape, material: MaterialId, emission: Option<(Illuminant, Sides)>) {
        if let Some((_, surfaces)) = &mut self.object {
            surfaces.push(SurfaceDef { shape, material, emission: None });
            return;
        }
        if let Some([from, to]) = self.motion()
            && let Some(shape) = shape.transformed(&from.inverse())
            && shape.transformed(&to).is_some()
        {
            let object = self.target.object(vec![SurfaceDef { shape, material, emission }]);
            self.target.place_moving(object, from, to);
            return;
        }
        self.target.surface(shape, material, emission);
    }

    /// The way of what moves, as two placements of what is turned and stretched already as the shutter opens, but lies
    /// around the origin of its own space: about that point pbrt turns things.
    fn motion(&self) -> Option<[Affine3A; 2]> {
        let [open, close] = self.state.ctm;
        let from = DAffine3::from_translation(open.translation);
        let [from, to] = [from, close * open.inverse() * from].map(|m| rounded(&m));
        (self.state.moves() && Motion::new(&from, &to).is_some()).then_some([from, to])
    }

    /// `None` for what is a boundary between media only, none of which takes light.
    fn cover_of(&mut self, emits: bool, is_filled: bool) -> Option<MaterialId> {
        match self.state.cover {
            Some(Cover::Material(material)) => Some(material),
            Some(Cover::Nothing) if emits => Some(self.target.builder().material(BlackMaterial)),
            Some(Cover::Nothing) if is_filled => Some(self.nothing()),
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

/// The patch that a mesh of four corners is, with the texture coordinates of one: it has exact points of its own.
fn parallelogram(mesh: &PlyMesh) -> Option<Parallelogram> {
    let is_patch = mesh.triangles == Parallelogram::TRIANGLES
        && mesh.uvs == [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        && mesh.normals.is_empty();
    let [a, b, c, d] = mesh.positions.iter().map(|p| Vec3::from_array(*p)).collect::<Vec<_>>()[..] else { return None };
    let (u, v) = (b - a, d - a);
    let off = (a + u + v - c).abs().max_element();
    let size = a.abs().max(c.abs()).max_element().max(u.length()).max(v.length());
    (is_patch && u.cross(v) != Vec3::ZERO && off <= 1e-6 * size).then(|| Parallelogram::new(a, u, v))
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
        ..PlyMesh::default()
    })
}
