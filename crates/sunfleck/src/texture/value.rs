//! What textures are made of: colours for light, or plain numbers.
use super::TextureId;
use crate::spectrum::{Colour, Rgb, Spectrum, Wavelengths};
use std::ops::{Add, Mul, Sub};

/// The value of a texture: at the wavelengths of a pass, or as the numbers that the scene gives.
pub(super) trait Value: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// One in every channel.
    const ONE: Self;
    /// Of a colour that is the same everywhere.
    fn colour(colour: &Colour, lambda: Wavelengths) -> Self;
    /// Of a pixel.
    fn pixel(rgb: Rgb, lambda: Wavelengths) -> Self;
}

impl Value for Spectrum {
    const ONE: Self = Self::ONE;
    #[inline]
    fn colour(colour: &Colour, lambda: Wavelengths) -> Self {
        colour.at(lambda)
    }
    #[inline]
    fn pixel(rgb: Rgb, lambda: Wavelengths) -> Self {
        Self::reflectance(rgb, lambda)
    }
}

impl Value for Rgb {
    const ONE: Self = Self::ONE;
    #[inline]
    fn colour(colour: &Colour, _: Wavelengths) -> Self {
        colour.rgb()
    }
    #[inline]
    fn pixel(rgb: Rgb, _: Wavelengths) -> Self {
        rgb
    }
}

/// A number over a surface: the same everywhere, or the red channel of a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    /// Everywhere.
    Constant(f32),
    /// Red channel; grey pictures have it in all three.
    Texture(TextureId),
}

impl From<f32> for Scalar {
    fn from(v: f32) -> Self {
        Self::Constant(v)
    }
}

impl From<TextureId> for Scalar {
    fn from(id: TextureId) -> Self {
        Self::Texture(id)
    }
}

impl Scalar {
    /// The texture, if there is one.
    pub fn texture(self) -> Option<TextureId> {
        match self {
            Self::Constant(_) => None,
            Self::Texture(id) => Some(id),
        }
    }
}
