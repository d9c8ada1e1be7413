//! Size of the picture, and how a pixel sees it.
use super::{filter::filter, values::pixels};
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
    /// How a pixel sees the picture's plane [default: what the scene file says, or box; `nrenderer` with --compat nrenderer]
    ///
    /// Kinds and settings: box (radius), triangle (radius), gaussian (radius, sigma), mitchell (radius, b, c), catmull-rom
    /// (radius), lanczos (radius, tau), all in pixels, such as gaussian:radius=1.5:sigma=0.5. Box with its radius of 0.5 is the
    /// pixel's own square; nrenderer is two pixels wide around the lower left corner, as NRenderer's path tracer jitters.
    #[arg(long, value_name = "KIND", value_parser = filter)]
    pub(crate) filter: Option<Filter>,
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
