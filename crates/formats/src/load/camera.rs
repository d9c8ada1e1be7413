//! What a picture needs besides the scene. NRenderer keeps all of it in its window, so these are its defaults.

use crate::image::Tone;
use glam::Vec3;
use sunfleck::camera::{Perspective, PerspectiveError, View};
use sunfleck::film::Filter;

/// A perspective camera, as plain numbers that a user may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSettings {
    /// Position and direction.
    pub view: View,
    /// Full vertical angle in degrees.
    pub fov: f32,
    /// Diameter of the lens in world units; 0 makes everything sharp.
    pub aperture: f32,
    /// Distance of the sharp plane in world units; matters with an aperture only.
    pub focus_distance: f32,
}

impl Default for CameraSettings {
    fn default() -> Self {
        let view = View { position: Vec3::new(0.0, 0.0, -3.0), look_at: Vec3::ZERO, up: Vec3::Y };
        Self { view, fov: 40.0, aperture: 0.0, focus_distance: 0.1 }
    }
}

impl CameraSettings {
    /// The camera for pictures of `aspect` = width / height.
    ///
    /// # Errors
    /// A number out of its range.
    pub fn build(&self, aspect: f32) -> Result<Perspective, PerspectiveError> {
        let camera = Perspective::new(&self.view, self.fov, aspect)?;
        if self.aperture == 0.0 { Ok(camera) } else { camera.with_lens(self.aperture, self.focus_distance) }
    }
}

/// Settings of a picture when the user says nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderDefaults {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// How a pixel sees the picture's plane.
    pub filter: Filter,
    /// How linear values become 8-bit ones.
    pub tone: Tone,
}

impl Default for RenderDefaults {
    fn default() -> Self {
        Self { width: 500, height: 500, filter: Filter::Box, tone: Tone::Srgb }
    }
}
