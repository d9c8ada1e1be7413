//! Lights without extent, `KHR_lights_punctual`.
//!
//! Intensities are in candela and irradiances in lux, that is, W/sr and W/m² weighed by the eye; emissive surfaces are in
//! candela per square metre. One such unit is one unit of the picture, for all of them alike, so that lights and emissive
//! surfaces stand in the proportion that the file gives. Blender's exporter is an exception that cannot be passed over: in
//! its usual mode it multiplies lights, but not emission, by 683 lm/W (`PBR_WATTS_TO_LUMENS`), so for its files that is taken
//! back. Its other modes do not; a file of theirs has no light as bright as any in the usual mode.

use super::super::document::Fields;
use super::Importer;
use glam::{DAffine3, DVec3, Vec3};
use serde_json::Value;
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};
use sunfleck::light::{DirectionalLight, PointLight, Rim, SpotLight};

/// Lumens of a watt of green light (SI), and of all light in Blender.
const LUMENS_PER_WATT: f32 = 683.0;
/// A lamp of 1 W in Blender's usual mode has 54 candela, and its weakest sun hundreds of lux.
const BLENDER_LEAST: f32 = 50.0;

impl Importer<'_> {
    /// Adds the light of a node, if it has one.
    pub(super) fn light(&mut self, node: &Value, world: &DAffine3) {
        let Some(index) = node.extension("KHR_lights_punctual").and_then(|e| e.index("light")) else { return };
        let lights = self.root.extension("KHR_lights_punctual").map_or(&[][..], |e| e.items("lights"));
        let Some(light) = lights.get(index) else { return };
        let colour = Vec3::from_array(light.numbers("color", [1.0; 3])).max(Vec3::ZERO);
        let amount = colour * light.number("intensity", 1.0).max(0.0) / self.photometric_scale();
        if amount == Vec3::ZERO {
            return;
        }
        let p = world.translation.as_vec3();
        let axis = world.transform_vector3(DVec3::NEG_Z).normalize_or(DVec3::NEG_Z).as_vec3();
        match light.text("type") {
            Some("point") => self.target.light(PointLight { p, intensity: amount.into() }),
            Some("directional") => {
                if let Some(light) = DirectionalLight::new(axis, amount) {
                    self.target.light(light);
                }
            }
            Some("spot") => {
                let cone = light.field("spot");
                let outer = cone.number("outerConeAngle", FRAC_PI_4).clamp(1e-4, FRAC_PI_2);
                let inner = cone.number("innerConeAngle", 0.0).clamp(0.0, outer);
                if let Ok(light) = SpotLight::new(p, axis, amount, [inner, outer]) {
                    self.target.light(light.with_rim(Rim::Square));
                }
            }
            _ => {
                let path = format!("extensions.KHR_lights_punctual.lights[{index}]");
                self.note("gltf::light", path, "lights of this type are not known; it is left out");
            }
        }
    }

    /// What the numbers of lights are divided by.
    fn photometric_scale(&self) -> f32 {
        let generator = self.root.field("asset").text("generator").unwrap_or("");
        let lights = self.root.extension("KHR_lights_punctual").map_or(&[][..], |e| e.items("lights"));
        let is_bright = lights.iter().any(|l| l.number("intensity", 1.0) >= BLENDER_LEAST);
        let is_blender = generator.contains("Blender") && generator.contains("glTF");
        if is_blender && is_bright { LUMENS_PER_WATT } else { 1.0 }
    }
}
