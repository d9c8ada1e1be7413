//! Closed geometry does not leak: a ray that starts inside always meets a wall.
use glam::{Affine3A, Mat3, Quat, Vec3};
use sunfleck::{
    bsdf::DiffuseMaterial,
    math::{Ray, warp::square_to_sphere},
    sampler::{Domain, Sampler},
    scene::{Scene, SceneBuilder, SurfaceDef},
    shape::{Mesh, Parallelogram, Shape},
    spectrum::{Rgb, Wavelengths},
};

/// A ball of triangles: an octahedron, each side cut in four `levels` times and pushed out to radius 1.
fn ball(levels: u32) -> Mesh {
    let mut triangles: Vec<[Vec3; 3]> = Vec::new();
    for [x, y, z] in [1.0f32, -1.0].map(|x| [1.0f32, -1.0].map(|y| [1.0f32, -1.0].map(|z| [x, y, z]))).concat().concat()
    {
        triangles.push([x * Vec3::X, y * Vec3::Y, z * Vec3::Z]);
    }
    for _ in 0..levels {
        let cut = |[a, b, c]: [Vec3; 3]| {
            let [ab, bc, ca] = [(a + b), (b + c), (c + a)].map(Vec3::normalize);
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(cut).collect();
    }
    let mut positions: Vec<Vec3> = Vec::new();
    let mut index_of = std::collections::HashMap::new();
    let mut index = |p: Vec3| {
        // Negative zero is the same place.
        let key = (p + 0.0).to_array().map(f32::to_bits);
        *index_of.entry(key).or_insert_with(|| {
            positions.push(p);
            positions.len() as u32 - 1
        })
    };
    let indices = triangles.iter().map(|t| t.map(&mut index)).collect();
    Mesh::new(positions, vec![], vec![], indices).unwrap()
}

/// The six walls of the cube [−1, 1]³.
fn walls() -> Vec<Shape> {
    let axes = [(Vec3::X, Vec3::Y, Vec3::Z), (Vec3::Y, Vec3::Z, Vec3::X), (Vec3::Z, Vec3::X, Vec3::Y)];
    let wall = |u: Vec3, v: Vec3, p: Vec3| Shape::Parallelogram(Parallelogram::new(p - u - v, 2.0 * u, 2.0 * v));
    axes.into_iter().flat_map(|(u, v, n)| [wall(u, v, n), wall(u, v, -n)]).collect()
}

fn scene_of(shapes: Vec<Shape>, m: Option<Affine3A>) -> Scene {
    let mut b = SceneBuilder::new();
    let reflectance = b.constant(Rgb::splat(0.5));
    let material = b.material(DiffuseMaterial { reflectance });
    let surfaces = shapes.into_iter().map(|shape| SurfaceDef { shape, material, emission: None });
    match m {
        None => surfaces.for_each(|s| b.surface(s)),
        Some(m) => {
            let object = b.object(surfaces.collect());
            b.place(object, m);
        }
    }
    b.build().unwrap()
}

fn crooked() -> Affine3A {
    let turn = Mat3::from_quat(Quat::from_euler(glam::EulerRot::XYZ, 1.0, 2.0, 3.0));
    Affine3A::from_mat3_translation(
        turn * Mat3::from_diagonal(Vec3::new(30.0, -10.0, 20.0)),
        Vec3::new(400.0, 80.0, -200.0),
    )
}

fn rooms() -> Vec<(&'static str, Scene, Affine3A)> {
    vec![
        ("ball", scene_of(vec![Shape::Mesh(ball(3))], None), Affine3A::IDENTITY),
        ("cube", scene_of(walls(), None), Affine3A::IDENTITY),
        ("placed ball", scene_of(vec![Shape::Mesh(ball(2))], Some(crooked())), crooked()),
        ("placed cube", scene_of(walls(), Some(crooked())), crooked()),
    ]
}

#[test]
fn rays_from_inside_meet_a_wall_even_through_edges_and_corners() {
    let corners = ball(3);
    for (name, scene, m) in rooms() {
        let world = scene.world(Wavelengths::Rgb, 0.0);
        for i in 0..100_000u64 {
            let s = &mut Sampler::new(3, Domain::Prepare, 0, i);
            let o = m.transform_point3(0.5 * square_to_sphere(s.next_2d()) * s.next_1d());
            // At vertices, along axes and diagonals, and anywhere.
            let target = match i % 3 {
                0 => corners.positions()[i as usize % corners.positions().len()],
                1 => [Vec3::X, Vec3::NEG_Y, Vec3::ONE, Vec3::new(1.0, -1.0, 0.0)][i as usize / 3 % 4],
                _ => square_to_sphere(s.next_2d()),
            };
            let d = (m.transform_point3(target) - o).normalize();
            assert!(world.intersect(&Ray::new(o, d)).is_some(), "{name}: {o} toward {d}");
        }
    }
}

#[test]
fn walks_along_the_walls_never_get_out() {
    for (name, scene, m) in rooms() {
        let world = scene.world(Wavelengths::Rgb, 0.0);
        let (mut steps, mut leaks, mut through_corners) = (0, 0, 0);
        for walk in 0..2000 {
            let s = &mut Sampler::new(4, Domain::Prepare, 0, walk);
            let mut ray =
                Ray::new(m.transform_point3(0.5 * square_to_sphere(s.next_2d())), square_to_sphere(s.next_2d()));
            for step in 0..60 {
                steps += 1;
                let Some(at) = world.intersect(&ray) else {
                    // Nearer to an edge than coordinates are exact, a ray may start behind the next wall.
                    let o = m.inverse().transform_point3(ray.o);
                    let outside = if name.contains("cube") { o.abs().max_element() > 1.0 } else { o.length() > 1.0 };
                    *(if outside { &mut through_corners } else { &mut leaks }) += 1;
                    break;
                };
                // Every other step nearly grazes, which is how walls are crossed in corners.
                let inward = at.ng * at.ng.dot(at.wo).signum();
                let d = square_to_sphere(s.next_2d());
                let d = if step % 2 == 0 {
                    d.reject_from(inward) + 1e-3 * s.next_1d() * inward
                } else {
                    d * d.dot(inward).signum()
                };
                ray = at.spawn(d.normalize_or(inward));
            }
        }
        assert!(steps > 100_000, "{name}: {steps}");
        assert_eq!(leaks, 0, "{name}: of {steps} steps");
        let limit = if m == Affine3A::IDENTITY { 0 } else { steps / 20_000 };
        assert!(through_corners <= limit, "{name}: {through_corners} of {steps} steps");
    }
}
