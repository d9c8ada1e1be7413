//! What is written and said.
use super::values::exposure;
use clap::{Args, ValueEnum};
use formats::image::Tone;
use std::path::PathBuf;

/// Pictures and messages.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct OutputArgs {
    /// Picture to write: .png (8 bits, toned), .exr, .hdr or .pfm (linear); may be repeated [default: the first scene
    /// file's name with .png, in the current folder]
    #[arg(short, long = "output", value_name = "FILE")]
    pub(crate) outputs: Vec<PathBuf>,
    /// Brightens PNG pictures by 2^EV, -32 to 32
    #[arg(long, value_name = "EV", default_value = "0", value_parser = exposure, allow_hyphen_values = true)]
    pub(crate) exposure: f32,
    /// Curve from radiance to PNG values [default: srgb, `nrenderer` with --compat nrenderer]
    #[arg(long, value_name = "CURVE")]
    pub(crate) tone: Option<ToneName>,
    /// Print JSON to standard output: one object at the end, or with `--json=lines` also one per pass
    #[arg(long, value_name = "STYLE", num_args = 0..=1, require_equals = true, default_missing_value = "object")]
    pub(crate) json: Option<JsonStyle>,
    /// Afterwards, show each sampler of the algorithm alone, and tell what becomes of the light of each lamp
    ///
    /// Beside the first picture, NAME.explain.exr has a layer for each sampler, as it counts in the picture and as if it
    /// were the only one; if the first picture is no .exr, they are pictures of its kind, NAME.explain-SAMPLER. Takes as
    /// long as 16 passes for each sampler, less if there were fewer than 8 passes.
    #[arg(long)]
    pub(crate) explain: bool,
    /// Say nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// How much JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum JsonStyle {
    /// One object at the end
    Object,
    /// One object a line: each pass, then the end
    Lines,
}

/// Curves for 8-bit pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ToneName {
    /// The sRGB curve
    Srgb,
    /// The square root, as NRenderer shows its pictures
    Nrenderer,
}

impl From<ToneName> for Tone {
    fn from(name: ToneName) -> Self {
        match name {
            ToneName::Srgb => Self::Srgb,
            ToneName::Nrenderer => Self::SquareRoot,
        }
    }
}
