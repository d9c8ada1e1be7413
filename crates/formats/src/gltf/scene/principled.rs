//! The opaque part of materials, and the extensions that refine it.

use super::super::document::Fields;
use super::Importer;
use super::materials::ior;
use super::textures::Role;
use glam::Vec3;
use serde_json::Value;
use sunfleck::bsdf::{FilmMaterial, PrincipledMaterial, Scalar};
use sunfleck::scene::TextureId;
use sunfleck::texture::{Channel, Mix, Texture};

/// Reflectance along the normal at an index of 1.5.
const F0: f32 = 0.04;

impl Importer<'_> {
    /// Metallic-roughness with specular, clear coat, sheen and anisotropy.
    pub(super) fn principled(&mut self, json: &Value, base: TextureId, name: &str) -> PrincipledMaterial {
        let pbr = json.field("pbrMetallicRoughness");
        let unit = |object: &Value, key: &str, default: f32| object.number(key, default).clamp(0.0, 1.0);
        let packed = pbr.field("metallicRoughnessTexture");
        let rough = self.channel(packed, 1, unit(pbr, "roughnessFactor", 1.0));
        let mut model = PrincipledMaterial {
            metallic: self.channel(packed, 2, unit(pbr, "metallicFactor", 1.0)),
            roughness: self.brushed(json, rough, name),
            ior: ior(json).into(),
            ..PrincipledMaterial::new(base)
        };
        if let Some(specular) = json.extension("KHR_materials_specular") {
            model.specular = self.channel(specular.field("specularTexture"), 3, unit(specular, "specularFactor", 1.0));
            let factor = Vec3::from_array(specular.numbers("specularColorFactor", [1.0; 3])).max(Vec3::ZERO);
            let picture = self.texture(specular.field("specularColorTexture"), Role::Colour);
            model.specular_color = Some(self.tinted(picture, factor));
        }
        if let Some(coat) = json.extension("KHR_materials_clearcoat") {
            model.coat = self.channel(coat.field("clearcoatTexture"), 0, unit(coat, "clearcoatFactor", 0.0));
            let factor = unit(coat, "clearcoatRoughnessFactor", 0.0);
            model.coat_roughness = self.channel(coat.field("clearcoatRoughnessTexture"), 1, factor);
            if coat.get("clearcoatNormalTexture").is_some() {
                self.note("gltf::coat", name, "the normals of the clear coat are those of what lies below");
            }
        }
        if let Some(sheen) = json.extension("KHR_materials_sheen") {
            let factor = Vec3::from_array(sheen.numbers("sheenColorFactor", [0.0; 3])).clamp(Vec3::ZERO, Vec3::ONE);
            if factor != Vec3::ZERO {
                let picture = self.texture(sheen.field("sheenColorTexture"), Role::Colour);
                model.sheen = Some(self.tinted(picture, factor));
            }
            let factor = unit(sheen, "sheenRoughnessFactor", 0.0);
            model.sheen_roughness = self.channel(sheen.field("sheenRoughnessTexture"), 3, factor);
        }
        if let Some(film) = json.extension("KHR_materials_iridescence") {
            let share = self.channel(film.field("iridescenceTexture"), 0, unit(film, "iridescenceFactor", 0.0));
            if share != 0.0.into() {
                let thickness = self.thickness(film);
                model.film = Some(FilmMaterial { share, ior: film.number("iridescenceIor", 1.3), thickness });
            }
        }
        model
    }

    /// Of a thin film, nm: its most, or between its least and its most by a picture.
    fn thickness(&mut self, film: &Value) -> Scalar {
        let [least, most] = [("iridescenceThicknessMinimum", 100.0), ("iridescenceThicknessMaximum", 400.0)]
            .map(|(key, default)| film.number(key, default).max(0.0));
        let Some(picture) = self.texture(film.field("iridescenceThicknessTexture"), Role::Data) else {
            return most.into();
        };
        let builder = self.target.builder();
        let [from, to] = [least, most].map(|v| builder.constant(Vec3::splat(v)));
        let amount = builder.texture(Texture::Channel(Channel { of: picture.id, channel: 1 }));
        builder.texture(Texture::Mix(Mix { from, to, amount })).into()
    }

    /// The older model: matt colour, reflectance along the normal, and glossiness.
    pub(super) fn specular_glossiness(&mut self, old: &Value, base: TextureId) -> PrincipledMaterial {
        let info = old.field("specularGlossinessTexture");
        let factor = Vec3::from_array(old.numbers("specularFactor", [1.0; 3])).clamp(Vec3::ZERO, Vec3::ONE);
        let picture = self.texture(info, Role::Colour);
        let glossiness = old.number("glossinessFactor", 1.0).clamp(0.0, 1.0) * picture.map_or(1.0, |p| p.opacity);
        let color = self.tinted(picture, factor / F0);
        PrincipledMaterial {
            roughness: (1.0 - glossiness).into(),
            specular_color: Some(color),
            ..PrincipledMaterial::new(base)
        }
    }
}
