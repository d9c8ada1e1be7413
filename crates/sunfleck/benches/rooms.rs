//! The rooms that a photon passes, one after the other: how fast is each alone? A room of matt walls with a ball of glass and
//! one of matt white, 2¹⁶ light paths, a picture of 256². Emitting, walking and gathering run on one thread; showers and the
//! map use all.
//!
//! `cargo bench -p sunfleck --bench rooms`
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{Vec2, Vec3};
use std::hint::black_box;
use std::time::Duration;
use sunfleck::{
    bsdf::{DielectricMaterial, DiffuseMaterial},
    camera::{Perspective, Project, View},
    light::Sides,
    photon::{CameraEnd, Catch, Disc, Keep, Kernel, RadiusMap, Shower, Source, gather_within},
    sampler::{Domain, Sampler},
    scene::{Interaction, MID_SHUTTER, Scene, SceneBuilder, SurfaceDef, World},
    shape::{Parallelogram, Shape, Sphere},
    spectrum::{Rgb, Wavelengths},
    walk::{Arrival, Limits, Step, Visit, walk},
};

/// Light paths.
const PATHS: u64 = 1 << 16;
/// Pixels in a row and in a column.
const SIDE: u32 = 256;
/// Radii of gathers, world units: about 4 pixels, and twice that.
const RADII: [f32; 2] = [0.03, 0.06];

fn patch(p: [f32; 3], u: [f32; 3], v: [f32; 3]) -> Shape {
    Shape::Parallelogram(Parallelogram::new(p.into(), u.into(), v.into()))
}

fn matt(b: &mut SceneBuilder, colour: Rgb) -> sunfleck::scene::MaterialId {
    let reflectance = b.constant(colour);
    b.material(DiffuseMaterial { reflectance })
}

fn scene() -> Scene {
    let mut b = SceneBuilder::new();
    let (white, red) = (matt(&mut b, Rgb::splat(0.7)), matt(&mut b, Rgb::new(0.6, 0.1, 0.1)));
    let (x, y, z) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]);
    let (corner, top, far) = ([-1.0; 3], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]);
    for (p, u, v, m) in [
        (corner, z, x, white),
        (top, x, z, white),
        (corner, y, z, red),
        ([1.0, -1.0, -1.0], z, y, red),
        (far, x, y, white),
    ] {
        b.add(patch(p, u, v), m);
    }
    let one = b.constant(Rgb::ONE);
    let glass = b.material(DielectricMaterial { eta: 1.5.into(), reflectance: one, transmittance: one });
    b.add(Shape::Sphere(Sphere { centre: Vec3::new(0.35, -0.6, 0.0), radius: 0.4 }), glass);
    b.add(Shape::Sphere(Sphere { centre: Vec3::new(-0.45, -0.65, 0.4), radius: 0.35 }), white);
    let lamp = patch([-0.25, 0.98, -0.25], [0.5, 0.0, 0.0], [0.0, 0.0, 0.5]);
    b.surface(SurfaceDef { shape: lamp, material: white, emission: Some((Rgb::splat(10.0).into(), Sides::One)) });
    let view = View { position: Vec3::new(0.0, 0.0, -3.4), look_at: Vec3::ZERO, up: Vec3::Y };
    b.camera(Perspective::new(&view, 40.0, 1.0).expect("a camera"));
    b.build().expect("a scene")
}

/// Counts what is met.
struct Count(u64);

impl Visit for Count {
    fn surface(&mut self, _: &Arrival, _: &mut Sampler) -> Step {
        self.0 += 1;
        Step::On
    }
}

fn quick(c: &mut Criterion) -> criterion::BenchmarkGroup<'_, criterion::measurement::WallTime> {
    let mut group = c.benchmark_group("rooms");
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    group
}

fn light(c: &mut Criterion) {
    let scene = scene();
    let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
    let source = Source::plain();
    let sampler = |path| Sampler::new(1, Domain::Light, 0, path);
    let mut group = quick(c);
    group.throughput(Throughput::Elements(PATHS));
    group.bench_function("emit", |b| {
        b.iter(|| (0..PATHS).filter(|&path| black_box(source.emit(&world, &mut sampler(path))).is_some()).count());
    });
    group.bench_function("walk", |b| {
        b.iter(|| {
            let mut met = Count(0);
            for path in 0..PATHS {
                let mut sampler = sampler(path);
                if let Some(emission) = source.emit(&world, &mut sampler) {
                    walk(&world, &emission.start, &Limits::default(), &mut sampler, &mut met);
                }
            }
            met.0
        });
    });
    group.bench_function("deposit", |b| b.iter(|| shower().shoot(&world, &source).photons.len()));
    group.finish();
}

fn shower() -> Shower {
    let (domain, keep, limits) = (Domain::Light, Keep::All, Limits::default());
    Shower { seed: 1, domain, pass: 0, first: 0, paths: PATHS, keep, limits }
}

/// Where the camera sees something matt, row by row.
fn seen(world: &World) -> Vec<Interaction> {
    let raster = |x, y| (Vec2::new(x as f32, y as f32) + 0.5) / SIDE as f32;
    let rays = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| raster(x, y)));
    let hits = rays.filter_map(|r| world.intersect(&world.camera().ray(r, Vec2::splat(0.5)).ray));
    hits.filter(Interaction::is_connectible).collect()
}

fn map(c: &mut Criterion) {
    let scene = scene();
    let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
    let Catch { positions, photons, .. } = shower().shoot(&world, &Source::plain());
    let seen = seen(&world);
    let mut group = quick(c);
    for radius in RADII {
        group.throughput(Throughput::Elements(photons.len() as u64));
        group.bench_function(BenchmarkId::new("map build", radius), |b| {
            b.iter(|| RadiusMap::new(&positions, &photons, radius).len());
        });
        let map = RadiusMap::new(&positions, &photons, radius);
        let (disc, end) = (
            Disc { radius, kernel: Kernel::Epanechnikov },
            CameraEnd { most: Limits::default().scatterings, dispersed: false },
        );
        group.throughput(Throughput::Elements(seen.len() as u64));
        group.bench_function(BenchmarkId::new("gather", radius), |b| {
            b.iter(|| seen.iter().map(|at| gather_within(&map, at, disc, end).max()).sum::<f32>());
        });
    }
    group.finish();
}

criterion_group!(benches, light, map);
criterion_main!(benches);
