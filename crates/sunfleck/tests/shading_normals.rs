//! A flat patch whose vertex normals lean to one side, under parallel light: what each algorithm must show is known.
use glam::Vec3;
use sunfleck::{
    bsdf::DiffuseMaterial,
    camera::{Perspective, View},
    film::{FilmSpec, Filter, PassImage},
    integrator::{Params, Pass, find},
    light::DirectionalLight,
    scene::{Scene, SceneBuilder},
    shape::{Mesh, Shape},
};

const ALBEDO: f32 = 0.6;
const LEAN: f32 = 0.7;

/// The shading normal: leans from +z toward +x.
fn shading_normal() -> Vec3 {
    Vec3::new(LEAN.sin(), 0.0, LEAN.cos())
}

/// A large square in the plane z = 0, seen from above so that it fills the picture, lit from the direction `to_light`.
fn leaning_patch(to_light: Vec3) -> Scene {
    let mut b = SceneBuilder::new();
    let reflectance = b.constant(Vec3::splat(ALBEDO));
    let paint = b.material(DiffuseMaterial { reflectance });
    let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    let positions = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let mesh = Mesh::new(positions, vec![shading_normal(); 4], vec![], vec![[0, 1, 2], [2, 3, 0]]).unwrap();
    b.add(Shape::Mesh(mesh), paint);
    b.light(DirectionalLight::new(-to_light, Vec3::ONE).unwrap());
    let view = View { position: Vec3::new(0.3, 0.0, 3.0), look_at: Vec3::ZERO, up: Vec3::Y };
    b.camera(Perspective::new(&view, 30.0, 1.0).unwrap());
    b.build().unwrap()
}

fn mean_radiance(scene: &Scene, name: &str, settings: &[(&str, &str)]) -> f32 {
    let mut params = Params::default();
    settings.iter().for_each(|(k, v)| params.set(*k, *v));
    let integrator = find(name).unwrap().build(params).unwrap();
    let spec = FilmSpec { width: 16, height: 16, filter: Filter::Box };
    let prepared = integrator.prepare(scene, spec, 1);
    let mut image = PassImage::new(spec);
    let mut sum = 0.0;
    let passes = 64;
    for index in 0..passes {
        image.clear();
        prepared.render_pass(&Pass::new(1, index), &mut image);
        sum += image.pixels().iter().map(|p| p.x).sum::<f32>() / spec.pixels() as f32;
    }
    sum / passes as f32
}

/// By camera paths, by light paths, and by photons alone.
const WAYS: [(&str, &[(&str, &str)]); 3] = [
    ("path", &[]),
    ("light", &[]),
    ("ppm", &[("direct", "photons"), ("photons", "20000"), ("radius", "0.1"), ("alpha", "1")]),
];

#[test]
fn a_leaning_normal_shades_by_its_own_cosine_whichever_way_light_is_found() {
    for to_light in [Vec3::new(0.5, 0.2, 1.0), Vec3::new(-0.4, 0.1, 1.0), Vec3::new(2.0, 0.0, 1.0)] {
        let wi = to_light.normalize();
        let scene = leaning_patch(wi);
        let want = ALBEDO / std::f32::consts::PI * shading_normal().dot(wi);
        for (name, settings) in WAYS {
            // Light paths scatter toward the lens at random places: their noise is largest.
            let got = mean_radiance(&scene, name, settings);
            assert!((got / want - 1.0).abs() < 0.03, "{name}, light from {wi}: {got}, not {want}");
        }
    }
}

#[test]
fn light_from_behind_the_true_surface_never_leaks_through_a_leaning_normal() {
    let wi = Vec3::new(1.0, 0.0, -0.2).normalize();
    assert!(shading_normal().dot(wi) > 0.0, "the shading normal must be fooled");
    let scene = leaning_patch(wi);
    for (name, settings) in WAYS {
        assert_eq!(mean_radiance(&scene, name, settings), 0.0, "{name}");
    }
}
