//! What a picture needs besides the scene. NRenderer keeps all of it in its window, so these are its defaults.

use crate::image::Tone;
use glam::{Vec2, Vec3};
use sunfleck::camera::{Camera, CameraError, Orthographic, Perspective, Spherical, Unrolling, View};
use sunfleck::film::Filter;

/// How a camera makes a picture of what lies before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Projection {
    /// As an eye sees it, at the angle [`CameraSettings::fov`].
    #[default]
    Perspective,
    /// Along parallel rays, from a plane of this height in world units.
    Orthographic(f32),
    /// In all directions.
    Spherical(Unrolling),
}

/// A camera, as plain numbers that a user may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSettings {
    /// The kind of camera.
    pub projection: Projection,
    /// Position and direction.
    pub view: View,
    /// Full vertical angle in degrees, for perspective.
    pub fov: f32,
    /// Diameter of the lens in world units; 0 makes everything sharp.
    pub aperture: f32,
    /// Distance of the sharp plane in world units; matters with an aperture only.
    pub focus_distance: f32,
    /// Width of the picture's plane over its height, if the file says so.
    pub aspect: Option<f32>,
    /// Whether left and right are exchanged.
    pub is_mirrored: bool,
    /// How far the middle of the picture is from the line of sight, to the right and up, in heights of the picture.
    pub shift: [f32; 2],
}

impl Default for CameraSettings {
    fn default() -> Self {
        let view = View { position: Vec3::new(0.0, 0.0, -3.0), look_at: Vec3::ZERO, up: Vec3::Y };
        Self {
            projection: Projection::Perspective,
            view,
            fov: 40.0,
            aperture: 0.0,
            focus_distance: 0.1,
            aspect: None,
            is_mirrored: false,
            shift: [0.0; 2],
        }
    }
}

impl CameraSettings {
    /// The camera for pictures of `aspect` = width / height.
    ///
    /// # Errors
    /// A number out of its range.
    pub fn build(&self, aspect: f32) -> Result<Camera, CameraError> {
        let (shift, lens) = (Vec2::from_array(self.shift), self.aperture != 0.0);
        Ok(match self.projection {
            Projection::Perspective => {
                let camera = Perspective::new(&self.view, self.fov, aspect)?.with_shift(shift);
                let camera = if self.is_mirrored { camera.mirrored() } else { camera };
                if lens { camera.with_lens(self.aperture, self.focus_distance)? } else { camera }.into()
            }
            Projection::Orthographic(height) => {
                let camera = Orthographic::new(&self.view, height, aspect)?.with_shift(shift);
                let camera = if self.is_mirrored { camera.mirrored() } else { camera };
                if lens { camera.with_lens(self.aperture, self.focus_distance)? } else { camera }.into()
            }
            Projection::Spherical(unrolling) => {
                let camera = Spherical::new(&self.view, unrolling)?;
                if self.is_mirrored { camera.mirrored() } else { camera }.into()
            }
        })
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

/// What a file says about how to render it: defaults where the user says nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hints {
    /// Width in pixels.
    pub width: Option<u32>,
    /// Height in pixels.
    pub height: Option<u32>,
    /// How a pixel sees the picture's plane.
    pub filter: Option<Filter>,
    /// Passes, each of one sample a pixel.
    pub passes: Option<u64>,
    /// Scatterings on a path from light to eye at most.
    pub scatterings: Option<u32>,
    /// The algorithm, by its name in the file's own renderer. It is told of, not used.
    pub integrator: Option<String>,
    /// Photons in one pass, for algorithms that send them.
    pub photons: Option<u64>,
    /// First radius of the photons' kernel in world units, for algorithms that have one.
    pub radius: Option<f64>,
}
