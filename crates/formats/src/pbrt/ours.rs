//! Materials that pbrt has no words for, as our own writer tells them.

use super::directives::{Importer, unknown};
use super::params::{Found, Params};
use super::state::Cover;
use glam::Vec3;
use sunfleck::bsdf::{
    BumpMapMaterial, CookTorranceMaterial, FilmMaterial, MaskMaterial, Material, NRendererPhongMaterial,
    NormalMapMaterial, PhongMaterial, PlasticMaterial, PrincipledMaterial, Roughness, Scalar, TurnedMaterial,
    TwoSidedMaterial,
};
use sunfleck::scene::MaterialId;

/// What our own models begin with.
pub(super) const PREFIX: &str = "sunfleck-";

const MODELS: [&str; 13] = [
    "bumpmap",
    "cooktorrance",
    "disney",
    "disneythin",
    "mask",
    "normalmap",
    "nrenderer-phong",
    "phong",
    "plastic",
    "principled",
    "roughplastic",
    "turned",
    "twosided",
];

impl Importer<'_> {
    fn thin_film(&mut self, params: &Params) -> Found<Option<FilmMaterial>> {
        let share = self.scalar(params, "film", 0.0)?;
        let (ior, thickness) = (params.number("filmior", 1.3)? as f32, self.scalar(params, "filmthickness", 400.0)?);
        Ok((share != 0.0.into()).then_some(FilmMaterial { share, ior, thickness }))
    }

    /// A model of ours, `name` without its beginning.
    pub(super) fn our_model(&mut self, name: &str, params: &Params) -> Found<Cover> {
        // What stands there for pbrt.
        params.ignore(&["reflectance", "roughness", "uroughness", "vroughness", "remaproughness", "eta", "k"]);
        params.ignore(&["materials", "amount", "displacement", "Kr", "Kt", "tint", "scale"]);
        let model: Material = match name {
            "phong" | "nrenderer-phong" => {
                let diffuse = self.spectrum(params, &["Kd"], Vec3::ZERO)?;
                let specular = self.spectrum(params, &["Ks"], Vec3::ZERO)?;
                let exponent = params.number("exponent", 1.0)? as f32;
                if exponent < 0.0 {
                    return Err(params.misfit("exponent", "a number of 0 or more"));
                }
                if name == "phong" {
                    PhongMaterial { diffuse, specular, exponent }.into()
                } else {
                    NRendererPhongMaterial { diffuse, specular, exponent }.into()
                }
            }
            "cooktorrance" => {
                let unit = |name| -> Found<f32> { Ok(params.number(name, 0.5)?.clamp(0.0, 1.0) as f32) };
                CookTorranceMaterial {
                    albedo: self.spectrum(params, &["Kd"], Vec3::splat(0.5))?,
                    f0: self.spectrum(params, &["Ks"], Vec3::splat(0.04))?,
                    roughness: unit("gloss")?,
                    metallic: unit("metallic")?,
                }
                .into()
            }
            "plastic" => PlasticMaterial {
                diffuse: self.spectrum(params, &["Kd"], Vec3::splat(0.5))?,
                specular: self.spectrum(params, &["Ks"], Vec3::ONE)?,
                ior: params.number("ior", 1.5)? as f32,
                alpha: self.both(params, ["alphau", "alphav"])?,
                nonlinear: params.bool("nonlinear", true)?,
            }
            .into(),
            "principled" => {
                let base = self.spectrum(params, &["Kd"], Vec3::splat(0.5))?;
                let colour = |this: &mut Self, name| {
                    params.get(name).is_some().then(|| this.spectrum(params, &[name], Vec3::ONE)).transpose()
                };
                let (specular_color, sheen) = (colour(self, "Ks")?, colour(self, "sheen")?);
                PrincipledMaterial {
                    metallic: self.scalar(params, "metallic", 0.0)?,
                    roughness: self.both(params, ["glossu", "glossv"])?,
                    ior: self.scalar(params, "ior", 1.5)?,
                    specular: self.scalar(params, "specular", 1.0)?,
                    specular_color,
                    coat: self.scalar(params, "coat", 0.0)?,
                    coat_roughness: self.scalar(params, "coatroughness", 0.0)?,
                    coat_ior: params.number("coatior", 1.5)? as f32,
                    sheen,
                    sheen_roughness: self.scalar(params, "sheenroughness", 0.3)?,
                    film: self.thin_film(params)?,
                    ..PrincipledMaterial::new(base)
                }
                .into()
            }
            "roughplastic" => self.rough_plastic(params)?.into(),
            "disney" => self.our_disney(params)?.into(),
            "disneythin" => self.our_disney_thin(params)?.into(),
            "mask" => {
                let of = self.part(params, "of")?;
                MaskMaterial { of, opacity: self.scalar(params, "opacity", 1.0)? }.into()
            }
            "twosided" => {
                let side =
                    |this: &mut Self, name| params.get(name).is_some().then(|| this.part(params, name)).transpose();
                TwoSidedMaterial { front: side(self, "front")?, back: side(self, "back")? }.into()
            }
            "normalmap" => {
                let (of, scale) = (self.part(params, "of")?, params.number("scale", 1.0)? as f32);
                NormalMapMaterial { of, map: self.spectrum(params, &["normals"], Vec3::new(0.5, 0.5, 1.0))?, scale }
                    .into()
            }
            "turned" => {
                let (of, angle) = (self.part(params, "of")?, params.number("angle", 0.0)? as f32);
                let is_drawn = params.get("direction").is_some();
                let direction = is_drawn.then(|| self.spectrum(params, &["direction"], Vec3::ONE)).transpose()?;
                TurnedMaterial { of, angle, direction }.into()
            }
            "bumpmap" => {
                let (of, scale) = (self.part(params, "of")?, params.number("scale", 1.0)? as f32);
                BumpMapMaterial { of, height: self.scalar(params, "height", 0.0)?, scale }.into()
            }
            _ => return Err(unknown(&params.at, "material of ours", name, MODELS)),
        };
        Ok(Cover::Material(self.target.builder().material(model)))
    }

    /// A material that a parameter names.
    fn part(&mut self, params: &Params, name: &'static str) -> Found<MaterialId> {
        let of = params.string(name)?.unwrap_or_default().to_owned();
        match self.named_materials.get(&of).copied() {
            Some(cover) => Ok(self.material_id(cover)),
            None => Err(unknown(&params.at, "material", &of, self.named_materials.keys().map(String::as_str))),
        }
    }

    /// Roughness along and across.
    fn both(&mut self, params: &Params, [u, v]: [&'static str; 2]) -> Found<Roughness> {
        Ok(Roughness::aligned(self.scalar(params, u, 0.0)?, self.scalar(params, v, 0.0)?))
    }

    /// A number, or a texture of numbers.
    pub(super) fn scalar(&mut self, params: &Params, name: &'static str, default: f64) -> Found<Scalar> {
        match params.get(name).cloned() {
            Some(param) if param.kind == "texture" => Ok(self.texture_of(&param)?.into()),
            _ => Ok(Scalar::Constant(params.number(name, default)? as f32)),
        }
    }
}
