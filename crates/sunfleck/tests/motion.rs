//! What moves while the shutter is open: each pass sees one time, and the mean over passes is the blurred picture.
use glam::{Affine3A, Quat, Vec3};
use sunfleck::{
    bsdf::DiffuseMaterial,
    camera::{Perspective, View},
    film::{FilmSpec, Filter, PassImage},
    integrator::{Params, Pass, find},
    light::Sides,
    math::{Motion, Ray, warp::square_to_sphere},
    sampler::{Domain, Sampler},
    scene::{MaterialId, ObjectId, Scene, SceneBuilder, SurfaceDef},
    shape::{Parallelogram, Shape, Sphere},
    spectrum::{Rgb, Wavelengths},
};

const RGB: Wavelengths = Wavelengths::Rgb;
const SIZE: u32 = 32;

fn grey(b: &mut SceneBuilder, reflectance: f32) -> MaterialId {
    let reflectance = b.constant(Rgb::splat(reflectance));
    b.material(DiffuseMaterial { reflectance })
}

fn shift(x: f32, y: f32) -> Affine3A {
    Affine3A::from_translation(Vec3::new(x, y, 0.0))
}

/// A square of side `side` in the plane z = 0 that faces an eye at z = 2, to which [−1, 1]² fills the picture.
fn square(b: &mut SceneBuilder, side: f32, radiance: Option<f32>) -> ObjectId {
    let material = grey(b, 0.0);
    let corner = Vec3::new(-0.5 * side, -0.5 * side, 0.0);
    let shape = Shape::Parallelogram(Parallelogram::new(corner, side * Vec3::X, side * Vec3::Y));
    b.object(vec![SurfaceDef { shape, material, emission: radiance.map(|l| (Rgb::splat(l).into(), Sides::One)) }])
}

fn eye(x: f32) -> Perspective {
    let (position, look_at) = (Vec3::new(x, 0.0, 2.0), Vec3::new(x, 0.0, 0.0));
    Perspective::new(&View { position, look_at, up: Vec3::Y }, 2.0 * 0.5f32.atan().to_degrees(), 1.0).unwrap()
}

/// Mean over `passes` of the red channel.
fn render(scene: &Scene, algorithm: &str, seed: u64, passes: std::ops::Range<u64>) -> Vec<f32> {
    let spec = FilmSpec { width: SIZE, height: SIZE, filter: Filter::Box };
    let integrator = find(algorithm).unwrap().build(Params::default()).unwrap();
    let prepared = integrator.prepare(scene, spec, seed);
    let mut sum = vec![0.0; spec.pixels()];
    let n = (passes.end - passes.start) as f32;
    let mut image = PassImage::new(spec);
    for index in passes {
        image.clear();
        prepared.render_pass(&Pass::new(seed, index), &mut image);
        sum.iter_mut().zip(image.pixels()).for_each(|(s, p)| *s += p.x / n);
    }
    sum
}

/// The share of time that the point `x` is covered by an interval of width `side` whose middle goes from `from` to `to`.
fn covered(x: f32, side: f32, from: f32, to: f32) -> f32 {
    let at = |edge: f32| ((edge - from) / (to - from)).clamp(0.0, 1.0);
    at(x + 0.5 * side) - at(x - 0.5 * side)
}

/// Whether the middle row is the trapezoid that a shining square leaves, within what 512 passes can tell.
fn is_the_trapezoid(scene: &Scene, algorithm: &str, side: f32, from: f32, to: f32) {
    let picture = render(scene, algorithm, 5, 0..512);
    let row = &picture[(SIZE * SIZE / 2) as usize..][..SIZE as usize];
    for (i, found) in row.iter().enumerate() {
        // Fine midpoints, as edges of the trapezoid fall inside pixels.
        let at = |k: u32| ((i as f32 + (k as f32 + 0.5) / 64.0) / SIZE as f32) * 2.0 - 1.0;
        let expected = (0..64).map(|k| covered(at(k), side, from, to)).sum::<f32>() / 64.0;
        assert!((found - expected).abs() < 0.015, "{algorithm}, pixel {i}: {found}, but {expected}");
    }
}

#[test]
fn a_shining_square_that_moves_evenly_leaves_a_trapezoid() {
    let (side, from, to) = (0.5, -0.55, 0.43);
    let mut b = SceneBuilder::new();
    let lamp = square(&mut b, side, Some(1.0));
    b.place_moving(lamp, shift(from, 0.0), shift(to, 0.0));
    b.camera(eye(0.0));
    let scene = b.build().unwrap();
    for algorithm in ["path", "light", "ppm", "bdpt", "unified"] {
        is_the_trapezoid(&scene, algorithm, side, from, to);
    }
}

#[test]
fn a_moving_eye_leaves_the_same_trapezoid_of_a_square_at_rest() {
    let (side, from, to) = (0.5, -0.55, 0.43);
    let mut b = SceneBuilder::new();
    let lamp = square(&mut b, side, Some(1.0));
    b.place(lamp, Affine3A::IDENTITY);
    b.camera_moving(eye(-from), eye(-to));
    is_the_trapezoid(&b.build().unwrap(), "path", side, from, to);
}

/// A dark square before a bright sky hides as much of it wherever it is.
#[test]
fn what_moves_hides_the_same_share_of_the_picture_at_every_time() {
    let (side, reach) = (0.6, 0.3);
    let mut b = SceneBuilder::new();
    let dark = square(&mut b, side, None);
    b.place_moving(dark, shift(-reach, reach), shift(reach, -reach));
    b.light(sunfleck::light::EnvironmentLight::constant(Rgb::ONE));
    b.camera(eye(0.0));
    let scene = b.build().unwrap();
    let expected = 1.0 - side * side / 4.0;
    for passes in [0..16, 16..32, 100..200] {
        let picture = render(&scene, "path", 2, passes.clone());
        let mean = picture.iter().sum::<f32>() / picture.len() as f32;
        assert!((mean - expected).abs() < 2e-3, "passes {passes:?}: {mean}, but {expected}");
    }
}

/// Places an object for the way between two maps.
type Put<'a> = &'a dyn Fn(&mut SceneBuilder, ObjectId, Affine3A, Affine3A);

/// A scene in which everything moves: a ball, a lamp and the eye.
fn lively(put: Put) -> Scene {
    let mut b = SceneBuilder::new();
    let material = grey(&mut b, 0.7);
    let floor = Parallelogram::new(Vec3::new(-3.0, -1.0, -3.0), 6.0 * Vec3::Z, 6.0 * Vec3::X);
    b.add(Shape::Parallelogram(floor), material);
    let ball = Shape::Sphere(Sphere { centre: Vec3::new(0.3, 0.0, 0.0), radius: 0.4 });
    let ball = b.object(vec![SurfaceDef { shape: ball, material, emission: None }]);
    let stretched = Affine3A::from_scale_rotation_translation(
        Vec3::new(1.5, 0.7, 1.0),
        Quat::from_rotation_z(1.0),
        Vec3::new(0.5, 0.3, 0.0),
    );
    put(&mut b, ball, Affine3A::IDENTITY, stretched);
    b.place(ball, shift(-1.0, -0.4));
    let lamp = square(&mut b, 0.8, Some(6.0));
    let above = |x: f32| shift(x, 1.8) * Affine3A::from_rotation_x(std::f32::consts::FRAC_PI_2);
    put(&mut b, lamp, above(-0.7), above(0.7));
    b.camera_moving(eye(0.0), eye(0.4));
    b.build().unwrap()
}

#[test]
fn at_each_time_the_scene_is_the_one_built_for_it() {
    let moving = lively(&SceneBuilder::place_moving);
    for time in [0.0, 0.3, 0.75, 1.0] {
        let still = lively(&|b, object, from, to| b.place(object, Motion::new(&from, &to).unwrap().at(time)));
        let (moving, still) = (moving.world(RGB, time), still.world(RGB, 0.0));
        let mut lit = 0;
        for i in 0..10_000 {
            let s = &mut Sampler::new(4, Domain::Prepare, 0, i);
            let o = 4.0 * square_to_sphere(s.next_2d());
            let to = 1.5 * square_to_sphere(s.next_2d());
            let ray = Ray::new(o, (to - o).normalize());
            match (moving.intersect(&ray), still.intersect(&ray)) {
                (Some(a), Some(b)) => {
                    assert!((a.p - b.p).length() < 1e-4 && (a.ng - b.ng).length() < 1e-3, "{time}: {a:#?} {b:#?}");
                    assert_eq!(moving.emitted(&a), still.emitted(&b));
                    lit += u32::from(!moving.emitted(&a).is_black());
                    let (u, v) = (s.next_1d(), s.next_2d());
                    let found = [&moving, &still].map(|w| w.sample_direct(a.p, u, v).map(|d| (d.li.wi, d.li.pdf)));
                    match found {
                        [Some((wi, pdf)), Some((wi_still, pdf_still))] => {
                            assert!((wi - wi_still).length() < 1e-4 && (pdf / pdf_still - 1.0).abs() < 1e-2);
                        }
                        [a, b] => assert_eq!(a.is_some(), b.is_some()),
                    }
                }
                (a, b) => assert!(a.is_none() && b.is_none(), "{time}: {a:?} {b:?}"),
            }
        }
        assert!(lit > 20, "{time}: {lit} rays met the lamp");
    }
}

#[test]
fn the_bounding_sphere_holds_the_whole_way() {
    let mut b = SceneBuilder::new();
    let material = grey(&mut b, 0.5);
    let ball = Shape::Sphere(Sphere { centre: Vec3::new(5.0, 0.0, 0.0), radius: 1.0 });
    let ball = b.object(vec![SurfaceDef { shape: ball, material, emission: None }]);
    // A loop, which leads back to where it began: the box around both ends tells nothing of the way.
    let turn = 0.99 * std::f32::consts::PI;
    let there = Affine3A::from_rotation_translation(Quat::from_rotation_z(turn), Vec3::new(10.0, 0.0, 0.0));
    b.place_moving(ball, Affine3A::IDENTITY, there);
    let lamp = square(&mut b, 1.0, Some(1.0));
    b.place_moving(lamp, shift(5.0, 0.0), shift(5.0, -4.0));
    let scene = b.build().unwrap();
    let (centre, radius) = scene.bounding_sphere();
    let holds = |p: Vec3| assert!(p.distance(centre) <= radius, "{p} is outside {radius} around {centre}");
    holds(Vec3::new(5.0, -4.5, 0.0));
    for time in (0..=100).map(|i| i as f32 / 100.0) {
        let middle = Vec3::new(10.0 * time + 5.0 * (turn * time).cos(), 5.0 * (turn * time).sin(), 0.0);
        [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y].into_iter().for_each(|d| holds(middle + d));
    }
    assert!(radius < 6.5, "{radius}");
    for time in [0.0, 0.5, 1.0] {
        assert_eq!(scene.world(RGB, time).around().radius, radius);
    }
}

#[test]
fn a_moving_scene_has_the_same_picture_for_any_number_of_threads() {
    let scene = lively(&SceneBuilder::place_moving);
    for algorithm in ["path", "light", "ppm", "photonmap", "bdpt", "vcm", "unified"] {
        let picture = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| render(&scene, algorithm, 3, 0..3))
        };
        let one = picture(1);
        assert!(one.iter().any(|v| *v > 0.0), "{algorithm}: black");
        assert!(one == picture(2) && one == picture(7), "{algorithm}");
        // A pass does not know which came before it.
        let alone = render(&scene, algorithm, 3, 2..3);
        let first = render(&scene, algorithm, 3, 0..2);
        let sum: Vec<f32> = first.iter().zip(&alone).map(|(a, b)| (2.0 * a + b) / 3.0).collect();
        assert!(one.iter().zip(&sum).all(|(a, b)| (a - b).abs() <= 1e-5 * a.abs().max(1.0)), "{algorithm}");
    }
}

#[test]
fn what_moves_is_counted() {
    let counts = lively(&SceneBuilder::place_moving).counts();
    assert_eq!((counts.instances, counts.moving_instances, counts.moving_camera), (3, 2, true));
    assert_eq!((counts.lights, counts.triangles, counts.spheres), (1, 4, 1));
    let still = SceneBuilder::new().build().unwrap().counts();
    assert_eq!((still.moving_instances, still.moving_camera), (0, false));
}

#[test]
fn motion_without_a_way_is_refused_with_the_object_named() {
    let build = |place: &dyn Fn(&mut SceneBuilder, ObjectId)| {
        let mut b = SceneBuilder::new();
        let material = grey(&mut b, 0.5);
        let bulb = Shape::Sphere(Sphere { centre: Vec3::ZERO, radius: 1.0 });
        let emission = Some((Rgb::ONE.into(), Sides::One));
        let object = b.object(vec![SurfaceDef { shape: bulb, material, emission }]);
        place(&mut b, object);
        b.build().err().map(|e| e.to_string()).unwrap_or_default()
    };
    let mirror = Affine3A::from_scale(Vec3::new(1.0, -1.0, 1.0));
    let message = build(&|b, o| b.place_moving(o, Affine3A::IDENTITY, mirror));
    assert!(message.starts_with("object 0 cannot move:"), "{message}");
    let message = build(&|b, o| b.place_moving(o, Affine3A::IDENTITY, Affine3A::from_scale(Vec3::new(1.0, 2.0, 1.0))));
    assert!(message.starts_with("object 0 holds an emitting sphere"), "{message}");
    assert_eq!(build(&|b, o| b.place_moving(o, shift(0.0, 0.0), shift(1.0, 0.0))), "");
    let message = build(&|b, _| b.place_moving(ObjectId(7), mirror, shift(1.0, 0.0)));
    assert_eq!(message, "object 7 does not exist: the scene has 1");
}
