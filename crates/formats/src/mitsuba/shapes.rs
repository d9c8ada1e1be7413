//! `shape`: surfaces in world space, or in the group that is being made.

use super::bsdfs::{Cover, Wanted};
use super::document::Found;
use super::props::Props;
use super::scene::Importer;
use super::{primitives, serialized, smooth};
use crate::diagnostic::{Diagnostic, SourceFile};
use crate::files::first_of;
use crate::obj;
use crate::ply::{self, PlyMesh};
use glam::{Affine3A, DAffine3, DVec3, Vec3};
use sunfleck::bsdf::NullMaterial;
use sunfleck::light::Sides;
use sunfleck::scene::{ObjectId, SurfaceDef};
use sunfleck::shape::{Parallelogram, Shape, Sphere};
use sunfleck::spectrum::Illuminant;
use sunfleck::texture::{ImageTexture, Wrap};

const SHAPES: [&str; 20] = [
    "bsplinecurve",
    "cube",
    "cylinder",
    "deformable",
    "disk",
    "ellipsoids",
    "ellipsoidsmesh",
    "hair",
    "heightfield",
    "instance",
    "linearcurve",
    "merge",
    "obj",
    "ply",
    "rectangle",
    "sdfgrid",
    "serialized",
    "shapegroup",
    "sphere",
    "mesh",
];

impl<'d> Importer<'d, '_> {
    /// Adds a shape that stands in the scene.
    pub(super) fn shape(&mut self, number: usize) -> Found<()> {
        let props = self.props(number);
        match props.element.plugin()?.0 {
            // Made where it is placed.
            "shapegroup" => return Ok(()),
            "instance" => self.instance(&props)?,
            "merge" => {
                for inner in props.objects("shape")? {
                    self.once(number, |this| this.shape(inner))?;
                }
            }
            _ => {
                for SurfaceDef { shape, material, emission } in self.surfaces(&props)? {
                    self.target.surface(shape, material, emission);
                }
            }
        }
        self.tell_unused(&props);
        Ok(())
    }

    /// A shape with what covers it and what it emits: pieces of it if that is a picture, and nothing if there is nothing to
    /// see of it.
    fn surfaces(&mut self, props: &Props<'d>) -> Found<Vec<SurfaceDef>> {
        props.ignore(&["name", "silhouette_sampling_weight", "max_smooth_angle", "collapse", "src_indices"]);
        let emission = self.emission(props)?;
        let has_media = !props.objects("medium")?.is_empty();
        let filling = self.filling(props)?;
        let is_flipped = props.element.plugin()?.0 == "obj" && props.boolean("flip_tex_coords", true)?;
        let cover = match props.object("bsdf")? {
            Some(number) => self.cover(Wanted { number, both_sides: false, is_flipped })?,
            None if props.element.is_old && has_media => {
                let material = self.target.builder().material(NullMaterial);
                Cover { material, is_nothing: true, varies: false }
            }
            None => self.plain_cover(),
        };
        for subsurface in props.objects("subsurface")? {
            let subsurface = self.props(subsurface);
            self.warn_once(
                "mitsuba::subsurface",
                "",
                &subsurface,
                "light does not enter surfaces yet: this is left out",
            );
        }
        let material = filling.map_or(cover.material, |interior| self.filled(cover.material, interior));
        let picture = match emission {
            Glow::Picture(picture) => picture,
            Glow::Nothing if cover.is_nothing && filling.is_none() => return Ok(Vec::new()),
            Glow::Nothing => {
                let shape = self.geometry(props, cover.varies)?;
                return Ok(shape.into_iter().map(|shape| SurfaceDef { shape, material, emission: None }).collect());
            }
            Glow::Even(radiance) => {
                let emission = Some((radiance, Sides::One));
                let shape = self.geometry(props, cover.varies)?;
                return Ok(shape
                    .into_iter()
                    .map(|shape| SurfaceDef { shape, material, emission: emission.clone() })
                    .collect());
            }
        };
        let Some(mesh) = self.mesh(props)? else { return Ok(Vec::new()) };
        let mut surfaces = Vec::new();
        for (radiance, piece) in crate::gltf::pieces(mesh, &picture) {
            let emission = (radiance != Vec3::ZERO).then(|| (radiance.into(), Sides::One));
            let shape = ply::shape(&piece, props.at().source.name(), &mut self.target.sink);
            surfaces.extend(shape.map(|shape| SurfaceDef { shape, material, emission }));
        }
        Ok(surfaces)
    }

    /// What an emitter on the shape sends out.
    fn emission(&mut self, props: &Props<'d>) -> Found<Glow> {
        let Some(number) = props.object("emitter")? else { return Ok(Glow::Nothing) };
        let light = self.props(number);
        let (name, _) = light.element.plugin()?;
        match name {
            "area" => {}
            "directionalarea" => self.near(name, &light, "one that shines in all directions"),
            _ => return Err(light.unknown_plugin("emitter on a shape", &["area"])),
        }
        light.ignore(&["sampling_weight"]);
        if let Some((number, _)) = light.get("radiance")
            && let Some(image) = self.shone_through(number)?
        {
            self.tell_unused(&light);
            let pixels = image.data.iter().map(|p| Vec3::from_array(*p).max(Vec3::ZERO)).collect();
            let picture = ImageTexture::new(image.width as usize, image.height as usize, pixels, Wrap::Repeat);
            return picture.map(Glow::Picture).ok_or_else(|| light.bad("the picture is empty"));
        }
        let radiance = self.light_of(&light, "radiance", 1.0)?;
        self.tell_unused(&light);
        Ok(if radiance.is_black() { Glow::Nothing } else { Glow::Even(radiance) })
    }

    /// The shape in world space; `None` if there is nothing to see of it, which is told of.
    fn geometry(&mut self, props: &Props<'d>, is_textured: bool) -> Found<Option<Shape>> {
        let (name, _) = props.element.plugin()?;
        let world = props.transform("to_world")?;
        let flip = props.boolean("flip_normals", false)?;
        if name == "sphere" && !flip && !is_textured {
            let centre = props.vector("center")?.unwrap_or(DVec3::ZERO).as_vec3();
            let radius = props.float("radius", 1.0)? as f32;
            let exact = Shape::Sphere(Sphere { centre, radius }).transformed(&rounded(&world));
            if let Some(moved) = exact.filter(|_| radius > 0.0) {
                return Ok(Some(moved));
            }
        }
        if name == "rectangle" && !flip && world.matrix3.determinant() > 0.0 {
            let side = |v: DVec3| world.transform_vector3(2.0 * v).as_vec3();
            let corner = world.transform_point3(DVec3::new(-1.0, -1.0, 0.0)).as_vec3();
            let shape = Shape::Parallelogram(Parallelogram::new(corner, side(DVec3::X), side(DVec3::Y)));
            return Ok((shape.area() > 0.0).then_some(shape));
        }
        let Some(mesh) = self.mesh(props)? else { return Ok(None) };
        Ok(ply::shape(&mesh, &mesh_name(props)?, &mut self.target.sink))
    }

    /// The shape in world space, cut into triangles.
    fn mesh(&mut self, props: &Props<'d>) -> Found<Option<PlyMesh>> {
        let (name, at) = props.element.plugin()?;
        let world = props.transform("to_world")?;
        let flip = props.boolean("flip_normals", false)?;
        let mesh = match name {
            "sphere" => {
                let centre = props.vector("center")?.unwrap_or(DVec3::ZERO);
                scaled(primitives::sphere(), centre, props.float("radius", 1.0)?)
            }
            "rectangle" => primitives::rectangle(),
            "cube" => primitives::cube(),
            "disk" => primitives::disk(),
            "cylinder" => {
                let (p0, p1) = (props.vector("p0")?.unwrap_or(DVec3::ZERO), props.vector("p1")?.unwrap_or(DVec3::Z));
                let mesh = primitives::cylinder(p0, p1, props.float("radius", 1.0)?);
                mesh.ok_or_else(|| props.bad("`p0` and `p1` are the same point"))?
            }
            "obj" | "ply" | "serialized" => match self.mesh_file(name, props)? {
                Some(mesh) => mesh,
                None => return Ok(None),
            },
            _ if SHAPES.contains(&name) => {
                self.near(name, props, "nothing: it is left out");
                props.ignore(&[
                    "filename",
                    "radius",
                    "reduction",
                    "angle_threshold",
                    "grid",
                    "normals",
                    "interpolation",
                ]);
                return Ok(None);
            }
            _ => return Err(at.unknown("shape", name, SHAPES)),
        };
        let mut mesh = mesh;
        ply::place(&mut mesh, &world, flip, &mesh_name(props)?, &mut self.target.sink);
        Ok(Some(mesh))
    }

    /// The mesh of a file with the normals that Mitsuba gives it. `None` with a warning if there is no such file.
    fn mesh_file(&mut self, kind: &str, props: &Props) -> Found<Option<PlyMesh>> {
        let Some(file) = props.string("filename")? else { return Err(props.bad("a mesh needs a `filename`")) };
        // OBJ files have v running up.
        let (flip_uvs, wants_faces) =
            (props.boolean("flip_tex_coords", kind == "obj")?, props.boolean("face_normals", false)?);
        let index = props.integer("shape_index", 0..=1 << 30)?.unwrap_or(0) as usize;
        let path = self.files.find(&file.value, file.at.source.name());
        let source = match self.files.read(&path) {
            Ok(bytes) => SourceFile::from_bytes(path.display().to_string(), bytes),
            Err(error) => {
                let severity = crate::Severity::Warning;
                let told = Diagnostic { severity, code: "mitsuba::missing-mesh", ..first_of(error) };
                self.target.sink.warn("mitsuba::missing-mesh", || file.at.tell(told, "left out"));
                return Ok(None);
            }
        };
        self.target.input(source.bytes());
        let (mut mesh, asks_for_faces) = match kind {
            "obj" => (obj::merged(&obj::parse(&source, &mut self.target.sink)), false),
            "ply" => (ply::parse(&source, &mut self.target.sink), false),
            _ => {
                let damaged = |why| file.at.bad("mitsuba::mesh", format!("{}: {why}", source.name()));
                serialized::mesh(source.bytes(), index).map_err(damaged)?
            }
        };
        if flip_uvs {
            mesh.uvs.iter_mut().for_each(|uv| uv[1] = 1.0 - uv[1]);
        }
        if wants_faces || asks_for_faces {
            mesh.normals.clear();
            return Ok(Some(mesh));
        }
        ply::drop_false_normals(&mut mesh, source.name(), &mut self.target.sink);
        if mesh.normals.is_empty() {
            smooth::add_normals(&mut mesh, kind == "obj");
        }
        Ok(Some(mesh))
    }

    fn instance(&mut self, props: &Props<'d>) -> Found<()> {
        let group = props.objects("shape")?.pop();
        let Some(number) = group else { return Err(props.bad("an instance needs a `shapegroup`")) };
        let world = rounded(&props.transform("to_world")?);
        let Some(object) = self.group(number)? else { return Ok(()) };
        if world.is_finite() && world.matrix3.determinant() != 0.0 {
            self.target.place(object, world);
        } else {
            let message = "an instance squeezed flat is left out";
            let told = props.at().tell(Diagnostic::warning("mitsuba::flat-instance", message), "");
            self.target.sink.warn("mitsuba::flat-instance", || told);
        }
        Ok(())
    }

    /// The surfaces of a group, made once; `None` if there are none.
    fn group(&mut self, number: usize) -> Found<Option<ObjectId>> {
        if let Some(object) = self.groups.get(&number) {
            return Ok(*object);
        }
        let props = self.props(number);
        if props.element.plugin()?.0 != "shapegroup" {
            return Err(props.unknown_plugin("shape to place", &["shapegroup"]));
        }
        let mut surfaces = Vec::new();
        for inner in props.objects("shape")? {
            let inner = self.props(inner);
            surfaces.extend(self.surfaces(&inner)?);
            self.tell_unused(&inner);
        }
        self.tell_unused(&props);
        let object = if surfaces.is_empty() { None } else { Some(self.target.object(surfaces)) };
        self.groups.insert(number, object);
        Ok(object)
    }
}

/// What a surface sends out.
enum Glow {
    Nothing,
    /// The same radiance everywhere.
    Even(Illuminant),
    /// Radiance by texture coordinates; the first row is at v = 0.
    Picture(ImageTexture),
}

/// What messages call a mesh: its file, or that of the scene.
fn mesh_name(props: &Props) -> Found<String> {
    let file = props.string("filename")?.map(|file| file.value.clone());
    Ok(file.unwrap_or_else(|| props.at().source.name().to_owned()))
}

/// In the precision of the scene.
fn rounded(m: &DAffine3) -> Affine3A {
    Affine3A::from_mat3_translation(m.matrix3.as_mat3(), m.translation.as_vec3())
}

/// Moved and stretched evenly, before all else.
fn scaled(mut mesh: PlyMesh, centre: DVec3, radius: f64) -> PlyMesh {
    let moved = |p: [f32; 3]| (centre + radius * Vec3::from_array(p).as_dvec3()).as_vec3().to_array();
    mesh.positions.iter_mut().for_each(|p| *p = moved(*p));
    mesh
}
