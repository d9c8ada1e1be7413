//! `sunfleck convert`.
use super::{CameraArgs, Compat, SceneArgs};
use clap::Args;
use std::path::PathBuf;

/// All that `convert` takes: the scene as other commands take it, and where it goes.
#[derive(Debug, Args)]
pub(crate) struct ConvertArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
    /// Read as NRenderer reads: two-sided area lights, a comma ends the numbers of a line
    #[arg(long, value_name = "PROGRAM", help_heading = "Compatibility")]
    pub(crate) compat: Option<Compat>,
    /// The file to write, a name ending in .pbrt; meshes and pictures come into a folder beside it, NAME.files
    #[arg(required = true, value_name = "OUT.pbrt", index = 2)]
    pub(crate) output: PathBuf,
}
