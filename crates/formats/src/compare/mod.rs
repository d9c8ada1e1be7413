//! How much two pictures differ: means, squared errors, block means, and a map of where.
//!
//! Pure arithmetic on [`RgbImage32`]; no files, no thresholds of what is good.

mod blocks;
mod heat;
mod mask;
#[cfg(test)]
mod tests;
mod z_test;

pub use blocks::{Block, BlockGrid, Channel};
pub use heat::{HeatMap, heat_map};
pub use mask::bright_mask;
pub use z_test::{Noisy, ZTest, z_test};

use crate::image::RgbImage32;

/// What is compared.
#[derive(Clone, Debug)]
pub struct CompareOptions {
    /// Leave out pixels whose grey reference exceeds this many times its median (lamps and their mirror images).
    pub bright_factor: Option<f32>,
    /// Leave out the neighbours of such pixels too, up to this many columns and rows away.
    pub bright_grow: u32,
    /// Further pixels to leave out: true where left out, row by row.
    pub mask: Option<Vec<bool>>,
    /// The trimmed error leaves out this part of the pixels, the worst ones; in [0, 1).
    pub trim: f64,
    /// Edge of a block, in pixels; at least 1.
    pub block: u32,
}

impl Default for CompareOptions {
    fn default() -> Self {
        Self { bright_factor: Some(20.0), bright_grow: 2, mask: None, trim: 0.001, block: 16 }
    }
}

/// Why two pictures cannot be compared.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CompareError {
    /// Their sizes differ.
    #[error("the picture has {}×{} pixels, but the reference {}×{}", .image.0, .image.1, .reference.0, .reference.1)]
    Size {
        /// Columns and rows of the picture.
        image: (u32, u32),
        /// Columns and rows of the reference.
        reference: (u32, u32),
    },
    /// The mask does not fit.
    #[error("the mask has {mask} pixels, but the picture {pixels}")]
    MaskSize {
        /// Entries of the mask.
        mask: usize,
        /// Pixels of the picture.
        pixels: usize,
    },
    /// No pixel is left to compare.
    #[error("no pixel is left to compare: {masked} are masked, {non_finite} are not finite")]
    Nothing {
        /// Pixels left out by masks.
        masked: usize,
        /// Pixels left out because a value is not finite.
        non_finite: usize,
    },
}

/// How a picture differs from its reference.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Pixels that were compared.
    pub pixels: usize,
    /// Pixels left out by masks.
    pub masked: usize,
    /// Pixels left out because the picture is not finite there.
    pub non_finite: usize,
    /// Pixels left out because only the reference is not finite there.
    pub reference_non_finite: usize,
    /// Means over the compared pixels.
    pub means: Means,
    /// Means over all finite pixels, masked or not.
    pub whole_means: Means,
    /// Root of the mean squared difference of R, G, B.
    pub rmse: [f64; 3],
    /// The same of grey.
    pub rmse_grey: f64,
    /// mean((x − r)² / (r² + 0.01)) of grey values x of the picture and r of the reference.
    pub rel_mse: f64,
    /// The same without the worst pixels.
    pub rel_mse_trimmed: f64,
    /// Means of square blocks, which tell bias from noise.
    pub blocks: BlockGrid,
}

/// Means of both pictures, and image over reference.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Means {
    /// R, G, B of the picture.
    pub image: [f64; 3],
    /// R, G, B of the reference.
    pub reference: [f64; 3],
    /// Picture over reference; not finite where the reference is black.
    pub ratio: [f64; 3],
    /// The same of grey.
    pub ratio_grey: f64,
}

/// The mean of the channels.
pub fn grey(pixel: [f32; 3]) -> f32 {
    (pixel[0] + pixel[1] + pixel[2]) / 3.0
}

/// Squared difference over the squared reference; 0.01 keeps dark pixels from ruling.
fn relative_square(x: f64, r: f64) -> f64 {
    (x - r).powi(2) / (r * r + 0.01)
}

/// Compares a picture with its reference.
///
/// # Errors
/// Sizes differ, or no pixel is left.
pub fn compare(
    image: &RgbImage32,
    reference: &RgbImage32,
    options: &CompareOptions,
) -> Result<Comparison, CompareError> {
    check_sizes(image, reference)?;
    let masked = mask::combined(reference, options)?;
    let pairs = || image.data.iter().zip(&reference.data).map(|(x, r)| (*x, *r));
    let is_finite = |p: [f32; 3]| p.iter().all(|x| x.is_finite());
    let kept: Vec<bool> = pairs().zip(&masked).map(|((x, r), m)| !m && is_finite(x) && is_finite(r)).collect();
    let open = || pairs().zip(&masked).filter(|(_, m)| !**m).map(|(pair, _)| pair);
    let non_finite = open().filter(|(x, _)| !is_finite(*x)).count();
    let reference_non_finite = open().filter(|(x, r)| is_finite(*x) && !is_finite(*r)).count();
    let compared: Vec<_> = pairs().zip(&kept).filter(|(_, k)| **k).map(|(pair, _)| pair).collect();
    let masked = masked.iter().filter(|m| **m).count();
    if compared.is_empty() {
        return Err(CompareError::Nothing { masked, non_finite: non_finite + reference_non_finite });
    }
    let relative = |(x, r): &([f32; 3], [f32; 3])| relative_square(f64::from(grey(*x)), f64::from(grey(*r)));
    let mut relative: Vec<f64> = compared.iter().map(relative).collect();
    let rmse =
        |value: &dyn Fn([f32; 3]) -> f64| mean(compared.iter().map(|(x, r)| (value(*x) - value(*r)).powi(2))).sqrt();
    Ok(Comparison {
        pixels: compared.len(),
        masked,
        non_finite,
        reference_non_finite,
        means: means(&compared),
        whole_means: means(&pairs().filter(|(x, r)| is_finite(*x) && is_finite(*r)).collect::<Vec<_>>()),
        rmse: [0, 1, 2].map(|c| rmse(&|p| f64::from(p[c]))),
        rmse_grey: rmse(&|p| f64::from(grey(p))),
        rel_mse: mean(relative.iter().copied()),
        rel_mse_trimmed: trimmed_mean(&mut relative, options.trim),
        blocks: BlockGrid::new(image, reference, &kept, options.block.max(1)),
    })
}

fn check_sizes(image: &RgbImage32, reference: &RgbImage32) -> Result<(), CompareError> {
    let (a, b) = ((image.width, image.height), (reference.width, reference.height));
    if a == b && image.data.len() == reference.data.len() {
        return Ok(());
    }
    Err(CompareError::Size { image: a, reference: b })
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_usize), |(sum, count), x| (sum + x, count + 1));
    sum / count as f64
}

/// The mean without the largest `trim` of the values; reorders them.
fn trimmed_mean(values: &mut [f64], trim: f64) -> f64 {
    let drop = ((values.len() as f64 * trim.clamp(0.0, 1.0)) as usize).min(values.len() - 1);
    let keep = values.len() - drop;
    values.select_nth_unstable_by(keep - 1, f64::total_cmp);
    mean(values[..keep].iter().copied())
}

fn means(pairs: &[([f32; 3], [f32; 3])]) -> Means {
    let image = [0, 1, 2].map(|c| mean(pairs.iter().map(|(x, _)| f64::from(x[c]))));
    let reference = [0, 1, 2].map(|c| mean(pairs.iter().map(|(_, r)| f64::from(r[c]))));
    let sum = |m: [f64; 3]| m.iter().sum::<f64>();
    Means {
        image,
        reference,
        ratio: [0, 1, 2].map(|c| image[c] / reference[c]),
        ratio_grey: sum(image) / sum(reference),
    }
}
