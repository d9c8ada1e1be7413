//! Brushed metal whose brushing does not follow the texture coordinates.
use super::{MaterialId, Site};
use crate::{
    bsdf::{MaterialEntry, TextureId},
    math::Frame,
    shape::Tangents,
};
use glam::Vec2;

/// A material whose tangents are turned about the normal.
#[derive(Clone, Copy, Debug)]
pub struct TurnedMaterial {
    /// The material.
    pub of: MaterialId,
    /// By how much, in radians from where u grows toward where v grows.
    pub angle: f32,
    /// Besides, a picture of directions, (2r − 1, 2g − 1) along the growth of u and of v; a picture of numbers.
    pub direction: Option<TextureId>,
}

impl TurnedMaterial {
    pub(super) const ENTRY: MaterialEntry = MaterialEntry {
        name: "turned",
        about: "another material, brushed at an `angle` to the texture coordinates, or where a picture `direction` points",
    };

    /// Unit tangents at a right angle, the first one where roughness is told along.
    pub(super) fn tangents(&self, site: &Site) -> Tangents {
        let (frame, side) = match site.tangents {
            Some([u, v]) => {
                let frame = Frame::along(site.n, u);
                (frame, 1f32.copysign(frame.t.dot(v)))
            }
            None => (Frame::from_normal(site.n), 1.0),
        };
        let drawn = self.direction.and_then(|id| (2.0 * site.at.rgb(id).truncate() - 1.0).try_normalize());
        let d = drawn.unwrap_or(Vec2::X).rotate(Vec2::from_angle(self.angle));
        let t = side * frame.t;
        [d.x * frame.s + d.y * t, d.x * t - d.y * frame.s]
    }
}
