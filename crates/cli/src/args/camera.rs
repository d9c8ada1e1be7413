//! Where the eye is. NRenderer keeps these in its window, not in its files; the defaults are its own.
use super::values::{aspect, fov, non_negative, positive, vector};
use crate::load::projection;
use clap::Args;
use formats::load::Projection;
use glam::Vec3;

/// The eye. A value that is not given comes from the scene file, and where that says nothing, from NRenderer.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Camera")]
pub(crate) struct CameraArgs {
    /// Kind of camera: perspective, orthographic:HEIGHT (world units), spherical, or spherical:equal-area
    #[arg(long = "camera", value_name = "KIND", value_parser = projection)]
    pub(crate) projection: Option<Projection>,
    /// Where the eye is [default: 0,0,-3]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(crate) camera_position: Option<Vec3>,
    /// The point in the middle of the picture [default: 0,0,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(crate) look_at: Option<Vec3>,
    /// The direction that points up in the picture [default: 0,1,0]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    pub(crate) up: Option<Vec3>,
    /// Full vertical field of view in degrees, between 0 and 180 [default: 40]
    #[arg(long, value_name = "DEGREES", value_parser = fov, allow_hyphen_values = true)]
    pub(crate) fov: Option<f32>,
    /// Width of the picture's plane over its height [default: 1]
    ///
    /// As in NRenderer this is not tied to the number of pixels: a picture of 800×400 pixels needs `--aspect 2`, or it
    /// looks stretched.
    #[arg(long, value_name = "RATIO", value_parser = aspect, allow_hyphen_values = true)]
    pub(crate) aspect: Option<f32>,
    /// Distance to the plane in focus [default: that of the look-at point; 0.1 with --compat nrenderer]
    #[arg(long, value_name = "DISTANCE", value_parser = positive, allow_hyphen_values = true)]
    pub(crate) focus: Option<f32>,
    /// Diameter of the lens; 0 is a pinhole, where everything is in focus [default: 0]
    #[arg(long, value_name = "DIAMETER", value_parser = non_negative, allow_hyphen_values = true)]
    pub(crate) aperture: Option<f32>,
}

impl CameraArgs {
    /// Whether the eye is put somewhere else than the files say.
    pub(crate) fn is_placed(&self) -> bool {
        self.camera_position.is_some() || self.look_at.is_some() || self.up.is_some()
    }
}
