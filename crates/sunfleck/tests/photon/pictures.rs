//! Pictures made with photons: against closed forms, against path tracing, and against themselves.
use crate::scenes::{
    ball, caustic, eye, eye_in_glass, furnace_ball, furnace_box, glass, leaning, make, matt, mean, measure, patch,
    room, shoot, small_cornell, spec,
};
use glam::Vec3;
use sunfleck::{
    bsdf::{ConductorMaterial, PhongMaterial, RoughConductorMaterial},
    integrator::Integrator,
    light::{EnvironmentLight, Sides},
    scene::{Scene, SceneBuilder, SurfaceDef},
    shape::{Parallelogram, Shape},
    spectrum::Rgb,
};

/// Photon mapping with everything set for little blur.
const SHARP: &str = "photons=6000 nearest=8 max-radius=0.12";

#[test]
fn every_algorithm_gives_le_over_one_minus_albedo_in_a_furnace() {
    let (le, albedo) = (Rgb::new(1.0, 0.5, 2.0), Rgb::new(0.5, 0.3, 0.6));
    let want = le / (1.0 - albedo);
    let (sphere, cube) = (furnace_ball(le, albedo), furnace_box(le, albedo));
    for (name, settings, passes) in [
        ("path", "", 32),
        ("light", "", 128),
        ("ppm", "photons=4000 radius=0.05", 64),
        ("ppm", "photons=4000 radius=0.05 direct=photons kernel=epanechnikov", 64),
        ("photonmap", SHARP, 16),
        ("photonmap", "photons=8000 radius=0.05 kernel=cone", 16),
        ("photonmap", "photons=2000 nearest=8 max-radius=0.07 final-gather=2", 128),
    ] {
        let it = make(name, settings);
        // A gather near an edge also finds photons of the next wall, a little more than it misses of its own.
        let photons = !matches!(name, "path" | "light");
        for (scene, tolerance) in [(&sphere, 0.01), (&cube, if photons { 0.02 } else { 0.01 })] {
            let got = mean(&shoot(scene, &*it, spec(16), passes));
            assert!((got / want - 1.0).abs().max_element() < tolerance, "{name} {settings}: {got} instead of {want}");
        }
    }
}

/// An emitting sphere around a ball of glass, seen from `from`.
fn glass_in_light(from: Vec3) -> Scene {
    let mut b = SceneBuilder::new();
    let black = matt(&mut b, Rgb::ZERO);
    b.surface(SurfaceDef {
        shape: ball([0.0; 3], 10.0),
        material: black,
        emission: Some((Rgb::ONE.into(), Sides::Two)),
    });
    let clear = glass(&mut b, 1.5);
    b.add(ball([0.0; 3], 1.0), clear);
    b.camera(eye(from, if from == Vec3::ZERO { Vec3::Z } else { Vec3::ZERO }, 60.0));
    b.build().unwrap()
}

#[test]
fn lossless_glass_in_even_light_cannot_be_seen() {
    let scene = glass_in_light(Vec3::new(0.0, 0.0, -3.0));
    for (name, settings) in [("path", ""), ("ppm", "photons=10"), ("photonmap", "photons=10")] {
        let film = shoot(&scene, &*make(name, settings), spec(16), 64);
        for (i, p) in film.mean().iter().enumerate() {
            assert!((*p - 1.0).abs().max_element() < 1e-3, "{name}, pixel {i}: {p}");
        }
    }
}

#[test]
fn an_eye_inside_glass_sees_eta_squared_times_the_light_outside() {
    let scene = glass_in_light(Vec3::ZERO);
    for (name, settings) in [("path", ""), ("ppm", "photons=10"), ("photonmap", "photons=10")] {
        let got = mean(&shoot(&scene, &*make(name, settings), spec(16), 16));
        assert!((got / 2.25 - 1.0).abs().max_element() < 1e-3, "{name}: {got}");
    }
}

/// Both pictures agree block by block within noise and `bias`, and their means within 0.3 %.
fn agree(what: &str, scene: &Scene, settings: (&str, &str), batches: u64, passes: (u64, u64), bias: f64) {
    let path = measure(scene, &*make("path", ""), 32, batches, passes.0);
    let other = measure(scene, &*make(settings.0, settings.1), 32, batches, passes.1);
    let (worst, rms) = other.deviation(&path, bias);
    let ratio = other.mean() / path.mean();
    println!("{what}: mean {ratio:.5}, worst {worst:.2}, rms {rms:.2}");
    assert!((ratio - 1.0).abs() < 0.003, "{what}: the mean is {ratio} of what it should be");
    // With some fifteen degrees of freedom, one value in 50,000 is beyond 6; there are 48.
    assert!(worst < 6.0 && rms < 1.5, "{what}: worst deviation {worst}, root mean square {rms}");
}

#[test]
fn ppm_agrees_with_path_tracing_in_a_closed_room() {
    let scene = small_cornell();
    agree("connect", &scene, ("ppm", "photons=4000 radius=0.08"), 12, (48, 48), 0.005);
    agree("photons", &scene, ("ppm", "photons=4000 radius=0.08 direct=photons"), 12, (48, 48), 0.01);
}

#[test]
fn ppm_with_its_own_radius_agrees_with_path_tracing_after_some_hundred_passes() {
    let scene = room(Rgb::splat(8.0), 0.8).build().unwrap();
    agree("own radius", &scene, ("ppm", ""), 8, (64, 200), 0.01);
}

#[test]
fn photonmap_agrees_with_path_tracing_in_a_closed_room() {
    let scene = small_cornell();
    agree("nearest", &scene, ("photonmap", SHARP), 8, (48, 16), 0.01);
    agree("gather", &scene, ("photonmap", "photons=4000 nearest=12 max-radius=0.2 final-gather=4"), 8, (48, 8), 0.01);
}

#[test]
fn photons_agree_with_path_tracing_under_a_glass_ball() {
    let scene = caustic();
    agree("ppm", &scene, ("ppm", "photons=4000 radius=0.06"), 10, (96, 48), 0.01);
    agree("photonmap", &scene, ("photonmap", SHARP), 8, (96, 16), 0.02);
    let gather = "photons=4000 nearest=8 max-radius=0.15 final-gather=4";
    agree("gather", &scene, ("photonmap", gather), 8, (96, 8), 0.02);
}

#[test]
fn leaning_normals_agree_with_path_tracing() {
    let grey = leaning(|b| matt(b, Rgb::splat(0.8)));
    let glossy = leaning(|b| {
        let (diffuse, specular) = (b.constant(Rgb::splat(0.3)), b.constant(Rgb::splat(0.6)));
        b.material(PhongMaterial { diffuse, specular, exponent: 4.0 })
    });
    for (what, scene) in [("matt", &grey), ("glossy", &glossy)] {
        let ppm = "photons=4000 radius=0.06 direct=photons kernel=epanechnikov";
        agree(what, scene, ("ppm", ppm), 10, (32, 32), 0.01);
    }
}

#[test]
fn every_number_of_scatterings_agrees_with_path_tracing() {
    let (matt, clear, dipped) = (small_cornell(), caustic(), eye_in_glass());
    for (scene, limit) in
        [(&matt, 0), (&matt, 1), (&matt, 2), (&matt, 3), (&clear, 3), (&clear, 4), (&dipped, 2), (&dipped, 3)]
    {
        let picture = |name, settings: &str, passes| {
            let it = make(name, &format!("scatterings={limit} {settings}"));
            measure(scene, &*it, 16, 8, passes)
        };
        let path = picture("path", "", 128);
        for (name, settings, passes) in [
            ("ppm", "photons=4000 radius=0.08", 16),
            ("ppm", "photons=4000 radius=0.08 direct=photons", 16),
            ("photonmap", SHARP, 24),
            ("photonmap", "photons=2000 nearest=8 max-radius=0.2 final-gather=2", 24),
        ] {
            let other = picture(name, settings, passes);
            let (worst, _) = other.deviation(&path, 0.02);
            assert!(worst < 9.0, "{name} {settings}, {limit} scatterings: worst deviation {worst}");
            let ratio = other.mean() / path.mean();
            assert!((ratio - 1.0).abs() < 0.015, "{name} {settings}, {limit} scatterings: {ratio}");
        }
    }
}

#[test]
fn pictures_are_the_same_for_any_number_of_threads() {
    let scene = caustic();
    for (name, settings) in [
        ("ppm", "photons=3000"),
        ("photonmap", "photons=3000 samples=2"),
        ("photonmap", "photons=3000 final-gather=2 reshoot=off"),
        ("photonmap", "photons=3000 radius=0.2"),
    ] {
        let picture = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| shoot(&scene, &*make(name, settings), spec(24), 3))
        };
        let one = picture(1);
        assert!(one == picture(2) && one == picture(7), "{name} {settings}");
    }
}

#[test]
fn passes_are_pure_and_do_not_depend_on_those_before() {
    let scene = small_cornell();
    for (name, settings) in
        [("ppm", "photons=500"), ("photonmap", "photons=500"), ("photonmap", "photons=500 reshoot=off")]
    {
        let it = make(name, settings);
        let mut twice = shoot(&scene, &*it, spec(8), 2);
        twice.merge(&shoot(&scene, &*it, spec(8), 2));
        let four = shoot(&scene, &*it, spec(8), 4);
        assert!(twice != four, "{name} repeats itself");
        assert!(shoot(&scene, &*it, spec(8), 4) == four, "{name}");
    }
}

#[test]
fn coloured_light_keeps_its_colour_on_white_walls() {
    let mut b = SceneBuilder::new();
    let grey = matt(&mut b, Rgb::splat(0.7));
    for shape in crate::scenes::walls() {
        b.add(shape, grey);
    }
    let shape = patch([-0.3, 0.9, -0.3], [0.6, 0.0, 0.0], [0.0, 0.0, 0.6]);
    let colour = Rgb::new(3.0, 2.0, 0.5);
    b.surface(SurfaceDef { shape, material: grey, emission: Some((colour.into(), Sides::One)) });
    b.camera(eye(Vec3::new(0.0, 0.0, -0.9), Vec3::Z, 80.0));
    let scene = b.build().unwrap();
    for (name, settings) in [("ppm", "direct=photons"), ("ppm", ""), ("photonmap", ""), ("photonmap", "final-gather=2")]
    {
        for p in shoot(&scene, &*make(name, settings), spec(16), 2).mean() {
            assert!((p / p.x * colour.x / colour - 1.0).abs().max_element() < 1e-4, "{name} {settings}: {p}");
        }
    }
}

#[test]
fn no_pixel_is_black_or_broken_in_a_lit_room() {
    let scene = small_cornell();
    for (name, settings) in
        [("ppm", ""), ("photonmap", "photons=2000 nearest=20"), ("photonmap", "photons=3 nearest=2")]
    {
        let it: Box<dyn Integrator> = make(name, settings);
        let film = shoot(&scene, &*it, spec(32), 4);
        let black = film.mean().iter().filter(|p| p.element_sum() <= 0.0 || !p.is_finite()).count();
        // Only what the lamp cannot see may be dark when photons are very few.
        assert!(black < 1024 / 20, "{name} {settings}: {black} black pixels");
    }
}

/// A ball of brushed metal on a floor so large that hardly a photon comes near it.
#[test]
fn unified_leaves_to_its_path_tracer_what_no_photon_reaches() {
    let mut b = SceneBuilder::new();
    let floor = matt(&mut b, Rgb::splat(0.8));
    let side = 4000.0;
    let corner = Vec3::new(-0.5 * side, 0.0, -0.5 * side);
    b.add(Shape::Parallelogram(Parallelogram::new(corner, side * Vec3::Z, side * Vec3::X)), floor);
    let [eta, k, reflectance] = [0.2, 3.0, 1.0].map(|v| b.constant(Rgb::splat(v)));
    let metal = ConductorMaterial { eta, k, reflectance };
    let rough = b.material(RoughConductorMaterial { metal, alpha: 0.3.into() });
    b.add(ball([0.0, 1.0, 0.0], 1.0), rough);
    b.light(EnvironmentLight::constant(Rgb::splat(1.0)));
    b.camera(eye(Vec3::new(0.0, 1.2, -3.0), Vec3::new(0.0, 0.8, 0.0), 45.0));
    let scene = b.build().unwrap();
    let [want, got] = [("path", ""), ("unified", "aim=off")]
        .map(|(name, settings)| shoot(&scene, &*make(name, settings), spec(64), 24));
    let (want, got) = (mean(&want), mean(&got));
    assert!((got / want - 1.0).abs().max_element() < 0.01, "{got} instead of {want}");
}

/// A ball of glass over a little table, under a lamp, before an eye 30 cm away; perhaps with a wall a hundred metres behind.
fn table_before(wall: bool) -> Scene {
    let mut b = SceneBuilder::new();
    let grey = matt(&mut b, Rgb::splat(0.6));
    b.add(patch([-0.05, -0.08, 0.2], [0.0, 0.0, 0.2], [0.1, 0.0, 0.0]), grey);
    if wall {
        b.add(patch([-200.0, -200.0, 100.0], [0.0, 400.0, 0.0], [400.0, 0.0, 0.0]), grey);
    }
    let clear = glass(&mut b, 1.5);
    b.add(ball([0.0, -0.04, 0.3], 0.03), clear);
    let black = matt(&mut b, Rgb::ZERO);
    let shape = ball([0.05, 0.12, 0.3], 0.01);
    b.surface(SurfaceDef { shape, material: black, emission: Some((Rgb::splat(40.0).into(), Sides::One)) });
    b.camera(eye(Vec3::ZERO, Vec3::Z, 50.0));
    b.build().expect("a scene")
}

#[test]
fn a_caustic_close_up_is_sharp_before_a_far_wall_too() {
    let brightest = |scene: &Scene, name: &str| {
        let film = shoot(scene, &*make(name, ""), spec(192), 24);
        // Below the ball, where there is no lamp.
        film.mean()[112 * 192..].iter().map(|p| p.element_sum() / 3.0).fold(0.0, f32::max)
    };
    let (alone, walled) = (table_before(false), table_before(true));
    for name in ["ppm", "unified"] {
        let (want, found) = (brightest(&alone, name), brightest(&walled, name));
        assert!((found / want - 1.0).abs() < 0.3, "{name}: {found} before a wall, {want} before nothing");
    }
}
