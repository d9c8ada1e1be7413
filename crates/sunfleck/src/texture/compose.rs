//! Textures made of other textures.
use super::{Lookup, TextureId};
use crate::spectrum::Spectrum;
use glam::Vec2;

/// From texture coordinates to others: `uv · scale + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvMap {
    /// Repetitions across and up.
    pub scale: Vec2,
    /// Shift after scaling.
    pub offset: Vec2,
}

impl Default for UvMap {
    fn default() -> Self {
        Self { scale: Vec2::ONE, offset: Vec2::ZERO }
    }
}

impl UvMap {
    /// The new coordinates.
    #[inline]
    pub fn at(&self, uv: Vec2) -> Vec2 {
        uv * self.scale + self.offset
    }
}

/// A texture at other coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Mapped {
    /// The texture.
    pub of: TextureId,
    /// Its coordinates from those of the surface.
    pub map: UvMap,
}

impl Mapped {
    pub(super) fn spectrum(&self, at: &Lookup) -> Spectrum {
        Lookup { uv: self.map.at(at.uv), ..*at }.spectrum(self.of)
    }
}

/// One texture times another, by wavelength.
#[derive(Clone, Copy, Debug)]
pub struct Product {
    /// Both.
    pub of: [TextureId; 2],
}

impl Product {
    pub(super) fn spectrum(self, at: &Lookup) -> Spectrum {
        at.spectrum(self.of[0]) * at.spectrum(self.of[1])
    }
}

/// Between two textures.
#[derive(Clone, Copy, Debug)]
pub struct Mix {
    /// Where `amount` is 0.
    pub from: TextureId,
    /// Where `amount` is 1.
    pub to: TextureId,
    /// The share of `to` in [0, 1].
    pub amount: TextureId,
}

impl Mix {
    pub(super) fn spectrum(&self, at: &Lookup) -> Spectrum {
        let share = at.spectrum(self.amount);
        at.spectrum(self.from) * (Spectrum::ONE - share) + at.spectrum(self.to) * share
    }
}
