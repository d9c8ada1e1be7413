//! What a scene is made of, for those who write it down or look through it.
use super::{ObjectId, SurfaceDef};
use crate::{
    bsdf::Material,
    light::Light,
    medium::{Interior, InteriorId},
    texture::Texture,
};
use glam::Affine3A;

/// An object's placements as the shutter opens and as it closes.
#[derive(Clone, Copy, Debug)]
pub struct Instance {
    /// What is placed.
    pub object: ObjectId,
    /// World from object as the shutter opens.
    pub from: Affine3A,
    /// And as it closes, if the object moves.
    pub to: Option<Affine3A>,
}

/// All that was added to a [`super::SceneBuilder`], in the order of its handles.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'b> {
    /// By [`super::TextureId`].
    pub textures: &'b [Texture],
    /// By [`super::MaterialId`].
    pub materials: &'b [Material],
    /// By [`InteriorId`].
    pub interiors: &'b [Interior],
    /// What lies behind materials, by [`super::MaterialId`]; those beyond the end have none.
    pub fillings: &'b [Option<InteriorId>],
    /// Placed directly in the world.
    pub surfaces: &'b [SurfaceDef],
    /// By [`ObjectId`].
    pub objects: &'b [Vec<SurfaceDef>],
    /// Objects placed.
    pub instances: &'b [Instance],
    /// Lights that are no surfaces.
    pub lights: &'b [Light],
}
