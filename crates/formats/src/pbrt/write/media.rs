//! Interiors, as media that absorb.

use super::Writer;
use super::text::{curve, numbers, ours, param, plain_index, quoted};
use sunfleck::medium::{Interior, InteriorId};
use sunfleck::scene::MaterialId;
use sunfleck::spectrum::{Curve, Wavelengths};

impl Writer<'_> {
    pub(super) fn media(&mut self) {
        for (i, interior) in self.scene.parts.interiors.iter().enumerate() {
            let priority = param("integer", "priority", &interior.priority.to_string());
            let exact = ours(&(plain_index("ior", &interior.ior) + &priority));
            let nothing = param("rgb", "sigma_s", "0 0 0");
            let line = format!(
                "MakeNamedMedium {} \"string type\" \"homogeneous\"{}{nothing}{exact}",
                name(InteriorId(i as u16)),
                sigma_a(interior)
            );
            self.line(line.trim_end());
        }
    }

    /// What lies behind the surfaces of `material`, in a scene that says so at all.
    pub(super) fn interface(&mut self, material: MaterialId) {
        let parts = self.scene.parts;
        if parts.interiors.is_empty() {
            return;
        }
        let inside = parts.fillings.get(material.0 as usize).copied().flatten().map_or("\"\"".to_owned(), name);
        self.line(&format!("MediumInterface {inside} \"\""));
    }
}

/// The name of an interior, in quotes.
fn name(id: InteriorId) -> String {
    quoted(&format!("interior {}", id.0))
}

/// The absorption coefficient.
fn sigma_a(interior: &Interior) -> String {
    match interior.color.curve() {
        None => {
            param("rgb", "sigma_a", &numbers(interior.sigma_a(Wavelengths::Rgb).to_rgb(Wavelengths::Rgb).to_array()))
        }
        Some(left) => curve("sigma_a", &Curve::new(|nm| -left.at(nm).clamp(1e-30, 1.0).ln() / interior.distance)),
    }
}
