//! Hits kept for later.
use super::{Interaction, MaterialId, world::Even};
use crate::{math::Frame, medium::Medium};
use glam::{Vec2, Vec3};

/// A hit in 64 bytes, of which [`super::World::recall`] makes an [`Interaction`] again where [`super::World::can_recall`]
/// says so.
#[derive(Clone, Copy, Debug)]
pub struct Record {
    /// Position.
    pub p: Vec3,
    ng: Vec3,
    n: Vec3,
    wo: Vec3,
    pub(super) uv: Vec2,
    /// The same for each coordinate, such that rays start as far off the surface as they did.
    p_error: f32,
    pub(super) material: MaterialId,
}

impl Record {
    /// What can be asked at `at`, except for its light and the distance to it.
    #[inline]
    pub fn new(at: &Interaction) -> Self {
        let across = at.ng.abs();
        let p_error = at.p_error.dot(across) / across.element_sum();
        Self { p: at.p, ng: at.ng, n: at.frame.n, wo: at.wo, uv: at.uv, p_error, material: at.material }
    }
    /// The hit with its scattering. It has no light, a distance of 0, and empty space on both sides.
    #[inline]
    pub(super) fn with(&self, even: &Even) -> Interaction {
        Interaction {
            p: self.p,
            p_error: Vec3::splat(self.p_error),
            ng: self.ng,
            frame: Frame::from_normal(self.n),
            wo: self.wo,
            distance: 0.0,
            uv: self.uv,
            bsdf: even.bsdf,
            material: self.material,
            widest: even.widest,
            curved: self.n != self.ng,
            light: None,
            near: Medium::VACUUM,
            far: Medium::VACUUM,
        }
    }
    /// Whether light that goes from here in direction `d` leaves on one side by both normals: elsewhere none does.
    #[inline]
    pub fn sides_agree(&self, d: Vec3) -> bool {
        self.ng.dot(d) * self.n.dot(d) > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_are_small() {
        assert_eq!(size_of::<Record>(), 64);
    }
}
