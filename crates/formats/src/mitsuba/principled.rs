//! `principled` and `principledthin`: Disney's material in Mitsuba's parameters (Burley 2012 and 2015).

use super::bsdfs::{Cover, Wanted};
use super::document::Found;
use super::props::Props;
use super::scene::Importer;
use super::spectra::Role;
use glam::Vec3;
use sunfleck::bsdf::{DisneyMaterial, DisneyThinMaterial, Scalar};

impl Importer<'_, '_> {
    /// The material of an element.
    pub(super) fn principled(&mut self, name: &str, props: &Props, wanted: Wanted) -> Found<Cover> {
        let base = self.input(props, &["base_color"], Vec3::splat(0.5), Role::Reflectance)?;
        props.ignore(&["diffuse_reflectance_sampling_rate", "main_specular_sampling_rate", "clearcoat_sampling_rate"]);
        props.ignore(&["specular_reflectance_sampling_rate", "specular_transmittance_sampling_rate"]);
        props.ignore(&["diffuse_transmittance_sampling_rate"]);
        let mut number = |name, default| self.scalar(props, name, default);
        let (roughness, anisotropic) = (number("roughness", 0.5)?, number("anisotropic", 0.0)?);
        let transmission = number("spec_trans", 0.0)?;
        let (sheen, sheen_tint) = (number("sheen", 0.0)?, number("sheen_tint", 0.0)?);
        let (specular_tint, flatness) = (number("spec_tint", 0.0)?, number("flatness", 0.0)?);
        let material = if name == "principledthin" {
            let (through, ior) = (number("diff_trans", 0.0)?, number("eta", 1.5)?);
            self.target.builder().material(DisneyThinMaterial {
                base: base.id,
                roughness,
                anisotropic,
                transmission,
                through,
                ior,
                specular_tint,
                sheen,
                sheen_tint,
                flatness,
            })
        } else {
            let is_clear = transmission != Scalar::Constant(0.0);
            let model = DisneyMaterial {
                base: base.id,
                roughness,
                anisotropic,
                metallic: number("metallic", 0.0)?,
                transmission: is_clear.then_some(transmission),
                specular_tint,
                sheen,
                sheen_tint,
                flatness,
                coat: number("clearcoat", 0.0)?,
                coat_gloss: number("clearcoat_gloss", 0.0)?,
                ior: self.index_of(props)?,
            };
            if is_clear || wanted.both_sides { self.target.builder().material(model) } else { self.one_sided(model) }
        };
        Ok(Cover { material, is_nothing: false, varies: base.varies })
    }

    /// The index of refraction, by itself or by `specular`, where 0.5 means 1.5.
    fn index_of(&mut self, props: &Props) -> Found<f32> {
        let specular = self.mean_of(props, "specular", 0.5)?.clamp(0.0, 12.0);
        let by_specular = 2.0 / (1.0 - (0.08 * specular).sqrt()) - 1.0;
        Ok(self.mean_of(props, "eta", by_specular)?.max(1.0 + 1e-3) as f32)
    }
}
