//! Lights of the command line.
use super::spec::Spec;
use crate::failure::Failure;
use glam::Vec3;
use sunfleck::{
    bsdf::BlackMaterial,
    light::{DirectionalLight, EnvironmentLight, PointLight, Sides, SpotLight},
    scene::{SceneBuilder, SurfaceDef},
    shape::{Shape, Sphere},
};

const KINDS: [&str; 5] = ["point", "spot", "sun", "sky", "ball"];

/// Adds the light that was told; true if it is a surface.
pub(super) fn add(spec: &Spec, b: &mut SceneBuilder) -> Result<bool, Failure> {
    if spec.preset.is_some() {
        return Err(spec.bad("settings are told as `key=value`"));
    }
    let at = |default: Vec3| Ok::<Vec3, Failure>(spec.vector("at")?.unwrap_or(default));
    match spec.kind {
        "point" => {
            b.light(PointLight { p: at(Vec3::ZERO)?, intensity: spec.colour("intensity", Vec3::splat(10.0))?.into() });
        }
        "spot" => {
            let p = at(Vec3::ZERO)?;
            let to = spec.vector("to")?.unwrap_or(p - Vec3::Y);
            let angle = spec.number("angle", 30.0, |a| a > 0.0 && a <= 180.0, "more than 0 and at most 180")?;
            let rim = spec.number("rim", 0.2 * angle, |r| (0.0..=angle).contains(&r), "from 0 to the angle")?;
            let intensity = spec.colour("intensity", Vec3::splat(10.0))?;
            let angles = [angle - rim, angle].map(f32::to_radians);
            let spot = SpotLight::new(p, to - p, intensity, angles).map_err(|e| spec.bad(&e.to_string()))?;
            b.light(spot);
        }
        "sun" => {
            let direction = spec.vector("direction")?.unwrap_or(Vec3::new(-0.4, -1.0, 0.3));
            let irradiance = spec.colour("irradiance", Vec3::splat(3.0))?;
            let sun = DirectionalLight::new(direction, irradiance);
            b.light(sun.ok_or_else(|| spec.bad("`direction` is no direction"))?);
        }
        "sky" => b.light(EnvironmentLight::constant(spec.colour("radiance", Vec3::ONE)?)),
        "ball" => {
            let (centre, radius) = (at(Vec3::ZERO)?, spec.number("radius", 0.1, |r| r > 0.0, "positive")?);
            let radiance = spec.colour("radiance", Vec3::splat(50.0))?;
            let material = b.material(BlackMaterial);
            let shape = Shape::Sphere(Sphere { centre, radius });
            b.surface(SurfaceDef { shape, material, emission: Some((radiance.into(), Sides::One)) });
            return Ok(true);
        }
        other => return Err(spec.unknown("light", other, KINDS)),
    }
    Ok(false)
}
