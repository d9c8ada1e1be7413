//! Radii fitted to the error they leave.
use crate::scenes::{caustic, eye, make, matt, room, spec, walls};
use glam::Vec3;
use sunfleck::{
    integrator::{Params, find},
    light::SpotLight,
    photon::{After, Bandwidth, Keep, Kernel, Radii, Schedule, Source},
    scene::SceneBuilder,
    spectrum::Rgb,
    walk::Limits,
};

#[test]
fn radii_fitted_to_the_error_shrink_in_focus_and_forget_where_the_search_began() {
    let scene = caustic();
    let limits = Limits::default();
    let source = Source::plain();
    let bandwidth = Bandwidth {
        source: &source,
        spec: spec(64),
        limits,
        keep: Keep::Scattered,
        kernel: Kernel::Epanechnikov,
        schedule: Schedule::default(),
        seed: 1,
        paths: 100_000,
    };
    let after = After::new(64, Schedule::default());
    let start = Radii::from_footprints(&scene, spec(64), &limits, 1, 4.0, 1.0);
    let fit = |factor: f32| bandwidth.fit(&scene, start.clone().scaled(factor));
    let fitted = [1.0, 1.0 / 30.0, 30.0].map(fit);
    // Wide gathers where light is even, narrow ones where it is not.
    let tiles = fitted[0].ladders[0].len();
    let rungs: Vec<usize> = (0..tiles).map(|tile| fitted[0].best(0, tile, after)).collect();
    let count = |pick: fn(usize) -> bool| rungs.iter().filter(|r| pick(**r)).count();
    assert!(8 * count(|r| r == 0) >= tiles && 8 * count(|r| r >= 2) >= tiles, "{rungs:?}");
    let [first, others @ ..] = fitted.map(|f| f.radii.typical());
    for other in others {
        assert!((0.4..2.5).contains(&(other / first)), "{other} against {first}");
    }
}

#[test]
fn unified_forgets_a_bad_scale_but_keeps_a_radius_that_was_named() {
    let scene = caustic();
    let typical = |key: &str, value: &str| {
        let mut params = Params::default();
        params.set(key, value);
        let unified = find("unified").unwrap().build(params).unwrap();
        let audit = unified.prepare(&scene, spec(64), 1).audit(1, 1000).expect("there is a caustic");
        audit.radii.typical()
    };
    let [usual, wide] = ["1", "30"].map(|scale| typical("radius-scale", scale));
    assert!((0.4..2.5).contains(&(wide / usual)), "{wide} against {usual}");
    assert_eq!(typical("radius", "0.0123"), 0.0123);
}

#[test]
fn a_matt_room_has_photons_only_where_its_light_is_hard_to_find() {
    let lit_openly = room(Rgb::splat(8.0), 0.6).build().unwrap();
    // All light comes from a small bright spot on the ceiling.
    let mut b = SceneBuilder::new();
    let white = matt(&mut b, Rgb::splat(0.7));
    for wall in walls() {
        b.add(wall, white);
    }
    b.light(SpotLight::new(Vec3::ZERO, Vec3::Y, Rgb::splat(30.0), [0.06, 0.08]).unwrap());
    b.camera(eye(Vec3::new(0.0, 0.0, -0.95), Vec3::new(0.0, -0.6, 1.0), 70.0));
    let lit_by_a_spot = b.build().unwrap();
    for (scene, has_photons) in [(lit_openly, false), (lit_by_a_spot, true)] {
        let unified = make("unified", "");
        assert_eq!(unified.prepare(&scene, spec(64), 1).audit(1, 1000).is_some(), has_photons);
    }
}
