//! The scene: flat tables addressed by typed ids, immutable once built.
//!
//! [`SceneBuilder`] checks and freezes it; [`World`] is the scene as one pass sees it, and what every algorithm asks.
mod build;
mod interaction;
mod world;

pub use build::{Quality, SceneBuilder, SceneError, SurfaceDef};
pub use interaction::{Interaction, Scattered};
pub use world::{DirectSample, World};

use crate::{
    bsdf::Material,
    camera::Camera,
    light::{Light, LightId, LightTable, Surroundings},
    shape::Shape,
    spectrum::Wavelengths,
    texture::Texture,
};
use glam::{Affine3A, Vec3};

pub use crate::bsdf::TextureId;

/// Handle of a material of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(pub u32);

/// Handle of an object that instances refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ObjectId(pub u32);

/// A shape, what covers it, and the light on it, if any.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Geometry.
    pub shape: Shape,
    /// Scattering.
    pub material: MaterialId,
    /// Set if the surface emits.
    pub light: Option<LightId>,
}

/// An object placed in the world.
#[derive(Clone, Debug)]
struct Placement {
    object: ObjectId,
    world_from_object: Affine3A,
    object_from_world: Affine3A,
    /// Takes normals of the object to the world (not unit).
    normal_from_object: glam::Mat3A,
}

/// The time at which measurements before the first pass look at the scene.
pub const MID_SHUTTER: f32 = 0.5;

/// Everything a pass may read.
pub struct Scene {
    textures: Vec<Texture>,
    materials: Vec<Material>,
    surfaces: Vec<Surface>,
    objects: Vec<Vec<Surface>>,
    placements: Vec<Placement>,
    lights: Vec<Light>,
    light_table: LightTable,
    camera: Camera,
    bvh: accel::Bvh,
    centre: Vec3,
    radius: f32,
}

/// What a scene holds, for summaries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneCounts {
    /// Surfaces placed in the world or in objects.
    pub surfaces: usize,
    /// Triangles kept by the ray index.
    pub triangles: usize,
    /// Spheres among the surfaces.
    pub spheres: usize,
    /// Placed objects.
    pub instances: usize,
    /// Material models.
    pub materials: usize,
    /// Textures.
    pub textures: usize,
    /// Lights.
    pub lights: usize,
    /// Bytes of the ray index.
    pub bvh_bytes: usize,
}

impl Scene {
    /// The scene as a pass at `lambda` sees it, at `time` in [0, 1] while the shutter is open.
    pub fn world(&self, lambda: Wavelengths, time: f32) -> World<'_> {
        World::new(self, lambda, time)
    }
    /// All lights, by [`LightId`].
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }
    /// All materials, by [`MaterialId`].
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }
    /// Centre and radius of a sphere around all geometry.
    pub fn bounding_sphere(&self) -> (Vec3, f32) {
        (self.centre, self.radius)
    }
    /// What lights may know of the scene.
    pub fn surroundings(&self, lambda: Wavelengths) -> Surroundings {
        Surroundings { centre: self.centre, radius: self.radius, lambda }
    }
    /// Numbers for a summary.
    pub fn counts(&self) -> SceneCounts {
        let all = || self.surfaces.iter().chain(self.objects.iter().flatten());
        SceneCounts {
            surfaces: all().count(),
            triangles: self.bvh.counts().triangles,
            spheres: all().filter(|s| matches!(s.shape, Shape::Sphere(_))).count(),
            instances: self.placements.len(),
            materials: self.materials.len(),
            textures: self.textures.len(),
            lights: self.lights.len(),
            bvh_bytes: self.bvh.memory_bytes(),
        }
    }
}
