//! The principled material, put together from others.
use super::{MaterialId, SceneBuilder, TextureId};
use crate::{
    bsdf::{
        DielectricMaterial, Material, MixMaterial, PrincipledMaterial, RoughDielectricMaterial, Roughness, Scalar,
        ThinDielectricMaterial,
    },
    spectrum::{Ior, Rgb},
    texture::{Mix, Product, Texture},
};

/// The clear part of a principled material.
#[derive(Clone, Copy, Debug)]
pub struct Transmission {
    /// Share in [0, 1] of the non-metal that is clear instead of matt.
    pub amount: Scalar,
    /// What tints each passage through the surface, in [0, 1].
    pub color: TextureId,
    /// Index of refraction over that of the surroundings.
    pub ior: Ior,
    /// A sheet without inside, which bends no light and does not blur what is seen through it.
    pub thin: bool,
}

impl SceneBuilder {
    /// Adds `opaque`, of which the share `transmission` lets light through: a mix with glass of the same roughness. Coat and
    /// sheen lie on the opaque part alone.
    pub fn principled(&mut self, opaque: PrincipledMaterial, transmission: Option<Transmission>) -> MaterialId {
        let Some(t) = transmission.filter(|t| t.amount != 0.0.into()) else { return self.material(opaque) };
        let reflectance = self.constant(Rgb::ONE);
        let clear: Material = if t.thin {
            ThinDielectricMaterial { eta: t.ior, reflectance, transmittance: t.color }.into()
        } else {
            let glass = DielectricMaterial { eta: t.ior, reflectance, transmittance: t.color };
            let Roughness { u, v, .. } = opaque.roughness;
            let squared =
                if u == v { self.squared(u).into() } else { Roughness::aligned(self.squared(u), self.squared(v)) };
            RoughDielectricMaterial { glass, alpha: squared }.into()
        };
        let of = [self.material(opaque), self.material(clear)];
        let amount = self.without(t.amount, opaque.metallic);
        self.material(MixMaterial { of, amount })
    }
    /// A scalar as a texture.
    fn shown(&mut self, s: Scalar) -> TextureId {
        match s {
            Scalar::Texture(id) => id,
            Scalar::Constant(v) => self.constant(Rgb::splat(v)),
        }
    }
    fn squared(&mut self, s: Scalar) -> Scalar {
        match s {
            Scalar::Constant(v) => (v * v).into(),
            Scalar::Texture(id) => self.texture(Texture::Product(Product { of: [id, id] })).into(),
        }
    }
    /// `a (1 − b)`.
    fn without(&mut self, a: Scalar, b: Scalar) -> Scalar {
        if let (Scalar::Constant(a), Scalar::Constant(b)) = (a, b) {
            return (a * (1.0 - b)).into();
        }
        let (from, amount, to) = (self.shown(a), self.shown(b), self.constant(Rgb::ZERO));
        self.texture(Texture::Mix(Mix { from, to, amount })).into()
    }
}
