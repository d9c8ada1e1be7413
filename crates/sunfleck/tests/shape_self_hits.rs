//! A ray that leaves a surface never meets that surface again, and a shadow ray never meets the light it goes to.
//!
//! NRenderer's pictures are 3 % too dark because it leaves this to a constant; here it must hold at every scale, at every
//! distance from the origin, and for every direction.
use glam::{Affine3A, EulerRot, Mat3, Quat, Vec2, Vec3};
use sunfleck::{
    bsdf::DiffuseMaterial,
    light::{Emitter, Sides},
    math::{Frame, Ray, warp::square_to_sphere},
    sampler::{Domain, Sampler},
    scene::{Interaction, Scene, SceneBuilder, SurfaceDef, World},
    shape::{Mesh, Parallelogram, Shape, Sphere},
    spectrum::{Rgb, Wavelengths},
};

const SCALES: [f32; 3] = [1e-3, 1.0, 1e3];
const OFFSETS: [f32; 4] = [0.0, 1.0, 1e2, 1e4];
/// Shapes per scale and offset, and points and directions on each: 12 · 900 · 8 · 12 = 1 036 800 rays a kind.
const SHAPES: u64 = 900;
const POINTS: u32 = 8;
const DIRECTIONS: u32 = 12;

fn in_cube(s: &mut Sampler) -> Vec3 {
    2.0 * Vec3::new(s.next_1d(), s.next_1d(), s.next_1d()) - 1.0
}

/// A direction over the side `n`: grazing down to 1e-6, steep, or along an axis of the world.
fn leaving(n: Vec3, s: &mut Sampler, case: u32) -> Vec3 {
    let d = square_to_sphere(s.next_2d());
    match case % 4 {
        0 => d * d.dot(n).signum(),
        1 => {
            let frame = Frame::from_normal(n);
            let (sin, cos) = (std::f32::consts::TAU * s.next_1d()).sin_cos();
            (cos * frame.s + sin * frame.t + 10f32.powf(-6.0 * s.next_1d()) * n).normalize()
        }
        2 => (0.1 * d + n).normalize(),
        _ => {
            let axis = Vec3::AXES[(s.next_1d() * 3.0) as usize % 3];
            axis * axis.dot(n).signum()
        }
    }
}

fn scene_of(shape: Shape, placed: Option<Affine3A>) -> Scene {
    let mut b = SceneBuilder::new();
    let grey = b.constant(Rgb::splat(0.5));
    let material = b.material(DiffuseMaterial { reflectance: grey });
    let surface = SurfaceDef { shape, material, emission: None };
    match placed {
        None => b.surface(surface),
        Some(m) => {
            let o = b.object(vec![surface]);
            b.place(o, m);
        }
    }
    b.build().unwrap()
}

/// Where a ray from somewhere around meets the shape near `target`; `None` if rounding lets it miss an edge.
fn arrive(world: &World, target: Vec3, reach: f32, s: &mut Sampler) -> Option<Interaction> {
    let o = target + reach * (0.2 + 5.0 * s.next_1d()) * square_to_sphere(s.next_2d());
    world.intersect(&Ray::new(o, (target - o).try_normalize()?))
}

/// Counts rays that come back to a flat shape, of how many.
fn flat_self_hits(make: impl Fn(f32, Vec3, &mut Sampler) -> (Shape, Option<Affine3A>, [Vec3; 3])) -> (u32, u32) {
    let (mut bad, mut all) = (0, 0);
    for (config, (scale, offset)) in SCALES.iter().flat_map(|s| OFFSETS.map(|o| (*s, o))).enumerate() {
        for index in 0..SHAPES {
            let s = &mut Sampler::new(11, Domain::Prepare, config as u64, index);
            let centre = offset * in_cube(s);
            let (shape, placed, [p, u, v]) = make(scale, centre, s);
            let scene = scene_of(shape, placed);
            let world = scene.world(Wavelengths::Rgb, 0.0);
            for _ in 0..POINTS {
                // Squares draw points near the corner, where coordinates cancel.
                let (a, b) = (s.next_1d().powi(3), s.next_1d().powi(3));
                let target = p + a * u + b * (1.0 - a) * v;
                let Some(at) = arrive(&world, target, scale, s) else { continue };
                for case in 0..DIRECTIONS {
                    let side = if s.next_1d() < 0.5 { at.ng } else { -at.ng };
                    let d = leaving(side, s, case);
                    all += 1;
                    bad += u32::from(world.intersect(&at.spawn(d)).is_some());
                }
            }
        }
    }
    (bad, all)
}

fn no_self_hits(kind: &str, (bad, all): (u32, u32)) {
    assert!(all > 800_000, "{kind}: only {all} rays left a surface");
    assert_eq!(bad, 0, "{kind}: of {all} rays that left a surface");
}

/// Corner and two edges. Every third lies in a plane of the coordinate axes, and when `centre` is the origin in one through
/// it, where relative errors say nothing; every third is a needle, up to a thousand times as long as wide.
fn edges(scale: f32, centre: Vec3, s: &mut Sampler) -> [Vec3; 3] {
    let (p, u, mut v) = (centre + scale * in_cube(s), scale * in_cube(s), scale * in_cube(s));
    match (s.next_1d() * 3.0) as u32 {
        0 => {
            let axis = Vec3::AXES[(s.next_1d() * 3.0) as usize % 3];
            let flat = |w: Vec3| w * (1.0 - axis);
            return [flat(p) + centre * axis, flat(u), flat(v)];
        }
        1 => v = 10f32.powf(-3.0 * s.next_1d()) * v + 0.9 * u * s.next_1d(),
        _ => {}
    }
    [p, u, v]
}

#[test]
fn rays_never_return_to_the_triangle_they_leave() {
    no_self_hits(
        "triangles",
        flat_self_hits(|scale, centre, s| {
            let [p, u, v] = edges(scale, centre, s);
            (Shape::Mesh(Mesh::new(vec![p, p + u, p + v], vec![], vec![], vec![[0, 1, 2]]).unwrap()), None, [p, u, v])
        }),
    );
}

#[test]
fn rays_never_return_to_the_parallelogram_they_leave() {
    no_self_hits(
        "parallelograms",
        flat_self_hits(|scale, centre, s| {
            let [p, u, v] = edges(scale, centre, s);
            (Shape::Parallelogram(Parallelogram::new(p, u, v)), None, [p, u, v])
        }),
    );
}

#[test]
fn rays_never_return_to_the_placed_triangle_they_leave() {
    no_self_hits(
        "placed triangles",
        flat_self_hits(|scale, centre, s| {
            let [p, u, v] = edges(1.0, Vec3::ZERO, s);
            let m = placement(scale, centre, s);
            let shape = Mesh::new(vec![p, p + u, p + v], vec![], vec![], vec![[0, 1, 2]]).unwrap();
            let moved = [m.transform_point3(p), m.transform_vector3(u), m.transform_vector3(v)];
            (Shape::Mesh(shape), Some(m), moved)
        }),
    );
}

/// Turned, unevenly scaled and in half the cases mirrored.
fn placement(scale: f32, centre: Vec3, s: &mut Sampler) -> Affine3A {
    let turn = |s: &mut Sampler| {
        let a = 6.0 * in_cube(s);
        Mat3::from_quat(Quat::from_euler(EulerRot::XYZ, a.x, a.y, a.z))
    };
    let sign = if s.next_1d() < 0.5 { -1.0 } else { 1.0 };
    let stretch = scale * Vec3::new(sign * (0.3 + s.next_1d()), 0.3 + s.next_1d(), 0.3 + s.next_1d());
    Affine3A::from_mat3_translation(turn(s) * Mat3::from_diagonal(stretch) * turn(s), centre)
}

/// Rays leaving a ball meet nothing; rays entering it meet its far side at the chord's end.
fn sphere_self_hits(placed: bool) -> (u32, u32) {
    let (mut bad, mut all) = (0, 0);
    for (config, (scale, offset)) in SCALES.iter().flat_map(|s| OFFSETS.map(|o| (*s, o))).enumerate() {
        for index in 0..SHAPES {
            let s = &mut Sampler::new(13, Domain::Prepare, config as u64, index);
            let centre = offset * in_cube(s);
            let ball = |centre, radius| Shape::Sphere(Sphere { centre, radius });
            let scene = if placed {
                scene_of(ball(0.1 * in_cube(s), 1.0), Some(placement(scale, centre, s)))
            } else {
                scene_of(ball(centre, scale), None)
            };
            let world = scene.world(Wavelengths::Rgb, 0.0);
            for _ in 0..POINTS {
                let target = centre + 0.3 * scale * in_cube(s);
                let Some(at) = arrive(&world, target, 2.0 * scale, s) else { continue };
                for case in 0..DIRECTIONS {
                    let out = leaving(at.ng, s, case);
                    all += 2;
                    bad += u32::from(world.intersect(&at.spawn(out)).is_some());
                    bad += u32::from(returns_inside(&world, &at, -out, if placed { 0.05 } else { 1.0 } * scale));
                }
            }
        }
    }
    (bad, all)
}

/// Whether a ray into the ball ends well before the chord of a ball of radius `r` would.
fn returns_inside(world: &World, at: &Interaction, d: Vec3, r: f32) -> bool {
    let chord = -2.0 * r * d.dot(at.ng);
    let slack = 4.0 * at.p_error.length() * (r / chord).max(1.0);
    world.intersect(&at.spawn(d)).is_some_and(|hit| hit.distance < 0.5 * chord - slack)
}

#[test]
fn rays_never_return_to_the_sphere_they_leave() {
    no_self_hits("spheres", sphere_self_hits(false));
}

#[test]
fn rays_never_return_to_the_placed_sphere_they_leave() {
    no_self_hits("placed spheres", sphere_self_hits(true));
}

/// A matt floor and an emitter over it, nothing else.
fn lit(light: Shape, floor: Shape) -> Scene {
    let mut b = SceneBuilder::new();
    let grey = b.constant(Rgb::splat(0.5));
    let material = b.material(DiffuseMaterial { reflectance: grey });
    b.add(floor, material);
    b.surface(SurfaceDef { shape: light, material, emission: Some((Rgb::ONE.into(), Sides::Two)) });
    b.build().unwrap()
}

#[test]
fn shadow_rays_never_meet_the_light_they_go_to_nor_the_surface_they_leave() {
    let (mut blocked, mut all) = (0, 0);
    for (config, (scale, offset)) in SCALES.iter().flat_map(|s| OFFSETS.map(|o| (*s, o))).enumerate() {
        // A scene of which a float resolves no part has no shadows to speak of.
        if offset * f32::EPSILON * 1e4 > scale {
            continue;
        }
        for index in 0..600 {
            let s = &mut Sampler::new(17, Domain::Prepare, config as u64, index);
            let centre = offset * in_cube(s);
            let floor = Parallelogram::new(
                centre - scale * Vec3::ONE.with_z(0.0),
                2.0 * scale * Vec3::X,
                2.0 * scale * Vec3::Y,
            );
            let above = centre + scale * (1.5 + s.next_1d()) * Vec3::Z;
            let light = match index % 3 {
                0 => Shape::Sphere(Sphere { centre: above, radius: 0.5 * scale }),
                1 => {
                    Shape::Parallelogram(Parallelogram::new(above, 0.4 * scale * in_cube(s), 0.4 * scale * in_cube(s)))
                }
                _ => {
                    let p = [0, 1, 2].map(|_| above + 0.4 * scale * in_cube(s));
                    Shape::Mesh(Mesh::new(p.to_vec(), vec![], vec![], vec![[0, 1, 2]]).unwrap())
                }
            };
            let scene = lit(light, Shape::Parallelogram(floor));
            let world = scene.world(Wavelengths::Rgb, 0.0);
            for _ in 0..64 {
                let target = floor.p() + s.next_1d() * floor.u() + s.next_1d() * floor.v();
                let d = (scale * Vec3::new(0.0, 0.0, -0.3) + 0.05 * scale * in_cube(s)).normalize();
                let Some(at) = world.intersect(&Ray::new(target - 0.3 * scale * d, d)) else { continue };
                let u: Vec2 = s.next_2d();
                let Some(li) = scene.lights()[0].sample_li(at.p, u, world.around()) else { continue };
                all += 1;
                blocked += u32::from(world.occluded(&at.spawn_toward(li.wi, &li.end)));
            }
        }
    }
    assert!(all > 300_000, "{all}");
    assert_eq!(blocked, 0, "of {all} shadow rays");
}
