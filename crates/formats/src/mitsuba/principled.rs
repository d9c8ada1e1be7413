//! `principled` and `principledthin`: Disney's material in Mitsuba's parameters (Burley 2012 and 2015).

use super::bsdfs::{Cover, Wanted};
use super::document::Found;
use super::props::Props;
use super::scene::Importer;
use super::spectra::Role;
use glam::Vec3;
use sunfleck::bsdf::{PrincipledMaterial, Roughness, Scalar};
use sunfleck::scene::Transmission;
use sunfleck::spectrum::Ior;
use sunfleck::texture::{Product, Texture};

/// The clear coat's share: a quarter of what is asked for.
const COAT: f32 = 0.25;

impl Importer<'_, '_> {
    /// The material of an element.
    pub(super) fn principled(&mut self, name: &str, props: &Props, wanted: Wanted) -> Found<Cover> {
        let base = self.input(props, &["base_color"], Vec3::splat(0.5), Role::Reflectance)?;
        let ior = self.index_of(props)?;
        let sheen = self.scalar(props, "sheen", 0.0)?;
        let coat = self.scalar(props, "clearcoat", 0.0)?;
        let gloss = self.mean_of(props, "clearcoat_gloss", 0.0)?.clamp(0.0, 1.0);
        props.ignore(&["diffuse_reflectance_sampling_rate", "main_specular_sampling_rate", "clearcoat_sampling_rate"]);
        for (left_out, why) in [
            ("spec_tint", "white highlights"),
            ("sheen_tint", "white sheen"),
            ("flatness", "no flatness"),
            ("diff_trans", "no light scattered through"),
        ] {
            if props.has(left_out) {
                self.near(left_out, props, why);
            }
        }
        let opaque = PrincipledMaterial {
            metallic: self.scalar(props, "metallic", 0.0)?,
            roughness: self.stretched_roughness(props)?,
            ior: ior.into(),
            coat: self.times(coat, COAT),
            // Its alpha goes from 0.1 to 0.001.
            coat_roughness: ((0.1 - 0.099 * gloss).sqrt() as f32).into(),
            sheen: (sheen != Scalar::Constant(0.0)).then(|| self.shown(sheen)),
            ..PrincipledMaterial::new(base.id)
        };
        let amount = self.scalar(props, "spec_trans", 0.0)?;
        let is_clear = amount != Scalar::Constant(0.0);
        let is_thin = name == "principledthin";
        let clear = Transmission { amount, color: base.id, ior: Ior::Constant(ior), thin: is_thin };
        let material = if is_clear || is_thin || wanted.both_sides {
            self.target.builder().principled(opaque, Some(clear).filter(|_| is_clear))
        } else {
            self.one_sided(opaque)
        };
        Ok(Cover { material, is_nothing: false, varies: base.varies })
    }

    /// The index of refraction, by itself or by `specular`, where 0.5 means 1.5.
    fn index_of(&mut self, props: &Props) -> Found<f32> {
        let specular = self.mean_of(props, "specular", 0.5)?.clamp(0.0, 12.0);
        let by_specular = 2.0 / (1.0 - (0.08 * specular).sqrt()) - 1.0;
        Ok(self.mean_of(props, "eta", by_specular)?.max(1.0 + 1e-3) as f32)
    }

    /// Roughness along and across: alpha is stretched by √(1 − 0.9·anisotropic) (Burley 2012, section 5.4).
    fn stretched_roughness(&mut self, props: &Props) -> Found<Roughness> {
        let roughness = self.scalar(props, "roughness", 0.5)?;
        let anisotropic = self.mean_of(props, "anisotropic", 0.0)?.clamp(0.0, 1.0);
        if anisotropic == 0.0 {
            return Ok(roughness.into());
        }
        // Of perceived roughness, whose square is alpha, half as much in the exponent.
        let stretch = (1.0 - 0.9 * anisotropic).powf(0.25) as f32;
        Ok(Roughness { u: self.times(roughness, 1.0 / stretch), v: self.times(roughness, stretch) })
    }

    fn shown(&mut self, number: Scalar) -> sunfleck::bsdf::TextureId {
        match number {
            Scalar::Texture(id) => id,
            Scalar::Constant(v) => self.constant(Vec3::splat(v)).id,
        }
    }

    fn times(&mut self, number: Scalar, factor: f32) -> Scalar {
        match number {
            Scalar::Constant(v) => Scalar::Constant((v * factor).min(1.0)),
            Scalar::Texture(id) => {
                let factor = self.constant(Vec3::splat(factor)).id;
                self.target.builder().texture(Texture::Product(Product { of: [id, factor] })).into()
            }
        }
    }
}
