//! Colours over surfaces: from a place on a surface to a colour.
//!
//! Textures may be made of others, which come before them in the scene's table. To add one: write `texture/<name>.rs` and
//! one variant of [`Texture`].
mod checks;
mod compose;
mod image;
mod noise;

pub use checks::{Checkerboard, Dots};
pub use compose::{Mapped, Mix, Product, UvMap};
pub use image::{ImageTexture, Wrap};
pub use noise::{Noise, NoiseKind};

use crate::spectrum::{Colour, Spectrum, Wavelengths};
use glam::{Vec2, Vec3};

/// Handle of a texture of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextureId(pub u32);

/// What a texture, or a material that uses it, may look at.
#[derive(Clone, Copy)]
pub struct Lookup<'s> {
    /// All textures of the scene.
    pub textures: &'s [Texture],
    /// Texture coordinates of the hit.
    pub uv: Vec2,
    /// The hit in world space.
    pub p: Vec3,
    /// What the lanes mean in this pass.
    pub lambda: Wavelengths,
}

impl Lookup<'_> {
    /// The colour of texture `id` here, at the wavelengths of the pass.
    #[inline]
    pub fn spectrum(&self, id: TextureId) -> Spectrum {
        self.textures[id.0 as usize].spectrum(self)
    }
}

/// One of the models of this room.
#[derive(Clone, Debug)]
pub enum Texture {
    /// The same colour everywhere, by RGB or by a measured spectrum.
    Constant(Colour),
    /// A picture.
    Image(ImageTexture),
    /// Another texture at other coordinates.
    Mapped(Mapped),
    /// One texture times another.
    Product(Product),
    /// Between two textures.
    Mix(Mix),
    /// Two textures in turn.
    Checkerboard(Checkerboard),
    /// One texture in dots on another.
    Dots(Dots),
    /// A solid pattern of noise.
    Noise(Noise),
}

impl Texture {
    /// The values at a place.
    #[inline]
    pub fn spectrum(&self, at: &Lookup) -> Spectrum {
        match self {
            Self::Constant(c) => c.at(at.lambda),
            Self::Image(i) => Spectrum::reflectance(i.eval(at.uv), at.lambda),
            Self::Mapped(t) => t.spectrum(at),
            Self::Product(t) => t.spectrum(at),
            Self::Mix(t) => t.spectrum(at),
            Self::Checkerboard(t) => t.spectrum(at),
            Self::Dots(t) => t.spectrum(at),
            Self::Noise(t) => t.spectrum(at),
        }
    }
    /// The textures it is made of.
    pub fn parts(&self) -> Vec<TextureId> {
        match self {
            Self::Constant(_) | Self::Image(_) | Self::Noise(_) => Vec::new(),
            Self::Mapped(t) => vec![t.of],
            Self::Product(t) => t.of.to_vec(),
            Self::Mix(t) => vec![t.from, t.to, t.amount],
            Self::Checkerboard(t) => t.of.to_vec(),
            Self::Dots(t) => vec![t.inside, t.outside],
        }
    }
}
