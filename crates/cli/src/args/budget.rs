//! When to stop, and how hard to work.
use super::values::{duration, passes, seed, threads};
use clap::Args;
use std::time::Duration;

/// When to stop; the first limit reached ends the render.
#[derive(Debug, Args)]
#[command(next_help_heading = "Budget")]
pub(crate) struct BudgetArgs {
    /// Passes, each a picture of its own; the result is their mean [default: 64 without --time]
    ///
    /// NRenderer's default is 16 samples of its depth 4, which leaves a noisy picture; `--compat nrenderer` restores both.
    #[arg(long, value_name = "N", value_parser = passes, allow_hyphen_values = true, conflicts_with = "spp")]
    pub(crate) passes: Option<u64>,
    /// Samples a pixel at least; every pass takes one, or what the algorithm's setting `samples` says
    #[arg(long, value_name = "N", value_parser = passes, allow_hyphen_values = true)]
    pub(crate) spp: Option<u64>,
    /// Time, such as 30s, 5m or 1h30m, preparation included; kept to within one pass
    #[arg(long, value_name = "DURATION", value_parser = duration, allow_hyphen_values = true)]
    pub(crate) time: Option<Duration>,
    /// Seed of all randomness; the same seed gives the same picture on any number of threads
    #[arg(long, value_name = "N", default_value = "0", value_parser = seed, allow_hyphen_values = true)]
    pub(crate) seed: u64,
    /// Threads, 1 to 1024 [default: all the machine has]
    #[arg(long, value_name = "N", value_parser = threads, allow_hyphen_values = true)]
    pub(crate) threads: Option<usize>,
}
