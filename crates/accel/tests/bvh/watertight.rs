//! No ray slips between two triangles of a closed mesh, nor past their boxes.

use crate::LEVELS;
use crate::support::{Mesh, Rng, bumpy_ball};
use accel::{Bvh, Quality, Ray, SimdLevel};
use glam::Vec3;

fn ball_at(centre: Vec3, level: usize) -> Mesh {
    let mut mesh = bumpy_ball(level, 0.2);
    for p in &mut mesh.positions {
        *p += centre;
    }
    mesh
}

fn build(mesh: &Mesh, quality: Quality, level: SimdLevel) -> Bvh {
    Bvh::build(&[mesh.geometry()], &[], &[], quality).with_simd(level)
}

/// Panics if the ray meets nothing; `target` is what it was aimed at.
fn must_hit(bvh: &Bvh, ray: &Ray, target: Vec3) {
    assert!(bvh.closest(ray).is_some(), "{:?} leaks at {target}: {ray:?}", bvh.simd());
    assert!(bvh.occluded(ray), "{:?} leaks at {target} when asked for any hit: {ray:?}", bvh.simd());
}

/// Points on vertices and edges of the mesh.
fn seams(mesh: &Mesh) -> Vec<Vec3> {
    let edges = mesh.indices.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let along = edges.flat_map(|(a, b)| {
        let (a, b) = (mesh.positions[a as usize], mesh.positions[b as usize]);
        [0.5, 0.25, 1.0 / 3.0, 0.999].map(|s| a.lerp(b, s))
    });
    mesh.positions.iter().copied().chain(along).collect()
}

#[test]
fn rays_from_inside_hit_every_vertex_and_edge() {
    for centre in [Vec3::ZERO, Vec3::splat(1e4)] {
        let mesh = ball_at(centre, 4);
        let targets = seams(&mesh);
        for level in LEVELS {
            for quality in [Quality::Default, Quality::High] {
                let bvh = build(&mesh, quality, level);
                for o in [centre, centre + Vec3::new(0.1, -0.2, 0.05)] {
                    for &target in &targets {
                        must_hit(&bvh, &Ray::new(o, target - o), target);
                    }
                }
            }
        }
    }
}

#[test]
fn rays_from_outside_towards_the_inside_of_the_silhouette_hit() {
    let mesh = ball_at(Vec3::ZERO, 4);
    let targets = seams(&mesh);
    for level in LEVELS {
        let bvh = build(&mesh, Quality::Default, level);
        let mut rng = Rng(11);
        for &target in &targets {
            // Past the target the line goes through the middle of the ball, so it must enter somewhere.
            let far = target * (3.0 + 40.0 * rng.uniform());
            must_hit(&bvh, &Ray::new(far, target - far), target);
        }
    }
}

#[test]
fn axis_parallel_rays_hit_with_both_zeros() {
    for centre in [Vec3::ZERO, Vec3::new(1e4, -1e4, 1e4)] {
        let mesh = ball_at(centre, 4);
        for level in LEVELS {
            let bvh = build(&mesh, Quality::Default, level);
            for &target in mesh.positions.iter().filter(|&&p| (p - centre).abs().max_element() < 0.99) {
                for axis in 0..3 {
                    for (sign, zero) in [(1.0, 0.0), (-1.0, 0.0), (1.0, -0.0), (-1.0, -0.0)] {
                        let mut d = Vec3::splat(zero);
                        d[axis] = sign;
                        let mut o = target;
                        o[axis] = centre[axis];
                        if (o - centre).length() < 0.6 {
                            must_hit(&bvh, &Ray::new(o, d), target);
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn a_million_random_rays_from_inside_all_hit() {
    let mesh = ball_at(Vec3::ZERO, 5);
    for (level, count) in [(SimdLevel::Portable, 100_000), (SimdLevel::Avx2, 200_000), (SimdLevel::Avx512, 1_000_000)] {
        let bvh = build(&mesh, Quality::Default, level);
        let mut rng = Rng(5);
        for _ in 0..count {
            let (o, d) = (rng.cube() * 0.3, rng.direction() * (0.01 + 100.0 * rng.uniform()));
            assert!(bvh.closest(&Ray::new(o, d)).is_some(), "{level:?} leaks: {o} {d}");
        }
    }
}

#[test]
fn rays_in_the_plane_of_a_box_face_hit_a_grid_of_aligned_triangles() {
    // All vertices on integers: every box face holds vertices and edges, and rays run exactly along the faces.
    let mut mesh = Mesh::default();
    for y in 0..=16 {
        mesh.positions.extend((0..=16).map(|x| Vec3::new(x as f32 - 8.0, y as f32 - 8.0, 0.0)));
    }
    for (y, x) in (0..16).flat_map(|y| (0..16).map(move |x| (y, x))) {
        let i: u32 = y * 17 + x;
        mesh.indices.extend([[i, i + 1, i + 18], [i, i + 18, i + 17]]);
    }
    for level in LEVELS {
        let bvh = build(&mesh, Quality::Default, level);
        for &target in &mesh.positions {
            for d in [Vec3::Z, -Vec3::Z, Vec3::new(-0.0, 0.0, 2.0), Vec3::new(0.0, -0.0, -0.5)] {
                must_hit(&bvh, &Ray::new(target - d * 3.0, d), target);
            }
        }
    }
}
