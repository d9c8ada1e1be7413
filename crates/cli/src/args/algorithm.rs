//! Which algorithm, with which settings.
use super::values::{bytes, key_value, scatterings};
use clap::{Args, builder::PossibleValuesParser};
use sunfleck::integrator::REGISTRY;

/// What `render` uses when nothing is said.
pub(crate) const DEFAULT_INTEGRATOR: &str = "unified";

/// The algorithm. Shorthands are settings under a flag of their own; an algorithm without them says so.
#[derive(Debug, Args)]
#[command(next_help_heading = "Algorithm")]
pub(crate) struct AlgorithmArgs {
    /// Algorithm; `sunfleck list integrators` tells what each is for [default: unified]
    #[arg(long, value_name = "NAME", hide_possible_values = true,
        value_parser = PossibleValuesParser::new(REGISTRY.iter().map(|e| e.name)))]
    pub(crate) integrator: Option<String>,
    /// A setting of the algorithm, such as `--set roulette-after=8`; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = key_value)]
    pub(crate) settings: Vec<(String, String)>,
    /// Scatterings on a path from light to eye at most, 0 to 10000 [default: 64]
    ///
    /// 0 shows only the lights themselves, 1 is direct light. With `--compat nrenderer` it is NRenderer's depth N of
    /// at least 1, which allows N−1 scatterings, and the default is 4. NRenderer's default is too small for glass,
    /// where one bead takes two scatterings; Russian roulette keeps 64 affordable.
    #[arg(long, value_name = "N", value_parser = scatterings, allow_hyphen_values = true)]
    pub(crate) depth: Option<u32>,
    /// Photons or light paths per pass: short for `--set photons=…`
    #[arg(long, value_name = "N")]
    pub(crate) photons: Option<String>,
    /// Photons per estimate: short for `--set nearest=…`
    #[arg(long, value_name = "N")]
    pub(crate) nearest: Option<String>,
    /// Radius within which photons count: short for `--set radius=…`
    #[arg(long, value_name = "R")]
    pub(crate) radius: Option<String>,
    /// How the radius shrinks from pass to pass: short for `--set alpha=…`
    #[arg(long, value_name = "A")]
    pub(crate) alpha: Option<String>,
    /// Whether light is sent to where the camera needs it: short for `--set aim=…`
    #[arg(long, value_name = "on|off")]
    pub(crate) aim: Option<String>,
    /// Memory for what light paths leave behind, such as 512MiB or 2GB [default: a quarter of the machine's]
    ///
    /// Where it is too little for a pass, the pass is split into parts, one after the other. Short for
    /// `--set memory=…`, which counts bytes.
    #[arg(long, value_name = "SIZE", value_parser = bytes)]
    pub(crate) memory: Option<u64>,
    /// Final gathering: short for `--set final-gather=…`
    #[arg(long, value_name = "VALUE")]
    pub(crate) final_gather: Option<String>,
}

impl AlgorithmArgs {
    /// The word of the algorithm.
    pub(crate) fn name(&self) -> &str {
        self.integrator.as_deref().unwrap_or(DEFAULT_INTEGRATOR)
    }
}
