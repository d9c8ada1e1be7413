//! A perfect mirror of one colour at every angle.
use super::{BsdfSample, Lookup, Model, Scatter, TextureId, Transport};
use crate::{math::Local, spectrum::Spectrum};
use glam::Vec2;

/// An ideal mirror, two-sided.
#[derive(Clone, Copy, Debug)]
pub struct MirrorMaterial {
    /// Reflected fraction, in [0, 1], the same at all angles.
    pub reflect: TextureId,
}

impl Model for MirrorMaterial {
    type Closure = Mirror;
    const NAME: &'static str = "mirror";
    const ABOUT: &'static str = "ideal mirror, two-sided; `reflect` is its colour at every angle (no Fresnel)";
    #[inline]
    fn resolve(&self, at: &Lookup) -> Mirror {
        Mirror { reflect: at.spectrum(self.reflect) }
    }
    fn textures(&self) -> Vec<TextureId> {
        vec![self.reflect]
    }
}

/// Reflects into the mirror direction, whatever the angle.
#[derive(Clone, Copy, Debug)]
pub struct Mirror {
    /// Reflected fraction.
    pub reflect: Spectrum,
}

impl Scatter for Mirror {
    #[inline]
    fn sample(&self, wo: Local, _: f32, _: Vec2, _: Transport) -> Option<BsdfSample> {
        BsdfSample::specular(wo, self.reflect)
    }
}
