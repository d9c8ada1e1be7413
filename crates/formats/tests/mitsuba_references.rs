//! Scenes of Mitsuba's own test suite beside its converged pictures, which come with the variance of each pixel's samples.
//! Skipped where those are not at hand.
//!
//! Each value must be as near to the reference as the noise of both asks for, at the level that Mitsuba's tests use: of
//! pictures that are right, one in a hundred has a value beyond.
mod shared;

use formats::compare::{Noisy, ZTest, z_test};
use formats::image::{RgbImage32, read_image};
use formats::{LoadOptions, load};
use glam::Vec3;
use shared::shared;
use std::ops::ControlFlow;
use std::path::Path;
use sunfleck::film::{FilmSpec, Filter};
use sunfleck::integrator::{Params, find};
use sunfleck::render::{Budget, Settings, render};
use sunfleck::spectrum::ColorMode;

/// Samples a pixel of the references.
const REFERENCE_SAMPLES: f32 = 32_000.0;

/// Variance of a sample at least.
const LEAST_VARIANCE: f32 = 1e-4;

/// Rendered by path tracing with next-event estimation; the outcome, or `None` (with a note) where the files are not there.
fn against_reference(scene: &str, reference: &str, passes: u64) -> Option<ZTest> {
    let folder = shared("scenes/mitsuba3-test-refs/tests/scenes")?;
    let (scene, reference) = (folder.join(scene), folder.join(reference));
    let mut loaded = load(std::slice::from_ref(&scene), &LoadOptions::default()).expect("the scene loads");
    let aspect = loaded.camera.aspect.expect("a sensor");
    loaded.builder.camera(loaded.camera.build(aspect).expect("the camera"));
    let world = loaded.builder.build().expect("the scene builds");
    let mut params = Params::default();
    loaded.hints.scatterings.iter().for_each(|n| params.set("scatterings", n.to_string()));
    let integrator = find("path").expect("a known algorithm").build(params).expect("known settings");
    let spec = FilmSpec { width: loaded.defaults.width, height: loaded.defaults.height, filter: Filter::Box };
    let budget = Budget { passes: Some(passes), time: None };
    let settings = Settings { spec, seed: 1, color: ColorMode::Rgb, budget };
    let film = render(&world, integrator.as_ref(), &settings, |_, _| ControlFlow::Continue(()));
    let picture = |data: Vec<Vec3>| {
        let data = data.iter().map(Vec3::to_array).collect();
        RgbImage32 { width: spec.width, height: spec.height, data }
    };
    let (mean, mut variance) = (picture(film.mean()), picture(film.variance_of_mean().expect("several passes")));
    let name = reference.display().to_string();
    let theirs = read_image(Path::new(&format!("{name}_ref_rgb.exr"))).expect("a reference opens").image;
    let of_samples = read_image(Path::new(&format!("{name}_ref_rgb_var.exr"))).expect("it has a variance").image;
    // Few samples may miss what is rare, and then tell of no variance; Mitsuba's tests have the same floor.
    let mut theirs_variance = of_samples;
    theirs_variance.data.iter_mut().flatten().for_each(|v| *v = v.max(LEAST_VARIANCE));
    for (ours, theirs) in variance.data.iter_mut().flatten().zip(theirs_variance.data.iter_mut().flatten()) {
        *ours = ours.max(*theirs / passes as f32);
        *theirs /= REFERENCE_SAMPLES;
    }
    let ours = Noisy { mean: &mean, variance: &variance };
    let test = z_test(ours, Noisy { mean: &theirs, variance: &theirs_variance }, 0.01).expect("like sizes");
    println!("{}: {test:?}", scene.display());
    Some(test)
}

fn assert_accepted(scene: &str, reference: &str, least: f64) {
    if let Some(test) = against_reference(scene, reference, 256) {
        assert!(test.accepted >= least, "{scene}: {test:?}");
    }
}

#[test]
fn a_sphere_in_the_sun_agrees_with_mitsuba() {
    assert_accepted("floating_sphere/test_directional_direct.xml", "floating_sphere/refs/test_directional", 0.99);
}

#[test]
fn instances_agree_with_mitsuba() {
    assert_accepted("instancing/test_instancing_path.xml", "instancing/refs/test_instancing", 0.99);
}

#[test]
fn mirrors_in_mirrors_agree_with_mitsuba() {
    assert_accepted("infinite_mirrors/scene_path.xml", "infinite_mirrors/refs/scene", 0.99);
}

#[test]
fn emitters_of_many_kinds_agree_with_mitsuba() {
    let scene = "various_emitters/test_various_emitters_ptracer.xml";
    assert_accepted(scene, "various_emitters/refs/test_various_emitters", 0.99);
}

#[test]
fn things_around_a_lamp_agree_with_mitsuba() {
    let scene = "participating_media/test_surf_area_light_volpath.xml";
    assert_accepted(scene, "participating_media/refs/test_surf_area_light", 0.99);
}

#[test]
fn rough_and_layered_materials_agree_with_mitsuba() {
    let names = [
        "roughdielectric",
        "textured_roughconductor",
        "roughplastic_linear",
        "roughplastic_nonlinear",
        "texturedprincipled1",
        "texturedprincipled2",
        "texturedprincipledthin",
    ];
    let test = |name: &&str| {
        let scene = format!("bsdf_spheres/test_{name}_path.xml");
        against_reference(&scene, &format!("bsdf_spheres/refs/test_{name}"), 256)
    };
    let refused: Vec<_> = names.iter().filter(|name| test(name).is_some_and(|t| t.accepted < 0.99)).collect();
    assert!(refused.is_empty(), "{refused:?}");
}
