//! Materials laid over others: what rays pass, which material they meet, and which way its normal points.
use glam::{Affine3A, Vec2, Vec3, Vec4};
use sunfleck::{
    bsdf::{
        Bsdf, BumpMapMaterial, COVERINGS, DiffuseMaterial, Lobes, MaskMaterial, Material, MirrorMaterial, MixMaterial,
        NormalMapMaterial, NullMaterial, Scalar, TurnedMaterial, TwoSidedMaterial,
    },
    camera::{Perspective, View},
    film::{FilmSpec, Filter, PassImage},
    integrator::{Params, Pass, find},
    light::{DirectionalLight, Sides},
    math::{Ray, warp::square_to_sphere},
    sampler::{Domain, Sampler},
    scene::{Interaction, MaterialId, Scene, SceneBuilder, SceneError, SurfaceDef},
    shape::{Attributes, Mesh, Parallelogram, Shape, Sphere},
    spectrum::{Rgb, Wavelengths},
    texture::{ImageTexture, Texture, TextureId, Wrap},
};

fn matt(b: &mut SceneBuilder, c: f32) -> MaterialId {
    let reflectance = b.constant(Rgb::splat(c));
    b.material(DiffuseMaterial { reflectance })
}

/// The square [−1, 1]² in the plane z = 0 that faces up, with its texture coordinates along x and y.
fn square() -> Shape {
    Shape::Parallelogram(Parallelogram::new(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y))
}

fn under(b: &mut SceneBuilder, shape: Shape, m: impl Into<Material>) {
    let m = b.material(m);
    b.add(shape, m);
}

fn build(b: SceneBuilder) -> Scene {
    b.build().expect("a valid scene")
}

/// What many rays from above or below meet; each ray has its own direction.
fn met(scene: &Scene, from: f32) -> Vec<Option<Interaction>> {
    let world = scene.world(Wavelengths::Rgb, 0.5);
    let ray = |i| {
        let mut s = Sampler::new(1, Domain::Prepare, 0, i);
        let (o, to) = (s.next_2d() - 0.5, s.next_2d() - 0.5);
        let o = o.extend(from);
        world.intersect(&Ray::new(o, (to.extend(0.0) - o).normalize()))
    };
    (0..20_000).map(ray).collect()
}

fn share(met: &[Option<Interaction>], what: impl Fn(&Interaction) -> bool) -> f64 {
    met.iter().flatten().filter(|at| what(at)).count() as f64 / met.len() as f64
}

/// The number is right within four standard errors.
fn is_near(share: f64, want: f64) -> bool {
    (share - want).abs() < 4.0 * (want * (1.0 - want) / 20_000.0).sqrt() + 1e-9
}

#[test]
fn rays_meet_a_mask_as_often_as_it_is_opaque() {
    for opacity in [0.0, 0.3, 1.0] {
        let mut b = SceneBuilder::new();
        let of = matt(&mut b, 0.5);
        under(&mut b, square(), MaskMaterial { of, opacity: opacity.into() });
        let scene = build(b);
        let seen = share(&met(&scene, 1.0), |_| true);
        assert!(is_near(seen, f64::from(opacity)), "{opacity}: {seen}");
        let world = scene.world(Wavelengths::Rgb, 0.5);
        let mut stopped = 0;
        for i in 0..20_000 {
            let to = Sampler::new(2, Domain::Prepare, 0, i).next_2d() - 0.5;
            let o = Vec3::new(0.0, 0.0, 1.0);
            stopped += i32::from(world.occluded(&Ray { tmax: 2.0, ..Ray::new(o, to.extend(0.0) - o) }));
        }
        let stopped = f64::from(stopped) / 20_000.0;
        assert!(is_near(stopped, f64::from(opacity)), "shadow of {opacity}: {stopped}");
    }
}

#[test]
fn a_ray_has_two_chances_to_pass_a_ball_with_holes_and_what_lies_behind_is_met() {
    let mut b = SceneBuilder::new();
    let of = matt(&mut b, 0.5);
    let mirror = b.constant(Rgb::ONE);
    under(&mut b, Shape::Sphere(Sphere { centre: Vec3::Z, radius: 0.4 }), MaskMaterial { of, opacity: 0.3.into() });
    under(&mut b, square(), MirrorMaterial { reflect: mirror });
    let scene = build(b);
    let world = scene.world(Wavelengths::Rgb, 0.5);
    let mut passed = 0;
    for i in 0..20_000 {
        let near = 0.2 * (Sampler::new(2, Domain::Prepare, 0, i).next_2d() - 0.5);
        let at = world.intersect(&Ray::new(near.extend(3.0), Vec3::NEG_Z)).expect("the square is behind");
        passed += i32::from(matches!(at.bsdf, Bsdf::Mirror(_)));
    }
    let passed = f64::from(passed) / 20_000.0;
    assert!(is_near(passed, 0.7 * 0.7), "{passed}");
}

#[test]
fn a_stencil_is_exact_and_nothing_is_not_met() {
    let mut b = SceneBuilder::new();
    let of = matt(&mut b, 0.5);
    // White on the left, black on the right.
    let pixels = vec![Rgb::ONE, Rgb::ONE, Rgb::ZERO, Rgb::ZERO];
    let picture = b.texture(Texture::Image(ImageTexture::new(4, 1, pixels, Wrap::Clamp).unwrap()));
    under(&mut b, square(), MaskMaterial { of, opacity: picture.into() });
    let ball = Shape::Sphere(Sphere { centre: Vec3::ZERO, radius: 0.9 });
    under(&mut b, ball, NullMaterial);
    let scene = build(b);
    let world = scene.world(Wavelengths::Rgb, 0.5);
    for i in 0..2000 {
        let p = 2.0 * Sampler::new(4, Domain::Prepare, 0, i).next_2d() - 1.0;
        // Between the two is a ramp, one pixel wide.
        if p.x.abs() > 0.26 {
            let hit = world.intersect(&Ray::new(p.extend(2.0), Vec3::NEG_Z));
            assert_eq!(hit.is_some(), p.x < 0.0, "{p}");
        }
    }
}

#[test]
fn an_emitting_surface_has_no_holes() {
    let mut b = SceneBuilder::new();
    let of = matt(&mut b, 0.5);
    let material = b.material(MaskMaterial { of, opacity: 0.1.into() });
    b.surface(SurfaceDef { shape: square(), material, emission: Some((Rgb::ONE.into(), Sides::Two)) });
    assert_eq!(share(&met(&build(b), 1.0), |at| at.light.is_some()), 1.0);
}

#[test]
fn a_mix_shows_each_material_in_its_share_and_keeps_photons_wherever_one_of_them_would() {
    let mut b = SceneBuilder::new();
    let white = b.constant(Rgb::ONE);
    let mirror = b.material(MirrorMaterial { reflect: white });
    let grey = matt(&mut b, 0.5);
    let lace = b.material(MaskMaterial { of: grey, opacity: 0.5.into() });
    // A quarter mirror; of the rest half is holes.
    under(&mut b, square(), MixMaterial { of: [lace, mirror], amount: 0.25.into() });
    let met = met(&build(b), 1.0);
    let mirrors = share(&met, |at| matches!(at.bsdf, Bsdf::Mirror(_)));
    let matts = share(&met, |at| matches!(at.bsdf, Bsdf::Diffuse(_)));
    assert!(is_near(mirrors, 0.25) && is_near(matts, 0.375), "{mirrors} {matts}");
    assert!(met.iter().flatten().all(|at| at.widest > Lobes::Delta));
}

#[test]
fn each_side_has_its_own_material_or_is_black() {
    let mut b = SceneBuilder::new();
    let white = b.constant(Rgb::ONE);
    let mirror = b.material(MirrorMaterial { reflect: white });
    let grey = matt(&mut b, 0.5);
    under(&mut b, square(), TwoSidedMaterial { front: Some(grey), back: Some(mirror) });
    let scene = build(b);
    assert_eq!(share(&met(&scene, 1.0), |at| matches!(at.bsdf, Bsdf::Diffuse(_)) && at.widest > Lobes::Delta), 1.0);
    assert_eq!(share(&met(&scene, -1.0), |at| matches!(at.bsdf, Bsdf::Mirror(_)) && at.widest == Lobes::Delta), 1.0);
    let mut b = SceneBuilder::new();
    let grey = matt(&mut b, 0.5);
    under(&mut b, square(), TwoSidedMaterial { front: Some(grey), back: None });
    assert_eq!(share(&met(&build(b), -1.0), |at| matches!(at.bsdf, Bsdf::Black(_)) && at.widest == Lobes::Delta), 1.0);
}

/// The shading normal where a ray from above meets `shape` under a material laid over grey.
fn normal(shape: Shape, place: Affine3A, cover: impl Fn(&mut SceneBuilder, MaterialId) -> Material) -> Vec3 {
    let mut b = SceneBuilder::new();
    let grey = matt(&mut b, 0.5);
    let material = cover(&mut b, grey);
    let material = b.material(material);
    let object = b.object(vec![SurfaceDef { shape, material, emission: None }]);
    b.place(object, place);
    let scene = build(b);
    let at = scene.world(Wavelengths::Rgb, 0.5).intersect(&Ray::new(Vec3::new(0.1, 0.2, 5.0), Vec3::NEG_Z)).unwrap();
    at.frame.n
}

fn tilted(b: &mut SceneBuilder, of: MaterialId, n: Vec3) -> Material {
    let map = b.constant(0.5 * n + 0.5);
    NormalMapMaterial { of, map, scale: 1.0 }.into()
}

#[test]
fn normals_of_a_picture_lean_where_the_texture_coordinates_grow() {
    let lean = Vec3::new(0.6, 0.0, 0.8);
    let across = Vec3::new(0.0, 0.6, 0.8);
    let turn = Affine3A::from_rotation_z(0.8);
    let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    for (place, n, want) in [
        (Affine3A::IDENTITY, Vec3::Z, Vec3::Z),
        (Affine3A::IDENTITY, lean, lean),
        (Affine3A::IDENTITY, across, across),
        (turn, lean, turn.transform_vector3(lean)),
        (turn, across, turn.transform_vector3(across)),
        (mirror, lean, Vec3::new(-0.6, 0.0, 0.8)),
        (mirror, across, across),
    ] {
        let got = normal(square(), place, |b, of| tilted(b, of, n));
        assert!((got - want).length() < 1e-5, "{n} under {place}: {got} but {want}");
    }
}

#[test]
fn brushing_turns_with_its_angle_its_picture_and_its_place() {
    let tangent = |place: Affine3A, angle: f32, drawn: Option<Vec3>| {
        let mut b = SceneBuilder::new();
        let of = matt(&mut b, 0.5);
        let direction = drawn.map(|d| b.constant(0.5 * d + 0.5));
        let material = b.material(TurnedMaterial { of, angle, direction });
        let object = b.object(vec![SurfaceDef { shape: square(), material, emission: None }]);
        b.place(object, place);
        let scene = build(b);
        let ray = Ray::new(Vec3::new(0.1, 0.2, 5.0), Vec3::NEG_Z);
        scene.world(Wavelengths::Rgb, 0.5).intersect(&ray).unwrap().frame.s
    };
    let (flat, turn) = (Affine3A::IDENTITY, Affine3A::from_rotation_z(0.8));
    let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    let at = |angle: f32| Vec3::new(angle.cos(), angle.sin(), 0.0);
    for (place, angle, drawn, want) in [
        (flat, 0.0, None, Vec3::X),
        (flat, 0.5, None, at(0.5)),
        (turn, 0.5, None, at(1.3)),
        (mirror, 0.5, None, at(0.5) * Vec3::new(-1.0, 1.0, 1.0)),
        (flat, 0.0, Some(Vec3::Y), Vec3::Y),
        (flat, 0.5, Some(at(0.25)), at(0.75)),
    ] {
        let got = tangent(place, angle, drawn);
        assert!((got - want).length() < 1e-5, "{angle} and {drawn:?} under {place}: {got} but {want}");
    }
}

/// A triangle around the origin in the plane z = 0 with these texture coordinates.
fn triangle(uvs: [Vec2; 3]) -> Mesh {
    let positions = vec![Vec3::new(-2.0, -2.0, 0.0), Vec3::new(3.0, -2.0, 0.0), Vec3::new(-2.0, 3.0, 0.0)];
    Mesh::new(positions, vec![], uvs.to_vec(), vec![[0, 1, 2]]).unwrap()
}

#[test]
fn meshes_find_their_tangents_by_texture_coordinates_or_bring_them() {
    let lean = Vec3::new(0.6, 0.0, 0.8);
    let of = |mesh: Mesh, n| normal(Shape::Mesh(mesh), Affine3A::IDENTITY, |b, of| tilted(b, of, n));
    // u grows along y, v along −x: turned by a right angle.
    let turned = triangle([Vec2::new(0.0, 0.0), Vec2::new(0.0, -1.0), Vec2::new(1.0, 0.0)]);
    assert!((of(turned.clone(), lean) - Vec3::new(0.0, 0.6, 0.8)).length() < 1e-5);
    assert!((of(turned.clone(), Vec3::new(0.0, 0.6, 0.8)) - Vec3::new(-0.6, 0.0, 0.8)).length() < 1e-5);
    let given = Attributes { tangents: vec![Vec4::new(1.0, 0.0, 0.0, -1.0); 3], ..Attributes::default() };
    let given = turned.with_attributes(given).unwrap();
    assert!((of(given.clone(), lean) - lean).length() < 1e-5);
    assert!((of(given, Vec3::new(0.0, 0.6, 0.8)) - Vec3::new(0.0, -0.6, 0.8)).length() < 1e-5);
}

#[test]
fn normals_never_lean_below_the_true_surface() {
    for i in 0..500 {
        let n = square_to_sphere(Sampler::new(9, Domain::Prepare, 0, i).next_2d());
        let got = normal(square(), Affine3A::IDENTITY, |b, of| tilted(b, of, n));
        assert!(got.z > 0.0 && got.is_normalized(), "{n}: {got}");
    }
}

#[test]
fn a_ramp_has_the_slope_of_its_height() {
    // Height grows by 1 while u does, which is 2 wide.
    let ramp = |b: &mut SceneBuilder, of: MaterialId| -> Material {
        let pixels = (0..64).map(|i| Rgb::splat((i as f32 + 0.5) / 64.0)).collect();
        let height = b.texture(Texture::Image(ImageTexture::new(64, 1, pixels, Wrap::Clamp).unwrap()));
        BumpMapMaterial { of, height: height.into(), scale: 3.0 }.into()
    };
    let want = Vec3::new(-3.0 / 2.0, 0.0, 1.0).normalize();
    assert!((normal(square(), Affine3A::IDENTITY, ramp) - want).length() < 1e-3);
    // Twice as large, half as steep.
    let want = Vec3::new(-3.0 / 4.0, 0.0, 1.0).normalize();
    assert!((normal(square(), Affine3A::from_scale(Vec3::splat(2.0)), ramp) - want).length() < 1e-3);
    let flat = |_: &mut SceneBuilder, of| BumpMapMaterial { of, height: Scalar::Constant(5.0), scale: 1.0 }.into();
    assert!((normal(square(), Affine3A::IDENTITY, flat) - Vec3::Z).length() < 1e-6);
}

#[test]
fn attributes_are_as_many_as_vertices_and_materials_lie_over_earlier_ones() {
    let mesh = triangle([Vec2::ZERO, Vec2::X, Vec2::Y]);
    let two = Attributes { colours: vec![Vec4::ONE; 2], ..Attributes::default() };
    let message = mesh.with_attributes(two).unwrap_err().to_string();
    assert_eq!(message, "there are 2 vertex colours for 3 vertices");
    let mut b = SceneBuilder::new();
    let later = MaterialId(1);
    b.material(MaskMaterial { of: later, opacity: Scalar::Texture(TextureId(0)) });
    matt(&mut b, 0.5);
    assert!(matches!(b.build(), Err(SceneError::Missing { what: "material", id: 1, .. })));
}

#[test]
fn every_covering_is_listed_once() {
    let mut names: Vec<_> = COVERINGS.iter().map(|c| c.name).collect();
    names.dedup();
    assert_eq!(names, ["mix", "mask", "null", "twosided", "normalmap", "bumpmap", "turned"]);
}

/// Mean of the picture over 64 passes.
fn mean_radiance(scene: &Scene, name: &str, settings: &[(&str, &str)]) -> f32 {
    let mut params = Params::default();
    settings.iter().for_each(|(k, v)| params.set(*k, *v));
    let integrator = find(name).unwrap().build(params).unwrap();
    let spec = FilmSpec { width: 16, height: 16, filter: Filter::Box };
    let prepared = integrator.prepare(scene, spec, 1);
    let mut image = PassImage::new(spec);
    let mut sum = 0.0;
    for index in 0..64 {
        image.clear();
        prepared.render_pass(&Pass::new(1, index), &mut image);
        sum += image.pixels().iter().map(|p| p.x).sum::<f32>() / spec.pixels() as f32;
    }
    sum / 64.0
}

#[test]
fn a_mix_under_a_veil_is_as_bright_by_camera_paths_as_by_photons() {
    let mut b = SceneBuilder::new();
    let white = b.constant(Rgb::ONE);
    let mirror = b.material(MirrorMaterial { reflect: white });
    let [grey, black] = [0.6, 0.0].map(|c| matt(&mut b, c));
    under(&mut b, square(), MixMaterial { of: [grey, mirror], amount: 0.5.into() });
    let veil = Parallelogram::new(Vec3::new(-1.2, -1.2, 0.5), 2.4 * Vec3::X, 2.4 * Vec3::Y);
    under(&mut b, Shape::Parallelogram(veil), MaskMaterial { of: black, opacity: 0.3.into() });
    let wi = Vec3::new(0.4, 0.2, 1.0).normalize();
    b.light(DirectionalLight::new(-wi, Vec3::ONE).unwrap());
    let view = View { position: Vec3::new(0.3, 0.0, 3.0), look_at: Vec3::ZERO, up: Vec3::Y };
    b.camera(Perspective::new(&view, 20.0, 1.0).unwrap());
    let scene = build(b);
    // Through the veil, half matt, and through the veil again.
    let want = 0.7 * 0.5 * 0.6 / std::f32::consts::PI * wi.z * 0.7;
    let photons: &[_] = &[("direct", "photons"), ("photons", "20000"), ("radius", "0.1"), ("alpha", "1")];
    for (name, settings) in [("path", &[] as &[_]), ("ppm", photons), ("photonmap", &[]), ("vcm", &[])] {
        let got = mean_radiance(&scene, name, settings);
        assert!((got / want - 1.0).abs() < 0.03, "{name}: {got}, not {want}");
    }
}
