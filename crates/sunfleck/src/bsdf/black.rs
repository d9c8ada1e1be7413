//! A surface that swallows all light.
use super::{BsdfSample, Lookup, Model, Scatter, TextureId, Transport};
use crate::math::Local;
use glam::Vec2;

/// The body of a light, or a beam stop.
#[derive(Clone, Copy, Debug)]
pub struct BlackMaterial;

impl Model for BlackMaterial {
    type Closure = Black;
    const NAME: &'static str = "black";
    const ABOUT: &'static str = "absorbs all light; for the bodies of lamps, which only emit";
    #[inline]
    fn resolve(&self, _: &Lookup) -> Black {
        Black
    }
    fn textures(&self) -> Vec<TextureId> {
        Vec::new()
    }
    fn is_matt(&self) -> bool {
        true
    }
}

/// Scatters nothing: every path ends here.
#[derive(Clone, Copy, Debug)]
pub struct Black;

impl Scatter for Black {
    #[inline]
    fn sample(&self, _: Local, _: f32, _: Vec2, _: Transport) -> Option<BsdfSample> {
        None
    }
}
