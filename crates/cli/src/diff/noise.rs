//! The z-test of `diff`: are the differences those of noise?
use super::refused;
use crate::{args::DiffArgs, failure::Failure};
use formats::compare::{Noisy, ZTest, z_test};
use formats::image::{ImageFile, RgbImage32, read_image};
use std::path::Path;

/// Variance of a sample at least: few samples may miss what is rare, and then tell of none. Mitsuba's own tests have this floor.
const LEAST_VARIANCE: f32 = 1e-4;

/// The test, if a variance was given. Pixels that are masked or not finite are left out.
pub(super) fn test(
    args: &DiffArgs,
    picture: &ImageFile,
    reference: &RgbImage32,
    mask: Option<&[bool]>,
) -> Result<Option<ZTest>, Failure> {
    let Some(path) = &args.variance else { return Ok(None) };
    let samples = args.samples.or_else(|| passes_of(picture)).ok_or_else(|| unknown(&args.picture))?;
    let of_samples = read_image(path)?.image;
    let image = &picture.image;
    let sizes = [image, reference, &of_samples].map(|i| (i.width, i.height));
    if sizes[0] != sizes[2] {
        let [(w, h), _, (vw, vh)] = sizes;
        return Err(Failure::input(format!(
            "the variance has {vw}×{vh} pixels, but {} {w}×{h}",
            args.picture.display()
        )));
    }
    let finite = |i: &RgbImage32, at: usize| i.data.get(at).is_some_and(|p| p.iter().all(|v| v.is_finite()));
    let is_kept =
        |at: &usize| mask.is_none_or(|m| !m[*at]) && [image, reference, &of_samples].iter().all(|i| finite(i, *at));
    let kept: Vec<usize> = (0..image.data.len()).filter(is_kept).collect();
    let row = |of: &dyn Fn(usize) -> [f32; 3]| {
        let data = kept.iter().map(|at| of(*at)).collect();
        RgbImage32 { width: kept.len() as u32, height: 1, data }
    };
    let over =
        |n: Option<u64>| row(&|at| of_samples.data[at].map(|v| n.map_or(0.0, |n| v.max(LEAST_VARIANCE) / n as f32)));
    let (x, r) = (row(&|at| image.data[at]), row(&|at| reference.data[at]));
    let (variance_x, variance_r) = (over(Some(samples)), over(args.reference_samples));
    let (x, r) = (Noisy { mean: &x, variance: &variance_x }, Noisy { mean: &r, variance: &variance_r });
    z_test(x, r, args.significance).map(Some).map_err(|e| refused(&e))
}

/// What our own pictures tell.
fn passes_of(picture: &ImageFile) -> Option<u64> {
    let told = picture.metadata.iter().find(|(name, _)| name.ends_with("passes"))?;
    told.1.parse().ok().filter(|n| *n > 0)
}

fn unknown(picture: &Path) -> Failure {
    Failure::input(format!("{} does not tell its samples a pixel: say --samples N", picture.display()))
}
