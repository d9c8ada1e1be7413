//! Spheres, instances, filters, and input that no ray can hit.

use crate::LEVELS;
use crate::support::{Mesh, Rng, brute_force, bumpy_ball, triangle_soup};
use accel::{Bvh, Geometry, Hit, Instance, Objects, Quality, Ray};
use glam::{Affine3A, Quat, Vec3};

fn spheres(all: &[(Vec3, f32)]) -> Bvh {
    let geometry: Vec<_> = all.iter().map(|&(centre, radius)| Geometry::Sphere { centre, radius }).collect();
    Bvh::build(&geometry, &[], &[], Quality::Default)
}

#[test]
fn rays_meet_spheres_where_the_quadratic_says() {
    let mut rng = Rng(21);
    let all: Vec<(Vec3, f32)> = (0..200).map(|_| (rng.cube() * 3.0, 0.01 + 0.4 * rng.uniform())).collect();
    let bvh = spheres(&all);
    for _ in 0..5000 {
        let ray = Ray::new(rng.cube() * 4.0, rng.direction() * 2.0);
        let roots = |&(centre, radius): &(Vec3, f32)| {
            let (oc, d) = ((ray.o - centre).as_dvec3(), ray.d.as_dvec3());
            let (a, b, c) = (d.dot(d), oc.dot(d), oc.dot(oc) - f64::from(radius).powi(2));
            let root = (b * b - a * c).sqrt();
            [(-b - root) / a, (-b + root) / a].into_iter().find(|&t| t > 0.0)
        };
        let expected = all.iter().filter_map(roots).min_by(f64::total_cmp);
        let found = bvh.closest(&ray);
        assert_eq!(found.is_some(), expected.is_some(), "{ray:?}");
        if let (Some(found), Some(expected)) = (found, expected) {
            assert!((f64::from(found.t) - expected).abs() <= 1e-6 * expected.max(0.01), "{found:?} {expected}");
        }
    }
}

#[test]
fn far_huge_and_tiny_spheres_keep_their_precision() {
    for (centre, radius, o, expected) in [
        (Vec3::ZERO, 1.0, Vec3::new(0.0, 0.0, 1e6), 999_999.0),
        (Vec3::ZERO, 1e-6, Vec3::new(0.0, 0.0, 100.0), 100.0 - 1e-6),
        (Vec3::new(0.0, 0.0, -1e7), 1e7, Vec3::Z, 1.0),
        (Vec3::new(0.0, 0.0, 5.0), 10.0, Vec3::Z, 6.0),
    ] {
        let hit = spheres(&[(centre, radius)]).closest(&Ray::new(o, Vec3::NEG_Z)).expect("a hit");
        assert!((f64::from(hit.t) - expected).abs() <= 2e-7 * expected, "{hit:?} {expected}");
    }
    let grazing = spheres(&[(Vec3::ZERO, 1.0)]);
    assert!(grazing.occluded(&Ray::new(Vec3::new(0.999_999, 0.0, 1e4), Vec3::NEG_Z)));
    assert!(!grazing.occluded(&Ray::new(Vec3::new(1.000_001, 0.0, 1e4), Vec3::NEG_Z)));
}

/// Triangles of each mesh but the last of an object.
const CUT: u32 = 100;

/// A mesh as several.
fn cut(mesh: &Mesh) -> Vec<Geometry<'_>> {
    let geometry = |indices| Geometry::Triangles { positions: &mesh.positions, indices };
    mesh.indices.chunks(CUT as usize).map(geometry).collect()
}

#[test]
fn instances_answer_like_their_transformed_triangles() {
    let ball = bumpy_ball(2, 0.3);
    let soup = triangle_soup(300, 0.4, 9);
    let mut rng = Rng(4);
    let place = |rng: &mut Rng| {
        let turn = Quat::from_axis_angle(rng.direction(), 6.0 * rng.uniform());
        let scale = Vec3::new(0.2 + rng.uniform(), -0.2 - rng.uniform(), 0.2 + rng.uniform()) * 0.4;
        Affine3A::from_scale_rotation_translation(scale, turn, rng.cube() * 2.0)
    };
    let instances: Vec<Instance> =
        (0..30).map(|i| Instance { object: i % 2, world_from_object: place(&mut rng) }).collect();
    let mut flat = soup.clone();
    let mut owner: Vec<_> = (0..soup.indices.len() as u32).map(|i| (Hit::NO_INSTANCE, 0, i)).collect();
    for (id, instance) in instances.iter().enumerate() {
        let object = if instance.object == 0 { &ball } else { &soup };
        let first = flat.positions.len() as u32;
        flat.positions.extend(object.positions.iter().map(|&p| instance.world_from_object.transform_point3(p)));
        flat.indices.extend(object.indices.iter().map(|t| t.map(|i| i + first)));
        owner.extend((0..object.indices.len() as u32).map(|i| (id as u32, i / CUT, i % CUT)));
    }
    let (balls, soups) = (cut(&ball), cut(&soup));
    let objects: [&[Geometry]; 2] = [&balls, &soups];
    for level in LEVELS {
        let bvh = Bvh::build(&[soup.geometry()], &objects, &instances, Quality::Default).with_simd(level);
        assert_eq!(bvh.counts().instances, 30);
        let mut rng = Rng(8);
        for _ in 0..1000 {
            let ray = Ray { o: rng.cube() * 3.0, d: rng.cube(), tmin: 0.0, tmax: 4.0 };
            let (found, expected) = (bvh.closest(&ray), brute_force(&flat, &ray));
            assert_eq!(found.is_some(), expected.is_some(), "{ray:?}");
            assert_eq!(bvh.occluded(&ray), expected.is_some(), "{ray:?}");
            if let (Some(found), Some(expected)) = (found, expected) {
                assert!((found.t - expected.t).abs() <= 1e-4 * expected.t, "{found:?} {expected:?}");
                let names = (found.instance, found.geometry, found.primitive);
                assert_eq!(names, owner[expected.primitive as usize]);
            }
        }
    }
}

#[test]
fn objects_placed_anew_answer_as_if_built_anew() {
    let (ball, soup) = (bumpy_ball(2, 0.3), triangle_soup(300, 0.4, 9));
    let sphere = Geometry::Sphere { centre: Vec3::X, radius: 0.5 };
    let groups: [&[Geometry]; 3] = [&[ball.geometry()], &[], &[soup.geometry(), sphere]];
    let objects = Objects::build(&groups, Quality::Default);
    assert!(objects.bounds(1).is_empty() && objects.bounds(2).contains(Vec3::X * 1.5));
    let mut rng = Rng(31);
    for moment in 0..20 {
        let mut place = |object| Instance {
            object,
            world_from_object: Affine3A::from_rotation_translation(
                Quat::from_axis_angle(rng.direction(), 6.0 * rng.uniform()),
                rng.cube() * 2.0,
            ),
        };
        let instances: Vec<Instance> = (0..moment).map(|i| place(i % 3)).collect();
        let world = &[ball.geometry(), sphere][..moment as usize % 3];
        let moved = objects.place(world, &instances, Quality::Default);
        let built = Bvh::build(world, &groups, &instances, Quality::Default);
        assert_eq!((moved.counts(), moved.bounds()), (built.counts(), built.bounds()));
        for _ in 0..300 {
            let ray = Ray::new(rng.cube() * 3.0, rng.direction());
            assert_eq!(moved.closest(&ray), built.closest(&ray));
        }
    }
}

#[test]
fn a_filter_lets_rays_through() {
    let soup = triangle_soup(2000, 0.2, 12);
    let even = |hit: &Hit| hit.primitive.is_multiple_of(2);
    let mut half = soup.clone();
    half.indices = soup.indices.iter().copied().step_by(2).collect();
    for level in LEVELS {
        let bvh = Bvh::build(&[soup.geometry()], &[], &[], Quality::Default).with_simd(level);
        let mut rng = Rng(2);
        for _ in 0..300 {
            let ray = Ray::new(rng.cube() * 1.5, rng.direction());
            let expected = brute_force(&half, &ray).map(|hit| hit.primitive * 2);
            assert_eq!(bvh.closest_filtered(&ray, even).map(|hit| hit.primitive), expected);
            assert_eq!(bvh.occluded_filtered(&ray, even), expected.is_some());
        }
    }
}

#[test]
fn an_empty_hierarchy_has_no_hits_and_empty_bounds() {
    let bvh = Bvh::build(&[], &[], &[], Quality::Default);
    assert!(bvh.closest(&Ray::new(Vec3::ZERO, Vec3::X)).is_none() && bvh.bounds().is_empty());
}

#[test]
fn unusable_input_is_dropped_and_counted() {
    let bad = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X * 2.0, Vec3::NAN, Vec3::INFINITY, Vec3::splat(1e30)];
    let indices = [[0, 1, 2], [0, 1, 3], [0, 0, 0], [0, 1, 4], [0, 5, 2], [6, 1, 2]];
    let mesh = Geometry::Triangles { positions: &bad, indices: &indices };
    let sphere = |radius| Geometry::Sphere { centre: Vec3::ZERO, radius };
    let flat = Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0));
    let instance = |object, world_from_object| Instance { object, world_from_object };
    let instances = [
        instance(0, Affine3A::IDENTITY),
        instance(0, flat),
        instance(0, Affine3A::from_translation(Vec3::NAN)),
        instance(1, Affine3A::IDENTITY),
    ];
    let world = [mesh, sphere(0.0), sphere(-1.0), sphere(f32::NAN), sphere(f32::INFINITY)];
    let bvh = Bvh::build(&world, &[&[sphere(1.0)], &[]], &instances, Quality::High);
    let counts = bvh.counts();
    assert_eq!((counts.triangles, counts.spheres, counts.instances), (1, 1, 1));
    assert_eq!((counts.dropped_primitives, counts.dropped_instances), (9, 3));
    for d in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
        assert!(bvh.closest(&Ray::new(Vec3::Z * 3.0, d)).is_none());
    }
}

#[test]
fn equal_and_exponentially_spaced_centres_build() {
    let mut equal = triangle_soup(1, 0.5, 3);
    equal.indices = vec![[0, 1, 2]; 20_000];
    let mut spread = triangle_soup(2000, 0.1, 3);
    for (i, p) in spread.positions.iter_mut().enumerate() {
        *p *= 0.97_f32.powi(i as i32 / 3);
    }
    for quality in [Quality::Default, Quality::High] {
        for mesh in [&equal, &spread] {
            let bvh = Bvh::build(&[mesh.geometry()], &[], &[], quality);
            let [a, b, c] = mesh.corners(0);
            let ray = Ray::new((a + b + c) / 3.0 + (b - a).cross(c - a), -(b - a).cross(c - a));
            assert!(bvh.closest(&ray).is_some());
        }
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let soup = triangle_soup(30_000, 0.3, 6);
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
        pool.install(|| Bvh::build(&[soup.geometry()], &[], &[], Quality::High))
    };
    let (one, three) = (build(1), build(3));
    assert_eq!(one.memory_bytes(), three.memory_bytes());
    let mut rng = Rng(1);
    for _ in 0..2000 {
        let ray = Ray::new(rng.cube(), rng.direction());
        assert_eq!(one.closest(&ray), three.closest(&ray));
    }
}
