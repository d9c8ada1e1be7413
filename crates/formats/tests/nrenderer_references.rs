//! Pictures of NRenderer's stock scenes beside converged ones by another renderer. Skipped where those are not at hand.
//!
//! Few passes, so that the suite stays quick: means are held to half a percent or one, blocks of 50 pixels to a few. The
//! long comparison, with 4,096 samples a pixel, is kept in `benches/runs`.
mod shared;

use formats::compare::{Channel, CompareOptions, Comparison, compare};
use formats::image::{RgbImage32, read_image};
use formats::scn::ScnOptions;
use formats::{LoadOptions, load};
use shared::shared;
use std::ops::ControlFlow;
use sunfleck::film::{FilmSpec, Filter};
use sunfleck::integrator::{Params, find};
use sunfleck::render::{Budget, Settings, render};
use sunfleck::spectrum::ColorMode;

/// What is rendered, and what it is compared with.
struct Case {
    scene: &'static str,
    reference: &'static str,
    integrator: &'static str,
    settings: &'static [(&'static str, &'static str)],
    filter: Filter,
    passes: u64,
    /// Pixels (column, row) that are not compared.
    leave_out: fn(u32, u32) -> bool,
}

/// The comparison, or `None` (with a note) where the files are not there.
fn against_reference(case: &Case) -> Option<Comparison> {
    let scene = shared(&format!("scenes/nrenderer/stock/{}", case.scene))?;
    let reference = shared(&format!("references/nrenderer/{}", case.reference))?;
    let options = LoadOptions { scn: ScnOptions { compat: true, ..ScnOptions::default() }, ..LoadOptions::default() };
    let mut loaded = load(&[scene], &options).expect("a stock scene loads");
    loaded.builder.camera(loaded.camera.build(1.0).expect("the default camera"));
    let world = loaded.builder.build().expect("a stock scene builds");
    let reference = read_image(&reference).expect("a reference opens").image;

    let mut params = Params::default();
    case.settings.iter().for_each(|(k, v)| params.set(*k, *v));
    let integrator = find(case.integrator).expect("a known algorithm").build(params).expect("known settings");
    let spec = FilmSpec { width: reference.width, height: reference.height, filter: case.filter };
    let settings =
        Settings { spec, seed: 1, color: ColorMode::Rgb, budget: Budget { passes: Some(case.passes), time: None } };
    let film = render(&world, integrator.as_ref(), &settings, |_, _| ControlFlow::Continue(()));
    let data = film.mean().iter().map(sunfleck::math::Vec3::to_array).collect();
    let picture = RgbImage32 { width: spec.width, height: spec.height, data };
    let places = (0..spec.height).flat_map(|y| (0..spec.width).map(move |x| (x, y)));
    let mask = Some(places.map(|(x, y)| (case.leave_out)(x, y)).collect());
    let options = CompareOptions { block: 50, mask, ..CompareOptions::default() };
    Some(compare(&picture, &reference, &options).expect("like sizes"))
}

/// Means by channel within `mean`, all but `outliers` of the blocks within `block`.
fn assert_agrees(case: &Case, mean: f64, block: f64, outliers: f64) {
    let Some(c) = against_reference(case) else { return };
    for (channel, (ours, theirs)) in c.means.image.iter().zip(&c.means.reference).enumerate() {
        let off = ours / theirs - 1.0;
        assert!(
            off.abs() < mean,
            "{} on {}: channel {channel} is off by {:.2} %",
            case.integrator,
            case.scene,
            100.0 * off
        );
    }
    let above = c.blocks.fraction_above(block, Channel::Grey);
    assert!(above <= outliers, "{} on {}: {:.1} % of the blocks are off", case.integrator, case.scene, 100.0 * above);
}

const CORNELL: Case = Case {
    scene: "path_tracing_cornel.scn",
    reference: "path_tracing_cornel_inf_box.exr",
    integrator: "path",
    settings: &[],
    filter: Filter::Box,
    passes: 16,
    leave_out: |_, _| false,
};

#[test]
fn path_tracing_gives_the_reference_of_the_cornell_room() {
    assert_agrees(&CORNELL, 0.005, 0.05, 0.04);
}

#[test]
fn path_tracing_gives_the_reference_at_nrenderers_depth_and_filter() {
    let reference = "path_tracing_cornel_d4_nrfilter.exr";
    let settings = &[("scatterings", "3")];
    assert_agrees(&Case { reference, settings, filter: Filter::NRenderer, ..CORNELL }, 0.005, 0.05, 0.04);
}

#[test]
fn photons_give_the_reference_of_the_cornell_room() {
    assert_agrees(&Case { integrator: "ppm", passes: 12, ..CORNELL }, 0.01, 0.05, 0.04);
}

#[test]
fn photons_give_the_reference_of_the_glass_ball() {
    let case =
        Case { scene: "pt_glass.scn", reference: "pt_glass_inf_box.exr", integrator: "ppm", passes: 12, ..CORNELL };
    assert_agrees(&case, 0.01, 0.05, 0.04);
}

#[test]
fn ray_casting_gives_nrenderers_own_picture() {
    let case = Case {
        scene: "ray_cast_cornel.scn",
        reference: "ray_cast_cornel_raycast.exr",
        integrator: "raycast",
        filter: Filter::NRenderer,
        passes: 1,
        // The seams of the walls lie on the picture's diagonals, and rays through pixel corners meet them exactly: either
        // wall is right there.
        leave_out: |x, y| x.abs_diff(y) <= 1 || (x + y).abs_diff(499) <= 1,
        ..CORNELL
    };
    assert_agrees(&case, 0.001, 0.01, 0.02);
}
