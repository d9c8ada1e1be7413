use super::{Channel, CompareError, CompareOptions, HeatMap, bright_mask, compare, grey, heat_map};
use crate::image::RgbImage32;

fn grey_image(width: u32, height: u32, values: &[f32]) -> RgbImage32 {
    RgbImage32 { width, height, data: values.iter().map(|v| [*v; 3]).collect() }
}

fn unmasked() -> CompareOptions {
    CompareOptions { bright_factor: None, ..CompareOptions::default() }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-6 * b.abs().max(1.0)
}

#[test]
fn a_picture_equals_itself() {
    let image = grey_image(3, 1, &[0.0, 1.0, 5.0]);
    let c = compare(&image, &image, &unmasked()).unwrap();
    assert_eq!((c.rel_mse, c.rmse_grey, c.means.ratio_grey), (0.0, 0.0, 1.0));
    assert_eq!(c.blocks.fraction_above(0.0, Channel::Worst), 0.0);
}

#[test]
fn the_figures_are_those_computed_by_hand() {
    // Differences 1, −0.5, 0; references 2, 1, 0.
    let c = compare(&grey_image(3, 1, &[3.0, 0.5, 0.0]), &grey_image(3, 1, &[2.0, 1.0, 0.0]), &unmasked()).unwrap();
    assert!(near(c.rel_mse, (1.0 / 4.01 + 0.25 / 1.01) / 3.0));
    assert!(near(c.rmse_grey, (1.25_f64 / 3.0).sqrt()));
    assert!(near(c.means.ratio_grey, 3.5 / 3.0) && near(c.means.image[1], 3.5 / 3.0));
    assert_eq!(c.pixels, 3);
}

#[test]
fn channels_are_kept_apart_and_grey_is_their_mean() {
    let image = RgbImage32 { width: 1, height: 1, data: vec![[1.0, 2.0, 6.0]] };
    let reference = RgbImage32 { width: 1, height: 1, data: vec![[2.0, 2.0, 2.0]] };
    let c = compare(&image, &reference, &unmasked()).unwrap();
    assert_eq!(grey(image.data[0]), 3.0);
    assert_eq!(c.means.ratio, [0.5, 1.0, 3.0]);
    assert_eq!(c.rmse, [1.0, 0.0, 4.0]);
    assert!(near(c.rel_mse, 1.0 / 4.01));
    assert_eq!(c.blocks.blocks[0].relative(Channel::Worst), 2.0);
    assert_eq!(c.blocks.blocks[0].relative(Channel::Grey), 0.5);
}

#[test]
fn the_trimmed_error_leaves_out_the_worst_pixels() {
    let mut values = vec![1.1; 2000];
    values[7] = 100.0;
    values[9] = 50.0;
    let c = compare(&grey_image(50, 40, &values), &grey_image(50, 40, &[1.0; 2000]), &unmasked()).unwrap();
    assert!(c.rel_mse > 5.0);
    assert!(near(c.rel_mse_trimmed, f64::from(1.1_f32 - 1.0).powi(2) / 1.01), "{}", c.rel_mse_trimmed);
}

#[test]
fn bright_pixels_and_their_neighbours_are_masked() {
    let mut values = vec![1.0; 49];
    values[3 * 7 + 3] = 21.0;
    let reference = grey_image(7, 7, &values);
    assert_eq!(bright_mask(&reference, 20.0, 2).iter().filter(|m| **m).count(), 25);
    assert_eq!(bright_mask(&reference, 20.0, 0).iter().filter(|m| **m).count(), 1);
    assert_eq!(bright_mask(&reference, 21.0, 2).iter().filter(|m| **m).count(), 0);
    let mut corner = vec![1.0; 49];
    corner[0] = 30.0;
    assert_eq!(bright_mask(&grey_image(7, 7, &corner), 20.0, 2).iter().filter(|m| **m).count(), 9);
    let c = compare(&grey_image(7, 7, &[1.0; 49]), &reference, &CompareOptions::default()).unwrap();
    assert_eq!((c.masked, c.pixels, c.rel_mse), (25, 24, 0.0));
    assert!(c.whole_means.ratio_grey < 1.0);
}

#[test]
fn a_given_mask_adds_to_the_other() {
    let options = CompareOptions { mask: Some(vec![true, false]), ..unmasked() };
    let c = compare(&grey_image(2, 1, &[9.0, 1.0]), &grey_image(2, 1, &[1.0, 1.0]), &options).unwrap();
    assert_eq!((c.pixels, c.rel_mse), (1, 0.0));
}

#[test]
fn blocks_average_noise_but_not_bias() {
    // Left block: ±50 % noise with the right mean. Right block: 10 % too bright.
    let image: Vec<f32> = (0..16).map(|i| if i % 4 < 2 { 0.5 + (i % 2) as f32 } else { 1.1 }).collect();
    let options = CompareOptions { block: 2, ..unmasked() };
    let c = compare(&grey_image(4, 4, &image), &grey_image(4, 4, &[1.0; 16]), &options).unwrap();
    assert_eq!(c.blocks.blocks.len(), 4);
    assert_eq!(c.blocks.fraction_above(0.05, Channel::Grey), 0.5);
    assert_eq!(c.blocks.fraction_above(0.2, Channel::Grey), 0.0);
    let worst = c.blocks.worst(Channel::Grey).unwrap();
    assert!(near(worst.relative(Channel::Grey), f64::from(1.1_f32) - 1.0) && worst.x == 2);
}

#[test]
fn blocks_at_the_border_are_smaller_and_masked_ones_are_left_out() {
    let options = CompareOptions { block: 2, mask: Some(vec![true, true, false]), ..unmasked() };
    let c = compare(&grey_image(3, 1, &[1.0; 3]), &grey_image(3, 1, &[1.0; 3]), &options).unwrap();
    assert_eq!(c.blocks.blocks.len(), 1);
    assert_eq!(c.blocks.blocks[0].x, 2);
}

#[test]
fn light_where_the_reference_is_black_is_above_any_limit() {
    let c = compare(&grey_image(1, 1, &[0.1]), &grey_image(1, 1, &[0.0]), &unmasked()).unwrap();
    assert_eq!(c.blocks.fraction_above(1000.0, Channel::Grey), 1.0);
}

#[test]
fn pixels_that_are_not_finite_are_counted_and_left_out() {
    let image = grey_image(4, 1, &[f32::NAN, f32::INFINITY, 1.0, 1.0]);
    let reference = grey_image(4, 1, &[1.0, f32::NAN, f32::NAN, 1.0]);
    let c = compare(&image, &reference, &unmasked()).unwrap();
    assert_eq!((c.non_finite, c.reference_non_finite, c.pixels, c.rel_mse), (2, 1, 1, 0.0));
}

#[test]
fn what_cannot_be_compared_says_why() {
    let (a, b) = (grey_image(2, 1, &[0.0; 2]), grey_image(1, 2, &[0.0; 2]));
    let error = compare(&a, &b, &unmasked()).unwrap_err();
    assert_eq!(error.to_string(), "the picture has 2×1 pixels, but the reference 1×2");
    assert_eq!(heat_map(&a, &b, HeatMap::Signed, 1.0).unwrap_err(), error);
    let mask = |m: Vec<bool>| CompareOptions { mask: Some(m), ..unmasked() };
    assert_eq!(compare(&a, &a, &mask(vec![true])).unwrap_err(), CompareError::MaskSize { mask: 1, pixels: 2 });
    let nothing = CompareError::Nothing { masked: 2, non_finite: 0 };
    assert_eq!(compare(&a, &a, &mask(vec![true; 2])).unwrap_err(), nothing);
}

#[test]
fn the_ramps_rise_in_lightness_and_tell_signs_apart() {
    let reference = grey_image(5, 1, &[1.0; 5]);
    let scale = 1.01_f32.sqrt().recip();
    let image = grey_image(5, 1, &[1.0, 1.25, 1.5, 1.75, 2.0]);
    let heat = heat_map(&image, &reference, HeatMap::Absolute, scale).unwrap();
    let luminance: Vec<f32> = heat.data.iter().map(|p| 0.21 * p[0] + 0.72 * p[1] + 0.07 * p[2]).collect();
    assert_eq!(heat.data[0], [0.0; 3]);
    assert!(luminance.windows(2).all(|w| w[0] < w[1]), "{luminance:?}");
    let image = grey_image(5, 1, &[0.0, 1.0, 2.0, f32::NAN, 9.0]);
    let signed = heat_map(&image, &reference, HeatMap::Signed, scale).unwrap().data;
    assert!(signed[0][2] > 2.0 * signed[0][0], "blue: {:?}", signed[0]);
    assert!(signed[1].iter().all(|c| *c > 0.9), "white: {:?}", signed[1]);
    assert!(signed[2][0] > 2.0 * signed[2][2], "red: {:?}", signed[2]);
    assert_eq!((signed[3], signed[4]), ([1.0, 0.0, 1.0], signed[2]));
}
