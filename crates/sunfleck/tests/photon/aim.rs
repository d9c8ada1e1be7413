//! Aimed light: its densities are those of its starts, and it changes neither flux nor pictures, only their noise.
use crate::scenes::{ball, eye, glass, make, matt, measure, patch, shoot, spec};
use glam::{Mat3, Vec3};
use sunfleck::{
    light::{DirectionalLight, Emitter, EmitterHit, EnvironmentLight, Light, LightId, PointLight, Sides, SpotLight},
    math::Ray,
    photon::{Emission, Keep, Shower, Source, Training},
    sampler::{Domain, Sampler},
    scene::{Scene, SceneBuilder, SurfaceDef, World},
    shape::{Mesh, Shape},
    spectrum::{Rgb, Wavelengths},
    texture::{ImageTexture, Wrap},
    walk::Limits,
};

/// Showers whose spread tells how sure a mean is.
const SHOWERS: u64 = 24;
const BALL: Vec3 = Vec3::new(0.1, 0.3, 0.05);

/// A small glass ball on a floor three metres wide, seen from near.
fn glass_on_a_floor() -> SceneBuilder {
    let mut b = SceneBuilder::new();
    let (grey, clear) = (matt(&mut b, Rgb::splat(0.6)), glass(&mut b, 1.5));
    b.add(patch([-1.5, 0.0, -1.5], [0.0, 0.0, 3.0], [3.0, 0.0, 0.0]), grey);
    b.add(ball(BALL.to_array(), 0.2), clear);
    b.camera(eye(Vec3::new(0.0, 1.2, -1.6), BALL, 35.0));
    b
}

fn emit(b: &mut SceneBuilder, shape: Shape, sides: Sides) {
    let black = matt(b, Rgb::ZERO);
    b.surface(SurfaceDef { shape, material: black, emission: Some((Rgb::new(9.0, 8.0, 7.0).into(), sides)) });
}

/// A sky with a sun of some size.
fn sky() -> Light {
    let (w, h) = (32, 16);
    let pixel = |i: usize| {
        let sun = (20..=21).contains(&(i % w)) && (3..=4).contains(&(i / w));
        if sun { Rgb::new(60.0, 50.0, 40.0) } else { Rgb::new(0.3, 0.4, 0.6) }
    };
    let image = ImageTexture::new(w, h, (0..w * h).map(pixel).collect(), Wrap::Repeat).unwrap();
    EnvironmentLight::panorama(image, Rgb::ONE, Mat3::IDENTITY).unwrap().into()
}

/// The same place under each kind of light, and under several at once.
fn scenes() -> Vec<(&'static str, Scene)> {
    let with = |light: &dyn Fn(&mut SceneBuilder)| {
        let mut b = glass_on_a_floor();
        light(&mut b);
        b.build().unwrap()
    };
    let quad = || patch([0.4, 2.0, 0.2], [0.5, 0.0, 0.0], [0.0, 0.1, 0.5]);
    let mesh = || {
        let p = [[0.4, 2.0, 0.2], [0.9, 2.1, 0.3], [0.5, 2.0, 0.9], [0.1, 1.8, 0.6]].map(Vec3::from).to_vec();
        Shape::Mesh(Mesh::new(p, vec![], vec![], vec![[0, 1, 2], [0, 2, 3]]).unwrap())
    };
    let point = || PointLight { p: Vec3::new(-0.6, 1.6, 0.5), intensity: Rgb::new(3.0, 2.0, 1.0).into() };
    let spot = || {
        let p = Vec3::new(0.9, 1.7, -0.3);
        SpotLight::new(p, -p, Rgb::new(4.0, 5.0, 6.0), [0.5, 0.8]).unwrap()
    };
    let sun = || DirectionalLight::new(Vec3::new(-0.4, -1.0, 0.3), Rgb::new(4.0, 3.0, 2.0)).unwrap();
    vec![
        ("quad, one side", with(&|b| emit(b, quad(), Sides::One))),
        ("quad, two sides", with(&|b| emit(b, quad(), Sides::Two))),
        ("sphere", with(&|b| emit(b, ball([0.6, 1.7, 0.4], 0.2), Sides::One))),
        ("mesh", with(&|b| emit(b, mesh(), Sides::Two))),
        ("point", with(&|b| b.light(point()))),
        ("spot", with(&|b| b.light(spot()))),
        ("directional", with(&|b| b.light(sun()))),
        ("constant environment", with(&|b| b.light(EnvironmentLight::constant(Rgb::new(0.5, 0.6, 0.7))))),
        ("environment", with(&|b| b.light(sky()))),
        (
            "several",
            with(&|b| {
                emit(b, quad(), Sides::Two);
                b.light(point());
                b.light(sun());
                b.light(sky());
                // One that the camera has no use for.
                b.light(PointLight { p: Vec3::new(0.0, -1.0, 0.0), intensity: Rgb::splat(2.0).into() });
            }),
        ),
    ]
}

fn aimed(name: &str, scene: &Scene) -> Source {
    let source = Source::aimed(scene, spec(128), &Training { seed: 3, limits: Limits::default(), direct: false });
    assert!(source.aim().is_some(), "{name}: nothing was learned");
    source
}

fn start(source: &Source, world: &World, i: u64) -> Option<Emission> {
    source.emit(world, &mut Sampler::new(11, Domain::Light, 0, i))
}

/// The emitter that a ray came from, by going back along it; `None` for lights without a surface.
fn origin(world: &World, e: &Emission) -> Option<EmitterHit> {
    let back = Ray::new(e.le.ray.o + 1e-3 * e.le.ray.d, -e.le.ray.d);
    matches!(world.light(e.light), Light::Area(_)).then(|| world.intersect(&back).map(|at| at.emitter_hit()))?
}

#[test]
fn every_start_has_the_density_that_is_asked_for_later() {
    for (name, scene) in scenes() {
        let world = scene.world(Wavelengths::Rgb, 0.5);
        for source in [Source::plain(), aimed(name, &scene)] {
            let mut off = 0;
            let starts: Vec<Emission> = (0..20_000).filter_map(|i| start(&source, &world, i)).collect();
            for e in &starts {
                let product = e.le.pdf_area * e.le.pdf_dir;
                assert!(e.pdf > 0.0 && e.start.beta.is_finite() && product > 0.0, "{name}: {e:?}");
                let through = e.le.ray.at(2.5);
                let later = source.pdf(&world, e.light, origin(&world, e).as_ref(), through, e.le.ray.d);
                // Rays that graze the edge of a target are on either side of it, by rounding.
                off += u32::from((later / e.pdf - 1.0).abs() > 2e-3);
            }
            assert!(starts.len() > 5000 && off < 100, "{name}: {off} of {} starts differ", starts.len());
        }
    }
}

/// Where a start goes: 6 bands and 8 sectors of direction, or how far it passes from the ball, and on which side. `None`
/// for light from infinity that passes by the scene: plain emission has none, and nothing asks for its density.
fn bin(world: &World, e: &Emission) -> Option<usize> {
    let (o, d) = (e.le.ray.o, e.le.ray.d);
    if matches!(
        world.light(e.light),
        Light::Area(_) | Light::Point(_) | Light::Spot(_) | Light::Goniometric(_) | Light::Projection(_)
    ) {
        let band = ((0.5 - 0.5 * d.y) * 6.0).min(5.0) as usize;
        let sector = ((d.z.atan2(d.x) / std::f32::consts::TAU + 0.5) * 8.0).min(7.0) as usize;
        return Some(e.light.0 as usize * BINS + band * 8 + sector);
    }
    let off = (o - BALL).reject_from(d);
    let octant = (0..3).map(|a| usize::from(off[a] > 0.0) << a).sum::<usize>();
    let ring = (off.length() / 0.1).log2().clamp(0.0, 5.0) as usize;
    let meets = (o - world.around().centre).reject_from(d).length() < world.around().radius;
    meets.then_some(e.light.0 as usize * BINS + ring * 8 + octant)
}
const BINS: usize = 48;

#[test]
fn starts_are_as_frequent_as_their_density_says() {
    const N: u64 = 200_000;
    for (name, scene) in scenes() {
        let world = scene.world(Wavelengths::Rgb, 0.5);
        let (plain, source) = (Source::plain(), aimed(name, &scene));
        let bins = scene.lights().len() * BINS;
        // How often starts fall into a bin, and how often they should, by plain starts weighed by the ratio of densities.
        let (mut drawn, mut want) = (vec![0.0; bins], vec![[0.0; 2]; bins]);
        for i in 0..N {
            if let Some(at) = start(&source, &world, i).and_then(|e| bin(&world, &e)) {
                drawn[at] += 1.0;
            }
            let plain = start(&plain, &world, N + i).and_then(|e| bin(&world, &e).map(|at| (at, e)));
            if let Some((at, e)) = plain {
                let pdf = source.pdf(&world, e.light, origin(&world, &e).as_ref(), e.le.ray.at(2.5), e.le.ray.d);
                let w = f64::from(pdf / e.pdf);
                want[at][0] += w;
                want[at][1] += w * w;
            }
        }
        let (mut chi2, mut used) = (0.0, 0.0);
        for (i, (n, [w, w2])) in drawn.iter().zip(&want).enumerate() {
            // Small counts are no normal numbers.
            if n + w < 50.0 {
                continue;
            }
            let z = (n - w) / (n + w2 + (2e-3 * w).powi(2)).sqrt();
            assert!(z.abs() < 5.0, "{name}, bin {i}: {n} drawn, {w} wanted");
            (chi2, used) = (chi2 + z * z, used + 1.0);
        }
        assert!(
            used > 5.0 && chi2 < used + 4.0 * (2.0f64 * used).sqrt() + 4.0,
            "{name}: chi2 {chi2:.0} over {used} bins"
        );
    }
}

#[test]
fn aimed_light_brings_the_same_flux_to_every_place() {
    let tile = |p: Vec3| {
        let q = ((p - Vec3::new(-1.5, 0.0, -1.5)) / 3.0 * 6.0).clamp(Vec3::ZERO, Vec3::splat(5.0));
        q.z as usize * 6 + q.x as usize
    };
    // Means and variances of the means, by tile of the floor.
    let flux = |scene: &Scene, source: &Source, seed: u64| {
        let mut sums = vec![[0.0f64; 2]; 36];

        for pass in 0..SHOWERS {
            let limits = Limits { scatterings: 8, ..Limits::default() };
            let shower = Shower { seed, domain: Domain::Light, pass, first: 0, paths: 8192, keep: Keep::All, limits };
            let catch = shower.shoot(&scene.world(Wavelengths::Rgb, 0.5), source);
            let mut tiles = [0.0f64; 36];
            for (p, photon) in catch.positions.iter().zip(&catch.photons).filter(|(p, _)| p.y < 0.01) {
                tiles[tile(*p)] += f64::from(photon.flux.to_rgb(Wavelengths::Rgb).element_sum());
            }
            sums.iter_mut().zip(tiles).for_each(|(s, t)| *s = [s[0] + t, s[1] + t * t]);
        }
        let n = SHOWERS as f64;
        sums.into_iter().map(|[s, s2]| [s / n, (s2 / n - (s / n).powi(2)).max(0.0) / (n - 1.0)]).collect::<Vec<_>>()
    };
    for (name, scene) in scenes() {
        let (plain, aim) = (flux(&scene, &Source::plain(), 5), flux(&scene, &aimed(name, &scene), 6));
        let total = |t: &[[f64; 2]]| (t.iter().map(|x| x[0]).sum::<f64>(), t.iter().map(|x| x[1]).sum::<f64>());
        let ((a, va), (b, vb)) = (total(&plain), total(&aim));
        assert!((a - b).abs() < 5.0 * (va + vb).sqrt() + 0.002 * a, "{name}: {a} W plain, {b} W aimed");
        for (i, ([a, va], [b, vb])) in plain.iter().zip(&aim).enumerate() {
            let z = (a - b) / (va + vb + (0.005 * a).powi(2) + 1e-12).sqrt();
            assert!(z.abs() < 5.5, "{name}, tile {i}: {a} plain, {b} aimed");
        }
    }
}

#[test]
fn aimed_pictures_agree_with_plain_ones() {
    let scenes = scenes();
    let cases = [
        ("ppm", "several", 16),
        ("ppm", "point", 16),
        ("vcm", "several", 16),
        ("vcm", "environment", 16),
        ("vcm", "quad, two sides", 16),
        ("bdpt", "several", 24),
        ("unified", "environment", 16),
    ];
    for (algorithm, name, passes) in cases {
        let (_, scene) = scenes.iter().find(|(n, _)| *n == name).unwrap();
        let picture = |aim: &str| {
            let it = make(algorithm, &format!("photons=6000 radius=0.04 aim={aim}"));
            measure(scene, &*it, 32, 12, passes)
        };
        let (on, off) = (picture("on"), picture("off"));
        let (worst, rms) = on.deviation(&off, 0.003);
        let ratio = on.mean() / off.mean();
        println!("{algorithm}, {name}: mean {ratio:.4}, worst {worst:.1}, rms {rms:.2}");
        assert!(worst < 6.0 && rms < 1.5, "{algorithm}, {name}: worst deviation {worst}, root mean square {rms}");
        assert!((ratio - 1.0).abs() < 0.01, "{algorithm}, {name}: {ratio}");
    }
}

/// A ball of glass of radius 1 on a floor 2 km wide, under a sky.
fn far_glass() -> Scene {
    let mut b = SceneBuilder::new();
    let (sand, clear) = (matt(&mut b, Rgb::splat(0.5)), glass(&mut b, 1.5));
    b.add(patch([-1000.0, -1.0, -1000.0], [0.0, 0.0, 2000.0], [2000.0, 0.0, 0.0]), sand);
    b.add(ball([0.0, 0.02, 0.0], 1.0), clear);
    b.light(sky());
    b.camera(eye(Vec3::new(1.0, 4.0, -8.0), Vec3::new(0.0, -0.6, 0.0), 30.0));
    b.build().unwrap()
}

#[test]
fn light_finds_a_small_ball_of_glass_in_a_scene_a_thousand_times_larger() {
    let scene = far_glass();
    let world = scene.world(Wavelengths::Rgb, 0.5);
    let caustic = |source: &Source| {
        let limits = Limits::default();
        let shower =
            Shower { seed: 1, domain: Domain::Light, pass: 0, first: 0, paths: 65_536, keep: Keep::Caustic, limits };
        let catch = shower.shoot(&world, source);
        catch.positions.iter().filter(|p| p.length() < 5.0).count()
    };
    let (plain, aim) = (caustic(&Source::plain()), caustic(&aimed("far glass", &scene)));
    assert!(plain < 10 && aim > 10_000, "{plain} photons of {} by plain emission, {aim} by aimed", 65_536);
}

#[test]
fn aiming_is_the_same_for_any_number_of_threads() {
    let (name, scene) = scenes().pop().unwrap();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let source = aimed(name, &scene);
            (format!("{:?}", source.aim()), shoot(&scene, &*make("ppm", "photons=3000"), spec(24), 2))
        })
    };
    let one = with(1);
    assert!(one == with(2) && one == with(7));
}

#[test]
fn where_all_light_is_needed_alike_it_is_not_aimed() {
    let scene = crate::scenes::furnace_box(Rgb::ONE, Rgb::splat(0.5));
    let training = Training { seed: 3, limits: Limits::default(), direct: false };
    assert!(Source::aimed(&scene, spec(64), &training).aim().is_none());
    let dark = Source::aimed(&glass_on_a_floor().build().unwrap(), spec(64), &training);
    assert!(dark.aim().is_none());
}

#[test]
fn a_light_sends_along_a_given_direction_what_it_sends_by_itself() {
    for (name, scene) in scenes() {
        let world = scene.world(Wavelengths::Rgb, 0.5);
        for id in (0..scene.lights().len() as u32).map(LightId) {
            let light = world.light(id);
            for i in 0..500 {
                let mut s = Sampler::new(2, Domain::Prepare, 0, i);
                let (u_area, u_dir) = (s.next_2d(), s.next_2d());
                let Some(le) = light.sample_le(u_area, u_dir, world.around()) else { continue };
                let Some(again) = light.le_along(&light.start_le(u_area), le.ray.d, world.around()) else {
                    assert!(light.start_le(u_area).place().is_none(), "{name}: nothing sent along {le:?}");
                    continue;
                };
                assert!(again.ray.o.abs_diff_eq(le.ray.o, 1e-5) && again.le == le.le, "{name}: {le:?} {again:?}");
                assert!((again.flux().max() / le.flux().max() - 1.0).abs() < 2e-3, "{name}: {le:?} {again:?}");
                assert!((again.pdf_dir / le.pdf_dir - 1.0).abs() < 2e-2, "{name}: {le:?} {again:?}");
            }
        }
    }
}
