//! Mitsuba's materials: pbrt's nearest, and what they are to us.

use super::Writer;
use super::materials::Model;
use super::text::{float, string};
use crate::Error;
use sunfleck::bsdf::{DisneyMaterial, DisneyThinMaterial, Facets, RoughPlasticMaterial, Roughness, Scalar};

/// The kind of landscape, where it is not pbrt's.
pub(super) fn facets(of: Roughness) -> String {
    kind(of.facets)
}

fn kind(facets: Facets) -> String {
    match facets {
        Facets::Ggx => String::new(),
        Facets::GgxSeparate => string("facets", "separate"),
        Facets::Beckmann => string("facets", "beckmann"),
    }
}

impl Writer<'_> {
    pub(super) fn rough_plastic(&mut self, m: &RoughPlasticMaterial) -> Result<Model, Error> {
        let (ior, alpha) = (m.boundary.ior(), m.boundary.alpha());
        let near = self.colour_param("reflectance", m.diffuse)?
            + &float("eta", ior)
            + &float("roughness", alpha)
            + " \"bool remaproughness\" false";
        let exact = self.colour_param("Kd", m.diffuse)?
            + &self.colour_param("Ks", m.specular)?
            + &float("ior", ior)
            + &float("alpha", alpha)
            + &kind(m.boundary.facets())
            + &format!(" \"bool nonlinear\" {}", m.nonlinear);
        Ok(Model::near("coateddiffuse", near, "sunfleck-roughplastic", &exact))
    }

    pub(super) fn disney(&mut self, m: &DisneyMaterial) -> Result<Model, Error> {
        let near = self.colour_param("reflectance", m.base)? + &roughness(m.roughness);
        let exact = self.colour_param("Kd", m.base)?
            + &self.numbers(&[
                ("gloss", m.roughness),
                ("anisotropic", m.anisotropic),
                ("metallic", m.metallic),
                ("ior", m.ior.into()),
                ("speculartint", m.specular_tint),
                ("sheen", m.sheen),
                ("sheentint", m.sheen_tint),
                ("flatness", m.flatness),
                ("coat", m.coat),
                ("coatgloss", m.coat_gloss),
            ])?
            + &m.transmission.map_or(Ok(String::new()), |clear| self.scalar_param("clear", clear))?;
        let is_metal = matches!(m.metallic, Scalar::Constant(metallic) if metallic > 0.5);
        let kind = if is_metal { "conductor" } else { "coateddiffuse" };
        Ok(Model::near(kind, near, "sunfleck-disney", &exact))
    }

    pub(super) fn disney_thin(&mut self, m: &DisneyThinMaterial) -> Result<Model, Error> {
        let near = self.colour_param("reflectance", m.base)? + &self.colour_param("transmittance", m.base)?;
        let exact = self.colour_param("Kd", m.base)?
            + &self.numbers(&[
                ("gloss", m.roughness),
                ("anisotropic", m.anisotropic),
                ("clear", m.transmission),
                ("through", m.through),
                ("ior", m.ior),
                ("speculartint", m.specular_tint),
                ("sheen", m.sheen),
                ("sheentint", m.sheen_tint),
                ("flatness", m.flatness),
            ])?;
        Ok(Model::near("diffusetransmission", near + " \"float scale\" 0.5", "sunfleck-disneythin", &exact))
    }

    fn numbers(&mut self, all: &[(&str, Scalar)]) -> Result<String, Error> {
        all.iter().map(|(name, number)| self.scalar_param(name, *number)).collect()
    }
}

/// Perceived roughness as alpha, where it is the same everywhere.
fn roughness(of: Scalar) -> String {
    let Scalar::Constant(r) = of else { return String::new() };
    float("roughness", r * r) + " \"bool remaproughness\" false"
}
