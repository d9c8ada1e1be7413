//! Materials, each under a name of its own.

use super::Writer;
use super::mitsubas::facets;
use super::text::{float, index, ours, param, quoted, string};
use crate::Error;
use glam::Vec3;
use sunfleck::bsdf::{
    ConductorMaterial, Covering, DielectricMaterial, Material, PlasticMaterial, PrincipledMaterial, Roughness, Scalar,
    TextureId, TwoSidedMaterial,
};
use sunfleck::scene::MaterialId;

/// A model and its parameters; what only we read is apart.
pub(super) struct Model {
    kind: &'static str,
    params: String,
    ours: String,
}

impl Model {
    fn new(kind: &'static str, params: String) -> Self {
        Self { kind, params, ours: String::new() }
    }
    /// pbrt's nearest model, and what it is to us.
    pub(super) fn near(kind: &'static str, params: String, ours_kind: &str, ours: &str) -> Self {
        Self { kind, params, ours: string("type", ours_kind) + ours }
    }
}

impl Writer<'_> {
    pub(super) fn materials(&mut self) -> Result<(), Error> {
        let materials = self.scene.parts.materials;
        let mut taken = std::collections::BTreeSet::new();
        for (i, material) in materials.iter().enumerate() {
            let id = MaterialId(i as u32);
            let said = self.scene.names.iter().find(|(_, named)| *named == id).map(|(name, _)| name.clone());
            let mut name = said.unwrap_or_else(|| format!("material {i}"));
            while !taken.insert(name.clone()) {
                name = format!("{name} ({i})");
            }
            self.materials.insert(id, name.clone());
            let model = self.model(material)?;
            let kind = string("type", model.kind);
            let line = format!("MakeNamedMaterial {}{kind}{}{}", quoted(&name), model.params, ours(&model.ours));
            self.line(line.trim_end());
        }
        Ok(())
    }

    fn model(&mut self, material: &Material) -> Result<Model, Error> {
        Ok(match material {
            Material::Diffuse(m) => Model::new("diffuse", self.colour_param("reflectance", m.reflectance)?),
            Material::Black(_) => Model::new("diffuse", " \"rgb reflectance\" [ 0 0 0 ]".to_owned()),
            Material::Mirror(m) => {
                let (near, exact) = (self.colour_param("reflectance", m.reflect)?, self.colour_param("Kr", m.reflect)?);
                Model::near("conductor", near, "mirror", &exact)
            }
            Material::Dielectric(m) => self.glass("dielectric", m, None)?,
            Material::RoughDielectric(m) => self.glass("dielectric", &m.glass, Some(m.alpha))?,
            Material::ThinDielectric(m) => {
                let glass =
                    DielectricMaterial { eta: m.eta, reflectance: m.reflectance, transmittance: m.transmittance };
                self.glass("thindielectric", &glass, None)?
            }
            Material::Conductor(m) => self.metal(m, None)?,
            Material::RoughConductor(m) => self.metal(&m.metal, Some(m.alpha))?,
            Material::Phong(m) => self.phong("sunfleck-phong", [m.diffuse, m.specular], m.exponent)?,
            Material::NRendererPhong(m) => {
                self.phong("sunfleck-nrenderer-phong", [m.diffuse, m.specular], m.exponent)?
            }
            Material::CookTorrance(m) => {
                let near = self.colour_param("reflectance", m.albedo)?
                    + &float("roughness", m.roughness * m.roughness)
                    + " \"bool remaproughness\" false";
                let exact = self.colour_param("Kd", m.albedo)?
                    + &self.colour_param("Ks", m.f0)?
                    + &float("gloss", m.roughness)
                    + &float("metallic", m.metallic);
                Model::near("coateddiffuse", near, "sunfleck-cooktorrance", &exact)
            }
            Material::Plastic(m) => self.plastic(m)?,
            Material::RoughPlastic(m) => self.rough_plastic(m)?,
            Material::Disney(m) => self.disney(m)?,
            Material::DisneyThin(m) => self.disney_thin(m)?,
            Material::CoatedConductor(m) => {
                let params = self.colour_param("conductor.eta", m.metal.eta)?
                    + &self.colour_param("conductor.k", m.metal.k)?
                    + &self.scalar_param("conductor.uroughness", m.alpha.u)?
                    + &self.scalar_param("conductor.vroughness", m.alpha.v)?
                    + &float("interface.eta", m.coat_ior)
                    + &self.scalar_param("interface.roughness", m.coat_alpha)?
                    + " \"bool remaproughness\" false";
                let white = self.is_white(m.metal.reflectance);
                let tint = if white { String::new() } else { self.colour_param("tint", m.metal.reflectance)? };
                Model { kind: "coatedconductor", params, ours: tint }
            }
            Material::DiffuseTransmission(m) => Model::new(
                "diffusetransmission",
                self.colour_param("reflectance", m.reflectance)?
                    + &self.colour_param("transmittance", m.transmittance)?,
            ),
            Material::Principled(m) => self.principled(m)?,
            Material::Covering(c) => self.covering(c)?,
            #[allow(unreachable_patterns, reason = "models may be added without a word for them here")]
            other => {
                self.note(&format!("materials of the kind `{}` are written as matt grey", other.name()));
                Model::new("diffuse", " \"rgb reflectance\" [ 0.5 0.5 0.5 ]".to_owned())
            }
        })
    }

    fn glass(&mut self, kind: &'static str, m: &DielectricMaterial, alpha: Option<Roughness>) -> Result<Model, Error> {
        let params = index("eta", &m.eta) + &self.roughness(alpha)?;
        let mut tints = alpha.map_or(String::new(), facets);
        for (name, id) in [("Kr", m.reflectance), ("Kt", m.transmittance)] {
            if !self.is_white(id) {
                tints += &self.colour_param(name, id)?;
            }
        }
        Ok(Model { kind, params, ours: tints })
    }

    fn metal(&mut self, m: &ConductorMaterial, alpha: Option<Roughness>) -> Result<Model, Error> {
        let params = self.colour_param("eta", m.eta)? + &self.colour_param("k", m.k)? + &self.roughness(alpha)?;
        let tint = if self.is_white(m.reflectance) { String::new() } else { self.colour_param("tint", m.reflectance)? };
        Ok(Model { kind: "conductor", params, ours: tint + &alpha.map_or(String::new(), facets) })
    }

    fn phong(&mut self, kind: &str, [diffuse, specular]: [TextureId; 2], exponent: f32) -> Result<Model, Error> {
        // The slope of a microfacet distribution with about the same highlight: α² = 2 / (n + 2).
        let alpha = (2.0 / (exponent + 2.0)).sqrt();
        let near =
            self.colour_param("reflectance", diffuse)? + &float("roughness", alpha) + " \"bool remaproughness\" false";
        let exact =
            self.colour_param("Kd", diffuse)? + &self.colour_param("Ks", specular)? + &float("exponent", exponent);
        Ok(Model::near("coateddiffuse", near, kind, &exact))
    }

    fn plastic(&mut self, m: &PlasticMaterial) -> Result<Model, Error> {
        let near =
            self.colour_param("reflectance", m.diffuse)? + &float("eta", m.ior) + &self.roughness(Some(m.alpha))?;
        if m.nonlinear && self.is_white(m.specular) {
            return Ok(Model::new("coateddiffuse", near));
        }
        let exact = self.colour_param("Kd", m.diffuse)?
            + &self.colour_param("Ks", m.specular)?
            + &float("ior", m.ior)
            + &self.scalar_param("alphau", m.alpha.u)?
            + &self.scalar_param("alphav", m.alpha.v)?
            + &format!(" \"bool nonlinear\" {}", m.nonlinear);
        Ok(Model::near("coateddiffuse", near, "sunfleck-plastic", &exact))
    }

    fn principled(&mut self, m: &PrincipledMaterial) -> Result<Model, Error> {
        let near = self.colour_param("reflectance", m.base)?;
        let mut exact = self.colour_param("Kd", m.base)?;
        for (name, s) in [
            ("metallic", m.metallic),
            ("glossu", m.roughness.u),
            ("glossv", m.roughness.v),
            ("ior", m.ior),
            ("specular", m.specular),
            ("coat", m.coat),
            ("coatroughness", m.coat_roughness),
            ("coatior", m.coat_ior.into()),
            ("sheenroughness", m.sheen_roughness),
        ] {
            exact += &self.scalar_param(name, s)?;
        }
        for (name, id) in [("Ks", m.specular_color), ("sheen", m.sheen)] {
            if let Some(id) = id {
                exact += &self.colour_param(name, id)?;
            }
        }
        if let Some(film) = m.film {
            exact += &self.scalar_param("film", film.share)?;
            exact += &float("filmior", film.ior);
            exact += &self.scalar_param("filmthickness", film.thickness)?;
        }
        // What shows most, where it is the same everywhere.
        let is_metal = matches!(m.metallic, Scalar::Constant(metallic) if metallic > 0.5);
        let mut near = near;
        if let (Scalar::Constant(u), Scalar::Constant(v)) = (m.roughness.u, m.roughness.v) {
            let rough = float("uroughness", u * u) + &float("vroughness", v * v);
            near += &(rough + " \"bool remaproughness\" false");
        }
        let kind = if is_metal { "conductor" } else { "coateddiffuse" };
        Ok(Model::near(kind, near, "sunfleck-principled", &exact))
    }

    fn covering(&mut self, c: &Covering) -> Result<Model, Error> {
        Ok(match c {
            Covering::Null(_) => Model::new("interface", String::new()),
            Covering::Mix(m) => {
                let of = m.of.map(|id| self.name_of(id)).join(" ");
                Model::new("mix", param("string", "materials", &of) + &self.scalar_param("amount", m.amount)?)
            }
            // Shapes have their holes themselves; this is for a mask inside of a mix.
            Covering::Mask(m) => {
                let exact = param("string", "of", &self.name_of(m.of)) + &self.scalar_param("opacity", m.opacity)?;
                self.inner(m.of, "sunfleck-mask", &exact)?
            }
            Covering::TwoSided(TwoSidedMaterial { front, back }) => {
                let mut exact = String::new();
                for (side, id) in [("front", front), ("back", back)] {
                    if let Some(id) = id {
                        exact += &param("string", side, &self.name_of(*id));
                    }
                }
                match front.or(*back) {
                    Some(of) => self.inner(of, "sunfleck-twosided", &exact)?,
                    None => Model::new("diffuse", " \"rgb reflectance\" [ 0 0 0 ]".to_owned()),
                }
            }
            Covering::NormalMap(m) => {
                let exact = param("string", "of", &self.name_of(m.of))
                    + &self.colour_param("normals", m.map)?
                    + &float("scale", m.scale);
                self.inner(m.of, "sunfleck-normalmap", &exact)?
            }
            Covering::Turned(m) => {
                let mut exact = param("string", "of", &self.name_of(m.of)) + &float("angle", m.angle);
                if let Some(id) = m.direction {
                    exact += &self.colour_param("direction", id)?;
                }
                self.inner(m.of, "sunfleck-turned", &exact)?
            }
            Covering::BumpMap(m) => {
                let height = self.scalar_param("displacement", m.height)?;
                let exact = param("string", "of", &self.name_of(m.of))
                    + &self.scalar_param("height", m.height)?
                    + &float("scale", m.scale);
                let mut model = self.inner(m.of, "sunfleck-bumpmap", &exact)?;
                if m.scale == 1.0 && height.starts_with(" \"texture") {
                    model.params += &height;
                }
                model
            }
        })
    }

    /// What lies under a covering, which only we read.
    fn inner(&mut self, of: MaterialId, kind: &str, exact: &str) -> Result<Model, Error> {
        let materials = self.scene.parts.materials;
        let Model { kind: near, params, .. } = self.model(&materials[of.0 as usize])?;
        Ok(Model::near(near, params, kind, exact))
    }

    fn roughness(&mut self, alpha: Option<Roughness>) -> Result<String, Error> {
        let Some(Roughness { u, v, .. }) = alpha else { return Ok(String::new()) };
        let both = if u == v {
            self.scalar_param("roughness", u)?
        } else {
            self.scalar_param("uroughness", u)? + &self.scalar_param("vroughness", v)?
        };
        Ok(both + " \"bool remaproughness\" false")
    }

    fn is_white(&self, id: TextureId) -> bool {
        self.constant(id).is_some_and(|c| c.rgb() == Vec3::ONE)
    }

    /// The name of a material that was told of, in quotes.
    pub(super) fn name_of(&self, id: MaterialId) -> String {
        quoted(self.materials.get(&id).map_or("", String::as_str))
    }

    /// What a shape of this material names, and its holes as a parameter.
    pub(super) fn of_shape(&mut self, id: MaterialId) -> Result<(String, String), Error> {
        let materials = self.scene.parts.materials;
        if let Material::Covering(Covering::Mask(m)) = &materials[id.0 as usize] {
            let alpha =
                if m.opacity == Scalar::Constant(1.0) { String::new() } else { self.scalar_param("alpha", m.opacity)? };
            return Ok((self.name_of(m.of), alpha));
        }
        Ok((self.name_of(id), String::new()))
    }
}
