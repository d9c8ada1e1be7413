//! Colours over surfaces: from texture coordinates to a colour.
//!
//! To add one: write `texture/<name>.rs` and one variant of [`Texture`].
mod image;

pub use image::{ImageTexture, Wrap};

use crate::spectrum::Rgb;
use glam::Vec2;

/// One of the models of this room.
#[derive(Clone, Debug)]
pub enum Texture {
    /// The same colour everywhere.
    Constant(Rgb),
    /// A picture.
    Image(ImageTexture),
}

impl Texture {
    /// The colour at `uv`.
    #[inline]
    pub fn eval(&self, uv: Vec2) -> Rgb {
        match self {
            Self::Constant(c) => *c,
            Self::Image(i) => i.eval(uv),
        }
    }
    /// The mean colour over the unit square: what a light or a summary needs to know.
    pub fn mean(&self) -> Rgb {
        match self {
            Self::Constant(c) => *c,
            Self::Image(i) => i.mean(),
        }
    }
}
