use accel::PointGrid;
use glam::Vec3;

use crate::sets::{self, Set, Uniform, with_threads};

fn found(grid: &PointGrid, p: Vec3, r: f32) -> Vec<(f32, u32)> {
    let mut found = Vec::new();
    grid.within(p, r, |i, d2| found.push((d2, i)));
    found.sort_by(|a, b| a.partial_cmp(b).expect("no NaN"));
    found
}

fn agrees_with_brute_force(set: &Set, cell: f32) {
    finds_all(&PointGrid::build(&set.points, cell), set, &[0.0, 0.2, 1.0, 1.7, 30.0], cell);
}

/// Radii in scales of `set`; `cell` for the message.
fn finds_all(grid: &PointGrid, set: &Set, radii: &[f32], cell: f32) {
    for p in set.queries() {
        for r in radii.iter().map(|f| f * set.scale) {
            assert_eq!(found(grid, p, r), set.within(p, r), "{}: cell {cell}, {p} within {r}", set.name);
        }
    }
}

#[test]
fn every_level_finds_each_point_once() {
    // A query takes the level that suits its radius: these ask all of them, and far beyond both ends.
    let radii = [0.0, 1e-3, 0.015, 0.06, 0.25, 1.4, 6.0, 70.0, 1e3];
    for set in sets::all() {
        for (finest, levels) in [(1.0, 1), (1.0, 2), (1.0 / 64.0, 5), (0.1, 3), (1e-3, PointGrid::MOST_LEVELS)] {
            let cell = finest * set.scale;
            finds_all(&PointGrid::build_levels(&set.points, cell, levels), &set, &radii, cell);
        }
    }
}

#[test]
fn levels_far_finer_or_coarser_than_floats_can_tell_lose_nothing() {
    for set in sets::all() {
        for cell in [1e-38, 1e-7, 1e9, 3e38] {
            let grid = PointGrid::build_levels(&set.points, cell, PointGrid::MOST_LEVELS);
            finds_all(&grid, &set, &[0.0, 0.2, 1.0, 30.0], cell);
        }
    }
}

#[test]
fn each_point_within_the_radius_is_visited_once() {
    for set in sets::all() {
        for cells in [0.3, 1.0, 2.0, 50.0] {
            agrees_with_brute_force(&set, set.scale * cells);
        }
    }
}

#[test]
fn cells_far_finer_or_coarser_than_floats_can_tell_lose_nothing() {
    for set in sets::all() {
        for cell in [1e-38, 1e-7, 1e9, 3e38] {
            agrees_with_brute_force(&set, cell);
        }
    }
}

/// With many more bricks than a table of 32-bit hashes' upper bits can tell apart, places collide all the time.
#[test]
fn colliding_bricks_neither_lose_nor_double_a_point() {
    let points: Vec<Vec3> =
        (0..40_000).map(|i| Vec3::new((i % 200) as f32, (i / 200) as f32, (i % 7) as f32)).collect();
    let grid = PointGrid::build(&points, 0.25);
    for (i, &p) in points.iter().enumerate() {
        assert_eq!(found(&grid, p, 0.5), [(0.0, i as u32)]);
    }
    for p in &points {
        assert_eq!(found(&grid, *p + Vec3::new(0.0, 0.0, 50.0), 0.5), []);
    }
}

#[test]
fn points_on_cell_faces_are_found_from_either_side() {
    let mut u = Uniform(3);
    let points: Vec<Vec3> = (0..4000).map(|_| (u.vec3() * 20.0 - 10.0).round() * 0.1).collect();
    let set = Set { name: "faces", points, scale: 0.1 };
    agrees_with_brute_force(&set, 0.1);
    agrees_with_brute_force(&set, 0.025);
}

#[test]
fn a_query_outside_the_bounds_finds_what_is_within_its_radius() {
    let grid = PointGrid::build(&[Vec3::ZERO, Vec3::X], 0.1);
    assert_eq!(found(&grid, Vec3::new(-3.0, 0.0, 0.0), 3.0), [(9.0, 0)]);
    assert_eq!(found(&grid, Vec3::new(1e4, 0.0, 0.0), 2e4).len(), 2);
}

#[test]
fn broken_queries_find_nothing() {
    let grid = PointGrid::build(&[Vec3::ZERO; 10], 1.0);
    for r in [-1.0, f32::NAN, f32::NEG_INFINITY] {
        assert_eq!(found(&grid, Vec3::ZERO, r), []);
    }
    for p in [Vec3::NAN, Vec3::INFINITY, Vec3::new(0.0, f32::NEG_INFINITY, 0.0)] {
        assert_eq!(found(&grid, p, f32::INFINITY), []);
    }
}

#[test]
fn an_infinite_radius_finds_every_finite_point() {
    for set in sets::all() {
        let grid = PointGrid::build(&set.points, set.scale);
        assert_eq!(found(&grid, Vec3::ZERO, f32::INFINITY).len(), grid.len(), "{}", set.name);
        assert_eq!(grid.len(), set.points.iter().filter(|p| p.is_finite()).count());
        assert_eq!(grid.is_empty(), set.points.iter().all(|p| !p.is_finite()));
    }
}

#[test]
fn slots_and_order_lead_to_the_same_points() {
    let set = &sets::all()[3];
    let grid = PointGrid::build(&set.points, set.scale);
    let mut seen: Vec<u32> = grid.order().to_vec();
    seen.sort_unstable();
    assert!(seen.iter().copied().eq(0..set.points.len() as u32));
    for p in set.queries() {
        let (mut by_slot, mut by_index) = (Vec::new(), Vec::new());
        grid.within_slots(p, set.scale, |slot, d2| by_slot.push((grid.order()[slot as usize], d2)));
        grid.within(p, set.scale, |i, d2| by_index.push((i, d2)));
        assert_eq!(by_slot, by_index);
    }
}

#[test]
fn the_order_of_visits_does_not_depend_on_threads() {
    let mut u = Uniform(1);
    let points: Vec<Vec3> = (0..100_000).map(|_| u.vec3()).collect();
    for levels in [1, 4] {
        let visits = |threads| {
            with_threads(threads, || {
                let grid = PointGrid::build_levels(&points, 0.05 / levels as f32, levels);
                let mut visits = Vec::new();
                for (i, p) in points.iter().step_by(997).enumerate() {
                    grid.within(*p, 0.02 * (i % 8) as f32, |i, d2| visits.push((i, d2)));
                }
                (grid.order().to_vec(), visits)
            })
        };
        let one = visits(1);
        assert!(one == visits(2) && one == visits(7));
    }
}

#[test]
fn a_million_identical_points_are_no_trouble() {
    for levels in [1, 4] {
        let grid = PointGrid::build_levels(&vec![Vec3::splat(0.1); 1_000_000], 1e-3, levels);
        let mut count = 0;
        grid.within(Vec3::splat(0.1), 0.0, |_, _| count += 1);
        grid.within(Vec3::ZERO, 0.01, |_, _| count += 1);
        assert_eq!(count, 1_000_000);
    }
}

#[test]
fn a_radius_of_many_cells_does_not_walk_them_all() {
    let mut u = Uniform(2);
    let points: Vec<Vec3> = (0..1000).map(|_| u.vec3() * 1e6).collect();
    let grid = PointGrid::build(&points, 1e-3);
    let mut count = 0;
    for p in &points {
        grid.within(*p, 4e6, |_, _| count += 1);
    }
    assert_eq!(count, 1_000_000);
}

#[test]
fn memory_is_counted() {
    let points: Vec<Vec3> = (0..1000).map(|i| Vec3::splat(i as f32)).collect();
    let bytes = PointGrid::build(&points, 1.0).memory_bytes();
    assert!((16_000..200_000).contains(&bytes), "{bytes}");
}
