//! The hierarchy gives the answers of a loop over all primitives.

use crate::LEVELS;
use crate::support::{Mesh, Rng, brute_force, bumpy_ball, triangle_soup};
use accel::{Bvh, Quality, Ray};

fn agrees_with_brute_force(mesh: &Mesh, quality: Quality) {
    for level in LEVELS {
        let bvh = Bvh::build(&[mesh.geometry()], &[], &[], quality).with_simd(level);
        let mut rng = Rng(7);
        let mut hits = 0;
        for _ in 0..500 {
            let ray = Ray { o: rng.cube() * 1.5, d: rng.cube(), tmin: 0.01, tmax: 0.3 + 3.0 * rng.uniform() };
            let (found, expected) = (bvh.closest(&ray), brute_force(mesh, &ray));
            assert_eq!(found.is_some(), expected.is_some(), "{level:?} {ray:?}");
            assert_eq!(bvh.occluded(&ray), expected.is_some(), "{level:?} {ray:?}");
            if let (Some(found), Some(expected)) = (found, expected) {
                assert!((found.t - expected.t).abs() <= 1e-5 * expected.t, "{found:?} {expected:?}");
                if found.primitive == expected.primitive {
                    assert!((found.u - expected.u).abs() < 1e-3 && (found.v - expected.v).abs() < 1e-3);
                } else {
                    assert!((found.t - expected.t).abs() <= 1e-6 * expected.t, "{found:?} {expected:?}");
                }
                hits += 1;
            }
        }
        assert!(hits > 50, "only {hits} hits");
    }
}

#[test]
fn rays_find_the_nearest_triangle_of_a_soup() {
    agrees_with_brute_force(&triangle_soup(3000, 0.15, 1), Quality::Default);
    agrees_with_brute_force(&triangle_soup(3000, 0.15, 2), Quality::High);
}

#[test]
fn rays_find_the_nearest_triangle_of_a_closed_mesh() {
    agrees_with_brute_force(&bumpy_ball(4, 0.3), Quality::Default);
}

#[test]
fn small_scenes_of_every_size_work() {
    for count in 1..40 {
        let mesh = triangle_soup(count, 0.8, count as u64);
        let bvh = Bvh::build(&[mesh.geometry()], &[], &[], Quality::Default);
        let mut rng = Rng(3);
        for _ in 0..100 {
            let ray = Ray::new(rng.cube() * 2.0, rng.direction());
            let (found, expected) = (bvh.closest(&ray), brute_force(&mesh, &ray));
            assert_eq!(found.map(|h| h.primitive), expected.map(|h| h.primitive), "{count} {ray:?}");
        }
    }
}
