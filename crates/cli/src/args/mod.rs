//! What can be said on the command line: one file per command, and one per group of `render`'s flags.
mod algorithm;
mod budget;
mod camera;
mod convert;
mod diff;
mod filter;
mod output;
mod picture;
mod render;
mod scene;
mod values;

pub(crate) use algorithm::AlgorithmArgs;
pub(crate) use budget::BudgetArgs;
pub(crate) use camera::CameraArgs;
pub(crate) use convert::ConvertArgs;
pub(crate) use diff::DiffArgs;
pub(crate) use output::{JsonStyle, OutputArgs};
pub(crate) use picture::PictureArgs;
pub(crate) use render::{Compat, RenderArgs};
pub(crate) use scene::SceneArgs;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

/// The whole command line.
#[derive(Debug, Parser)]
#[command(
    name = "sunfleck",
    version,
    about = "A renderer of the photon-mapping family: light through glass and water",
    after_help = "Exit codes: 0 done, 1 failed (or a limit of `diff` exceeded), 2 bad input, 130 interrupted.",
    max_term_width = 100
)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// One word after `sunfleck`.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene to pictures
    Render(Box<RenderArgs>),
    /// Tell what a scene holds
    Info(Box<InfoArgs>),
    /// Write a scene of any format as pbrt text, with meshes and pictures beside it
    Convert(Box<ConvertArgs>),
    /// List integrators, materials or file formats
    List(ListArgs),
    /// Compare a picture with a reference
    Diff(Box<DiffArgs>),
    /// Print a completion script for a shell
    Completions(CompletionsArgs),
}

/// `sunfleck info`.
#[derive(Debug, Args)]
pub(crate) struct InfoArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
    /// Read as NRenderer reads: two-sided area lights, a comma ends the numbers of a line
    #[arg(long, value_name = "PROGRAM", help_heading = "Compatibility")]
    pub(crate) compat: Option<Compat>,
    /// Print one JSON object instead of text
    #[arg(long, help_heading = "Output")]
    pub(crate) json: bool,
}

/// `sunfleck list`.
#[derive(Debug, Args)]
pub(crate) struct ListArgs {
    /// What to list
    pub(crate) what: Listing,
    /// Print a JSON array instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

/// What `sunfleck list` knows.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Listing {
    /// Algorithms and their settings
    Integrators,
    /// Models of scattering
    Materials,
    /// Files that can be read and written
    Formats,
}

/// `sunfleck completions`.
#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// Which shell
    pub(crate) shell: Shell,
}
