//! What a scene promises: placing an object is the same as moving its geometry, and what is missing is named.
use glam::{Affine3A, EulerRot, Mat3, Quat, Vec2, Vec3};
use sunfleck::{
    bsdf::{DiffuseMaterial, Transport, TwoSidedMaterial},
    light::{AreaLight, DirectionalLight, EnvironmentLight, Light, PointLight, Sides},
    math::{Ray, warp::square_to_sphere},
    sampler::{Domain, Sampler},
    scene::{Interaction, MaterialId, ObjectId, Record, Scene, SceneBuilder, Sky, SurfaceDef, TextureId},
    shape::{Mesh, Parallelogram, Shape, Sphere},
    spectrum::{Rgb, Spectrum, Wavelengths},
    texture::{Checkerboard, Product, Texture, UvMap, VertexColour},
};

const RGB: Wavelengths = Wavelengths::Rgb;

fn sampler(i: u64) -> Sampler<'static> {
    Sampler::new(21, Domain::Prepare, 0, i)
}

fn in_cube(s: &mut Sampler) -> Vec3 {
    2.0 * Vec3::new(s.next_1d(), s.next_1d(), s.next_1d()) - 1.0
}

fn grey(b: &mut SceneBuilder) -> MaterialId {
    let reflectance = b.constant(Rgb::splat(0.5));
    b.material(DiffuseMaterial { reflectance })
}

/// A bumpy open sheet with vertex normals and texture coordinates.
fn sheet() -> Mesh {
    let n = 6u32;
    let at = |i: u32| Vec2::new((i % n) as f32, (i / n) as f32) / (n - 1) as f32;
    let height = |p: Vec2| 0.2 * (5.0 * p.x).sin() * (4.0 * p.y).cos();
    let positions = (0..n * n).map(|i| (2.0 * at(i) - 1.0).extend(height(at(i)))).collect();
    let normals = (0..n * n).map(|i| Vec3::new((7.0 * at(i).x).sin() * 0.3, 0.2, 1.0).normalize()).collect();
    let quads = (0..n - 1).flat_map(|y| (0..n - 1).map(move |x| y * n + x));
    let indices = quads.flat_map(|i| [[i, i + 1, i + n], [i + 1, i + n + 1, i + n]]).collect();
    Mesh::new(positions, normals, (0..n * n).map(at).collect(), indices).unwrap()
}

fn turn(x: f32, y: f32, z: f32) -> Mat3 {
    Mat3::from_quat(Quat::from_euler(EulerRot::XYZ, x, y, z))
}

/// A turn, an uneven stretch, a mirror image, a shear, and all of it far out.
fn placements() -> Vec<(&'static str, Affine3A)> {
    let place = |m, t| Affine3A::from_mat3_translation(m, t);
    let stretch = Mat3::from_diagonal(Vec3::new(2.0, 0.5, 1.3));
    let mirror = Mat3::from_diagonal(Vec3::new(-1.0, 1.0, 1.0));
    let shear = Mat3::from_cols(Vec3::X, Vec3::new(0.7, 1.0, 0.0), Vec3::new(-0.2, 0.4, 1.0));
    vec![
        ("turned", place(turn(0.4, 1.0, -2.0), Vec3::new(1.0, 2.0, 3.0))),
        ("stretched", place(turn(0.3, 0.2, 0.1) * stretch, Vec3::Y)),
        ("mirrored", place(mirror, Vec3::ZERO)),
        ("turned, stretched, mirrored", place(turn(1.0, 0.1, 2.0) * stretch * mirror * turn(0.5, 0.6, 0.7), Vec3::X)),
        ("turned inside out", place(-turn(1.0, 2.0, 3.0), Vec3::NEG_Z)),
        ("sheared", place(shear, Vec3::ZERO)),
        ("far and large", place(50.0 * turn(2.0, 1.0, 0.0) * mirror, Vec3::new(3000.0, -500.0, 100.0))),
    ]
}

/// [`grey`], by a texture that looks at its coordinates.
fn checked(b: &mut SceneBuilder) -> MaterialId {
    let grey = b.constant(Rgb::splat(0.5));
    let reflectance = b.texture(Texture::Checkerboard(Checkerboard { of: [grey; 2], map: UvMap::default() }));
    b.material(DiffuseMaterial { reflectance })
}

fn placed(shape: Shape, m: Affine3A) -> Scene {
    let mut b = SceneBuilder::new();
    let material = checked(&mut b);
    let object = b.object(vec![SurfaceDef { shape, material, emission: None }]);
    b.place(object, m);
    b.build().unwrap()
}

fn moved(shape: &Shape, m: Affine3A) -> Scene {
    let mut b = SceneBuilder::new();
    let material = checked(&mut b);
    b.add(shape.transformed(&m).unwrap(), material);
    b.build().unwrap()
}

/// Rays at an object within the cube of side 2 around the origin, after placing.
fn rays_at(m: Affine3A, count: u64) -> impl Iterator<Item = Ray> {
    (0..count).map(move |i| {
        let s = &mut sampler(i);
        let (a, b) = (m.transform_point3(3.0 * square_to_sphere(s.next_2d())), m.transform_point3(in_cube(s)));
        Ray::new(a, (b - a).normalize())
    })
}

fn same_shading(a: &Interaction, b: &Interaction, scale: f32) -> bool {
    let wi = b.ng * b.ng.dot(b.wo).signum();
    // A plane that is off by a rounding is hit by a grazing ray that much further on.
    let slack = 1e-4 * scale / b.ng.dot(b.wo).abs();
    (a.p - b.p).length() < slack
        && (a.ng - b.ng).length() < 1e-3
        && (a.frame.n - b.frame.n).length() < 1e-3
        && (a.distance - b.distance).abs() < slack
        && (a.f_cos(wi, Transport::Radiance).max() - b.f_cos(wi, Transport::Radiance).max()).abs() < 1e-3
}

#[test]
fn hits_know_their_texture_coordinates_where_the_material_looks_at_them() {
    let ball = Shape::Sphere(Sphere { centre: Vec3::ZERO, radius: 1.0 });
    // Its x and y tell half a radian of longitude, its z a sixth of the way from pole to pole.
    let n = Vec3::new(0.5f32.cos(), 0.5f32.sin(), 0.0) * 0.75f32.sqrt() + 0.5 * Vec3::Z;
    let world = placed(ball, Affine3A::IDENTITY);
    let at = world.world(RGB, 0.0).intersect(&Ray::new(3.0 * n, -n)).unwrap();
    assert!((at.uv - Vec2::new(0.5 / std::f32::consts::TAU, 2.0 / 3.0)).length() < 1e-5, "{}", at.uv);
}

#[test]
fn what_is_recalled_is_what_was_met() {
    for (name, m) in placements() {
        let scene = placed(Shape::Mesh(sheet()), m);
        let world = scene.world(RGB, 0.0);
        let mut hits = 0;
        for (i, at) in rays_at(m, 2000).filter_map(|ray| world.intersect(&ray)).enumerate() {
            hits += 1;
            assert!(world.can_recall(&at));
            let again = world.recall(&Record::new(&at));
            let wi = square_to_sphere(sampler(i as u64).next_2d());
            assert_eq!((again.p, again.ng, again.wo, again.uv), (at.p, at.ng, at.wo, at.uv), "{name}");
            assert_eq!((again.pdf(wi), again.pdf_back(wi)), (at.pdf(wi), at.pdf_back(wi)), "{name}");
            for mode in [Transport::Radiance, Transport::Flux] {
                assert_eq!(again.f_cos(wi, mode), at.f_cos(wi, mode), "{name}");
            }
            // Off the surface by as much, but for roundings.
            let (far, moved) = ((again.spawn(wi).o - at.spawn(wi).o).length(), (at.spawn(wi).o - at.p).length());
            assert!(far <= 1e-3 * moved + 2.0 * f32::EPSILON * at.p.abs().max_element(), "{name}: {far} of {moved}");
        }
        assert!(hits > 300, "{name}");
    }
}

#[test]
fn what_depends_on_more_than_the_place_is_not_recalled() {
    let mut b = SceneBuilder::new();
    let of = grey(&mut b);
    let colours = b.texture(Texture::Vertex(VertexColour::Rgb));
    let twice = b.texture(Texture::Product(Product { of: [colours; 2] }));
    let dyed = b.material(DiffuseMaterial { reflectance: twice });
    let covered = b.material(TwoSidedMaterial { front: Some(of), back: None });
    for (x, material) in [(0.0, of), (10.0, dyed), (20.0, covered)] {
        b.add(Shape::Sphere(Sphere { centre: Vec3::new(x, 0.0, 0.0), radius: 1.0 }), material);
    }
    let scene = b.build().unwrap();
    let world = scene.world(RGB, 0.0);
    let recalled = [0.0, 10.0, 20.0].map(|x| {
        let at = world.intersect(&Ray::new(Vec3::new(x, 0.0, -5.0), Vec3::Z)).unwrap();
        world.can_recall(&at)
    });
    assert_eq!(recalled, [true, false, false]);
}

#[test]
fn a_placed_object_is_hit_and_shaded_like_the_same_geometry_moved() {
    let quad = Parallelogram::new(Vec3::new(-0.8, -0.5, 0.1), Vec3::new(1.5, 0.2, 0.3), Vec3::new(0.1, 1.2, -0.2));
    for (kind, shape) in [("mesh", Shape::Mesh(sheet())), ("parallelogram", Shape::Parallelogram(quad))] {
        for (name, m) in placements() {
            let (instance, by_hand) = (placed(shape.clone(), m), moved(&shape, m));
            let (instance, by_hand) = (instance.world(RGB, 0.0), by_hand.world(RGB, 0.0));
            let (mut hits, mut edges) = (0, 0);
            for ray in rays_at(m, 4000) {
                match (instance.intersect(&ray), by_hand.intersect(&ray)) {
                    (Some(a), Some(b)) => {
                        hits += 1;
                        let scale = m.matrix3.determinant().abs().cbrt() + b.p.length() * 0.01;
                        let mirrored_edges = kind == "parallelogram" && m.matrix3.determinant() < 0.0;
                        let same_uv = mirrored_edges || (a.uv - b.uv).length() < 1e-3;
                        assert!(same_shading(&a, &b, scale) && same_uv, "{kind} {name}: {a:#?} {b:#?}");
                    }
                    (None, None) => {}
                    _ => edges += 1,
                }
            }
            assert!(hits > 300 && edges < 3, "{kind} {name}: {hits} hits, {edges} differ");
        }
    }
}

#[test]
fn a_placed_sphere_is_the_ellipsoid_of_its_matrix_with_normals_outward() {
    let ball = Sphere { centre: Vec3::new(0.1, -0.2, 0.0), radius: 0.7 };
    for (name, m) in placements() {
        let scene = placed(Shape::Sphere(ball), m);
        let world = scene.world(RGB, 0.0);
        let inverse = m.inverse();
        let size = m.matrix3.determinant().abs().cbrt();
        let mut hits = 0;
        for ray in rays_at(m, 2000) {
            let Some(at) = world.intersect(&ray) else { continue };
            hits += 1;
            let local = inverse.transform_point3(at.p) - ball.centre;
            assert!((local.length() / ball.radius - 1.0).abs() < 1e-3, "{name}: {} off the surface", local.length());
            // The gradient of |M⁻¹p − c|² points outward.
            let n = (inverse.matrix3.transpose() * local).normalize();
            assert!((at.ng - n).length() < 2e-3 && (at.frame.n - n).length() < 2e-3, "{name}: {} and {n}", at.ng);
            assert!((at.p - ray.at(at.distance)).length() < 1e-3 * size + 1e-5 * at.p.length(), "{name}");
            assert!(ray.d.dot(at.ng) < 0.0, "{name}: hit from inside");
        }
        assert!(hits > 300, "{name}: {hits}");
    }
}

fn emitter(shape: Shape, material: MaterialId) -> SurfaceDef {
    SurfaceDef { shape, material, emission: Some((Rgb::new(3.0, 2.0, 1.0).into(), Sides::One)) }
}

#[test]
fn emitting_objects_become_lights_wherever_they_are_placed() {
    for (name, m) in placements() {
        let mut b = SceneBuilder::new();
        let material = grey(&mut b);
        let object = b.object(vec![emitter(Shape::Mesh(sheet()), material)]);
        b.place(object, m);
        b.place(object, Affine3A::from_translation(Vec3::new(0.0, 0.0, -100.0)));
        let scene = b.build().unwrap();
        assert_eq!(scene.lights().len(), 2, "{name}");
        let world = scene.world(RGB, 0.0);
        let (mut front, mut back) = (0, 0);
        for ray in rays_at(m, 2000) {
            let Some(at) = world.intersect(&ray) else { continue };
            // The side that emits is the outer one, mirrored or not: local +z.
            let local = m.inverse().transform_vector3(ray.d);
            let le = world.emitted(&at);
            assert_eq!(!le.is_black(), at.ng.dot(ray.d) < 0.0, "{name}");
            if local.z < -2.0 * local.truncate().length() {
                front += 1;
                assert_eq!(le, Spectrum::emission(Rgb::new(3.0, 2.0, 1.0), RGB), "{name}");
            } else if local.z > 2.0 * local.truncate().length() {
                back += 1;
                assert!(le.is_black(), "{name}");
            }
        }
        assert!(front > 10 && back > 10, "{name}: {front} {back}");
    }
}

#[test]
fn only_an_emitting_sphere_refuses_to_be_stretched() {
    let ball = || Shape::Sphere(Sphere { centre: Vec3::ZERO, radius: 1.0 });
    let build = |emits: bool, m: Affine3A| {
        let mut b = SceneBuilder::new();
        let material = grey(&mut b);
        let other = if emits { ball() } else { Shape::Mesh(sheet()) };
        let plain = SurfaceDef { shape: ball(), material, emission: None };
        let object = b.object(vec![plain, emitter(other, material)]);
        b.place(object, m);
        b.build().map(|s| (s.lights().len(), s.counts().spheres)).map_err(|e| e.to_string())
    };
    let stretch = Affine3A::from_scale(Vec3::new(1.0, 2.0, 1.0));
    assert_eq!(build(false, stretch), Ok((1, 1)));
    assert_eq!(build(true, Affine3A::from_scale(Vec3::splat(2.0))), Ok((1, 2)));
    let message = build(true, stretch).unwrap_err();
    assert!(message.starts_with("object 0 holds an emitting sphere and is placed with uneven scaling"), "{message}");
}

#[test]
fn handles_that_name_nothing_are_named() {
    let build = |make: &dyn Fn(&mut SceneBuilder)| {
        let mut b = SceneBuilder::new();
        make(&mut b);
        b.build().err().map(|e| e.to_string()).unwrap_or_default()
    };
    let ball = || Shape::Sphere(Sphere { centre: Vec3::ZERO, radius: 1.0 });
    assert_eq!(build(&|b| b.add(ball(), MaterialId(0))), "material 0 does not exist: the scene has 0");
    let in_object = |b: &mut SceneBuilder| {
        grey(b);
        b.object(vec![SurfaceDef { shape: ball(), material: MaterialId(7), emission: None }]);
    };
    assert_eq!(build(&in_object), "material 7 does not exist: the scene has 1");
    let texture = |b: &mut SceneBuilder| _ = b.material(DiffuseMaterial { reflectance: TextureId(3) });
    assert_eq!(build(&texture), "texture 3 does not exist: the scene has 0");
    assert_eq!(build(&|b| b.place(ObjectId(1), Affine3A::IDENTITY)), "object 1 does not exist: the scene has 0");
    assert_eq!(build(&|_| {}), "", "an empty scene is a scene");
}

#[test]
fn the_bounding_sphere_holds_everything_and_is_never_empty() {
    let mut b = SceneBuilder::new();
    let material = grey(&mut b);
    b.add(Shape::Sphere(Sphere { centre: Vec3::new(5.0, 0.0, 0.0), radius: 2.0 }), material);
    let object = b.object(vec![SurfaceDef { shape: Shape::Mesh(sheet()), material, emission: None }]);
    b.place(object, Affine3A::from_translation(Vec3::new(0.0, -9.0, 0.0)));
    let (centre, radius) = b.build().unwrap().bounding_sphere();
    for p in
        [Vec3::new(7.0, 0.0, 0.0), Vec3::new(5.0, 2.0, 0.0), Vec3::new(1.0, -10.0, 0.0), Vec3::new(-1.0, -8.0, 0.0)]
    {
        assert!(p.distance(centre) <= 1.0001 * radius, "{p}");
    }
    assert!(radius < 12.0);
    assert_eq!(SceneBuilder::new().build().unwrap().bounding_sphere(), (Vec3::ZERO, 1.0));
}

#[test]
fn lights_are_chosen_by_power_and_never_when_dark() {
    let mut b = SceneBuilder::new();
    let material = grey(&mut b);
    let floor = Parallelogram::new(Vec3::new(-1.0, 0.0, -1.0), 2.0 * Vec3::Z, 2.0 * Vec3::X);
    b.add(Shape::Parallelogram(floor), material);
    let point = |i: f32| PointLight { p: Vec3::Y, intensity: Rgb::splat(i).into() };
    b.light(point(1.0));
    b.light(point(0.0));
    b.light(point(3.0));
    b.light(DirectionalLight::new(Vec3::NEG_Y, Rgb::ONE).unwrap());
    b.light(EnvironmentLight::constant(Rgb::splat(0.5)));
    b.surface(emitter(Shape::Parallelogram(Parallelogram::new(2.0 * Vec3::Y, floor.u(), floor.v())), material));
    let scene = b.build().unwrap();
    let world = scene.world(RGB, 0.0);
    let powers: Vec<f32> =
        scene.lights().iter().map(|l| sunfleck::light::Emitter::power(l, world.around()).element_sum()).collect();
    let total: f32 = powers.iter().sum();
    let mut drawn = vec![0u32; powers.len()];
    for i in 0..10_000 {
        let (id, prob, rest) = world.choose_light((i as f32 + 0.5) / 10_000.0).unwrap();
        assert!((prob - world.light_prob(id)).abs() < 1e-6 && (0.0..1.0).contains(&rest));
        drawn[id.0 as usize] += 1;
    }
    for (power, count) in powers.iter().zip(&drawn) {
        assert!((power / total - *count as f32 / 10_000.0).abs() < 1e-3, "{power} of {total}: {count} of 10000");
    }
    assert_eq!(drawn[1], 0, "a dark light");
    assert!(matches!(scene.lights()[5], Light::Area(AreaLight { .. })));
}

#[test]
fn what_leaves_the_scene_is_found_with_the_density_of_its_connections() {
    let mut b = SceneBuilder::new();
    b.light(EnvironmentLight::constant(Rgb::new(1.0, 2.0, 3.0)));
    b.light(PointLight { p: Vec3::Y, intensity: Rgb::splat(10.0).into() });
    let scene = b.build().unwrap();
    let world = scene.world(RGB, 0.0);
    let (mut matched, mut escaped) = (0, world.escaped(Vec3::ZERO, Vec3::X));
    assert_eq!(escaped.next().unwrap().le, Spectrum::emission(Rgb::new(1.0, 2.0, 3.0), RGB));
    assert!(escaped.next().is_none(), "no ray meets a point light");
    for i in 0..100 {
        let s = &mut sampler(i);
        let d = world.sample_direct(Vec3::ZERO, s.next_1d(), s.next_2d()).unwrap();
        if !d.li.delta {
            matched += 1;
            let Sky { le, pdf_direct: pdf, .. } = world.escaped(Vec3::ZERO, d.li.wi).next().unwrap();
            assert!(le == d.li.li && (pdf / d.li.pdf - 1.0).abs() < 1e-5);
        }
    }
    assert!(matched > 5);
}
