//! Objects placed in the world.

use crate::Ray;
use glam::Affine3A;

/// An object of `objects` placed in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index into the slice of objects.
    pub object: u32,
    /// Where the object's points go in the world. Must be invertible, else the instance is dropped.
    pub world_from_object: Affine3A,
}

/// An instance as traversal needs it.
#[derive(Clone, Copy)]
pub(super) struct Placed {
    pub(super) object_from_world: Affine3A,
    /// The node at which the object's hierarchy starts.
    pub(super) root: u32,
    /// Index into the caller's slice of instances.
    pub(super) id: u32,
}

impl Placed {
    /// The ray in the object's space, with unchanged parameters as the direction is not renormalised.
    pub(super) fn localise(&self, ray: &Ray) -> Ray {
        Ray {
            o: self.object_from_world.transform_point3(ray.o),
            d: self.object_from_world.transform_vector3(ray.d),
            ..*ray
        }
    }
}

/// The inverse, if the map can be inverted in f32.
pub(super) fn invert(map: &Affine3A) -> Option<Affine3A> {
    let det = map.matrix3.determinant();
    if !map.is_finite() || det == 0.0 || !det.is_finite() {
        return None;
    }
    let inverse = map.inverse();
    inverse.is_finite().then_some(inverse)
}
