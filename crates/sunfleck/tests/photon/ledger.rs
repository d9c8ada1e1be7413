//! The books of the light against closed forms: nothing is lost, nothing is made, and what is seen is told apart from what is
//! not.
use crate::scenes::{ball, eye, glass, matt, patch, spec, walls};
use glam::Vec3;
use sunfleck::{
    bsdf::{DielectricMaterial, Lobes, RoughDielectricMaterial},
    light::{LightId, PointLight},
    photon::{Account, Audit, Keep, Ledger, Radii, Source},
    scene::{MaterialId, Scene, SceneBuilder},
    spectrum::Rgb,
    walk::Limits,
};

const PATHS: u64 = 1 << 15;

fn audit(scene: &Scene, keep: Keep, scatterings: u32) -> Ledger {
    let limits = Limits { scatterings, ..Limits::default() };
    Audit { source: Source::plain(), keep, radii: Radii::fixed(0.05), limits, seed: 5, paths: PATHS }
        .of(scene, spec(64))
}

/// A lamp of `watts` in each channel.
fn lamp(b: &mut SceneBuilder, p: [f32; 3], watts: f32) {
    b.light(PointLight { p: p.into(), intensity: Rgb::splat(watts / (4.0 * std::f32::consts::PI)).into() });
}

/// The first `sides` walls of a cube of albedo `a` around a lamp of 3 W.
fn cube(a: f32, sides: usize) -> Scene {
    let mut b = SceneBuilder::new();
    let grey = matt(&mut b, Rgb::splat(a));
    walls().into_iter().take(sides).for_each(|w| b.add(w, grey));
    lamp(&mut b, [0.0, 0.0, 0.0], 3.0);
    b.camera(eye(Vec3::new(0.0, 0.0, -0.9), Vec3::ZERO, 60.0));
    b.build().expect("a scene")
}

fn only(ledger: &Ledger) -> Account {
    *ledger.account(LightId(0))
}

/// What was emitted went somewhere, watt by watt and path by path.
fn balances(a: &Account) {
    let spent = a.absorbed.watts + a.escaped.watts + a.cut.watts + a.roulette;
    assert!((spent / a.emitted.watts - 1.0).abs().max_element() < 1e-5, "{spent} of {}", a.emitted.watts);
    assert_eq!(a.emitted.count, a.absorbed.count + a.escaped.count + a.cut.count);
    // Roulette gives what it takes, to within the noise of so many paths.
    assert!((a.roulette / a.emitted.watts).abs().max_element() < 0.02, "{} {}", a.roulette, a.emitted.watts);
}

#[test]
fn in_a_closed_grey_box_all_light_is_absorbed() {
    let a = only(&audit(&cube(0.6, 6), Keep::All, 1000));
    balances(&a);
    assert_eq!((a.emitted.count, a.escaped.count, a.cut.count), (PATHS, 0, 0));
    assert!((a.emitted.watts.x / 3.0 - 1.0).abs() < 1e-4, "{}", a.emitted.watts);
    assert!((a.absorbed.watts.x / 3.0 - 1.0).abs() < 0.01, "{}", a.absorbed.watts);
    // The geometric series of the albedo.
    assert!((a.stored.watts.x / (3.0 / 0.4) - 1.0).abs() < 0.01, "{}", a.stored.watts);
}

#[test]
fn from_an_open_black_box_a_sixth_of_the_light_escapes() {
    let a = only(&audit(&cube(0.0, 5), Keep::All, 64));
    balances(&a);
    assert!((a.escaped.watts.x / 3.0 - 1.0 / 6.0).abs() < 0.002, "{}", a.escaped.watts);
    assert!((a.absorbed.watts.x / 3.0 - 5.0 / 6.0).abs() < 0.002, "{}", a.absorbed.watts);
}

#[test]
fn an_open_grey_box_and_a_limit_on_scatterings_share_the_light() {
    let open = only(&audit(&cube(0.6, 5), Keep::All, 64));
    balances(&open);
    assert!(open.escaped.watts.x > 0.6 && open.absorbed.watts.x > 1.5, "{open:?}");
    // One scattering on the light's side, then the limit: a² is left of what the first walls scatter.
    let cut = only(&audit(&cube(0.6, 6), Keep::All, 2));
    balances(&cut);
    assert!((cut.cut.watts.x / (3.0 * 0.6) - 1.0).abs() < 0.01, "{}", cut.cut.watts);
    assert!((cut.absorbed.watts.x / (3.0 * 0.4) - 1.0).abs() < 0.01, "{}", cut.absorbed.watts);
}

#[test]
fn over_a_wide_grey_plane_half_of_the_light_and_what_is_scattered_escape() {
    let mut b = SceneBuilder::new();
    let grey = matt(&mut b, Rgb::splat(0.6));
    b.add(patch([-1e4, 0.0, -1e4], [0.0, 0.0, 2e4], [2e4, 0.0, 0.0]), grey);
    lamp(&mut b, [0.0, 1.0, 0.0], 2.0);
    b.camera(eye(Vec3::new(0.0, 2.0, -3.0), Vec3::ZERO, 40.0));
    let a = only(&audit(&b.build().expect("a scene"), Keep::All, 64));
    balances(&a);
    assert!((a.escaped.watts.x / (2.0 * 0.8) - 1.0).abs() < 0.01, "{}", a.escaped.watts);
    assert!((a.absorbed.watts.x / (2.0 * 0.2) - 1.0).abs() < 0.01, "{}", a.absorbed.watts);
}

/// Two black floors far apart, each under a lamp; the camera sees all of the first and nothing of the second.
fn two_floors() -> Scene {
    let mut b = SceneBuilder::new();
    let black = matt(&mut b, Rgb::splat(0.2));
    for x in [0.0, 100.0] {
        b.add(patch([x - 0.1, 0.0, -0.1], [0.0, 0.0, 0.2], [0.2, 0.0, 0.0]), black);
        lamp(&mut b, [x, 0.5, 0.0], if x == 0.0 { 1.0 } else { 4.0 });
    }
    b.camera(eye(Vec3::new(0.0, 0.4, -0.4), Vec3::ZERO, 40.0));
    b.build().expect("a scene")
}

#[test]
fn photons_in_view_are_gathered_and_those_out_of_view_are_not() {
    let ledger = audit(&two_floors(), Keep::All, 64);
    let [seen, unseen] = *ledger.accounts() else { panic!("two lights") };
    balances(&seen);
    balances(&unseen);
    assert!((seen.emitted.watts.x / 1.0 - 1.0).abs() < 0.01 && (unseen.emitted.watts.x / 4.0 - 1.0).abs() < 0.01);
    assert!(seen.stored.count > 50 && unseen.stored.count > 200);
    assert_eq!((seen.gathered, seen.useful), (seen.stored, seen.stored.count));
    assert_eq!((unseen.gathered.count, unseen.useful), (0, 0));
}

#[test]
fn photons_below_a_floor_that_is_seen_from_above_are_not_gathered() {
    let mut b = SceneBuilder::new();
    let grey = matt(&mut b, Rgb::splat(0.5));
    b.add(patch([-1.0, 0.0, -1.0], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]), grey);
    lamp(&mut b, [0.0, -0.5, 0.0], 1.0);
    b.camera(eye(Vec3::new(0.0, 2.0, -2.0), Vec3::ZERO, 60.0));
    let a = only(&audit(&b.build().expect("a scene"), Keep::All, 64));
    assert!(a.stored.count > 1000);
    assert_eq!((a.gathered.count, a.useful), (0, 0));
}

/// A ball below a lamp of 3 W in a grey cube.
fn ball_in_a_cube(material: impl Fn(&mut SceneBuilder) -> MaterialId) -> Scene {
    let mut b = SceneBuilder::new();
    let (grey, material) = (matt(&mut b, Rgb::splat(0.6)), material(&mut b));
    walls().into_iter().for_each(|w| b.add(w, grey));
    b.add(ball([0.0, -0.5, 0.3], 0.3), material);
    lamp(&mut b, [0.0, 0.5, 0.0], 3.0);
    b.camera(eye(Vec3::new(0.0, 0.0, -0.9), Vec3::ZERO, 60.0));
    b.build().expect("a scene")
}

#[test]
fn what_narrow_lobes_scattered_last_counts_as_caustic_where_they_gather_nothing() {
    for (alpha, gathers, is_caustic) in
        [(0.09, Lobes::Wide, true), (0.09, Lobes::Narrow, false), (0.2, Lobes::Wide, false)]
    {
        let scene = ball_in_a_cube(|b| {
            let white = b.constant(Vec3::ONE);
            let glass = DielectricMaterial { eta: 1.5.into(), reflectance: white, transmittance: white };
            b.material(RoughDielectricMaterial { glass, alpha: alpha.into() })
        });
        let limits = Limits { gathers, ..Limits::default() };
        let audit = |keep| {
            let (source, radii) = (Source::plain(), Radii::fixed(0.05));
            only(&Audit { source, keep, radii, limits, seed: 5, paths: PATHS }.of(&scene, spec(64)))
        };
        let caustic = audit(Keep::LastDelta);
        assert_eq!(caustic.stored.count > 1000, is_caustic, "{alpha} {gathers:?}: {caustic:?}");
        assert_eq!(caustic.stored.count > 0, is_caustic, "{alpha} {gathers:?}: {caustic:?}");
    }
}

#[test]
fn what_mirrors_and_glass_scattered_last_is_kept_by_that_rule_alone() {
    let plain = only(&audit(&cube(0.6, 6), Keep::LastDelta, 64));
    assert_eq!(plain.stored.count, 0);
    let scene = ball_in_a_cube(|b| glass(b, 1.5));
    let caustic = only(&audit(&scene, Keep::LastDelta, 64));
    balances(&caustic);
    assert!(caustic.stored.count > 1000 && caustic.gathered.count > 100, "{caustic:?}");
    assert!(caustic.gathered.count < caustic.stored.count && caustic.useful <= caustic.gathered.count);
}

#[test]
fn the_books_are_the_same_on_any_number_of_threads() {
    let scene = cube(0.7, 5);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| audit(&scene, Keep::Scattered, 64))
    };
    assert!(on(1) == on(7) && on(1) == on(2));
}
