//! What `diff` prints.
use super::limits::{blocks_within, mean_error};
use crate::{args::DiffArgs, table::aligned};
use formats::compare::{Channel, Comparison, ZTest};
use serde::Serialize;

/// All figures of a comparison.
#[derive(Debug, Serialize)]
pub(super) struct Report<'a> {
    picture: String,
    reference: String,
    width: u32,
    height: u32,
    pixels_compared: usize,
    pixels_masked: usize,
    pixels_not_finite: usize,
    reference_pixels_not_finite: usize,
    mean: [f64; 3],
    reference_mean: [f64; 3],
    /// Not finite, hence `null` in JSON, where the reference is black.
    mean_ratio: [f64; 3],
    worst_mean_error: f64,
    rmse: f64,
    rmse_channels: [f64; 3],
    relmse: f64,
    relmse_trimmed: f64,
    blocks: Blocks,
    /// With `--variance`.
    z_test: Option<Noise>,
    /// Limits that were exceeded, in words.
    exceeded: &'a [String],
}

#[derive(Debug, Serialize)]
struct Blocks {
    size: u32,
    count: usize,
    tolerance: f64,
    within: f64,
    worst: Option<Worst>,
}

#[derive(Debug, Serialize)]
struct Noise {
    significance: f64,
    values: usize,
    accepted: f64,
    /// Standard deviations that a difference may have, and that the largest has.
    limit: f64,
    worst: f64,
}

#[derive(Debug, Serialize)]
struct Worst {
    x: u32,
    y: u32,
    relative: f64,
}

impl<'a> Report<'a> {
    pub(super) fn new(
        args: &DiffArgs,
        (width, height): (u32, u32),
        c: &Comparison,
        z: Option<ZTest>,
        exceeded: &'a [String],
    ) -> Self {
        let significance = args.significance;
        let noise =
            |z: ZTest| Noise { significance, values: z.values, accepted: z.accepted, limit: z.limit, worst: z.worst };
        let worst = |b: &formats::compare::Block| Worst { x: b.x, y: b.y, relative: b.relative(Channel::Grey) };
        Self {
            picture: args.picture.display().to_string(),
            reference: args.reference.display().to_string(),
            width,
            height,
            pixels_compared: c.pixels,
            pixels_masked: c.masked,
            pixels_not_finite: c.non_finite,
            reference_pixels_not_finite: c.reference_non_finite,
            mean: c.means.image,
            reference_mean: c.means.reference,
            mean_ratio: c.means.ratio,
            worst_mean_error: mean_error(c),
            rmse: c.rmse_grey,
            rmse_channels: c.rmse,
            relmse: c.rel_mse,
            relmse_trimmed: c.rel_mse_trimmed,
            blocks: Blocks {
                size: c.blocks.size,
                count: c.blocks.blocks.len(),
                tolerance: args.block_tolerance,
                within: blocks_within(c, args.block_tolerance),
                worst: c.blocks.worst(Channel::Grey).map(worst),
            },
            z_test: z.map(noise),
            exceeded,
        }
    }

    /// The same for people.
    pub(super) fn text(&self) -> String {
        let three = |v: [f64; 3]| v.map(|x| format!("{x:.5}")).join(" ");
        let b = &self.blocks;
        let worst = b.worst.as_ref().map(|w| format!(", worst {:+.2}% at ({}, {})", 100.0 * w.relative, w.x, w.y));
        let not_finite = self.pixels_not_finite + self.reference_pixels_not_finite;
        let rows = [
            ("size", format!("{}×{}", self.width, self.height)),
            (
                "pixels",
                format!("{} compared, {} masked, {not_finite} not finite", self.pixels_compared, self.pixels_masked),
            ),
            ("mean", three(self.mean)),
            ("mean of reference", three(self.reference_mean)),
            ("ratio", three(self.mean_ratio)),
            ("RMSE", format!("{:.6}  (R G B {})", self.rmse, three(self.rmse_channels))),
            ("relMSE", format!("{:.6}", self.relmse)),
            ("relMSE trimmed", format!("{:.6}  (without the worst 0.1%)", self.relmse_trimmed)),
            (
                "block means",
                format!(
                    "{:.1}% of {} blocks of {}×{} within {}%{}",
                    100.0 * b.within,
                    b.count,
                    b.size,
                    b.size,
                    100.0 * b.tolerance,
                    worst.unwrap_or_default()
                ),
            ),
        ];
        let mut rows = rows.map(|(name, value)| [name.to_owned(), value]).to_vec();
        if let Some(z) = &self.z_test {
            let value = format!(
                "{:.3}% of {} values accepted, at {}% (limit {:.2}σ, worst {:.1}σ)",
                100.0 * z.accepted,
                z.values,
                100.0 * z.significance,
                z.limit,
                z.worst
            );
            rows.push(["z-test".to_owned(), value]);
        }
        aligned(&rows)
    }
}
