//! Radii fitted to the error they leave.
use crate::scenes::{caustic, spec};
use sunfleck::{
    integrator::{Params, find},
    photon::{After, Bandwidth, Keep, Kernel, Radii, Schedule, Source},
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
