//! Mitsuba's materials, as our own writer tells them.

use super::directives::Importer;
use super::params::{Found, Params};
use glam::Vec3;
use sunfleck::bsdf::{DisneyMaterial, DisneyThinMaterial, Facets, RoughBoundary, RoughPlasticMaterial};

/// The kind of landscape that `facets` names.
pub(super) fn facets(params: &Params) -> Found<Facets> {
    Ok(match params.string("facets")? {
        Some("beckmann") => Facets::Beckmann,
        Some("separate") => Facets::GgxSeparate,
        _ => Facets::Ggx,
    })
}

impl Importer<'_> {
    pub(super) fn rough_plastic(&mut self, params: &Params) -> Found<RoughPlasticMaterial> {
        let (ior, alpha) = (params.number("ior", 1.5)? as f32, params.number("alpha", 0.1)? as f32);
        Ok(RoughPlasticMaterial {
            diffuse: self.spectrum(params, &["Kd"], Vec3::splat(0.5))?,
            specular: self.spectrum(params, &["Ks"], Vec3::ONE)?,
            boundary: RoughBoundary::new(ior, alpha, facets(params)?),
            nonlinear: params.bool("nonlinear", false)?,
        })
    }

    pub(super) fn our_disney(&mut self, params: &Params) -> Found<DisneyMaterial> {
        let transmission = params.get("clear").is_some().then(|| self.scalar(params, "clear", 0.0)).transpose()?;
        Ok(DisneyMaterial {
            base: self.spectrum(params, &["Kd"], Vec3::splat(0.5))?,
            roughness: self.scalar(params, "gloss", 0.5)?,
            anisotropic: self.scalar(params, "anisotropic", 0.0)?,
            metallic: self.scalar(params, "metallic", 0.0)?,
            transmission,
            ior: params.number("ior", 1.5)? as f32,
            specular_tint: self.scalar(params, "speculartint", 0.0)?,
            sheen: self.scalar(params, "sheen", 0.0)?,
            sheen_tint: self.scalar(params, "sheentint", 0.0)?,
            flatness: self.scalar(params, "flatness", 0.0)?,
            coat: self.scalar(params, "coat", 0.0)?,
            coat_gloss: self.scalar(params, "coatgloss", 0.0)?,
        })
    }

    pub(super) fn our_disney_thin(&mut self, params: &Params) -> Found<DisneyThinMaterial> {
        Ok(DisneyThinMaterial {
            base: self.spectrum(params, &["Kd"], Vec3::splat(0.5))?,
            roughness: self.scalar(params, "gloss", 0.5)?,
            anisotropic: self.scalar(params, "anisotropic", 0.0)?,
            transmission: self.scalar(params, "clear", 0.0)?,
            through: self.scalar(params, "through", 0.0)?,
            ior: self.scalar(params, "ior", 1.5)?,
            specular_tint: self.scalar(params, "speculartint", 0.0)?,
            sheen: self.scalar(params, "sheen", 0.0)?,
            sheen_tint: self.scalar(params, "sheentint", 0.0)?,
            flatness: self.scalar(params, "flatness", 0.0)?,
        })
    }
}
