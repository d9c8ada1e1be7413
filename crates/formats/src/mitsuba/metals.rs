//! Metals by their chemical formula.

use super::document::Found;
use super::metals_table::METALS;
use super::props::Props;
use super::scene::Importer;
use super::spectra::Role;
use glam::Vec3;
use sunfleck::bsdf::ConductorMaterial;
use sunfleck::spectrum::named;

/// What reflects all light, whatever the angle: nearly nothing, with an extinction.
const PERFECT: (f32, f32) = (1e-4, 1.0);

impl Importer<'_, '_> {
    /// The metal that `eta` and `k` describe, or `material` names.
    pub(super) fn metal(&mut self, props: &Props) -> Found<ConductorMaterial> {
        let reflectance = self.input(props, &["specular_reflectance"], Vec3::ONE, Role::Reflectance)?.id;
        // The default of the old versions is copper, that of the new ones a perfect mirror.
        let default = if props.element.is_old { "Cu" } else { "none" };
        props.ignore(&["ext_eta"]);
        let word = props.string("material")?;
        if props.has("eta") || props.has("k") {
            let eta = self.input(props, &["eta"], Vec3::ZERO, Role::Index)?.id;
            let k = self.input(props, &["k"], Vec3::ONE, Role::Index)?.id;
            return Ok(ConductorMaterial { eta, k, reflectance });
        }
        let name = word.map_or(default, |w| w.value.as_str());
        let name = name.strip_suffix("_palik").unwrap_or(name);
        if name == "none" {
            let (eta, k) = PERFECT;
            let [eta, k] = [eta, k].map(|v| self.constant(Vec3::splat(v)).id);
            return Ok(ConductorMaterial { eta, k, reflectance });
        }
        let measured = [format!("metal-{name}-eta"), format!("metal-{name}-k")];
        if let [Some(eta), Some(k)] = measured.each_ref().map(|n| named(n)) {
            let [eta, k] = [eta, k].map(|n| self.target.builder().constant(n.colour()));
            return Ok(ConductorMaterial { eta, k, reflectance });
        }
        let Some((_, eta, k)) = METALS.iter().find(|(formula, ..)| *formula == name) else {
            let at = word.map_or(props.at(), |w| &w.at);
            return Err(at.unknown("metal", name, METALS.iter().map(|(formula, ..)| *formula).chain(["none"])));
        };
        let [eta, k] = [eta, k].map(|v| self.constant(Vec3::from_array(*v)).id);
        Ok(ConductorMaterial { eta, k, reflectance })
    }
}
