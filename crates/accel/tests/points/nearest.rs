use accel::{KdTree, Neighbours};
use glam::Vec3;

use crate::sets::{self, Uniform, with_threads};

fn found(tree: &KdTree, p: Vec3, k: usize, r_max: f32) -> Vec<(f32, u32)> {
    let mut out = Neighbours::new();
    tree.nearest(p, k, r_max, &mut out);
    out.iter().map(|(i, d2)| (d2, i)).collect()
}

#[test]
fn the_k_nearest_are_those_of_brute_force() {
    for set in sets::all() {
        let tree = KdTree::build(&set.points);
        let mut out = Neighbours::new();
        for p in set.queries() {
            for r_max in [0.0, 0.3 * set.scale, 2.0 * set.scale, f32::INFINITY] {
                let all = set.within(p, r_max);
                for k in [0, 1, 2, 15, 16, 17, 100, 5000] {
                    tree.nearest(p, k, r_max, &mut out);
                    let found: Vec<_> = out.iter().map(|(i, d2)| (d2, i)).collect();
                    assert_eq!(found, all[..k.min(all.len())], "{}: {k} of {p} within {r_max}", set.name);
                    tree.nearest_unordered(p, k, r_max, &mut out);
                    assert_eq!(out.farthest(), found.last().map(|&(d2, i)| (i, d2)), "{}: {k} of {p}", set.name);
                    let mut sorted: Vec<_> = out.iter().map(|(i, d2)| (d2, i)).collect();
                    sorted.sort_by(|a, b| a.partial_cmp(b).expect("no NaN"));
                    assert_eq!(sorted, found, "{}: {k} of {p} within {r_max}", set.name);
                }
            }
        }
    }
}

#[test]
fn sizes_around_whole_nodes_lose_no_point() {
    let mut u = Uniform(5);
    let points: Vec<Vec3> = (0..5000).map(|_| u.vec3()).collect();
    for n in [15, 16, 17, 255, 256, 257, 271, 272, 4095, 4096, 4097, 4112, 4352, 5000] {
        let tree = KdTree::build(&points[..n]);
        assert_eq!(tree.len(), n);
        let mut indices: Vec<u32> = found(&tree, Vec3::splat(0.4), n + 1, 10.0).iter().map(|&(_, i)| i).collect();
        indices.sort_unstable();
        assert!(indices.into_iter().eq(0..n as u32), "{n}");
    }
}

#[test]
fn broken_queries_find_nothing() {
    let tree = KdTree::build(&[Vec3::ZERO; 10]);
    for r_max in [-1.0, f32::NAN, f32::NEG_INFINITY] {
        assert_eq!(found(&tree, Vec3::ZERO, 5, r_max), []);
    }
    for p in [Vec3::NAN, Vec3::INFINITY, Vec3::new(0.0, f32::NEG_INFINITY, 0.0)] {
        assert_eq!(found(&tree, p, 5, f32::INFINITY), []);
    }
}

#[test]
fn of_a_million_identical_points_the_lowest_indices_are_nearest() {
    let tree = KdTree::build(&vec![Vec3::splat(0.1); 1_000_000]);
    for p in [Vec3::splat(0.1), Vec3::ZERO].repeat(1000) {
        let indices = found(&tree, p, 100, 1.0);
        assert!(indices.iter().map(|&(_, i)| i).eq(0..100));
    }
}

#[test]
fn a_dense_spot_far_inside_a_large_scene_is_still_split() {
    let mut u = Uniform(4);
    let mut points: Vec<Vec3> = (0..100_000).map(|_| Vec3::splat(5.0) + u.vec3() * 1e-3).collect();
    points.extend([Vec3::splat(-1e8), Vec3::splat(1e8)]);
    let tree = KdTree::build(&points);
    for p in &points[..20_000] {
        assert_eq!(found(&tree, *p, 1, 1.0)[0].0, 0.0);
    }
}

#[test]
fn neighbours_do_not_depend_on_threads() {
    let mut u = Uniform(1);
    let points: Vec<Vec3> = (0..100_000).map(|_| (u.vec3() * 50.0).floor()).collect();
    let answers = |threads| {
        with_threads(threads, || {
            let tree = KdTree::build(&points);
            points.iter().step_by(997).map(|p| found(&tree, *p, 40, 5.0)).collect::<Vec<_>>()
        })
    };
    let one = answers(1);
    assert!(one == answers(2) && one == answers(7));
}

#[test]
fn neighbours_tell_their_farthest() {
    let tree = KdTree::build(&[Vec3::X, Vec3::X * 2.0, Vec3::X * 3.0]);
    let mut out = Neighbours::new();
    assert!(out.is_empty() && out.farthest().is_none());
    tree.nearest(Vec3::ZERO, 2, 10.0, &mut out);
    assert_eq!((out.len(), out.get(0), out.get(2)), (2, Some((0, 1.0)), None));
    assert_eq!(out.farthest(), Some((1, 4.0)));
}
