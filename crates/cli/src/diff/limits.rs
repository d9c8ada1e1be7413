//! Which of the limits given were exceeded.
use crate::args::DiffArgs;
use formats::compare::{Channel, Comparison, ZTest};

/// Share of the blocks whose grey mean is within `tolerance` of the reference's.
pub(super) fn blocks_within(c: &Comparison, tolerance: f64) -> f64 {
    1.0 - c.blocks.fraction_above(tolerance, Channel::Grey)
}

/// Largest distance of a channel's mean from the reference's, relative to it; infinite where only the reference is black.
pub(super) fn mean_error(c: &Comparison) -> f64 {
    let relative = |i: usize| {
        let (x, r) = (c.means.image[i], c.means.reference[i]);
        if x == r { 0.0 } else { ((x - r) / r).abs() }
    };
    (0..3).map(relative).fold(0.0, f64::max)
}

/// One line for each limit that was exceeded. A picture with values that are not finite exceeds any limit.
pub(super) fn exceeded(args: &DiffArgs, c: &Comparison, z: Option<&ZTest>) -> Vec<String> {
    let over = |name: &str, value: f64, limit: Option<f64>| {
        limit.filter(|l| value > *l).map(|l| format!("{name} is {value:.6}, more than {l}"))
    };
    let percent = |name: &str, value: f64, limit: Option<f64>| {
        let line = |l| format!("{name} is {:.3}%, more than {}%", 100.0 * value, 100.0 * l);
        limit.filter(|l| value > *l).map(line)
    };
    let within = blocks_within(c, args.block_tolerance);
    let few = |least: f64| {
        let (have, tolerance) = (100.0 * within, 100.0 * args.block_tolerance);
        format!("{have:.3}% of the blocks are within {tolerance}%, less than {}%", 100.0 * least)
    };
    let any_limit = [args.max_relmse, args.max_rmse, args.max_mean_error, args.min_blocks_within, args.min_accepted];
    let accepted = z.map_or(1.0, |z| z.accepted);
    let refused =
        |least: f64| format!("the z-test accepts {:.3}% of the values, less than {}%", 100.0 * accepted, 100.0 * least);
    let broken = c.non_finite > 0 && any_limit.iter().any(Option::is_some);
    [
        broken.then(|| format!("{} pixels of the picture are not finite", c.non_finite)),
        over("relMSE", c.rel_mse, args.max_relmse),
        over("RMSE", c.rmse_grey, args.max_rmse),
        percent("the error of a channel's mean", mean_error(c), args.max_mean_error),
        args.min_blocks_within.filter(|least| within < *least).map(few),
        args.min_accepted.filter(|least| accepted < *least).map(refused),
    ]
    .into_iter()
    .flatten()
    .collect()
}
