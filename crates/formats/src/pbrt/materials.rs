//! `Material`: what pbrt's models are among ours. What is only near is told of, once for each model.

use super::directives::{Importer, unknown, warning};
use super::ours::PREFIX;
use super::params::{Found, Params};
use super::spectra::Role;
use super::state::Cover;
use glam::Vec3;
use sunfleck::bsdf::{
    ConductorMaterial, DielectricMaterial, DiffuseMaterial, Material, MirrorMaterial, RoughConductorMaterial,
    RoughDielectricMaterial, TextureId, ThinDielectricMaterial,
};
use sunfleck::scene::MaterialId;
use sunfleck::spectrum::{Ior, named};

/// The models of version 4, then those of version 3.
const MATERIALS: [&str; 25] = [
    "interface",
    "diffuse",
    "coateddiffuse",
    "coatedconductor",
    "diffusetransmission",
    "dielectric",
    "thindielectric",
    "hair",
    "conductor",
    "measured",
    "subsurface",
    "mix",
    "matte",
    "plastic",
    "metal",
    "mirror",
    "uber",
    "substrate",
    "glass",
    "translucent",
    "kdsubsurface",
    "disney",
    "fourier",
    "none",
    "retroreflective",
];

impl Importer<'_> {
    /// The material of a `Material` directive.
    pub(super) fn material(&mut self, name: &str, params: Params) -> Found<Cover> {
        let params = self.with_defaults("material", params);
        let made = self.cover(name, &params)?;
        self.tell_unused(&params);
        Ok(made)
    }

    /// pbrt's: a matt grey of 0.5.
    pub(super) fn default_material(&mut self) -> MaterialId {
        let reflectance = self.target.builder().constant(Vec3::splat(0.5));
        let material = self.target.builder().material(DiffuseMaterial { reflectance });
        self.state.cover = Some(Cover::Material(material));
        material
    }

    fn cover(&mut self, name: &str, params: &Params) -> Found<Cover> {
        if matches!(name, "interface" | "none" | "") {
            return Ok(Cover::Nothing);
        }
        if name == "mix" {
            return self.mix(params);
        }
        if let Some(ours) = name.strip_prefix(PREFIX) {
            return self.our_model(ours, params);
        }
        let model: Material = match name {
            "diffuse" | "matte" => self.diffuse(params)?.into(),
            "dielectric" | "glass" => self.dielectric(params)?,
            "thindielectric" => {
                let glass = self.glass(params)?;
                let DielectricMaterial { eta, reflectance, transmittance } = glass;
                ThinDielectricMaterial { eta, reflectance, transmittance }.into()
            }
            "conductor" | "metal" => self.conductor(name == "metal", params)?,
            "mirror" => {
                // What stands there for version 4, which has no such model.
                params.ignore(&["reflectance"]);
                MirrorMaterial { reflect: self.spectrum(params, &["Kr"], Vec3::splat(0.9))? }.into()
            }
            "plastic" if !self.has_gloss(params)? => self.matt_base(params, 0.25)?,
            "coateddiffuse" => self.coated_diffuse(params)?,
            "coatedconductor" => self.coated_conductor(params)?,
            "plastic" | "substrate" => self.gloss(name, params)?,
            "disney" => self.disney(params)?,
            "diffusetransmission" | "translucent" => self.sheet(name, params)?,
            "uber" => self.uber(params)?,
            _ if MATERIALS.contains(&name) => self.substitute(name, params)?,
            _ => return Err(unknown(&params.at, "material", name, MATERIALS)),
        };
        let mut id = self.with_relief(model, params)?;
        if name == "uber" {
            id = self.uber_opacity(id, params)?;
        }
        Ok(Cover::Material(id))
    }

    pub(super) fn near(&mut self, name: &str, params: &Params, what: &str) {
        self.warn_once("pbrt::substitute", name, || {
            let message = format!("`{name}` is not among our materials: shown as {what}");
            params.at.tell(warning("pbrt::substitute", message), "")
        });
    }

    fn diffuse(&mut self, params: &Params) -> Found<DiffuseMaterial> {
        if params.get("sigma").and_then(|s| s.numbers()).is_some_and(|n| n.iter().any(|s| *s > 0.0)) {
            self.near("sigma", params, "evenly matt (Lambert)");
        }
        Ok(DiffuseMaterial { reflectance: self.spectrum(params, &["reflectance", "Kd"], Vec3::splat(0.5))? })
    }

    /// The index of refraction under its names in both versions.
    pub(super) fn eta(&mut self, params: &Params, default: f32) -> Found<Ior> {
        for name in ["eta", "index"] {
            if let Some(param) = params.get(name) {
                if param.kind == "texture" {
                    return Ok(Ior::Constant(self.float(params, name, f64::from(default))? as f32));
                }
                let param = param.clone();
                return self.index(&param);
            }
        }
        Ok(Ior::Constant(default))
    }

    /// An index under another name; of a texture its mean.
    pub(super) fn index_of(&mut self, params: &Params, name: &'static str, default: f32) -> Found<f32> {
        match params.get(name).cloned() {
            Some(param) if param.kind == "texture" => Ok(self.float(params, name, f64::from(default))? as f32),
            Some(param) => Ok(self.index(&param)?.d()),
            None => Ok(default),
        }
    }

    fn glass(&mut self, params: &Params) -> Found<DielectricMaterial> {
        let eta = self.eta(params, 1.5)?;
        if eta.d() <= 0.0 {
            return Err(params.bad("pbrt::value", "an index of refraction must be greater than 0"));
        }
        Ok(DielectricMaterial {
            eta,
            reflectance: self.spectrum(params, &["Kr"], Vec3::ONE)?,
            transmittance: self.spectrum(params, &["Kt"], Vec3::ONE)?,
        })
    }

    fn dielectric(&mut self, params: &Params) -> Found<Material> {
        let glass = self.glass(params)?;
        let alpha = self.roughness(params, ["roughness", "uroughness", "vroughness"], 0.0)?;
        Ok(alpha.map_or_else(|| glass.into(), |alpha| RoughDielectricMaterial { glass, alpha }.into()))
    }

    fn conductor(&mut self, is_version_3: bool, params: &Params) -> Found<Material> {
        let default = if is_version_3 { 0.01 } else { 0.0 };
        let alpha = self.roughness(params, ["roughness", "uroughness", "vroughness"], default)?;
        let metal = self.metal(params, ["eta", "k", "reflectance"])?;
        Ok(alpha.map_or_else(|| metal.into(), |alpha| RoughConductorMaterial { metal, alpha }.into()))
    }

    /// A metal by its indices or by its reflectance along the normal.
    pub(super) fn metal(
        &mut self,
        params: &Params,
        [eta, k, reflectance]: [&'static str; 3],
    ) -> Found<ConductorMaterial> {
        let white = self.target.builder().constant(Vec3::ONE);
        if let Some(param) = params.get(reflectance) {
            let param = param.clone();
            let r = self.mean_spectrum(&param)?.clamp(Vec3::ZERO, Vec3::splat(0.9999));
            // An index of 1 and this extinction reflect `r` (Pharr, Jakob & Humphreys 2023, section 10.5.2).
            let k = 2.0 * (r / (Vec3::ONE - r)).map(f32::sqrt);
            let k = self.target.builder().constant(k);
            return Ok(ConductorMaterial { eta: white, k, reflectance: white });
        }
        let eta = self.index_texture(params, eta, "metal-Cu-eta")?;
        let k = self.index_texture(params, k, "metal-Cu-k")?;
        Ok(ConductorMaterial { eta, k, reflectance: self.spectrum(params, &["tint"], Vec3::ONE)? })
    }

    fn uber(&mut self, params: &Params) -> Found<Material> {
        let mean = |this: &mut Self, name| match params.get(name).cloned() {
            Some(param) => this.mean_spectrum(&param),
            None => Ok(Vec3::ZERO),
        };
        let (kt, kr) = (mean(self, "Kt")?, mean(self, "Kr")?);
        if kt != Vec3::ZERO {
            return self.dielectric(params);
        }
        if kr != Vec3::ZERO && kr.element_sum() > mean(self, "Kd")?.element_sum() {
            return Ok(MirrorMaterial { reflect: self.spectrum(params, &["Kr"], Vec3::ZERO)? }.into());
        }
        if !self.has_gloss(params)? {
            return self.matt_base(params, 0.25);
        }
        self.gloss("uber", params)
    }

    /// Whether version 3's `Ks` reflects anything: its boundary is that of the index, and an index of 1 has none.
    fn has_gloss(&mut self, params: &Params) -> Found<bool> {
        let is_black = match params.get("Ks").cloned() {
            Some(param) if param.kind != "texture" => self.mean_spectrum(&param)? == Vec3::ZERO,
            _ => false,
        };
        Ok(!is_black && self.eta(params, 1.5)?.d() != 1.0)
    }

    /// What is left of `plastic` and `uber` without gloss.
    fn matt_base(&mut self, params: &Params, default: f32) -> Found<Material> {
        params.ignore(&["Ks", "Kr", "Kt", "roughness", "uroughness", "vroughness", "remaproughness", "index", "eta"]);
        Ok(DiffuseMaterial { reflectance: self.spectrum(params, &["Kd"], Vec3::splat(default))? }.into())
    }

    /// The nearest model for what has none of its own.
    fn substitute(&mut self, name: &str, params: &Params) -> Found<Material> {
        let (what, model): (&str, Material) = match name {
            "subsurface" | "kdsubsurface" => ("a matt surface", {
                params.ignore(&["mfp", "eta", "g", "sigma_a", "sigma_s", "scale", "name", "roughness", "uroughness"]);
                params.ignore(&["vroughness", "remaproughness", "Kr", "Kt"]);
                DiffuseMaterial { reflectance: self.spectrum(params, &["reflectance", "Kd"], Vec3::splat(0.5))? }.into()
            }),
            _ => ("a matt surface", {
                params.ignore(&[
                    "filename",
                    "bsdffile",
                    "eumelanin",
                    "pheomelanin",
                    "eta",
                    "beta_m",
                    "beta_n",
                    "alpha",
                ]);
                params.ignore(&["sigma_a"]);
                let colour = self.spectrum(params, &["reflectance", "color"], Vec3::splat(0.3))?;
                DiffuseMaterial { reflectance: colour }.into()
            }),
        };
        self.near(name, params, what);
        Ok(model)
    }

    /// The colour under the first of the names that is given, as a texture.
    pub(super) fn spectrum(&mut self, params: &Params, names: &[&'static str], default: Vec3) -> Found<TextureId> {
        for name in names {
            if let Some(param) = params.get(name) {
                let param = param.clone();
                if param.kind == "texture" {
                    return self.texture_of(&param);
                }
                let colour = self.colour(&param, Role::Reflectance)?;
                return Ok(self.target.builder().constant(colour));
            }
        }
        Ok(self.target.builder().constant(default))
    }

    /// An index of refraction or extinction by channel; by default a named one.
    fn index_texture(&mut self, params: &Params, name: &'static str, default: &str) -> Found<TextureId> {
        match params.get(name).cloned() {
            Some(param) if param.kind == "texture" => self.texture_of(&param),
            Some(param) => {
                let colour = self.colour(&param, Role::Index)?;
                Ok(self.target.builder().constant(colour))
            }
            None => {
                let known = named(default).map_or_else(|| Vec3::ONE.into(), |n| self.known(n, Role::Index));
                Ok(self.target.builder().constant(known))
            }
        }
    }
}
