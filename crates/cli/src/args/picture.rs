//! Size of the picture, and how a pixel sees it.
use super::values::pixels;
use clap::{Args, ValueEnum};
use sunfleck::{film::Filter, scene::Scene, spectrum::ColorMode};

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
    /// What light is carried as
    #[arg(long, value_name = "MODE", default_value = "auto")]
    pub(crate) color: ColorArg,
}

/// Ways to carry colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ColorArg {
    /// By wavelength where a material parts colours, else as RGB
    Auto,
    /// As red, green and blue
    Rgb,
    /// By wavelength: dispersion, measured metals and lamps
    Spectral,
}

impl ColorArg {
    /// The mode for `scene`.
    pub(crate) fn of(self, scene: &Scene) -> ColorMode {
        match self {
            Self::Auto if scene.is_dispersive() => ColorMode::Spectral,
            Self::Auto | Self::Rgb => ColorMode::Rgb,
            Self::Spectral => ColorMode::Spectral,
        }
    }
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
