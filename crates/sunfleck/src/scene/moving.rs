//! What is needed to put the scene together for one time while the shutter is open.
use super::{
    ObjectId, Surface, SurfaceDef,
    moment::{Moment, Placement, freeze, hierarchies},
};
use crate::{
    light::{Light, Surroundings},
    math::Motion,
};
use accel::Aabb;
use glam::Affine3A;
use std::sync::Arc;

/// The geometry of a scene.
pub(super) enum Geometry {
    /// The same for all passes.
    Still(Arc<Moment>),
    /// Put together for each.
    Moving(Moving),
}

/// Where something is while the shutter is open.
#[derive(Clone, Copy, Debug)]
pub(super) enum Place {
    Still(Affine3A),
    Moving(Motion),
}

/// A scene in which something moves. Hierarchies of objects are built once; a pass builds the few nodes above them.
/// Surfaces of the world that stand still are an object too, so that they are not among those.
pub(super) struct Moving {
    objects: accel::Objects,
    quality: accel::Quality,
    places: Places,
    /// Each is moved for itself, so that lights need not know of objects.
    emitters: Emitters,
}

impl Geometry {
    /// The geometry at `time`; `lights` are those that stand still.
    pub(super) fn at(&self, lights: &[Light], around: &Surroundings, time: f32) -> Arc<Moment> {
        match self {
            Self::Still(moment) => Arc::clone(moment),
            Self::Moving(moving) => Arc::new(moving.moment(lights, around, time)),
        }
    }
}

/// Every placement.
pub(super) type Places = Vec<(ObjectId, Place)>;
/// Emitting surfaces that move, in the space of the object they belong to.
pub(super) type Emitters = Vec<(SurfaceDef, Motion)>;

impl Place {
    pub(super) fn at(&self, time: f32) -> Affine3A {
        match self {
            Self::Still(map) => *map,
            Self::Moving(motion) => motion.at(time),
        }
    }
}

impl Moving {
    /// Builds the hierarchies. The world's `surfaces` are added to `objects`.
    pub(super) fn new(
        surfaces: Vec<Surface>,
        objects: &mut Vec<Vec<Surface>>,
        mut places: Places,
        emitters: Emitters,
        quality: accel::Quality,
    ) -> Self {
        places.push((ObjectId(objects.len() as u32), Place::Still(Affine3A::IDENTITY)));
        objects.push(surfaces);
        Self { objects: hierarchies(objects, quality), quality, places, emitters }
    }

    fn moment(&self, lights: &[Light], around: &Surroundings, time: f32) -> Moment {
        let mut moved = Vec::with_capacity(self.emitters.len());
        let surface = |(s, motion): &(SurfaceDef, Motion)| {
            let shape = s.shape.transformed(&motion.at(time)).expect("even at both ends, hence on the way");
            freeze(SurfaceDef { shape, material: s.material, emission: s.emission.clone() }, lights.len(), &mut moved)
        };
        let surfaces: Vec<_> = self.emitters.iter().map(surface).collect();
        let placements: Vec<_> = self.places.iter().map(|(o, place)| Placement::new(*o, place.at(time))).collect();
        Moment::new(&self.objects, surfaces, placements, self.quality).with_lights(lights, moved, around)
    }

    /// A box around everything, all the way.
    pub(super) fn swept(&self) -> Aabb {
        let placed = self.places.iter().map(|(o, place)| {
            let local = self.objects.bounds(o.0);
            match place {
                Place::Still(map) => local.transformed(map),
                Place::Moving(motion) => motion.bounds(&local),
            }
        });
        let emitting = self.emitters.iter().map(|(s, motion)| motion.bounds(&s.shape.bounds()));
        placed.chain(emitting).fold(Aabb::EMPTY, |all, one| all.union(&one))
    }
    /// How many objects are placed, the world aside, and how many of them move.
    pub(super) fn instances(&self) -> (usize, usize) {
        let moving = self.places.iter().filter(|(_, place)| matches!(place, Place::Moving(_))).count();
        (self.places.len() - 1, moving)
    }
}
