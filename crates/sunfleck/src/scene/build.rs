//! Putting a scene together, and checking it once so that passes need not.
use super::{MaterialId, ObjectId, Placement, Scene, Surface, TextureId};
use crate::{
    bsdf::Material,
    camera::{Camera, Perspective, View},
    light::{AreaLight, Light, LightId, LightTable, Sides, Surroundings},
    shape::{Parallelogram, Shape},
    spectrum::{Rgb, Wavelengths},
    texture::Texture,
};
use glam::{Affine3A, Mat3A, Vec3};

/// A surface to add.
#[derive(Clone, Debug)]
pub struct SurfaceDef {
    /// Geometry, in the space of what it is added to.
    pub shape: Shape,
    /// Scattering.
    pub material: MaterialId,
    /// Emitted radiance W/(m²·sr) and the sides that emit.
    pub emission: Option<(Rgb, Sides)>,
}

/// Why a scene cannot be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// A handle that names nothing.
    #[error("{what} {id} does not exist: the scene has {count}")]
    Missing {
        /// Kind of handle.
        what: &'static str,
        /// Its number.
        id: u32,
        /// How many there are.
        count: usize,
    },
    /// An emitting sphere in an instance that stretches or shears it.
    #[error("object {object} holds an emitting sphere and is placed with uneven scaling, which has no exact light")]
    StretchedLight {
        /// Which object.
        object: u32,
    },
}

/// Collects a scene. Handles are given out in order and checked by [`SceneBuilder::build`].
#[derive(Clone, Debug, Default)]
pub struct SceneBuilder {
    textures: Vec<Texture>,
    materials: Vec<Material>,
    surfaces: Vec<SurfaceDef>,
    objects: Vec<Vec<SurfaceDef>>,
    instances: Vec<(ObjectId, Affine3A)>,
    lights: Vec<Light>,
    camera: Option<Camera>,
    quality: Quality,
}

/// How much time the ray index may take to build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Quality {
    /// Quick to build.
    #[default]
    Default,
    /// Slower to build, faster to trace.
    High,
}

impl SceneBuilder {
    /// An empty scene.
    pub fn new() -> Self {
        Self::default()
    }
    /// Adds a texture.
    pub fn texture(&mut self, t: Texture) -> TextureId {
        self.textures.push(t);
        TextureId(self.textures.len() as u32 - 1)
    }
    /// Adds a texture of one colour.
    pub fn constant(&mut self, c: Rgb) -> TextureId {
        self.texture(Texture::Constant(c))
    }
    /// Adds a material.
    pub fn material(&mut self, m: impl Into<Material>) -> MaterialId {
        self.materials.push(m.into());
        MaterialId(self.materials.len() as u32 - 1)
    }
    /// Adds a surface in world space.
    pub fn surface(&mut self, s: SurfaceDef) {
        self.surfaces.push(s);
    }
    /// Adds a surface that does not emit.
    pub fn add(&mut self, shape: Shape, material: MaterialId) {
        self.surface(SurfaceDef { shape, material, emission: None });
    }
    /// Adds an object, seen only where [`SceneBuilder::place`] puts it.
    pub fn object(&mut self, surfaces: Vec<SurfaceDef>) -> ObjectId {
        self.objects.push(surfaces);
        ObjectId(self.objects.len() as u32 - 1)
    }
    /// Places an object in the world.
    pub fn place(&mut self, object: ObjectId, world_from_object: Affine3A) {
        self.instances.push((object, world_from_object));
    }
    /// Adds a light that is not a surface.
    pub fn light(&mut self, l: impl Into<Light>) {
        self.lights.push(l.into());
    }
    /// Sets the eye.
    pub fn camera(&mut self, c: impl Into<Camera>) {
        self.camera = Some(c.into());
    }
    /// Sets the effort for the ray index.
    pub fn quality(&mut self, q: Quality) {
        self.quality = q;
    }

    /// Checks all handles, turns emission into lights, and builds the ray index. Without a camera, one at
    /// (0, 0, −3) looks at the origin under 40 degrees, as NRenderer's does.
    ///
    /// # Errors
    /// A handle that names nothing, or a light that cannot be placed.
    pub fn build(mut self) -> Result<Scene, SceneError> {
        self.check()?;
        self.flatten_emitting_instances()?;
        let camera = self.camera.take().unwrap_or_else(default_camera);
        let mut lights = std::mem::take(&mut self.lights);
        let surfaces: Vec<Surface> =
            std::mem::take(&mut self.surfaces).into_iter().map(|s| freeze(s, &mut lights)).collect();
        let objects: Vec<Vec<Surface>> = std::mem::take(&mut self.objects)
            .into_iter()
            .map(|o| o.into_iter().filter(|s| s.emission.is_none()).map(|s| freeze(s, &mut lights)).collect())
            .collect();
        let placements: Vec<Placement> = self.instances.iter().map(|&(o, m)| placement(o, m)).collect();
        let bvh = build_index(&surfaces, &objects, &placements, self.quality);
        let (centre, radius) = bounding_sphere(&bvh);
        let around = Surroundings { centre, radius, lambda: Wavelengths::Rgb };
        let light_table = LightTable::new(&lights, &around);
        let Self { textures, materials, .. } = self;
        Ok(Scene {
            textures,
            materials,
            surfaces,
            objects,
            placements,
            lights,
            light_table,
            camera,
            bvh,
            centre,
            radius,
        })
    }

    fn check(&self) -> Result<(), SceneError> {
        let check = |what, id: u32, count: usize| {
            if (id as usize) < count { Ok(()) } else { Err(SceneError::Missing { what, id, count }) }
        };
        for s in self.surfaces.iter().chain(self.objects.iter().flatten()) {
            check("material", s.material.0, self.materials.len())?;
        }
        for t in self.materials.iter().flat_map(Material::textures) {
            check("texture", t.0, self.textures.len())?;
        }
        self.instances.iter().try_for_each(|(o, _)| check("object", o.0, self.objects.len()))
    }

    /// Emitting surfaces of objects are copied into the world at each placement, so that every light has one place.
    fn flatten_emitting_instances(&mut self) -> Result<(), SceneError> {
        for (object, m) in &self.instances {
            for s in self.objects[object.0 as usize].iter().filter(|s| s.emission.is_some()) {
                let shape = s.shape.transformed(m).ok_or(SceneError::StretchedLight { object: object.0 })?;
                self.surfaces.push(SurfaceDef { shape, ..s.clone() });
            }
        }
        // What does not emit stays behind; an object with nothing left needs no placing.
        let objects = &self.objects;
        self.instances.retain(|(o, _)| objects[o.0 as usize].iter().any(|s| s.emission.is_none()));
        Ok(())
    }
}

fn freeze(s: SurfaceDef, lights: &mut Vec<Light>) -> Surface {
    let light = s.emission.map(|(radiance, sides)| {
        lights.push(Light::Area(AreaLight { shape: s.shape.clone(), radiance, sides }));
        LightId(lights.len() as u32 - 1)
    });
    Surface { shape: s.shape, material: s.material, light }
}

fn placement(object: ObjectId, world_from_object: Affine3A) -> Placement {
    // The inverse transpose keeps the outer side outside under mirroring too: n·(x − p) > 0 maps to itself.
    let normal_from_object: Mat3A = world_from_object.matrix3.inverse().transpose();
    Placement { object, world_from_object, object_from_world: world_from_object.inverse(), normal_from_object }
}

/// Corners of the parallelograms of a group, which have no vertex array of their own to lend to the index.
fn corners(group: &[Surface]) -> Vec<[Vec3; 4]> {
    group.iter().map(|s| if let Shape::Parallelogram(q) = &s.shape { q.corners() } else { [Vec3::ZERO; 4] }).collect()
}

fn geometry<'a>(group: &'a [Surface], corners: &'a [[Vec3; 4]]) -> Vec<accel::Geometry<'a>> {
    let one = |(s, c): (&'a Surface, &'a [Vec3; 4])| match &s.shape {
        Shape::Mesh(m) => accel::Geometry::Triangles { positions: m.positions(), indices: m.indices() },
        Shape::Sphere(s) => accel::Geometry::Sphere { centre: s.centre, radius: s.radius },
        Shape::Parallelogram(_) => accel::Geometry::Triangles { positions: c, indices: &Parallelogram::TRIANGLES },
    };
    group.iter().zip(corners).map(one).collect()
}

fn build_index(
    surfaces: &[Surface],
    objects: &[Vec<Surface>],
    placements: &[Placement],
    quality: Quality,
) -> accel::Bvh {
    let world_corners = corners(surfaces);
    let world = geometry(surfaces, &world_corners);
    let object_corners: Vec<_> = objects.iter().map(|o| corners(o)).collect();
    let object_geometry: Vec<_> = objects.iter().zip(&object_corners).map(|(o, c)| geometry(o, c)).collect();
    let object_slices: Vec<&[accel::Geometry]> = object_geometry.iter().map(Vec::as_slice).collect();
    let instances: Vec<_> = placements
        .iter()
        .map(|p| accel::Instance { object: p.object.0, world_from_object: p.world_from_object })
        .collect();
    let quality = match quality {
        Quality::Default => accel::Quality::Default,
        Quality::High => accel::Quality::High,
    };
    accel::Bvh::build(&world, &object_slices, &instances, quality)
}

/// A sphere around all geometry; a unit one around the origin when there is none.
fn bounding_sphere(bvh: &accel::Bvh) -> (Vec3, f32) {
    let b = bvh.bounds();
    let radius = 0.5 * (b.max - b.min).length();
    if radius.is_finite() && radius > 0.0 && b.min.cmple(b.max).all() {
        (0.5 * (b.min + b.max), radius)
    } else {
        (Vec3::ZERO, 1.0)
    }
}

fn default_camera() -> Camera {
    let view = View { position: Vec3::new(0.0, 0.0, -3.0), look_at: Vec3::ZERO, up: Vec3::Y };
    Perspective::new(&view, 40.0, 1.0).expect("constants are in range").into()
}
