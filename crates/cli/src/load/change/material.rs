//! Materials of the command line.
use super::spec::Spec;
use crate::failure::Failure;
use glam::Vec3;
use sunfleck::{
    bsdf::{
        BlackMaterial, ConductorMaterial, CookTorranceMaterial, DielectricMaterial, DiffuseMaterial, Material,
        MirrorMaterial, NullMaterial, RoughConductorMaterial, RoughDielectricMaterial, ThinDielectricMaterial,
    },
    medium::Interior,
    scene::{MaterialId, SceneBuilder},
    spectrum::{Ior, NAMED, Named, named},
};

const KINDS: [&str; 8] = ["glass", "thinglass", "metal", "mirror", "diffuse", "gloss", "black", "null"];

/// The material that was told.
pub(super) fn make(spec: &Spec, b: &mut SceneBuilder) -> Result<Material, Failure> {
    if spec.preset.is_some() && !matches!(spec.kind, "glass" | "thinglass" | "metal") {
        return Err(spec.bad("only glass and metal come in kinds"));
    }
    Ok(match spec.kind {
        "glass" | "thinglass" => glass(spec, b)?,
        "metal" => metal(spec, b)?,
        "mirror" => MirrorMaterial { reflect: b.constant(spec.colour("color", Vec3::splat(0.95))?) }.into(),
        "diffuse" => DiffuseMaterial { reflectance: b.constant(spec.colour("color", Vec3::splat(0.5))?) }.into(),
        "gloss" => CookTorranceMaterial {
            albedo: b.constant(spec.colour("color", Vec3::splat(0.5))?),
            f0: b.constant(spec.colour("f0", Vec3::splat(0.04))?),
            roughness: roughness(spec, 0.3)?,
            metallic: 0.0,
        }
        .into(),
        "black" => BlackMaterial.into(),
        "null" => NullMaterial.into(),
        other => return Err(spec.unknown("material", other, KINDS)),
    })
}

/// What lies behind glass: `absorb` per scene unit, `priority` where it overlaps others.
pub(super) fn interior(spec: &Spec, b: &SceneBuilder, id: MaterialId) -> Result<Option<Interior>, Failure> {
    let ior = match b.parts().materials.get(id.0 as usize) {
        Some(Material::Dielectric(m)) => m.eta,
        Some(Material::RoughDielectric(m)) => m.glass.eta,
        _ => return Ok(None),
    };
    let absorb = spec.colour("absorb", Vec3::ZERO)?;
    let range = 0.0..=f32::from(u16::MAX);
    let priority =
        spec.number("priority", 0.0, |v| range.contains(&v) && v.fract() == 0.0, "a whole number to 65535")?;
    let is_empty = absorb == Vec3::ZERO && priority == 0.0;
    Ok((!is_empty).then(|| Interior::absorbing(absorb, ior).with_priority(priority as u16)))
}

fn roughness(spec: &Spec, default: f32) -> Result<f32, Failure> {
    spec.number("roughness", default, |r| (0.0..=1.0).contains(&r), "from 0 to 1")
}

/// Glasses by name, without `glass-` and in any case; also diamond, water and the like.
fn glass(spec: &Spec, b: &mut SceneBuilder) -> Result<Material, Failure> {
    let ior = spec.number("ior", 1.5, |v| v > 0.0, "positive")?;
    let eta = match spec.preset {
        None => Ior::Constant(ior),
        Some(name) => {
            let clear = || NAMED.iter().filter(|n| n.ior().is_some() && !n.name.starts_with("metal-"));
            let short = |n: &Named| n.name.strip_prefix("glass-").unwrap_or(n.name);
            let found = clear().find(|n| short(n).eq_ignore_ascii_case(name) || n.name.eq_ignore_ascii_case(name));
            found.and_then(Named::ior).ok_or_else(|| spec.unknown("glass", name, clear().map(short)))?
        }
    };
    let transmittance = b.constant(spec.colour("tint", Vec3::ONE)?);
    let reflectance = b.constant(Vec3::ONE);
    if spec.kind == "thinglass" {
        return Ok(ThinDielectricMaterial { eta, reflectance, transmittance }.into());
    }
    let (glass, roughness) = (DielectricMaterial { eta, reflectance, transmittance }, roughness(spec, 0.0)?);
    Ok(if roughness == 0.0 {
        glass.into()
    } else {
        RoughDielectricMaterial { glass, alpha: (roughness * roughness).into() }.into()
    })
}

/// Metals by symbol or by English name.
fn metal(spec: &Spec, b: &mut SceneBuilder) -> Result<Material, Failure> {
    let etas = || NAMED.iter().filter(|n| n.name.starts_with("metal-") && n.name.ends_with("-eta"));
    let symbol = |n: &Named| n.name.trim_start_matches("metal-").trim_end_matches("-eta").to_owned();
    let name = spec.preset.unwrap_or("silver");
    let found = etas().find(|n| symbol(n).eq_ignore_ascii_case(name) || n.about.eq_ignore_ascii_case(name));
    let Some(eta) = found else {
        let known: Vec<&str> = etas().map(|n| n.about).collect();
        return Err(spec.unknown("metal", name, known));
    };
    let k = named(&format!("metal-{}-k", symbol(eta)));
    let reflectance = b.constant(spec.colour("tint", Vec3::ONE)?);
    let k = b.constant(k.map_or_else(|| Vec3::ZERO.into(), Named::colour));
    let metal = ConductorMaterial { eta: b.constant(eta.colour()), k, reflectance };
    let roughness = roughness(spec, 0.0)?;
    Ok(if roughness == 0.0 {
        metal.into()
    } else {
        RoughConductorMaterial { metal, alpha: (roughness * roughness).into() }.into()
    })
}
