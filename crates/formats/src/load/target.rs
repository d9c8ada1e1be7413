//! The scene that files are read into.

use super::{CameraSettings, Hints, InputHash};
use crate::diagnostic::{Diagnostic, Sink};
use glam::{Affine3A, Vec3};
use sunfleck::light::{Light, Sides};
use sunfleck::medium::InteriorId;
use sunfleck::scene::{MaterialId, ObjectId, SceneBuilder, SurfaceDef};
use sunfleck::shape::Shape;
use sunfleck::spectrum::Illuminant;

/// A scene in the making, with the findings so far.
pub struct Target {
    /// Findings about the file that is being read.
    pub sink: Sink,
    /// The eye, if a file has one.
    pub(crate) camera: Option<CameraSettings>,
    /// Where the eye goes while the shutter is open, if it moves.
    pub(crate) camera_to: Option<CameraSettings>,
    /// Names that files give to materials, in order.
    pub(super) names: Vec<(String, MaterialId)>,
    /// What a file says about how to render it.
    pub(crate) hints: Option<Hints>,
    bounds: Option<(Vec3, Vec3)>,
    pub(super) builder: SceneBuilder,
    pub(super) warnings: Vec<Diagnostic>,
    pub(super) hash: InputHash,
    pub(super) surfaces: usize,
    pub(super) lights: usize,
    /// How many of the lights are surfaces that glow rather than light the scene.
    pub(crate) glowing: usize,
}

impl Target {
    pub(crate) fn new() -> Self {
        Self {
            sink: Sink::default(),
            camera: None,
            camera_to: None,
            names: Vec::new(),
            hints: None,
            bounds: None,
            builder: SceneBuilder::new(),
            warnings: Vec::new(),
            hash: InputHash::new(),
            surfaces: 0,
            lights: 0,
            glowing: 0,
        }
    }

    /// The scene so far.
    pub(crate) fn into_builder(self) -> SceneBuilder {
        self.builder
    }

    /// For materials and textures.
    pub(crate) fn builder(&mut self) -> &mut SceneBuilder {
        &mut self.builder
    }

    /// Notes what a file calls a material, so that it can be asked for by name.
    pub(crate) fn name_material(&mut self, name: &str, id: MaterialId) {
        self.names.push((name.to_owned(), id));
    }

    /// `of` with `interior` behind it, and with the same name.
    pub(crate) fn filled(&mut self, of: MaterialId, interior: InteriorId) -> MaterialId {
        let id = self.builder.filled(of, interior);
        let names: Vec<_> = self.names.iter().filter(|(_, named)| *named == of).map(|(n, _)| n.clone()).collect();
        self.names.extend(names.into_iter().map(|name| (name, id)));
        id
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
        self.extend_bounds(&shape);
        self.builder.surface(SurfaceDef { shape, material, emission });
    }

    /// Notes where the surfaces of an object will be.
    pub(crate) fn bound_object(&mut self, surfaces: &[SurfaceDef], places: &[Affine3A]) {
        let mut low = Vec3::INFINITY;
        let mut high = Vec3::NEG_INFINITY;
        for surface in surfaces {
            each_point(&surface.shape, |p| (low, high) = (low.min(p), high.max(p)));
        }
        if !(low.is_finite() && high.is_finite()) {
            return;
        }
        for place in places {
            for i in 0..8 {
                let corner = Vec3::new([low.x, high.x][i & 1], [low.y, high.y][i >> 1 & 1], [low.z, high.z][i >> 2]);
                self.include(place.transform_point3(corner));
            }
        }
    }

    fn include(&mut self, p: Vec3) {
        if p.is_finite() {
            let (low, high) = self.bounds.get_or_insert((p, p));
            (*low, *high) = (low.min(p), high.max(p));
        }
    }

    fn extend_bounds(&mut self, shape: &Shape) {
        each_point(shape, |p| self.include(p));
    }

    /// The lowest and the highest coordinates of all surfaces that are no objects.
    pub(super) fn bounds(&self) -> Option<(Vec3, Vec3)> {
        self.bounds
    }

    /// How many lights there are, emitting surfaces included.
    pub(crate) fn lights(&self) -> usize {
        self.lights
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

/// Points whose bounds are those of a shape.
fn each_point(shape: &Shape, mut add: impl FnMut(Vec3)) {
    match shape {
        Shape::Mesh(mesh) => mesh.indices().iter().flatten().for_each(|i| add(mesh.positions()[*i as usize])),
        Shape::Sphere(sphere) => [-1.0, 1.0].into_iter().for_each(|s| add(sphere.centre + s * sphere.radius)),
        Shape::Parallelogram(patch) => patch.corners().into_iter().for_each(add),
    }
}
