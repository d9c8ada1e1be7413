//! `sunfleck diff`: how far a picture is from its reference, and whether that is too far.
mod limits;
mod noise;
mod report;

use crate::{args::DiffArgs, console, destination, failure::Failure};
use formats::compare::{CompareError, CompareOptions, HeatMap, compare, grey, heat_map};
use formats::image::{RgbImage32, Tone, read_image, write_image};
use report::Report;

/// Pixels brighter than this many medians are lights, as are those up to [`GROWN`] pixels away.
const BRIGHT: f32 = 20.0;
const GROWN: u32 = 2;

pub(crate) fn run(args: &DiffArgs) -> Result<(), Failure> {
    args.heatmap.as_ref().map(|path| destination::check(path)).transpose()?;
    let file = read_image(&args.picture)?;
    let picture = &file.image;
    let reference = read_image(&args.reference)?.image;
    let mask = args.mask.as_ref().map(|path| mask_of(&read_image(path)?.image, picture, args));
    let options = CompareOptions {
        bright_factor: args.mask_lights.then_some(BRIGHT),
        bright_grow: GROWN,
        mask: mask.transpose()?,
        block: args.block,
        ..CompareOptions::default()
    };
    let comparison = compare(picture, &reference, &options).map_err(|e| refused(&e))?;
    let noise = noise::test(args, &file, &reference, options.mask.as_deref())?;
    let exceeded = limits::exceeded(args, &comparison, noise.as_ref());
    let report = Report::new(args, (picture.width, picture.height), &comparison, noise, &exceeded);
    let told = if args.json { console::print_json(&report) } else { console::print(&report.text()) };
    if let Some(path) = &args.heatmap {
        let kind = if args.signed { HeatMap::Signed } else { HeatMap::Absolute };
        let map = heat_map(picture, &reference, kind, args.heatmap_scale as f32).map_err(|e| refused(&e))?;
        write_image(path, &map.into(), Tone::Srgb).map_err(|e| Failure::Work(e.into()))?;
    }
    told?;
    if exceeded.is_empty() { Ok(()) } else { Err(Failure::Work(anyhow::Error::msg(exceeded.join("; ")))) }
}

fn refused(error: &CompareError) -> Failure {
    Failure::input(error.to_string())
}

/// True where `mask` is not black. Its size is checked here, since another one of as many pixels would pass later.
fn mask_of(mask: &RgbImage32, picture: &RgbImage32, args: &DiffArgs) -> Result<Vec<bool>, Failure> {
    if (mask.width, mask.height) != (picture.width, picture.height) {
        return Err(Failure::input(format!(
            "the mask has {}×{} pixels, but {} {}×{}",
            mask.width,
            mask.height,
            args.picture.display(),
            picture.width,
            picture.height
        )));
    }
    Ok(mask.data.iter().map(|p| grey(*p) > 0.0).collect())
}
