//! The common extension of MTL for physically based materials, as the principled model.

use super::MtlMaterial;
use super::appearance::{Appearances, Place, Role};
use crate::load::Target;
use glam::Vec3;
use std::f32::consts::TAU;
use sunfleck::bsdf::{PrincipledMaterial, Roughness, Scalar, TurnedMaterial};
use sunfleck::scene::{MaterialId, TextureId};
use sunfleck::texture::{Product, Texture};

impl MtlMaterial {
    /// Whether it says something of the extension.
    pub(super) fn is_physical(&self) -> bool {
        let numbers = [self.roughness, self.metallic, self.coat, self.coat_roughness, self.sheen, self.anisotropy];
        let pictures = [&self.roughness_map, &self.metallic_map, &self.sheen_map];
        numbers.iter().any(Option::is_some) || pictures.iter().any(|p| p.is_some())
    }
}

impl Appearances<'_> {
    /// The principled material of `base`: half rough and no metal unless the file says so.
    pub(super) fn physical(
        &mut self,
        mtl: &MtlMaterial,
        base: TextureId,
        place: Place,
        target: &mut Target,
    ) -> PrincipledMaterial {
        let metallic = self.unit(mtl.metallic_map.as_ref(), mtl.metallic, 0.0, place, target);
        let roughness = self.unit(mtl.roughness_map.as_ref(), mtl.roughness, 0.5, place, target);
        let number = |value: Option<f32>| Scalar::Constant(value.unwrap_or(0.0).clamp(0.0, 1.0));
        let sheen = match self.unit(mtl.sheen_map.as_ref(), mtl.sheen, 0.0, place, target) {
            Scalar::Texture(id) => Some(id),
            Scalar::Constant(sheen) => (sheen > 0.0).then(|| target.builder().constant(Vec3::splat(sheen))),
        };
        PrincipledMaterial {
            metallic,
            roughness: brushed(roughness, mtl.anisotropy.unwrap_or(0.0), target),
            ior: mtl.ior.filter(|n| *n > 1.0 && *n < 4.0).unwrap_or(1.5).into(),
            coat: number(mtl.coat),
            coat_roughness: number(mtl.coat_roughness),
            sheen,
            ..PrincipledMaterial::new(base)
        }
    }

    /// `of`, brushed at the angle that `anisor` gives in turns.
    pub(super) fn turned(mtl: &MtlMaterial, of: MaterialId, target: &mut Target) -> MaterialId {
        let turns = mtl.anisotropy_rotation.filter(|_| mtl.anisotropy.is_some_and(|a| a != 0.0)).unwrap_or(0.0);
        if turns == 0.0 {
            return of;
        }
        target.builder().material(TurnedMaterial { of, angle: turns.fract() * TAU, direction: None })
    }

    /// A picture times `factor`, or without one that number, or `default`.
    fn unit(
        &mut self,
        file: Option<&String>,
        factor: Option<f32>,
        default: f32,
        place: Place,
        target: &mut Target,
    ) -> Scalar {
        let picture = file.and_then(|name| self.picture(name, Vec3::ONE, Role::Data, place, target));
        match picture {
            Some(picture) => scaled(picture.id.into(), factor.unwrap_or(1.0).clamp(0.0, 1.0), target),
            None => factor.unwrap_or(default).clamp(0.0, 1.0).into(),
        }
    }
}

fn scaled(s: Scalar, factor: f32, target: &mut Target) -> Scalar {
    match s {
        _ if factor == 1.0 => s,
        Scalar::Constant(value) => (value * factor).into(),
        Scalar::Texture(id) => {
            let factor = target.builder().constant(Vec3::splat(factor));
            target.builder().texture(Texture::Product(Product { of: [id, factor] })).into()
        }
    }
}

/// Rougher along and smoother across, by `amount` in [0, 1]: the slopes' ratio is 1 − 0.9 · amount (Burley 2012, "Physically
/// Based Shading at Disney", section 5.4), and slopes are squares of perceived roughness.
fn brushed(roughness: Scalar, amount: f32, target: &mut Target) -> Roughness {
    if amount == 0.0 || !amount.is_finite() {
        return roughness.into();
    }
    let quarter = (1.0 - 0.9 * amount.clamp(0.0, 1.0)).powf(0.25);
    Roughness::aligned(scaled(roughness, 1.0 / quarter, target), scaled(roughness, quarter, target))
}
