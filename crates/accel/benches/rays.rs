//! Build and query times of the ray hierarchy alone, to notice when they get worse: of triangles in the world, of placed
//! copies, and of copies that move, which are placed anew for each time.

#[path = "scenes/mod.rs"]
mod scenes;
#[path = "scenes/swarm.rs"]
mod swarm;

use accel::{Bvh, Geometry, Hit, Quality};
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main, measurement::WallTime};
use glam::Vec3;

/// Copies in the swarm.
const COPIES: usize = 10_000;

fn still(criterion: &mut Criterion) {
    for (name, mesh) in [("ball", scenes::ball(6)), ("clutter", scenes::clutter())] {
        let geometry = [Geometry::Triangles { positions: &mesh.positions, indices: &mesh.indices }];
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        group.bench_function("build", |b| b.iter(|| Bvh::build(&geometry, &[], &[], Quality::Default)));
        trace(&mut group, &Bvh::build(&geometry, &[], &[], Quality::Default), |hit| mesh.normal(hit));
        group.finish();
    }
}

fn moving(criterion: &mut Criterion) {
    let swarm = swarm::Swarm::new(COPIES);
    let objects = swarm.objects();
    let mut group = criterion.benchmark_group("swarm");
    group.sample_size(10);
    group.throughput(Throughput::Elements(COPIES as u64));
    let mut time = 0.0;
    group.bench_function("place", |b| {
        b.iter(|| {
            time = (time + 0.618) % 1.0;
            swarm.at(&objects, time)
        });
    });
    trace(&mut group, &swarm.at(&objects, 0.5), |hit| swarm.normal(hit));
    group.finish();
}

/// The seven sets of rays: nearest and any hits, coherent and not.
fn trace(group: &mut BenchmarkGroup<WallTime>, bvh: &Bvh, normal: impl Fn(&Hit) -> Vec3) {
    for set in scenes::ray_sets(normal, bvh, 128) {
        group.throughput(Throughput::Elements(set.rays.len() as u64));
        group.bench_function(set.name, |b| {
            if set.any {
                b.iter(|| set.rays.iter().filter(|ray| bvh.occluded(ray)).count());
            } else {
                b.iter(|| set.rays.iter().filter(|ray| bvh.closest(ray).is_some()).count());
            }
        });
    }
}

criterion_group!(benches, still, moving);
criterion_main!(benches);
