//! Textures made of other textures.
use super::{Footprint, Lookup, TextureId, Value};
use crate::spectrum::Rgb;
use glam::{Affine2, Vec2};

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

impl From<UvMap> for Affine2 {
    fn from(m: UvMap) -> Self {
        Self::from_scale_angle_translation(m.scale, 0.0, m.offset)
    }
}

/// Which of a surface's texture coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum UvSet {
    /// Those of the hit, or what an outer [`Mapped`] made of them.
    #[default]
    First,
    /// The second set of a mesh, see [`crate::shape::Attributes`]; (0, 0) where there is none.
    Second,
}

/// A texture at other coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Mapped {
    /// The texture.
    pub of: TextureId,
    /// Its coordinates from those of the surface: scaling, turning, shearing and shifting.
    pub map: Affine2,
    /// Which coordinates those are.
    pub set: UvSet,
}

impl Mapped {
    pub(super) fn value<V: Value>(&self, at: &Lookup) -> V {
        let (uv, footprint) = match self.set {
            UvSet::First => (at.uv, at.footprint),
            UvSet::Second => (at.attributes.uv2, Footprint::POINT),
        };
        let footprint = if footprint.is_point() { footprint } else { footprint.mapped(self.map.matrix2) };
        Lookup { uv: self.map.transform_point2(uv), footprint, ..*at }.value(self.of)
    }
}

/// One texture times another, by wavelength.
#[derive(Clone, Copy, Debug)]
pub struct Product {
    /// Both.
    pub of: [TextureId; 2],
}

impl Product {
    pub(super) fn value<V: Value>(self, at: &Lookup) -> V {
        let at = at.for_product(&self.of);
        at.value::<V>(self.of[0]) * at.value(self.of[1])
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
    pub(super) fn value<V: Value>(&self, at: &Lookup) -> V {
        let at = at.for_product(&[self.amount, self.from]).for_product(&[self.amount, self.to]);
        let share: V = at.value(self.amount);
        at.value::<V>(self.from) * (V::ONE - share) + at.value::<V>(self.to) * share
    }
}

/// One channel of a texture as a grey: numbers that were packed side by side, as glTF's roughness and metalness.
#[derive(Clone, Copy, Debug)]
pub struct Channel {
    /// The texture.
    pub of: TextureId,
    /// 0 red, 1 green, 2 blue.
    pub channel: u8,
}

impl Channel {
    pub(super) fn value<V: Value>(self, at: &Lookup) -> V {
        V::pixel(Rgb::splat(at.rgb(self.of).to_array()[usize::from(self.channel.min(2))]), at.lambda)
    }
}

/// 1 where the red channel of a texture reaches `cutoff`, 0 elsewhere: a stencil.
#[derive(Clone, Copy, Debug)]
pub struct Threshold {
    /// The texture.
    pub of: TextureId,
    /// The least value that gives 1.
    pub cutoff: f32,
}

impl Threshold {
    pub(super) fn value<V: Value>(self, at: &Lookup) -> V {
        V::pixel(Rgb::splat(f32::from(at.rgb(self.of).x >= self.cutoff)), at.lambda)
    }
}

/// What a mesh knows at its vertices, see [`crate::shape::Attributes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexColour {
    /// The colour, linear sRGB; white where there is none.
    Rgb,
    /// The opacity as a grey; 1 where there is none.
    Alpha,
}

impl VertexColour {
    pub(super) fn value<V: Value>(self, at: &Lookup) -> V {
        let colour = at.attributes.colour;
        V::pixel(if self == Self::Rgb { colour.truncate() } else { Rgb::splat(colour.w) }, at.lambda)
    }
}
