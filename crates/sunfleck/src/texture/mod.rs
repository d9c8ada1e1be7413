//! Colours over surfaces: from texture coordinates to a colour.
//!
//! To add one: write `texture/<name>.rs` and one variant of [`Texture`].
mod image;

pub use image::{ImageTexture, Wrap};

use crate::spectrum::{Colour, Rgb, Spectrum, Wavelengths};
use glam::Vec2;

/// One of the models of this room.
#[derive(Clone, Debug)]
pub enum Texture {
    /// The same colour everywhere, by RGB or by a measured spectrum.
    Constant(Colour),
    /// A picture.
    Image(ImageTexture),
}

impl Texture {
    /// The values at `uv` at the wavelengths `lambda`.
    #[inline]
    pub fn spectrum(&self, uv: Vec2, lambda: Wavelengths) -> Spectrum {
        match self {
            Self::Constant(c) => c.at(lambda),
            Self::Image(i) => Spectrum::reflectance(i.eval(uv), lambda),
        }
    }
    /// The mean colour over the unit square: what a light or a summary needs to know.
    pub fn mean(&self) -> Rgb {
        match self {
            Self::Constant(c) => c.rgb(),
            Self::Image(i) => i.mean(),
        }
    }
}
