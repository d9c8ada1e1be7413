//! The scene that files are read into.

use super::{CameraSettings, Hints, InputHash};
use crate::diagnostic::{Diagnostic, Sink};
use glam::Affine3A;
use sunfleck::light::{Light, Sides};
use sunfleck::scene::{MaterialId, ObjectId, SceneBuilder, SurfaceDef};
use sunfleck::shape::Shape;
use sunfleck::spectrum::Illuminant;

/// A scene in the making, with the findings so far.
pub struct Target {
    /// Findings about the file that is being read.
    pub sink: Sink,
    /// The eye, if a file has one.
    pub(crate) camera: Option<CameraSettings>,
    /// What a file says about how to render it.
    pub(crate) hints: Option<Hints>,
    pub(super) builder: SceneBuilder,
    pub(super) warnings: Vec<Diagnostic>,
    pub(super) hash: InputHash,
    pub(super) surfaces: usize,
    pub(super) lights: usize,
}

impl Target {
    pub(super) fn new() -> Self {
        Self {
            sink: Sink::default(),
            camera: None,
            hints: None,
            builder: SceneBuilder::new(),
            warnings: Vec::new(),
            hash: InputHash::new(),
            surfaces: 0,
            lights: 0,
        }
    }

    /// For materials and textures.
    pub(crate) fn builder(&mut self) -> &mut SceneBuilder {
        &mut self.builder
    }

    /// Notes the bytes of an input file.
    pub(crate) fn input(&mut self, bytes: &[u8]) {
        self.hash.add(bytes);
    }

    /// Adds a surface, emitting if `emission` is not black.
    pub(crate) fn surface(&mut self, shape: Shape, material: MaterialId, emission: Option<(Illuminant, Sides)>) {
        let emission = emission.filter(|(radiance, _)| !radiance.is_black());
        self.surfaces += 1;
        self.lights += usize::from(emission.is_some());
        self.builder.surface(SurfaceDef { shape, material, emission });
    }

    /// Adds an object, to be placed.
    pub(crate) fn object(&mut self, surfaces: Vec<SurfaceDef>) -> ObjectId {
        self.builder.object(surfaces)
    }

    /// Places an object in the world.
    pub(crate) fn place(&mut self, object: ObjectId, world_from_object: Affine3A) {
        self.surfaces += 1;
        self.builder.place(object, world_from_object);
    }

    /// Places an object that moves from one place to another while the shutter is open.
    pub(crate) fn place_moving(&mut self, object: ObjectId, from: Affine3A, to: Affine3A) {
        self.surfaces += 1;
        self.builder.place_moving(object, from, to);
    }

    /// Adds a light that is no surface.
    pub(crate) fn light(&mut self, light: impl Into<Light>) {
        self.lights += 1;
        self.builder.light(light);
    }
}
