//! `sunfleck diff`.
use super::values::{non_negative_f64, percent, positive_percent, share};
use clap::Args;
use std::path::PathBuf;

/// All that `diff` takes. Errors are those of grey values, the mean of the channels; relMSE is the mean of
/// (x − r)² / (r² + 0.01). With any limit, pixels that are not finite count as exceeding it.
#[derive(Debug, Args)]
pub(crate) struct DiffArgs {
    /// Picture under test (.exr, .pfm, .hdr or .png)
    pub(crate) picture: PathBuf,
    /// Reference of the same size
    pub(crate) reference: PathBuf,
    /// Leave out pixels whose reference exceeds 20 times its median, and two pixels around them: lights and their
    /// mirror images
    #[arg(long)]
    pub(crate) mask_lights: bool,
    /// Leave out the pixels that are not black in this picture
    #[arg(long, value_name = "FILE")]
    pub(crate) mask: Option<PathBuf>,
    /// Side of the blocks whose means are compared, in pixels, 1 or more
    #[arg(long, value_name = "PIXELS", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub(crate) block: u32,
    /// How far a block's mean may be from the reference's
    #[arg(long, value_name = "PERCENT", default_value = "2%", value_parser = percent, allow_hyphen_values = true)]
    pub(crate) block_tolerance: f64,
    /// Write a map of the relative error, from black (none) to pale yellow
    #[arg(long, value_name = "FILE")]
    pub(crate) heatmap: Option<PathBuf>,
    /// Relative error at the bright end of the heat map, more than 0
    #[arg(long, value_name = "PERCENT", default_value = "50%", value_parser = positive_percent, allow_hyphen_values = true)]
    pub(crate) heatmap_scale: f64,
    /// Let the heat map tell too dark (blue) from too bright (red)
    #[arg(long)]
    pub(crate) signed: bool,
    /// Test whether the noise explains the differences (z-test): the variance of the reference's samples, by pixel and channel
    #[arg(long, value_name = "FILE")]
    pub(crate) variance: Option<PathBuf>,
    /// Samples a pixel of the picture, for --variance [default: the passes that its file tells]
    #[arg(long, value_name = "NUMBER", requires = "variance", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) samples: Option<u64>,
    /// Samples a pixel of the reference, for --variance [default: so many that it has no noise]
    #[arg(long, value_name = "NUMBER", requires = "variance", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) reference_samples: Option<u64>,
    /// Probability that the z-test refuses anything of a picture that is right, between 0 and 100%
    #[arg(long, value_name = "PERCENT", default_value = "1%", value_parser = share, allow_hyphen_values = true)]
    pub(crate) significance: f64,
    /// Fail if the z-test accepts a smaller share of the values
    #[arg(long, value_name = "PERCENT", requires = "variance", value_parser = percent, allow_hyphen_values = true)]
    pub(crate) min_accepted: Option<f64>,
    /// Fail if relMSE is larger
    #[arg(long, value_name = "NUMBER", value_parser = non_negative_f64, allow_hyphen_values = true)]
    pub(crate) max_relmse: Option<f64>,
    /// Fail if RMSE is larger
    #[arg(long, value_name = "NUMBER", value_parser = non_negative_f64, allow_hyphen_values = true)]
    pub(crate) max_rmse: Option<f64>,
    /// Fail if the mean of a channel is further from the reference's, relative to it
    #[arg(long, value_name = "PERCENT", value_parser = percent, allow_hyphen_values = true)]
    pub(crate) max_mean_error: Option<f64>,
    /// Fail if a smaller share of the blocks lies within the tolerance
    #[arg(long, value_name = "PERCENT", value_parser = percent, allow_hyphen_values = true)]
    pub(crate) min_blocks_within: Option<f64>,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub(crate) json: bool,
}
