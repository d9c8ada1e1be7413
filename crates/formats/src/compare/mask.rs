//! Which pixels are left out: lamps seen directly are so bright that their edges would rule every figure.

use super::{CompareError, CompareOptions, grey};
use crate::image::RgbImage32;

/// True where the grey value exceeds `factor` times its median, and up to `grow` columns and rows around.
pub fn bright_mask(reference: &RgbImage32, factor: f32, grow: u32) -> Vec<bool> {
    let greys: Vec<f32> = reference.data.iter().map(|p| grey(*p)).collect();
    let limit = f64::from(factor) * median(greys.iter().copied().filter(|g| g.is_finite()).collect());
    let mut mask: Vec<bool> = greys.iter().map(|g| f64::from(*g) > limit).collect();
    let (width, height) = (reference.width as usize, reference.height as usize);
    for y in 0..height {
        grow_line(&mut mask[y * width..(y + 1) * width], grow as usize);
    }
    let mut column = vec![false; height];
    for x in 0..width {
        for (y, c) in column.iter_mut().enumerate() {
            *c = mask[y * width + x];
        }
        grow_line(&mut column, grow as usize);
        for (y, c) in column.iter().enumerate() {
            mask[y * width + x] = *c;
        }
    }
    mask
}

/// Both masks of the options together.
pub(super) fn combined(reference: &RgbImage32, options: &CompareOptions) -> Result<Vec<bool>, CompareError> {
    let pixels = reference.data.len();
    let mut mask = match options.bright_factor {
        Some(factor) => bright_mask(reference, factor, options.bright_grow),
        None => vec![false; pixels],
    };
    if let Some(given) = &options.mask {
        if given.len() != pixels {
            return Err(CompareError::MaskSize { mask: given.len(), pixels });
        }
        mask.iter_mut().zip(given).for_each(|(m, g)| *m |= g);
    }
    Ok(mask)
}

/// Sets what is at most `reach` away from a set entry.
fn grow_line(line: &mut [bool], reach: usize) {
    let set: Vec<usize> = (0..line.len()).filter(|i| line[*i]).collect();
    for i in set {
        let end = (i + reach + 1).min(line.len());
        line[i.saturating_sub(reach)..end].fill(true);
    }
}

/// The middle value, or the mean of the two middle ones; 0 of nothing.
fn median(mut values: Vec<f32>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    let even = values.len().is_multiple_of(2);
    let (below, upper, _) = values.select_nth_unstable_by(middle, f32::total_cmp);
    let upper = f64::from(*upper);
    if !even {
        return upper;
    }
    let lower = below.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    f64::midpoint(f64::from(lower), upper)
}
