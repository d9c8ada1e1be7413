//! Geometry as rays meet it at one time, and the lights on it.
use super::{ObjectId, Surface, SurfaceDef};
use crate::{
    light::{AreaLight, Light, LightId, LightTable, Surroundings},
    shape::{Parallelogram, Shape},
};
use glam::{Affine3A, Mat3A, Vec3};

/// All geometry of the scene at one time. Objects' surfaces stay with the scene: they do not change.
pub(super) struct Moment {
    pub(super) bvh: accel::Bvh,
    /// Surfaces placed directly in the world.
    pub(super) surfaces: Vec<Surface>,
    pub(super) placements: Vec<Placement>,
    /// Lights that move, numbered after those of the scene.
    pub(super) moved_lights: Vec<Light>,
    /// Over the lights of the scene and these.
    pub(super) light_table: LightTable,
}

/// An object placed in the world.
#[derive(Clone, Debug)]
pub(super) struct Placement {
    pub(super) object: ObjectId,
    pub(super) world_from_object: Affine3A,
    pub(super) object_from_world: Affine3A,
    /// Takes normals of the object to the world (not unit).
    pub(super) normal_from_object: Mat3A,
}

impl Placement {
    pub(super) fn new(object: ObjectId, world_from_object: Affine3A) -> Self {
        // The inverse transpose keeps the outer side outside under mirroring too: n·(x − p) > 0 maps to itself.
        let normal_from_object: Mat3A = world_from_object.matrix3.inverse().transpose();
        Self { object, world_from_object, object_from_world: world_from_object.inverse(), normal_from_object }
    }
}

/// The hierarchies of objects.
pub(super) fn hierarchies(objects: &[Vec<Surface>], quality: accel::Quality) -> accel::Objects {
    let groups: Vec<_> = objects.iter().map(|o| Group::new(o)).collect();
    let geometry: Vec<_> = groups.iter().map(Group::geometry).collect();
    let slices: Vec<&[accel::Geometry]> = geometry.iter().map(Vec::as_slice).collect();
    accel::Objects::build(&slices, quality)
}

impl Moment {
    /// Geometry without lights.
    pub(super) fn new(
        objects: &accel::Objects,
        surfaces: Vec<Surface>,
        placements: Vec<Placement>,
        quality: accel::Quality,
    ) -> Self {
        let instance = |p: &Placement| accel::Instance { object: p.object.0, world_from_object: p.world_from_object };
        let instances: Vec<_> = placements.iter().map(instance).collect();
        let bvh = objects.place(&Group::new(&surfaces).geometry(), &instances, quality);
        Self { bvh, surfaces, placements, moved_lights: Vec::new(), light_table: LightTable::default() }
    }
    /// The same with its lights.
    pub(super) fn with_lights(mut self, still: &[Light], moved: Vec<Light>, around: &Surroundings) -> Self {
        self.light_table = LightTable::new(still.iter().chain(&moved), around);
        self.moved_lights = moved;
        self
    }
}

/// A surface for the tables; if it emits, its light is added to `lights`, which are numbered from `first` on.
pub(super) fn freeze(s: SurfaceDef, first: usize, lights: &mut Vec<Light>) -> Surface {
    let light = s.emission.map(|(radiance, sides)| {
        // Points are drawn from a patch faster, and spread better, than from two triangles.
        let patch = if let Shape::Mesh(m) = &s.shape { m.as_parallelogram().map(Shape::Parallelogram) } else { None };
        lights.push(Light::Area(AreaLight { shape: patch.unwrap_or_else(|| s.shape.clone()), radiance, sides }));
        LightId((first + lights.len() - 1) as u32)
    });
    Surface { shape: s.shape, material: s.material, light }
}

/// A group of surfaces in the terms of the ray index, and what it borrows.
struct Group<'a> {
    surfaces: &'a [Surface],
    /// Of parallelograms, which have no vertex array of their own to lend.
    corners: Vec<[Vec3; 4]>,
}

impl<'a> Group<'a> {
    fn new(surfaces: &'a [Surface]) -> Self {
        let corners = |s: &Surface| if let Shape::Parallelogram(q) = &s.shape { q.corners() } else { [Vec3::ZERO; 4] };
        Self { surfaces, corners: surfaces.iter().map(corners).collect() }
    }
    fn geometry(&'a self) -> Vec<accel::Geometry<'a>> {
        let one = |(s, c): (&'a Surface, &'a [Vec3; 4])| match &s.shape {
            Shape::Mesh(m) => accel::Geometry::Triangles { positions: m.positions(), indices: m.indices() },
            Shape::Sphere(s) => accel::Geometry::Sphere { centre: s.centre, radius: s.radius },
            Shape::Parallelogram(_) => accel::Geometry::Triangles { positions: c, indices: &Parallelogram::TRIANGLES },
        };
        self.surfaces.iter().zip(&self.corners).map(one).collect()
    }
}
