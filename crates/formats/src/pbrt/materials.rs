//! `Material`: what pbrt's models are among ours. What is only near is told of, once for each model.

use super::directives::{Importer, unknown, warning};
use super::params::{Found, Params};
use super::spectra::Role;
use super::state::Cover;
use crate::lines::shortened;
use glam::Vec3;
use sunfleck::bsdf::{
    ConductorMaterial, CookTorranceMaterial, DielectricMaterial, DiffuseMaterial, Material, MirrorMaterial,
    RoughConductorMaterial, RoughDielectricMaterial, TextureId,
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

    pub(super) fn make_named_material(&mut self, name: &str, params: Params) -> Found<()> {
        let Some(model) = params.string("type")?.map(str::to_owned) else {
            return Err(params.bad("pbrt::no-type", "a named material needs a `type`"));
        };
        let made = self.material(&model, params)?;
        self.named_materials.insert(name.to_owned(), made);
        Ok(())
    }

    pub(super) fn named_material(&mut self, name: &str, at: &super::tokens::At) -> Found<()> {
        let Some(cover) = self.named_materials.get(name) else {
            return Err(unknown(at, "material", name, self.named_materials.keys().map(String::as_str)));
        };
        self.state.cover = Some(*cover);
        Ok(())
    }

    /// pbrt's: a matt grey of 0.5.
    pub(super) fn default_material(&mut self) -> MaterialId {
        let reflectance = self.target.builder().constant(Vec3::splat(0.5));
        let material = self.target.builder().material(DiffuseMaterial { reflectance });
        self.state.cover = Some(Cover::Material(material));
        material
    }

    fn cover(&mut self, name: &str, params: &Params) -> Found<Cover> {
        for map in ["displacement", "bumpmap", "normalmap"] {
            if let Some(param) = params.get(map) {
                let at = param.at.clone();
                self.warn_once("pbrt::bump", map, || {
                    at.tell(warning("pbrt::bump", format!("`{map}` is left out: surfaces stay smooth")), "")
                });
            }
        }
        if matches!(name, "interface" | "none" | "") {
            return Ok(Cover::Nothing);
        }
        if name == "mix" {
            return self.mix(params);
        }
        let model: Material = match name {
            "diffuse" | "matte" => self.diffuse(params)?.into(),
            "dielectric" | "glass" => self.dielectric(params)?,
            "conductor" | "metal" => self.conductor(name == "metal", params)?,
            "mirror" => MirrorMaterial { reflect: self.spectrum(params, &["Kr"], Vec3::splat(0.9))? }.into(),
            "coateddiffuse" | "plastic" | "substrate" | "disney" => self.coated(name, params)?.into(),
            "uber" => self.uber(params)?,
            _ if MATERIALS.contains(&name) => self.substitute(name, params)?,
            _ => return Err(unknown(&params.at, "material", name, MATERIALS)),
        };
        Ok(Cover::Material(self.target.builder().material(model)))
    }

    fn near(&mut self, name: &str, params: &Params, what: &str) {
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

    /// GGX alpha from pbrt's roughness; `default` is the roughness when none is given.
    fn alpha(&mut self, params: &Params, prefix: [&'static str; 3], default: f64) -> Found<f32> {
        let both = self.float(params, prefix[0], default)?;
        let (u, v) = (self.float(params, prefix[1], both)?, self.float(params, prefix[2], both)?);
        let remap = params.bool("remaproughness", true)?;
        let is_version_3 = self.picture.is_version_3;
        let alpha = |r: f64| match (remap, is_version_3) {
            (false, _) => r,
            (true, false) => r.max(0.0).sqrt(),
            (true, true) => {
                // The fit of version 3 (Pharr, Jakob & Humphreys 2016, `RoughnessToAlpha`); 0 is smooth.
                let x = r.max(1e-3).ln();
                1.62142 + x * (0.819_955 + x * (0.1734 + x * (0.017_120_1 + x * 0.000_640_711)))
            }
        };
        let is_smooth = u <= 0.0 && v <= 0.0;
        if u != v {
            self.near("anisotropic roughness", params, "the same roughness in all directions");
        }
        Ok(if is_smooth { 0.0 } else { (alpha(u.max(1e-6)) * alpha(v.max(1e-6))).max(0.0).sqrt().min(1.0) as f32 })
    }

    /// The index of refraction under its names in both versions.
    fn eta(&mut self, params: &Params, default: f32) -> Found<Ior> {
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

    fn dielectric(&mut self, params: &Params) -> Found<Material> {
        let eta = self.eta(params, 1.5)?;
        if eta.d() <= 0.0 {
            return Err(params.bad("pbrt::value", "an index of refraction must be greater than 0"));
        }
        let glass = DielectricMaterial {
            eta,
            reflectance: self.spectrum(params, &["Kr"], Vec3::ONE)?,
            transmittance: self.spectrum(params, &["Kt"], Vec3::ONE)?,
        };
        let alpha = self.alpha(params, ["roughness", "uroughness", "vroughness"], 0.0)?;
        Ok(if alpha > 0.0 { RoughDielectricMaterial { glass, alpha: alpha.into() }.into() } else { glass.into() })
    }

    fn conductor(&mut self, is_version_3: bool, params: &Params) -> Found<Material> {
        let alpha =
            self.alpha(params, ["roughness", "uroughness", "vroughness"], if is_version_3 { 0.01 } else { 0.0 })?;
        let metal = self.metal(params, ["eta", "k", "reflectance"])?;
        Ok(if alpha > 0.0 { RoughConductorMaterial { metal, alpha: alpha.into() }.into() } else { metal.into() })
    }

    /// A metal by its indices or by its reflectance along the normal.
    fn metal(&mut self, params: &Params, [eta, k, reflectance]: [&'static str; 3]) -> Found<ConductorMaterial> {
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
        Ok(ConductorMaterial { eta, k, reflectance: white })
    }

    /// A matt base below a clear coat.
    fn coated(&mut self, name: &str, params: &Params) -> Found<CookTorranceMaterial> {
        self.near(name, params, "a matt base under a rough gloss (`cooktorrance`)");
        params.ignore(&["thickness", "g", "albedo", "maxdepth", "nsamples", "twosided", "opacity", "Kr", "Kt"]);
        let (base, rough): (f32, f64) = match name {
            "plastic" => (0.25, 0.1),
            "coateddiffuse" => (0.5, 0.0),
            "disney" => (0.5, 0.5),
            _ => (0.5, 0.1),
        };
        let albedo = self.spectrum(params, &["reflectance", "Kd", "color"], Vec3::splat(base))?;
        let alpha = self.alpha(params, ["roughness", "uroughness", "vroughness"], rough)?;
        let eta = self.eta(params, 1.5)?.d();
        let f0 = ((eta - 1.0) / (eta + 1.0)).powi(2);
        let metallic = self.float(params, "metallic", 0.0)?.clamp(0.0, 1.0) as f32;
        let f0 = match name {
            "plastic" | "uber" => self.scaled(params, "Ks", Vec3::splat(0.25), f0)?,
            "substrate" => self.spectrum(params, &["Ks"], Vec3::splat(0.5))?,
            _ => self.target.builder().constant(Vec3::splat(f0)),
        };
        Ok(CookTorranceMaterial { albedo, f0, roughness: alpha.sqrt(), metallic })
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
        Ok(self.coated("uber", params)?.into())
    }

    /// The nearest model for what has none of its own.
    fn substitute(&mut self, name: &str, params: &Params) -> Found<Material> {
        let (what, model): (&str, Material) = match name {
            "thindielectric" => ("a boundary that lets all through", {
                let white = self.target.builder().constant(Vec3::ONE);
                params.ignore(&["eta"]);
                DielectricMaterial { eta: Ior::Constant(1.0), reflectance: white, transmittance: white }.into()
            }),
            "coatedconductor" => ("its metal without the coat", {
                let names = ["conductor.roughness", "conductor.uroughness", "conductor.vroughness"];
                let alpha = self.alpha(params, names, 0.0)?;
                params.ignore(&[
                    "interface.roughness",
                    "interface.uroughness",
                    "interface.vroughness",
                    "interface.eta",
                ]);
                params.ignore(&["thickness", "g", "albedo", "maxdepth", "nsamples"]);
                let metal = self.metal(params, ["conductor.eta", "conductor.k", "reflectance"])?;
                if alpha > 0.0 { RoughConductorMaterial { metal, alpha: alpha.into() }.into() } else { metal.into() }
            }),
            "subsurface" | "kdsubsurface" => ("a matt surface", {
                params.ignore(&["mfp", "eta", "g", "sigma_a", "sigma_s", "scale", "name", "roughness", "uroughness"]);
                params.ignore(&["vroughness", "remaproughness", "Kr", "Kt"]);
                DiffuseMaterial { reflectance: self.spectrum(params, &["reflectance", "Kd"], Vec3::splat(0.5))? }.into()
            }),
            "diffusetransmission" | "translucent" => ("a matt surface", {
                params.ignore(&["transmittance", "scale", "Ks", "reflect", "transmit", "roughness"]);
                DiffuseMaterial { reflectance: self.spectrum(params, &["reflectance", "Kd"], Vec3::splat(0.25))? }
                    .into()
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

    /// The heavier one of two materials.
    fn mix(&mut self, params: &Params) -> Found<Cover> {
        let names: Vec<String> = match params.get("materials").and_then(|p| p.strings()) {
            Some(names) => names.to_vec(),
            None => ["namedmaterial1", "namedmaterial2"]
                .into_iter()
                .filter_map(|n| params.string(n).transpose().map(|s| s.map(str::to_owned)))
                .collect::<Found<_>>()?,
        };
        let second = match params.get("amount").cloned() {
            // Version 3 gives the share of the first as a colour, version 4 that of the second as a number.
            Some(param) if param.kind == "float" || param.kind == "texture" => self.float(params, "amount", 0.5)?,
            Some(param) => 1.0 - f64::from(self.mean_spectrum(&param)?.element_sum() / 3.0),
            None => 0.5,
        };
        let [first, other] = names.as_slice() else {
            return Err(params.bad("pbrt::mix", "a mix needs the names of two materials"));
        };
        let chosen = if second > 0.5 { other } else { first };
        self.near("mix", params, &format!("the heavier one of the two, here `{}`", shortened(chosen)));
        match self.named_materials.get(chosen) {
            Some(cover) => Ok(*cover),
            None => Err(unknown(&params.at, "material", chosen, self.named_materials.keys().map(String::as_str))),
        }
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

    fn scaled(&mut self, params: &Params, name: &'static str, default: Vec3, by: f32) -> Found<TextureId> {
        let colour = match params.get(name).cloned() {
            Some(param) => self.mean_spectrum(&param)?,
            None => default,
        };
        Ok(self.target.builder().constant(colour * by))
    }
}
