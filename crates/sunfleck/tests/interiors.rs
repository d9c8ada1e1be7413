//! Things that are filled: what they take of light, which of two counts, and what is seen of their surfaces.
use glam::Vec3;
use std::ops::ControlFlow;
use sunfleck::{
    bsdf::{DielectricMaterial, DiffuseMaterial, MaterialId, NullMaterial},
    camera::{Orthographic, Perspective, View},
    film::{FilmSpec, Filter},
    integrator::{Entry, Params, REGISTRY},
    light::{EnvironmentLight, PointLight, Sides},
    medium::Interior,
    render::{Budget, Settings, render},
    scene::{Scene, SceneBuilder, SurfaceDef},
    shape::{Mesh, Parallelogram, Shape, Sphere},
    spectrum::{ColorMode, Rgb},
    texture::{ImageTexture, Wrap},
};

const SIZE: u32 = 16;

fn picture(scene: &Scene, entry: &Entry, passes: u64, settings: &[(&str, &str)]) -> Vec<Rgb> {
    let mut params = Params::default();
    settings
        .iter()
        .filter(|(k, _)| entry.params.iter().any(|p| p.name == *k) || *k == "scatterings")
        .for_each(|(k, v)| params.set(*k, *v));
    let integrator = entry.build(params).expect("settings of this file");
    let spec = FilmSpec { width: SIZE, height: SIZE, filter: Filter::Box };
    let budget = Budget { passes: Some(passes), time: None };
    let settings = Settings { spec, seed: 5, color: ColorMode::Rgb, budget };
    render(scene, &*integrator, &settings, |_, _| ControlFlow::Continue(())).mean()
}

fn entry(name: &str) -> &'static Entry {
    REGISTRY.iter().find(|e| e.name == name).expect("in the list")
}

fn mean(pixels: &[Rgb]) -> Rgb {
    pixels.iter().sum::<Rgb>() / pixels.len() as f32
}

fn close(what: &str, got: Rgb, want: Rgb, bound: f32) {
    assert!((got / want - 1.0).abs().max_element() < bound, "{what}: {got} but {want}");
}

fn exp(v: Rgb) -> Rgb {
    Rgb::from_array(v.to_array().map(f32::exp))
}

fn glass(b: &mut SceneBuilder, eta: f32) -> MaterialId {
    let white = b.constant(Rgb::ONE);
    b.material(DielectricMaterial { eta: eta.into(), reflectance: white, transmittance: white })
}

fn filled(b: &mut SceneBuilder, eta: f32, interior: Interior) -> MaterialId {
    let (material, interior) = (glass(b, eta), b.interior(interior));
    b.fill(material, interior);
    material
}

fn ball(radius: f32) -> Shape {
    Shape::Sphere(Sphere { centre: Vec3::ZERO, radius })
}

/// A square across z, 20 wide, that faces `side` along z.
fn sheet(z: f32, side: f32) -> Shape {
    let p = Vec3::new(-10.0, -10.0 * side, z);
    Shape::Parallelogram(Parallelogram::new(p, 20.0 * Vec3::X, 20.0 * side * Vec3::Y))
}

fn lamp(b: &mut SceneBuilder, shape: Shape) {
    let black = b.constant(Rgb::ZERO);
    let material = b.material(DiffuseMaterial { reflectance: black });
    b.surface(SurfaceDef { shape, material, emission: Some((Rgb::ONE.into(), Sides::One)) });
}

/// Along the normal, with R the share that one boundary reflects and τ what is left after the slab:
/// (1 − R)² τ / (1 − R² τ²).
#[test]
fn a_slab_lets_through_what_fresnel_and_beer_say() {
    let (sigma, thickness, eta) = (Rgb::new(0.3, 1.0, 3.0), 0.7, 1.8f32);
    let mut b = SceneBuilder::new();
    let tinted = filled(&mut b, eta, Interior::absorbing(sigma, eta));
    b.add(sheet(0.0, 1.0), tinted);
    b.add(sheet(-thickness, -1.0), tinted);
    lamp(&mut b, sheet(-2.0, 1.0));
    let view = View { position: Vec3::new(0.0, 0.0, 3.0), look_at: Vec3::ZERO, up: Vec3::Y };
    b.camera(Orthographic::new(&view, 2.0, 1.0).unwrap());
    let scene = b.build().unwrap();
    let r = ((eta - 1.0) / (eta + 1.0)).powi(2);
    let tau = exp(sigma * -thickness);
    let want = (1.0 - r).powi(2) * tau / (1.0 - r * r * tau * tau);
    for name in ["path", "unified"] {
        close(name, mean(&picture(&scene, entry(name), 1024, &[])), want, 4e-3);
    }
}

fn eye(z: f32) -> Perspective {
    Perspective::new(&View { position: Vec3::new(0.0, 0.0, z), look_at: Vec3::ZERO, up: Vec3::Y }, 30.0, 1.0).unwrap()
}

/// A box around the origin, facing out or, as the wall of a hollow, in.
fn cube(half: f32, outward: bool) -> Shape {
    let corner = |i: u32| {
        half * Vec3::new([-1.0, 1.0][i as usize & 1], [-1.0, 1.0][i as usize >> 1 & 1], [-1.0, 1.0][i as usize >> 2])
    };
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let turned = |[a, b, c]: [u32; 3]| if outward { [a, b, c] } else { [a, c, b] };
    let indices = quads.iter().flat_map(|&[a, b, c, d]| [turned([a, b, c]), turned([a, c, d])]).collect();
    Shape::Mesh(Mesh::new((0..8).map(corner).collect(), vec![], vec![], indices).unwrap())
}

const GLASS: Rgb = Rgb::new(0.1, 0.3, 0.6);
const WINE: Rgb = Rgb::new(0.2, 1.5, 1.0);

/// A cup with wine that reaches into its wall, by priorities; and the same modelled with the boundary that there is.
fn cup(modelled: bool) -> Scene {
    let mut b = SceneBuilder::new();
    if modelled {
        let glass = filled(&mut b, 1.5, Interior::absorbing(GLASS, 1.5));
        let wine = filled(&mut b, 1.33 / 1.5, Interior::absorbing(WINE, 1.33));
        b.add(cube(1.0, true), glass);
        b.add(cube(0.8, true), wine);
    } else {
        let glass = filled(&mut b, 1.5, Interior::absorbing(GLASS, 1.5).with_priority(2));
        let wine = filled(&mut b, 1.33, Interior::absorbing(WINE, 1.33).with_priority(1));
        b.add(cube(1.0, true), glass);
        b.add(cube(0.8, false), glass);
        b.add(cube(0.9, true), wine);
    }
    // A matt ball in the wine, a lamp in the overlap: shadow rays cross the hidden wall.
    let reflectance = b.constant(Rgb::splat(0.7));
    let matt = b.material(DiffuseMaterial { reflectance });
    b.add(ball(0.3), matt);
    let half = (0..128).map(|i| if i % 16 < 8 { Rgb::new(1.0, 0.5, 0.2) } else { Rgb::new(0.2, 0.6, 1.0) }).collect();
    b.light(
        EnvironmentLight::panorama(
            ImageTexture::new(16, 8, half, Wrap::Repeat).unwrap(),
            Rgb::ONE,
            glam::Mat3::IDENTITY,
        )
        .unwrap(),
    );
    let view = View { position: Vec3::new(3.0, 2.0, 4.0), look_at: Vec3::ZERO, up: Vec3::Y };
    b.camera(Perspective::new(&view, 36.0, 1.0).unwrap());
    b.build().unwrap()
}

#[test]
fn a_liquid_that_overlaps_its_glass_looks_as_if_their_boundary_were_modelled() {
    let [by_priority, modelled] = [false, true].map(|m| picture(&cup(m), entry("path"), 256, &[]));
    let (a, b) = (mean(&by_priority), mean(&modelled));
    close("mean", a, b, 5e-3);
    // The same numbers choose the same ways, but for rounding.
    let alike = |(a, b): &(&Rgb, &Rgb)| (**a - **b).abs().max_element() < 0.05 * b.max_element();
    let count = by_priority.iter().zip(&modelled).filter(alike).count();
    assert!(count >= by_priority.len() * 97 / 100, "{count} of {}", by_priority.len());
}

/// A floor, an eye and a point light, all in a medium without index: light is taken on the way to the floor and to the eye.
#[test]
fn every_algorithm_counts_the_ways_to_the_floor_and_to_the_eye() {
    let sigma = Rgb::new(0.0, 0.2, 0.5);
    let scene = |fill: Option<Interior>| {
        let mut b = SceneBuilder::new();
        let reflectance = b.constant(Rgb::splat(0.5));
        let floor = b.material(DiffuseMaterial { reflectance });
        let disk = Parallelogram::new(Vec3::new(-0.1, -0.1, 0.0), 0.2 * Vec3::X, 0.2 * Vec3::Y);
        b.add(Shape::Parallelogram(disk), floor);
        b.light(PointLight { p: Vec3::new(0.0, 0.0, 1.0), intensity: Rgb::ONE.into() });
        if let Some(interior) = fill {
            let around = filled(&mut b, 1.0, interior);
            b.add(ball(9.0), around);
        }
        let view = View { position: Vec3::new(0.0, 0.0, 2.0), look_at: Vec3::ZERO, up: Vec3::Y };
        b.camera(Perspective::new(&view, 4.0, 1.0).unwrap());
        b.build().unwrap()
    };
    let [clear, fog] = [None, Some(Interior::absorbing(sigma, 1.0))].map(scene);
    // Photons of all emission: few of a point light's hit so small a floor, so compare the ways photons take by themselves.
    let settings = [("scatterings", "1"), ("photons", "20000"), ("radius", "0.05")];
    for entry in REGISTRY.iter().filter(|e| e.name != "raycast") {
        let [a, b] = [&clear, &fog].map(|s| mean(&picture(s, entry, 8, &settings)));
        // The floor is small: all ways to it are 1 long, and all from it 2.
        close(entry.name, b / a, exp(sigma * -3.0), 0.01);
    }
}

#[test]
fn an_eye_in_an_open_liquid_sees_less_by_the_way_to_its_surface() {
    let (sigma, radius) = (Rgb::new(0.1, 0.5, 1.0), 0.6);
    for interior in [Interior::absorbing(sigma, 1.0), Interior::absorbing(sigma, 1.0).with_priority(3)] {
        let mut b = SceneBuilder::new();
        let liquid = filled(&mut b, 1.0, interior);
        b.add(ball(radius), liquid);
        b.light(EnvironmentLight::constant(Rgb::ONE));
        b.camera(eye(1e-3));
        let scene = b.build().unwrap();
        for name in ["path", "unified"] {
            close(name, mean(&picture(&scene, entry(name), 4, &[])), exp(sigma * -radius), 3e-3);
        }
    }
}

/// Nothing bends or reflects at a surface without a material, but what it holds takes light; from inside and from outside.
#[test]
fn a_fog_without_surface_takes_light_along_the_way_through_it() {
    let sigma = Rgb::new(0.1, 0.5, 1.0);
    let mut b = SceneBuilder::new();
    let null = b.material(NullMaterial);
    let fog = b.interior(Interior::absorbing(sigma, 1.0));
    b.fill(null, fog);
    b.add(sheet(0.0, 1.0), null);
    b.add(sheet(-0.8, -1.0), null);
    lamp(&mut b, sheet(-2.0, 1.0));
    let view = View { position: Vec3::new(0.0, 0.0, 3.0), look_at: Vec3::ZERO, up: Vec3::Y };
    b.camera(Orthographic::new(&view, 2.0, 1.0).unwrap());
    let scene = b.build().unwrap();
    close("fog", mean(&picture(&scene, entry("path"), 4, &[])), exp(sigma * -0.8), 1e-3);
}

/// Interiors beyond those that a path can remember are forgotten, and said to be.
#[test]
fn too_many_shells_are_told_of() {
    for (shells, crowded) in [(8, false), (9, true)] {
        let mut b = SceneBuilder::new();
        for i in 0..shells {
            let shell = filled(&mut b, 1.0, Interior::clear(1.0));
            b.add(ball(1.0 - 0.05 * i as f32), shell);
        }
        b.light(EnvironmentLight::constant(Rgb::ONE));
        b.camera(eye(4.0));
        let scene = b.build().unwrap();
        close("clear", mean(&picture(&scene, entry("path"), 1, &[])), Rgb::ONE, 1e-5);
        assert_eq!(scene.was_crowded(), crowded, "{shells}");
    }
}

/// An interior that is its own neighbour has no boundary, wherever two of its balls meet.
#[test]
fn two_drops_of_one_liquid_are_one() {
    let mut b = SceneBuilder::new();
    let water = filled(&mut b, 1.33, Interior::absorbing(Rgb::splat(0.5), 1.33).with_priority(1));
    b.add(sheet(0.0, 1.0), water);
    b.add(sheet(-1.0, 1.0), water);
    b.add(sheet(-1.2, -1.0), water);
    b.add(sheet(-2.0, -1.0), water);
    lamp(&mut b, sheet(-3.0, 1.0));
    let view = View { position: Vec3::new(0.0, 0.0, 3.0), look_at: Vec3::ZERO, up: Vec3::Y };
    b.camera(Orthographic::new(&view, 2.0, 1.0).unwrap());
    let r = (0.33f32 / 2.33).powi(2);
    let tau = (-1.0f32).exp();
    let want = (1.0 - r).powi(2) * tau / (1.0 - r * r * tau * tau);
    close("one", mean(&picture(&b.build().unwrap(), entry("path"), 512, &[])), Rgb::splat(want), 5e-3);
}

#[test]
fn handles_are_checked() {
    let mut b = SceneBuilder::new();
    let water = b.interior(Interior::clear(1.33));
    b.fill(MaterialId(4), water);
    let error = b.build().err().expect("no such material").to_string();
    assert!(error.contains("material 4"), "{error}");
}
