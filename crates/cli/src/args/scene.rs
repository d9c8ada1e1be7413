//! Flags that change what a scene file says.
use super::values::{key_value, radiance};
use crate::load::replacement;
use clap::{Args, ValueEnum};
use glam::Vec3;
use std::path::PathBuf;
use sunfleck::light::Sides;

/// Which scene.
#[derive(Debug, Args)]
#[command(next_help_heading = "Scene")]
pub(crate) struct SceneArgs {
    /// Scene files; several are put together into one scene
    #[arg(required = true, value_name = "FILE", help_heading = None::<&str>, index = 1)]
    pub(crate) files: Vec<PathBuf>,
    /// Radiance of the surroundings, the same from everywhere, W/(m²·sr), each 0 or more
    #[arg(long, value_name = "R,G,B", value_parser = radiance, allow_hyphen_values = true, conflicts_with = "env")]
    pub(crate) ambient: Option<Vec3>,
    /// Surroundings from a picture in longitude and latitude: top row up, linear values are radiance
    #[arg(long, value_name = "IMAGE")]
    pub(crate) env: Option<PathBuf>,
    /// Another material for the one of that name: glass:bk7, metal:gold:roughness=0.1, diffuse:color=0.8,0.2,0.1, ...
    ///
    /// Kinds and settings: glass and thinglass (a glass by name such as bk7, sf11, diamond or water; ior, tint; glass also
    /// roughness), metal (by name such as gold or Cu; roughness, tint), mirror (color), diffuse (color), gloss (color, f0,
    /// roughness), black, null. Colours are one number or three with commas between. `*` stands for all materials, `#N` for
    /// number N of `sunfleck info`. May be repeated.
    #[arg(long = "material", value_name = "NAME=KIND", value_parser = replacement)]
    pub(crate) materials: Vec<(String, String)>,
    /// One more light: sun:direction=-1,-2,1:irradiance=3, point:at=0,3,0:intensity=10, ...
    ///
    /// Kinds and settings: point (at, intensity), spot (at, to, angle and rim in degrees, intensity), sun (direction in
    /// which it shines, irradiance), sky (radiance), ball (at, radius, radiance). May be repeated.
    #[arg(long = "add-light", value_name = "KIND", allow_hyphen_values = true)]
    pub(crate) lights: Vec<String>,
    /// A value for a name that a Mitsuba scene leaves open as `$NAME`; counts before the scene's own default
    #[arg(short = 'D', long = "define", value_name = "NAME=VALUE", value_parser = key_value)]
    pub(crate) defines: Vec<(String, String)>,
    /// Let scene files include others from outside of their folder
    #[arg(long)]
    pub(crate) allow_outside: bool,
    /// Fail where files are missing, and where a file breaks the rules of its format, even if no picture depends on it
    #[arg(long)]
    pub(crate) strict: bool,
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
