//! How surfaces look: from materials of the file to the models of the renderer.

use super::super::document::Fields;
use super::Importer;
use super::emission::Glow;
use super::geometry::Geometry;
use super::textures::{Picture, Role};
use glam::{Vec3, Vec4};
use serde_json::Value;
use std::collections::HashMap;
use sunfleck::bsdf::{MaskMaterial, NormalMapMaterial, PrincipledMaterial};
use sunfleck::light::Sides;
use sunfleck::medium::Interior;
use sunfleck::scene::{MaterialId, SurfaceDef, TextureId, Transmission};
use sunfleck::spectrum::Ior;
use sunfleck::texture::{Channel, Product, Scalar, Texture, Threshold, VertexColour};

/// Materials that were made already, by index and whether the vertices have colours.
#[derive(Default)]
pub(super) struct Materials(HashMap<(Option<usize>, bool), MaterialId>);

/// Index of refraction, if nothing is said.
const IOR: f32 = 1.5;

/// A colour over a surface, and what there is of opacity.
struct Base {
    colour: TextureId,
    /// Opacity, but for `factor`.
    alpha: Option<TextureId>,
    factor: f32,
}

impl Importer<'_> {
    /// Adds a mesh with its material, and the light that it emits.
    pub(super) fn dress(&mut self, geometry: Geometry, material: Option<usize>, surfaces: &mut Vec<SurfaceDef>) {
        let id = self.material(material, !geometry.colours.is_empty());
        let json = material.and_then(|i| self.root.items("materials").get(i)).unwrap_or(&Value::Null);
        let (emission, sides) = (emission(json), if json.flag("doubleSided") { Sides::Two } else { Sides::One });
        let glow = if emission == Vec3::ZERO { None } else { self.colours(json.field("emissiveTexture")) };
        let pieces = match &glow {
            Some((picture, map, set)) => Glow { picture, map: *map, set: *set }.pieces(geometry),
            None => vec![(Vec3::ONE, geometry)],
        };
        for (filter, piece) in pieces {
            let radiance = emission * filter;
            let emission = (radiance != Vec3::ZERO).then(|| (radiance.into(), sides));
            let shape = piece.into_shape();
            surfaces.extend(shape.map(|shape| SurfaceDef { shape, material: id, emission }));
        }
    }

    fn material(&mut self, index: Option<usize>, has_colours: bool) -> MaterialId {
        if let Some(id) = self.materials.0.get(&(index, has_colours)) {
            return *id;
        }
        let json = index.and_then(|i| self.root.items("materials").get(i)).unwrap_or(&Value::Null);
        let base = self.base(json, has_colours);
        let name = index.map_or_else(|| "materials".to_owned(), |i| self.called("materials", i));
        let bare = self.model(json, base.colour, &name);
        let id = self.relief(json, bare);
        let id = self.holes(json, &base, id);
        self.fill(json, id);
        if let Some(name) = json.text("name") {
            self.target.name_material(name, id);
        }
        self.materials.0.insert((index, has_colours), id);
        id
    }

    /// The base colour: factor, picture and vertex colours, multiplied.
    fn base(&mut self, json: &Value, has_colours: bool) -> Base {
        let old = json.extension("KHR_materials_pbrSpecularGlossiness");
        let pbr = old.unwrap_or(json.field("pbrMetallicRoughness"));
        let [factor, picture] =
            if old.is_some() { ["diffuseFactor", "diffuseTexture"] } else { ["baseColorFactor", "baseColorTexture"] };
        let factor = Vec4::from_array(pbr.numbers(factor, [1.0; 4])).clamp(Vec4::ZERO, Vec4::ONE);
        let picture = self.texture(pbr.field(picture), Role::Colour);
        let mut colour = self.tinted(picture, factor.truncate());
        let mut alpha = picture.and_then(|p| p.alpha);
        if has_colours {
            let [rgb, opacity] = [VertexColour::Rgb, VertexColour::Alpha].map(Texture::Vertex);
            let (rgb, opacity) = (self.target.builder().texture(rgb), self.target.builder().texture(opacity));
            colour = self.product(colour, rgb);
            alpha = Some(alpha.map_or(opacity, |a| self.product(a, opacity)));
        }
        Base { colour, alpha, factor: factor.w }
    }

    fn product(&mut self, a: TextureId, b: TextureId) -> TextureId {
        self.target.builder().texture(Texture::Product(Product { of: [a, b] }))
    }

    /// A picture times a colour, or the colour alone.
    pub(super) fn tinted(&mut self, picture: Option<Picture>, factor: Vec3) -> TextureId {
        match picture {
            Some(picture) if factor == Vec3::ONE => picture.id,
            Some(picture) => {
                let factor = self.target.builder().constant(factor);
                self.product(picture.id, factor)
            }
            None => self.target.builder().constant(factor),
        }
    }

    /// A factor times one channel of a picture; the fourth is its opacity.
    pub(super) fn channel(&mut self, info: &Value, channel: u8, factor: f32) -> Scalar {
        let Some(picture) = self.texture(info, Role::Data) else { return factor.into() };
        let id = match (channel, picture.alpha) {
            (0..=2, _) => self.target.builder().texture(Texture::Channel(Channel { of: picture.id, channel })),
            (_, Some(alpha)) => alpha,
            (_, None) => return factor.into(),
        };
        if factor == 1.0 {
            return id.into();
        }
        let factor = self.target.builder().constant(Vec3::splat(factor));
        self.product(id, factor).into()
    }

    /// The model, without normals and holes.
    fn model(&mut self, json: &Value, colour: TextureId, name: &str) -> MaterialId {
        if json.extension("KHR_materials_unlit").is_some() {
            self.note("gltf::unlit", name, "an unlit material is lit here, as a matt one");
            let matt =
                PrincipledMaterial { roughness: 1.0.into(), specular: 0.0.into(), ..PrincipledMaterial::new(colour) };
            return self.target.builder().material(matt);
        }
        if let Some(old) = json.extension("KHR_materials_pbrSpecularGlossiness") {
            let model = self.specular_glossiness(old, colour);
            return self.target.builder().material(model);
        }
        let opaque = self.principled(json, colour, name);
        let clear = self.transmission(json, colour);
        let model = self.target.builder().principled(opaque, clear);
        self.turned(json, model)
    }

    /// What lets light through: with a thickness the boundary of a body, without one a sheet.
    fn transmission(&mut self, json: &Value, color: TextureId) -> Option<Transmission> {
        let clear = json.extension("KHR_materials_transmission")?;
        let factor = clear.number("transmissionFactor", 0.0).clamp(0.0, 1.0);
        let amount = self.channel(clear.field("transmissionTexture"), 0, factor);
        Some(Transmission { amount, color, ior: dispersive(ior(json), json), thin: volume(json).is_none() })
    }

    /// What a body absorbs: `attenuationColor` is left of white after `attenuationDistance`, which is infinite by default.
    fn fill(&mut self, json: &Value, id: MaterialId) {
        let clear = json.extension("KHR_materials_transmission");
        let Some(volume) = volume(json).filter(|_| clear.is_some_and(|c| c.number("transmissionFactor", 0.0) > 0.0))
        else {
            return;
        };
        let distance = volume.number("attenuationDistance", 0.0);
        let color = Vec3::from_array(volume.numbers("attenuationColor", [1.0; 3])).clamp(Vec3::ZERO, Vec3::ONE);
        if distance > 0.0 && color != Vec3::ONE {
            let interior = Interior::passing(color, distance, dispersive(ior(json), json));
            let interior = self.target.builder().interior(interior);
            self.target.builder().fill(id, interior);
        }
    }

    fn relief(&mut self, json: &Value, of: MaterialId) -> MaterialId {
        let info = json.field("normalTexture");
        let Some(picture) = self.texture(info, Role::Data) else { return of };
        let scale = info.number("scale", 1.0);
        self.target.builder().material(NormalMapMaterial { of, map: picture.id, scale })
    }

    /// Opacity (glTF 2.0, section 3.9.5).
    fn holes(&mut self, json: &Value, base: &Base, of: MaterialId) -> MaterialId {
        let opacity: Scalar = match (json.text("alphaMode"), base.alpha) {
            (Some("MASK"), alpha) => {
                let cutoff = json.number("alphaCutoff", 0.5);
                match alpha {
                    None => f32::from(base.factor >= cutoff).into(),
                    Some(_) if base.factor <= 0.0 => f32::from(cutoff <= 0.0).into(),
                    Some(of) => {
                        let stencil = Threshold { of, cutoff: cutoff / base.factor };
                        self.target.builder().texture(Texture::Threshold(stencil)).into()
                    }
                }
            }
            (Some("BLEND"), None) => base.factor.into(),
            (Some("BLEND"), Some(alpha)) => {
                let factor = self.target.builder().constant(Vec3::splat(base.factor));
                self.product(alpha, factor).into()
            }
            _ => return of,
        };
        if opacity == Scalar::Constant(1.0) {
            return of;
        }
        self.target.builder().material(MaskMaterial { of, opacity })
    }
}

/// `KHR_materials_volume` of a body; a thickness of 0 is a sheet.
fn volume(json: &Value) -> Option<&Value> {
    json.extension("KHR_materials_volume").filter(|v| v.number("thicknessFactor", 0.0) > 0.0)
}

/// The index of refraction; 0 stands for no refraction at all, which is what a very high one reflects.
pub(super) fn ior(json: &Value) -> f32 {
    match json.extension("KHR_materials_ior").map_or(IOR, |e| e.number("ior", IOR)) {
        n if n < 1.0 => 1e3,
        n => n,
    }
}

/// Cauchy's formula with the Abbe number that `KHR_materials_dispersion` gives as 20/V.
fn dispersive(eta: f32, json: &Value) -> Ior {
    /// Lines d, F and C, in µm.
    const LINES: [f32; 3] = [0.5876, 0.4861, 0.6563];
    let dispersion = json.extension("KHR_materials_dispersion").map_or(0.0, |e| e.number("dispersion", 0.0));
    if dispersion <= 0.0 {
        return eta.into();
    }
    let [d, f, c] = LINES.map(|l| 1.0 / (l * l));
    let b = (eta - 1.0) * dispersion / 20.0 / (f - c);
    Ior::Cauchy([eta - b * d, b, 0.0])
}

/// Radiance that a material emits, but for its texture.
fn emission(json: &Value) -> Vec3 {
    let strength = json.extension("KHR_materials_emissive_strength").map_or(1.0, |e| e.number("emissiveStrength", 1.0));
    Vec3::from_array(json.numbers("emissiveFactor", [0.0; 3])).max(Vec3::ZERO) * strength.max(0.0)
}
