//! The point indices against a plain hash grid and the kd-tree crate `kiddo`, on a million photon-like points: a fifth
//! in a dense spot on the floor of a unit box, the rest even on its six sides. Queries come in random order, 4 % of them
//! in the spot. One thread asks; builds use all.
//!
//! `cargo bench -p accel --bench points`

use std::f32::consts::TAU;
use std::hint::black_box;
use std::num::NonZero;

use accel::{KdTree, Neighbours, PointGrid};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{IVec3, Vec3};
use kiddo::{ImmutableKdTree, SquaredEuclidean};

const POINTS: usize = 1_000_000;
const QUERIES: usize = 20_000;

struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1 << 24) as f32
    }

    fn point(&mut self, in_spot: f32) -> Vec3 {
        if self.next() < in_spot {
            let r = 0.05 * (-2.0 * (1.0 - self.next()).ln()).sqrt();
            let (sin, cos) = (self.next() * TAU).sin_cos();
            return Vec3::new(0.4 + r * cos, 0.0, 0.6 + r * sin);
        }
        let (u, v, side) = (self.next(), self.next(), (self.next() * 6.0) as usize);
        let mut p = [(side % 2) as f32; 3];
        p[(side / 2 + 1) % 3] = u;
        p[(side / 2 + 2) % 3] = v;
        p.into()
    }
}

/// What most renderers have: points sorted by the hash of their cell of edge `2 r`, so that a query reads eight cells. Made
/// as fast as it gets without another layout: a power of two of buckets, and no bucket read twice.
struct HashGrid {
    per_unit: f32,
    starts: Vec<u32>,
    points: Vec<Vec3>,
}

impl HashGrid {
    #[inline]
    fn cell(&self, p: Vec3) -> IVec3 {
        (p * self.per_unit).floor().as_ivec3()
    }

    #[inline]
    fn bucket(&self, cell: IVec3) -> usize {
        let mixed = (cell.x as u32).wrapping_mul(73_856_093)
            ^ (cell.y as u32).wrapping_mul(19_349_663)
            ^ (cell.z as u32).wrapping_mul(83_492_791);
        mixed as usize & (self.starts.len() - 2)
    }

    fn build(points: &[Vec3], cell: f32) -> Self {
        let buckets = points.len().next_power_of_two();
        let mut grid = Self { per_unit: 1.0 / cell, starts: vec![0; buckets + 1], points: vec![] };
        let buckets: Vec<u32> = points.iter().map(|&p| grid.bucket(grid.cell(p)) as u32).collect();
        buckets.iter().for_each(|&b| grid.starts[b as usize + 1] += 1);
        (1..grid.starts.len()).for_each(|b| grid.starts[b] += grid.starts[b - 1]);
        let mut next = grid.starts.clone();
        grid.points.resize(points.len(), Vec3::ZERO);
        for (&b, &p) in buckets.iter().zip(points) {
            grid.points[next[b as usize] as usize] = p;
            next[b as usize] += 1;
        }
        grid
    }

    #[inline]
    fn within(&self, p: Vec3, r: f32, mut visit: impl FnMut(f32)) {
        let (lo, hi) = (self.cell(p - r), self.cell(p + r));
        let (mut seen, mut count) = ([usize::MAX; 27], 0);
        for z in lo.z..=hi.z {
            for y in lo.y..=hi.y {
                for x in lo.x..=hi.x {
                    let bucket = self.bucket(IVec3::new(x, y, z));
                    if seen[..count].contains(&bucket) {
                        continue;
                    }
                    (seen[count], count) = (bucket, count + 1);
                    for &q in &self.points[self.starts[bucket] as usize..self.starts[bucket + 1] as usize] {
                        let d2 = p.distance_squared(q);
                        if d2 <= r * r {
                            visit(d2);
                        }
                    }
                }
            }
        }
    }
}

fn scene() -> (Vec<Vec3>, Vec<Vec3>) {
    let mut u = Uniform(1);
    ((0..POINTS).map(|_| u.point(0.2)).collect(), (0..QUERIES).map(|_| u.point(0.04)).collect())
}

fn arrays(points: &[Vec3]) -> Vec<[f32; 3]> {
    points.iter().map(Vec3::to_array).collect()
}

fn fixed_radius(c: &mut Criterion) {
    let (points, queries) = scene();
    let kiddo: ImmutableKdTree<f32, 3> = ImmutableKdTree::new_from_slice(&arrays(&points)).expect("finite points");
    let mut group = c.benchmark_group("within");
    group.sample_size(10).throughput(Throughput::Elements(QUERIES as u64));
    for r in [0.005, 0.01, 0.02] {
        // The map of photons has cells of 1.5 r; smaller ones are better where points lie thick.
        for (name, cell) in [("grid, cell r", r), ("grid, cell 1.5 r", 1.5 * r)] {
            let grid = PointGrid::build(&points, cell);
            group.bench_function(BenchmarkId::new(name, r), |b| {
                b.iter(|| {
                    let (mut hits, mut sum) = (0_u64, 0.0);
                    queries.iter().for_each(|&p| grid.within_slots(p, r, |_, d2| (hits, sum) = (hits + 1, sum + d2)));
                    black_box((hits, sum))
                });
            });
        }
        let plain = HashGrid::build(&points, 2.0 * r);
        group.bench_function(BenchmarkId::new("hash grid", r), |b| {
            b.iter(|| {
                let (mut hits, mut sum) = (0_u64, 0.0);
                queries.iter().for_each(|&p| plain.within(p, r, |d2| (hits, sum) = (hits + 1, sum + d2)));
                black_box((hits, sum))
            });
        });
        group.bench_function(BenchmarkId::new("kiddo", r), |b| {
            b.iter(|| {
                let within = |p: &Vec3| {
                    let found = kiddo.query(&p.to_array()).within::<SquaredEuclidean<f32>>(r * r).unsorted().execute();
                    found.len()
                };
                queries.iter().map(within).sum::<usize>()
            });
        });
    }
}

/// Radii that differ by up to `spread` each way, as far as pixels reach in scenes that go from near to far: one level of cells
/// for the radius in the middle, and levels for all.
fn spread_radii(c: &mut Criterion) {
    let (points, queries) = scene();
    let mut group = c.benchmark_group("spread");
    group.sample_size(10).throughput(Throughput::Elements(QUERIES as u64));
    for (spread, down, levels) in [(1.0, 0, 1), (4.0, 1, 3), (16.0, 2, 5)] {
        let mut u = Uniform(2);
        let asked: Vec<(Vec3, f32)> =
            queries.iter().map(|&p| (p, 0.003 * f32::powf(spread, 2.0 * u.next() - 1.0))).collect();
        let finest = 1.5 * 0.003 * 0.25_f32.powi(down);
        for (name, cell, levels) in [("one level", 1.5 * 0.003, 1), ("levels", finest, levels.max(2))] {
            let grid = PointGrid::build_levels(&points, cell, levels);
            group.bench_function(BenchmarkId::new(name, spread), |b| {
                b.iter(|| {
                    let (mut hits, mut sum) = (0_u64, 0.0);
                    asked
                        .iter()
                        .for_each(|&(p, r)| grid.within_slots(p, r, |_, d2| (hits, sum) = (hits + 1, sum + d2)));
                    black_box((hits, sum))
                });
            });
        }
    }
}

fn nearest(c: &mut Criterion) {
    let (points, queries) = scene();
    let kiddo: ImmutableKdTree<f32, 3> = ImmutableKdTree::new_from_slice(&arrays(&points)).expect("finite points");
    let tree = KdTree::build(&points);
    let mut group = c.benchmark_group("nearest");
    group.sample_size(10).throughput(Throughput::Elements(QUERIES as u64));
    for k in [20, 100] {
        group.bench_function(BenchmarkId::new("tree", k), |b| {
            let mut out = Neighbours::new();
            b.iter(|| {
                let mut farthest = |p: &Vec3| {
                    tree.nearest(*p, k, f32::INFINITY, &mut out);
                    out.farthest().map_or(0.0, |(_, d2)| d2)
                };
                queries.iter().map(&mut farthest).sum::<f32>()
            });
        });
        group.bench_function(BenchmarkId::new("kiddo", k), |b| {
            let k = NonZero::new(k).expect("more than none");
            b.iter(|| {
                let farthest = |p: &Vec3| {
                    let found = kiddo.query(&p.to_array()).nearest_n::<SquaredEuclidean<f32>>(k).execute();
                    found.last().map_or(0.0, |found| found.distance)
                };
                queries.iter().map(farthest).sum::<f32>()
            });
        });
    }
}

fn build(c: &mut Criterion) {
    let (points, _) = scene();
    let arrays = arrays(&points);
    let mut group = c.benchmark_group("build");
    group.sample_size(10);
    group.bench_function("grid", |b| b.iter(|| PointGrid::build(&points, 0.01)));
    for levels in [2, 4] {
        group.bench_function(BenchmarkId::new("grid, levels", levels), |b| {
            b.iter(|| PointGrid::build_levels(&points, 0.01, levels));
        });
    }
    group.bench_function("hash grid", |b| b.iter(|| HashGrid::build(&points, 0.02)));
    group.bench_function("tree", |b| b.iter(|| KdTree::build(&points)));
    group.bench_function("kiddo", |b| b.iter(|| ImmutableKdTree::<f32, 3>::new_from_slice(&arrays)));
}

criterion_group!(benches, build, fixed_radius, spread_radii, nearest);
criterion_main!(benches);
