//! Size of the picture, and how a pixel sees it.
use super::values::pixels;
use clap::{Args, ValueEnum};
use sunfleck::film::Filter;

/// Size of the picture, and how a pixel sees it.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Picture")]
pub(crate) struct PictureArgs {
    /// Width in pixels [default: 500]
    #[arg(long, value_name = "PIXELS", value_parser = pixels, allow_hyphen_values = true)]
    pub(crate) width: Option<u32>,
    /// Height in pixels [default: 500]
    #[arg(long, value_name = "PIXELS", value_parser = pixels, allow_hyphen_values = true)]
    pub(crate) height: Option<u32>,
    /// How a pixel sees the picture's plane [default: box, `nrenderer` with --compat nrenderer]
    #[arg(long, value_name = "FILTER")]
    pub(crate) filter: Option<FilterArg>,
}

/// Pixel filters by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FilterArg {
    /// The pixel's own square
    Box,
    /// Two pixels wide around the lower left corner, as NRenderer's path tracer jitters
    Nrenderer,
}

impl From<FilterArg> for Filter {
    fn from(f: FilterArg) -> Self {
        match f {
            FilterArg::Box => Self::Box,
            FilterArg::Nrenderer => Self::NRenderer,
        }
    }
}
