//! Build and query times of the ray hierarchy alone, to notice when they get worse.

#[path = "scenes/mod.rs"]
mod scenes;

use accel::{Bvh, Geometry, Quality};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

fn rays(criterion: &mut Criterion) {
    for (name, mesh) in [("ball", scenes::ball(6)), ("clutter", scenes::clutter())] {
        let geometry = [Geometry::Triangles { positions: &mesh.positions, indices: &mesh.indices }];
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        group.bench_function("build", |b| b.iter(|| Bvh::build(&geometry, &[], &[], Quality::Default)));
        let bvh = Bvh::build(&geometry, &[], &[], Quality::Default);
        for set in scenes::ray_sets(&mesh, &bvh, 128) {
            group.throughput(Throughput::Elements(set.rays.len() as u64));
            group.bench_function(set.name, |b| {
                if set.any {
                    b.iter(|| set.rays.iter().filter(|ray| bvh.occluded(ray)).count());
                } else {
                    b.iter(|| set.rays.iter().filter(|ray| bvh.closest(ray).is_some()).count());
                }
            });
        }
        group.finish();
    }
}

criterion_group!(benches, rays);
criterion_main!(benches);
