//! Flags that change what a scene file says.
use super::values::radiance;
use clap::{Args, ValueEnum};
use glam::Vec3;
use std::path::PathBuf;
use sunfleck::light::Sides;

/// Which scene.
#[derive(Debug, Args)]
#[command(next_help_heading = "Scene")]
pub(crate) struct SceneArgs {
    /// Scene files; several are put together into one scene
    #[arg(required = true, value_name = "FILE", help_heading = None::<&str>)]
    pub(crate) files: Vec<PathBuf>,
    /// Radiance of the surroundings, the same from everywhere, W/(m²·sr), each 0 or more
    #[arg(long, value_name = "R,G,B", value_parser = radiance, allow_hyphen_values = true, conflicts_with = "env")]
    pub(crate) ambient: Option<Vec3>,
    /// Surroundings from a picture in longitude and latitude: top row up, linear values are radiance
    #[arg(long, value_name = "IMAGE")]
    pub(crate) env: Option<PathBuf>,
    /// Let scene files include others from outside of their folder
    #[arg(long)]
    pub(crate) allow_outside: bool,
    /// Which sides of an area light emit; the outer side is that of U × V [default: one, `two` with --compat nrenderer]
    #[arg(long, value_name = "SIDES")]
    pub(crate) area_lights: Option<SidesName>,
}

/// Sides of an area light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SidesName {
    /// The outer side only
    #[value(alias = "one-sided")]
    One,
    /// Both sides, each with the full radiance
    #[value(alias = "two-sided")]
    Two,
}

impl From<SidesName> for Sides {
    fn from(name: SidesName) -> Self {
        match name {
            SidesName::One => Self::One,
            SidesName::Two => Self::Two,
        }
    }
}
