//! From the properties of a material to one of sunfleck's models.
//!
//! The type number of a material means different things in different versions of NRenderer, so the properties decide,
//! and the number only where they leave it open.

use super::properties::Properties;
use super::{ScnMaterial, ScnOptions};
use crate::diagnostic::SourceFile;
use crate::load::Target;
use glam::Vec3;
use sunfleck::bsdf::{
    ConductorMaterial, CookTorranceMaterial, DielectricMaterial, DiffuseMaterial, Material, MirrorMaterial,
    NRendererPhongMaterial, PhongMaterial, RoughDielectricMaterial,
};
use sunfleck::scene::MaterialId;

/// Glass, where a file does not say of which kind.
const GLASS_IOR: f32 = 1.5;

/// Adds the material to the scene.
pub(super) fn appearance(
    material: &ScnMaterial,
    source: &SourceFile,
    options: ScnOptions,
    target: &mut Target,
) -> MaterialId {
    let mut properties = Properties::new(material, source, target);
    properties.warn_of_unknown();
    let model = model(&mut properties, options.compat);
    let id = target.builder().material(model);
    target.name_material(&material.name.value, id);
    id
}

fn model(p: &mut Properties, compat: bool) -> Material {
    let is_clear = p.number("transparency").is_some_and(|t| t > 0.0);
    let is_rough = p.has("roughness") || p.has("F0") || p.has("metallic") || p.has("baseColor");
    let has_ior = p.has("ior") || p.has("ratio");
    if is_rough && (is_clear && has_ior) {
        return rough_glass(p);
    }
    if has_ior && !is_rough {
        return glass(p, GLASS_IOR).into();
    }
    if p.has("eta_r") && p.has("eta_i") {
        return conductor(p);
    }
    if p.has("reflect") || p.has("reflective") {
        return mirror(p);
    }
    if is_rough {
        return cook_torrance(p);
    }
    if p.has("refractIndex") {
        return plastic(p);
    }
    if p.has("specularEx") || p.has("specularColor") {
        return phong(p, compat);
    }
    by_number(p, compat, is_clear)
}

/// The properties leave the model open.
fn by_number(p: &mut Properties, compat: bool, is_clear: bool) -> Material {
    match p.type_id() {
        // The template of NRenderer says 1.0, which cannot be seen.
        2 if p.has("absorbed") && compat => glass(p, 1.0).into(),
        id if is_clear || (id == 2 && p.has("absorbed")) => {
            let ior = p.assume("ior", GLASS_IOR);
            glass(p, ior).into()
        }
        3 if p.has("albedo") => cook_torrance(p),
        1 if compat => phong(p, compat),
        _ => {
            let key = if !p.has("diffuseColor") && p.has("albedo") { "albedo" } else { "diffuseColor" };
            let reflectance = p.reflectance(key, Vec3::ONE);
            DiffuseMaterial { reflectance: p.constant(reflectance) }.into()
        }
    }
}

/// A dielectric; `default_ior` is for files that do not give one.
fn glass(p: &mut Properties, default_ior: f32) -> DielectricMaterial {
    let key = if p.has("ior") { "ior" } else { "ratio" };
    let eta = p.positive(key).unwrap_or(default_ior);
    let transmittance = p.reflectance("absorbed", Vec3::ONE);
    DielectricMaterial { eta: eta.into(), reflectance: p.constant(Vec3::ONE), transmittance: p.constant(transmittance) }
}

fn rough_glass(p: &mut Properties) -> Material {
    let roughness = p.unit("roughness", 0.2);
    RoughDielectricMaterial { glass: glass(p, GLASS_IOR), alpha: (roughness * roughness).into() }.into()
}

fn conductor(p: &mut Properties) -> Material {
    let eta = p.colour("eta_r").unwrap_or(Vec3::ONE).max(Vec3::splat(1e-3));
    let k = p.colour("eta_i").unwrap_or(Vec3::ZERO).max(Vec3::ZERO);
    let reflectance = p.reflectance("albedo", Vec3::ONE);
    ConductorMaterial { eta: p.constant(eta), k: p.constant(k), reflectance: p.constant(reflectance) }.into()
}

fn mirror(p: &mut Properties) -> Material {
    let key = if p.has("reflect") { "reflect" } else { "reflective" };
    let reflect = p.reflectance(key, Vec3::ONE);
    MirrorMaterial { reflect: p.constant(reflect) }.into()
}

fn cook_torrance(p: &mut Properties) -> Material {
    let key = ["baseColor", "albedo", "diffuseColor"].into_iter().find(|k| p.has(k)).unwrap_or("baseColor");
    let albedo = p.reflectance(key, Vec3::ONE);
    let f0 = p.reflectance("F0", Vec3::splat(0.04));
    CookTorranceMaterial {
        albedo: p.constant(albedo),
        f0: p.constant(f0),
        roughness: p.unit("roughness", 0.2),
        metallic: p.unit("metallic", 0.0),
    }
    .into()
}

/// A matt base under a polished coat, which a slightly rough one stands for.
fn plastic(p: &mut Properties) -> Material {
    let ior = p.positive("refractIndex").unwrap_or(GLASS_IOR);
    let f0 = ((ior - 1.0) / (ior + 1.0)).powi(2);
    let albedo = p.reflectance("diffuseColor", Vec3::ONE);
    let f0 = f0 * p.reflectance("specularColor", Vec3::ONE);
    CookTorranceMaterial { albedo: p.constant(albedo), f0: p.constant(f0), roughness: 0.1, metallic: 0.0 }.into()
}

fn phong(p: &mut Properties, compat: bool) -> Material {
    let diffuse = p.reflectance("diffuseColor", Vec3::ONE);
    let specular = p.reflectance("specularColor", Vec3::ONE);
    let exponent = p.within("specularEx", 1.0, 0.0..=1e6);
    let (diffuse, specular) = (p.constant(diffuse), p.constant(specular));
    if compat {
        NRendererPhongMaterial { diffuse, specular, exponent }.into()
    } else {
        PhongMaterial { diffuse, specular, exponent }.into()
    }
}
