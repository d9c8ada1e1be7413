//! Size of the picture.
use super::values::pixels;
use clap::Args;

/// Size of the picture.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Picture")]
pub(crate) struct PictureArgs {
    /// Width in pixels [default: 500]
    #[arg(long, value_name = "PIXELS", value_parser = pixels, allow_hyphen_values = true)]
    pub(crate) width: Option<u32>,
    /// Height in pixels [default: 500]
    #[arg(long, value_name = "PIXELS", value_parser = pixels, allow_hyphen_values = true)]
    pub(crate) height: Option<u32>,
}
