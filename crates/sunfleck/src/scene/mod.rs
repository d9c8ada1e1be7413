//! The scene: flat tables addressed by typed ids, immutable once built.
//!
//! [`SceneBuilder`] checks and freezes it; [`World`] is the scene as one pass sees it, and what every algorithm asks.
mod build;
mod filled;
mod interaction;
mod moment;
mod moving;
mod parts;
mod principled;
mod record;
mod surfaces;
mod world;

pub use build::{Quality, SceneBuilder, SceneError, SurfaceDef};
pub use interaction::{Interaction, NearSide, Scattered, TowardEye};
pub use parts::{Instance, Parts};
pub use principled::Transmission;
pub use record::Record;
pub use world::{DirectSample, Sky, World};

use crate::{
    bsdf::Material,
    camera::Camera,
    light::{Light, LightId, Surroundings},
    medium::{Interior, InteriorId},
    shape::Shape,
    spectrum::Wavelengths,
    texture::Texture,
};
use glam::Vec3;
use moving::Geometry;
use std::sync::atomic::{AtomicBool, Ordering};

pub use crate::bsdf::{MaterialId, TextureId};

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

/// The time at which measurements before the first pass look at the scene.
pub const MID_SHUTTER: f32 = 0.5;

/// Everything a pass may read.
pub struct Scene {
    textures: Vec<Texture>,
    materials: Vec<Material>,
    /// Whether rays may pass it, by material; empty if no material has holes.
    porous: Vec<bool>,
    /// What it looks at, by material.
    looks: Vec<Looks>,
    /// Some material [`Looks::has_means`].
    has_means: bool,
    interiors: Vec<Interior>,
    /// Some path was in more interiors than it can remember.
    crowded: AtomicBool,
    objects: Vec<Vec<Surface>>,
    /// Those that stand still.
    lights: Vec<Light>,
    geometry: Geometry,
    camera: Camera,
    /// Where the camera goes, if it moves.
    camera_to: Option<Camera>,
    around: Surroundings,
}

/// What a material must be told of a hit.
#[derive(Clone, Copy, Debug)]
struct Looks {
    /// Nothing at all: a plain model without textures.
    is_even: bool,
    /// Nothing but the point, its texture coordinates and its normal: see [`Record`].
    at_place_alone: bool,
    /// What is seen of the surface at once, for colours that are the mean over it.
    has_means: bool,
    /// What lies behind it. Not of a hit, but looked up with the rest.
    interior: Option<InteriorId>,
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
    /// Placed objects, those that move included.
    pub instances: usize,
    /// Placed objects that move while the shutter is open.
    pub moving_instances: usize,
    /// The camera moves while the shutter is open.
    pub moving_camera: bool,
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
    /// Whether passes at different times see different scenes.
    pub fn moves(&self) -> bool {
        self.camera_to.is_some() || matches!(self.geometry, Geometry::Moving(_))
    }
    /// The lights that stand still, by [`LightId`]; [`World::lights`] has all.
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }
    /// All materials, by [`MaterialId`].
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }
    /// Whether nothing in it makes caustics.
    pub fn is_matt(&self) -> bool {
        self.materials.iter().all(Material::is_matt)
    }
    /// All interiors, by [`InteriorId`].
    pub fn interiors(&self) -> &[Interior] {
        &self.interiors
    }
    /// Whether some path so far was in more than [`crate::medium::DEPTH`] interiors at once, and forgot the rest.
    pub fn was_crowded(&self) -> bool {
        self.crowded.load(Ordering::Relaxed)
    }
    /// Whether some material bends each wavelength differently, which only spectral mode shows.
    pub fn is_dispersive(&self) -> bool {
        self.materials.iter().any(Material::is_dispersive)
    }
    /// Centre and radius of a sphere around all geometry, wherever it moves.
    pub fn bounding_sphere(&self) -> (Vec3, f32) {
        (self.around.centre, self.around.radius)
    }
    /// What lights may know of the scene.
    pub fn surroundings(&self, lambda: Wavelengths) -> Surroundings {
        Surroundings { lambda, ..self.around }
    }
    /// Numbers for a summary.
    pub fn counts(&self) -> SceneCounts {
        let moment = self.geometry.at(&self.lights, &self.around, MID_SHUTTER);
        let all = || moment.surfaces.iter().chain(self.objects.iter().flatten());
        let index = moment.bvh.counts();
        let (instances, moving_instances) = match &self.geometry {
            Geometry::Still(_) => (moment.placements.len(), 0),
            Geometry::Moving(moving) => moving.instances(),
        };
        SceneCounts {
            surfaces: all().count(),
            triangles: index.triangles,
            spheres: all().filter(|s| matches!(s.shape, Shape::Sphere(_))).count(),
            instances,
            moving_instances,
            moving_camera: self.camera_to.is_some(),
            materials: self.materials.len(),
            textures: self.textures.len(),
            lights: self.lights.len() + moment.moved_lights.len(),
            bvh_bytes: moment.bvh.memory_bytes(),
        }
    }
}
