//! Colours over surfaces: from a place on a surface to a colour.
//!
//! Textures may be made of others, which come before them in the scene's table. To add one: write `texture/<name>.rs` and
//! one variant of [`Texture`].
mod checks;
mod compose;
mod footprint;
mod image;
mod noise;
mod pixels;
mod pyramid;
mod value;

pub use checks::{Checkerboard, Dots};
pub use compose::{Channel, Mapped, Mix, Product, Threshold, UvMap, UvSet, VertexColour};
pub use footprint::{Cone, Footprint};
pub use image::{ImageTexture, Wrap};
pub use noise::{Noise, NoiseKind};
pub use value::Scalar;

use crate::spectrum::{Colour, Rgb, Spectrum, Wavelengths};
use glam::{Vec2, Vec3, Vec4};
use value::Value;

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
    /// What else the surface knows here.
    pub attributes: VertexAttributes,
    /// How much of the surface colours are the mean of.
    pub footprint: Footprint,
}

/// What a mesh may know at its vertices, interpolated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexAttributes {
    /// Second set of texture coordinates.
    pub uv2: Vec2,
    /// Colour (linear sRGB) and opacity.
    pub colour: Vec4,
}

impl Default for VertexAttributes {
    fn default() -> Self {
        Self { uv2: Vec2::ZERO, colour: Vec4::ONE }
    }
}

impl<'s> Lookup<'s> {
    /// At texture coordinates `uv` and at the point `p` of a surface that knows nothing else.
    pub fn new(textures: &'s [Texture], uv: Vec2, p: Vec3, lambda: Wavelengths) -> Self {
        let (attributes, footprint) = (VertexAttributes::default(), Footprint::POINT);
        Self { textures, uv, p, lambda, attributes, footprint }
    }
}

impl Lookup<'_> {
    /// The colour of texture `id` here, at the wavelengths of the pass: the mean over the footprint.
    #[inline]
    pub fn spectrum(&self, id: TextureId) -> Spectrum {
        self.value(id)
    }
    /// The numbers of texture `id` here, as the scene gives them: for what is no colour of light. Of the very point, whatever
    /// the footprint is: what a surface of the mean roughness does is not the mean of what it does, nor with normals or heights.
    #[inline]
    pub fn rgb(&self, id: TextureId) -> Rgb {
        self.of_point(id)
    }
    /// As [`Lookup::spectrum`], of the very point: for what light is not in proportion to.
    #[inline]
    pub fn spectrum_of_point(&self, id: TextureId) -> Spectrum {
        self.of_point(id)
    }
    #[inline]
    fn of_point<V: Value>(&self, id: TextureId) -> V {
        if self.footprint.is_point() { self.value(id) } else { Self { footprint: Footprint::POINT, ..*self }.value(id) }
    }
    /// The same place for looking at several textures whose values are multiplied: a point if more than one of them varies, as
    /// the mean of a product is no product of means.
    #[inline]
    fn for_product(&self, of: &[TextureId]) -> Self {
        let is_even = |id: &TextureId| matches!(self.textures[id.0 as usize], Texture::Constant(_));
        if of.iter().filter(|id| !is_even(id)).count() > 1 {
            Self { footprint: Footprint::POINT, ..*self }
        } else {
            *self
        }
    }
    /// The number `s` here.
    #[inline]
    pub fn scalar(&self, s: Scalar) -> f32 {
        match s {
            Scalar::Constant(v) => v,
            Scalar::Texture(id) => self.rgb(id).x,
        }
    }
    #[inline]
    fn value<V: Value>(&self, id: TextureId) -> V {
        self.textures[id.0 as usize].value(self)
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
    /// One channel of another.
    Channel(Channel),
    /// A stencil made of another.
    Threshold(Threshold),
    /// Colour or opacity of a mesh's vertices.
    Vertex(VertexColour),
}

impl Texture {
    /// The values at a place.
    #[inline]
    fn value<V: Value>(&self, at: &Lookup) -> V {
        match self {
            Self::Constant(c) => V::colour(c, at.lambda),
            Self::Image(i) => V::pixel(i.filtered(at.uv, &at.footprint), at.lambda),
            Self::Mapped(t) => t.value(at),
            Self::Product(t) => t.value(at),
            Self::Mix(t) => t.value(at),
            Self::Checkerboard(t) => t.value(at),
            Self::Dots(t) => t.value(at),
            Self::Noise(t) => t.value(at),
            Self::Channel(t) => t.value(at),
            Self::Threshold(t) => t.value(at),
            Self::Vertex(t) => t.value(at),
        }
    }
    /// Whether it looks itself at what only a mesh's vertices know: see [`VertexAttributes`].
    pub(crate) fn asks_vertices(&self) -> bool {
        matches!(self, Self::Vertex(_) | Self::Mapped(Mapped { set: UvSet::Second, .. }))
    }
    /// Whether its mean over a footprint is more than its value at a point, if one that it is made of has such means.
    pub(crate) fn has_means(&self) -> bool {
        matches!(self, Self::Image(_) | Self::Checkerboard(_))
    }
    /// The textures it is made of.
    pub fn parts(&self) -> Vec<TextureId> {
        match self {
            Self::Constant(_) | Self::Image(_) | Self::Noise(_) | Self::Vertex(_) => Vec::new(),
            Self::Mapped(t) => vec![t.of],
            Self::Product(t) => t.of.to_vec(),
            Self::Mix(t) => vec![t.from, t.to, t.amount],
            Self::Checkerboard(t) => t.of.to_vec(),
            Self::Dots(t) => vec![t.inside, t.outside],
            Self::Channel(t) => vec![t.of],
            Self::Threshold(t) => vec![t.of],
        }
    }
}
