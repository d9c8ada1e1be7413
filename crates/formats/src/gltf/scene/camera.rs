//! The camera.

use super::super::document::Fields;
use super::Importer;
use crate::load::{CameraSettings, Projection};
use glam::{DAffine3, DVec3};
use serde_json::Value;
use sunfleck::camera::View;

/// Height of a picture of a given aspect, if nothing else says it.
const HEIGHT: f32 = 500.0;
/// Cameras in the wild say aspects that no picture has.
const MAX_ASPECT: f32 = 10.0;

impl Importer<'_> {
    /// Takes the camera of a node, if it has one and none was found before.
    pub(super) fn camera(&mut self, node: &Value, world: &DAffine3) {
        let Some(index) = node.index("camera") else { return };
        let Some(camera) = self.root.items("cameras").get(index) else { return };
        if self.target.camera.is_some() {
            return self.note("gltf::cameras", "cameras", "there are several; the first one is used");
        }
        let turn = |v: DVec3| world.transform_vector3(v).normalize_or(v);
        let (position, forward, up) = (world.translation, turn(DVec3::NEG_Z), turn(DVec3::Y));
        let view = View { position: position.as_vec3(), look_at: (position + forward).as_vec3(), up: up.as_vec3() };
        let is_mirrored = world.matrix3.determinant() < 0.0;
        let settings = CameraSettings { view, is_mirrored, ..CameraSettings::default() };
        let settings = match camera.text("type") {
            Some("orthographic") => orthographic(camera.field("orthographic"), settings),
            _ => perspective(camera.field("perspective"), settings),
        };
        if let Some(aspect) = settings.aspect {
            let hints = self.target.hints.get_or_insert_default();
            (hints.width, hints.height) = size(aspect);
        }
        self.target.camera = Some(settings);
    }
}

/// `ymag` is half of the height that is seen.
fn orthographic(lens: &Value, settings: CameraSettings) -> CameraSettings {
    let (xmag, ymag) = (lens.number("xmag", 1.0).abs(), lens.number("ymag", 1.0).abs());
    let height = if ymag > 0.0 { 2.0 * ymag } else { 1.0 };
    CameraSettings { projection: Projection::Orthographic(height), aspect: usable(xmag / ymag), ..settings }
}

fn perspective(lens: &Value, settings: CameraSettings) -> CameraSettings {
    let fov = lens.number("yfov", 0.8).to_degrees();
    let fov = if fov > 0.0 && fov < 179.0 { fov } else { settings.fov };
    CameraSettings { fov, aspect: usable(lens.number("aspectRatio", 0.0)), ..settings }
}

fn usable(aspect: f32) -> Option<f32> {
    (aspect.is_finite() && (1.0 / MAX_ASPECT..=MAX_ASPECT).contains(&aspect)).then_some(aspect)
}

/// Width and height of a picture.
fn size(aspect: f32) -> (Option<u32>, Option<u32>) {
    let width = if aspect >= 1.0 { HEIGHT * aspect } else { HEIGHT };
    (Some(width.round() as u32), Some((width / aspect).round() as u32))
}
