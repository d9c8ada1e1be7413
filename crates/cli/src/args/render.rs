//! `sunfleck render`.
use super::{AlgorithmArgs, BudgetArgs, CameraArgs, OutputArgs, PictureArgs, SceneArgs};
use clap::{Args, ValueEnum};

/// All that `render` takes.
#[derive(Debug, Args)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    #[command(flatten)]
    pub(crate) algorithm: AlgorithmArgs,
    #[command(flatten)]
    pub(crate) budget: BudgetArgs,
    /// Behave as another program does
    ///
    /// `nrenderer`: a pixel is a box two pixels wide around its lower left corner, PNG values are square roots,
    /// `--depth N` (default 4) allows N−1 scatterings, 16 passes, area lights emit on both sides, and a comma in a scene
    /// file ends the numbers of its line.
    #[arg(long, value_name = "PROGRAM", help_heading = "Compatibility")]
    pub(crate) compat: Option<Compat>,
}

/// Programs whose habits can be taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Compat {
    /// The teaching renderer of Nankai University
    Nrenderer,
}
