//! `KHR_materials_anisotropy`: brushed metal.

use super::super::document::Fields;
use super::Importer;
use super::textures::Role;
use glam::Vec3;
use serde_json::Value;
use sunfleck::bsdf::{Roughness, Scalar, TurnedMaterial};
use sunfleck::scene::{MaterialId, TextureId};
use sunfleck::texture::{ImageTexture, Texture, Wrap};

/// Perceived roughness along the brushing, from that across and the strength: alpha, its square, goes to 1 by the square of
/// the strength (the extension's appendix).
fn along(across: f32, strength: f32) -> f32 {
    let alpha = across * across;
    (alpha + (1.0 - alpha) * strength * strength).sqrt()
}

impl Importer<'_> {
    /// Roughness along and across, `rough` being that without brushing.
    pub(super) fn brushed(&mut self, json: &Value, rough: Scalar, name: &str) -> Roughness {
        let Some(brush) = json.extension("KHR_materials_anisotropy") else { return rough.into() };
        let factor = brush.number("anisotropyStrength", 0.0).clamp(0.0, 1.0);
        let info = brush.field("anisotropyTexture");
        let picture = self.texture(info, Role::Data);
        let u = match (rough, picture) {
            (Scalar::Constant(across), None) => Some(Scalar::Constant(along(across, factor))),
            (Scalar::Constant(across), Some(_)) => self.each_pixel(info, |p| along(across, p.z * factor)),
            (Scalar::Texture(_), picture) => {
                if picture.is_some() {
                    self.note(
                        "gltf::anisotropy",
                        name,
                        "where roughness is a picture too, its strength is the same all over",
                    );
                }
                let strength = factor * picture.map_or(1.0, |p| p.mean.z);
                let pbr = json.field("pbrMetallicRoughness");
                let most = pbr.number("roughnessFactor", 1.0).clamp(0.0, 1.0);
                self.each_pixel(pbr.field("metallicRoughnessTexture"), |p| along(p.y * most, strength))
            }
        };
        u.map_or(rough.into(), |u| Roughness::aligned(u, rough))
    }

    /// `of`, brushed in the direction that the extension gives.
    pub(super) fn turned(&mut self, json: &Value, of: MaterialId) -> MaterialId {
        let Some(brush) = json.extension("KHR_materials_anisotropy") else { return of };
        let angle = brush.number("anisotropyRotation", 0.0);
        let direction = self.texture(brush.field("anisotropyTexture"), Role::Data).map(|p| p.id);
        if brush.number("anisotropyStrength", 0.0) <= 0.0 || angle == 0.0 && direction.is_none() {
            return of;
        }
        self.target.builder().material(TurnedMaterial { of, angle, direction })
    }

    /// A picture of numbers made of another one, at the same coordinates.
    fn each_pixel(&mut self, info: &Value, value: impl Fn(Vec3) -> f32) -> Option<Scalar> {
        let (image, map, set) = self.lying(info, Role::Data)?;
        let (w, h) = (image.width(), image.height());
        let pixels = (0..w * h).map(|i| Vec3::splat(value(image.pixel(i % w, i / w)))).collect();
        let [across, down] = image.wrap();
        let made = ImageTexture::new(w, h, pixels, Wrap::Repeat)?.with_wrap(across, down);
        let id: TextureId = self.target.builder().texture(Texture::Image(made));
        Some(self.mapped(id, map, set).into())
    }
}
