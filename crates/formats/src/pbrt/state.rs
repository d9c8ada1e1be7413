//! What `AttributeBegin` saves and `AttributeEnd` brings back.

use super::media::Interface;
use super::params::{Param, Params};
use glam::{DAffine3, DMat3, DMat4, DVec3};
use std::collections::HashMap;
use std::rc::Rc;
use sunfleck::scene::MaterialId;

/// What covers a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cover {
    Material(MaterialId),
    /// A boundary between media only: nothing to see.
    Nothing,
}

/// The graphics state.
#[derive(Clone)]
pub(super) struct Attributes {
    /// The current transformation, object to world, when the shutter opens and when it closes.
    pub(super) ctm: [DAffine3; 2],
    /// Which of the two is being changed.
    pub(super) active: [bool; 2],
    /// `None` is the default material.
    pub(super) cover: Option<Cover>,
    /// What lies inside of shapes and around them.
    pub(super) interface: Interface,
    pub(super) area_light: Option<Rc<Params>>,
    pub(super) reverse: bool,
    /// Parameters that `Attribute` gives to all directives of a kind.
    pub(super) defaults: Rc<HashMap<String, Vec<Param>>>,
}

impl Default for Attributes {
    fn default() -> Self {
        Self {
            ctm: [DAffine3::IDENTITY; 2],
            active: [true; 2],
            cover: None,
            interface: [None, None],
            area_light: None,
            reverse: false,
            defaults: Rc::default(),
        }
    }
}

impl Attributes {
    /// Object to world when the shutter opens.
    pub(super) fn world_from_object(&self) -> DAffine3 {
        self.ctm[0]
    }
    /// Whether the two transformations differ.
    pub(super) fn moves(&self) -> bool {
        self.ctm[0] != self.ctm[1]
    }
    /// Multiplies the active transformations from the right: the new one comes first.
    pub(super) fn concat(&mut self, m: DAffine3) {
        self.change(|ctm| ctm * m);
    }
    pub(super) fn change(&mut self, f: impl Fn(DAffine3) -> DAffine3) {
        for (ctm, active) in self.ctm.iter_mut().zip(self.active) {
            if active {
                *ctm = f(*ctm);
            }
        }
    }
}

/// The 16 numbers of `Transform` stand column by column. `None` if the last row is not 0 0 0 1.
pub(super) fn matrix(numbers: &[f64; 16]) -> Option<DAffine3> {
    let m = DMat4::from_cols_array(numbers);
    let w = m.row(3);
    let last = w.w;
    let affine = w.truncate().abs().max_element() <= 1e-9 * last.abs() && last != 0.0;
    affine.then(|| DAffine3::from_mat4(m * (1.0 / last)))
}

/// Camera from world, left-handed: x to the right, y up, z into the picture. `None` for coinciding points.
pub(super) fn look_at(eye: DVec3, target: DVec3, up: DVec3) -> Option<DAffine3> {
    let forward = (target - eye).try_normalize()?;
    let right = up.cross(forward).try_normalize()?;
    let world_from_camera =
        DAffine3::from_mat3_translation(DMat3::from_cols(right, forward.cross(right), forward), eye);
    Some(world_from_camera.inverse())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_are_listed_by_columns() {
        let mut numbers = DMat4::IDENTITY.to_cols_array();
        numbers[12..15].copy_from_slice(&[1.0, 2.0, 3.0]);
        let m = matrix(&numbers).unwrap();
        assert_eq!(m.transform_point3(DVec3::ZERO), DVec3::new(1.0, 2.0, 3.0));
        numbers[3] = 0.5;
        assert!(matrix(&numbers).is_none());
    }

    #[test]
    fn a_camera_that_looks_along_z_has_x_at_its_right() {
        let camera_from_world = look_at(DVec3::new(0.0, 0.0, -5.0), DVec3::ZERO, DVec3::Y).unwrap();
        let p = camera_from_world.transform_point3(DVec3::new(1.0, 2.0, 3.0));
        assert!((p - DVec3::new(1.0, 2.0, 8.0)).length() < 1e-12);
        assert!(look_at(DVec3::ZERO, DVec3::ZERO, DVec3::Y).is_none());
    }

    #[test]
    fn the_last_transformation_said_is_the_first_applied() {
        let mut a = Attributes::default();
        a.concat(DAffine3::from_translation(DVec3::X));
        a.concat(DAffine3::from_scale(DVec3::splat(2.0)));
        assert_eq!(a.world_from_object().transform_point3(DVec3::ONE), DVec3::new(3.0, 2.0, 2.0));
        a.active = [false, true];
        a.concat(DAffine3::from_translation(DVec3::X));
        assert!(a.moves());
    }
}
