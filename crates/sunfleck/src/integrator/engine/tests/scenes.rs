//! A room with a ball of each kind, under each kind of light.
use crate::{
    bsdf::{
        ConductorMaterial, DielectricMaterial, DiffuseMaterial, MirrorMaterial, PhongMaterial, RoughConductorMaterial,
        RoughDielectricMaterial,
    },
    camera::{Orthographic, Perspective, View},
    light::{DirectionalLight, EnvironmentLight, PointLight, Sides, SpotLight},
    scene::{MaterialId, Scene, SceneBuilder, SurfaceDef},
    shape::{Mesh, Parallelogram, Shape, Sphere},
    texture::{ImageTexture, Wrap},
};
use glam::{Mat3, Vec3};

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Lights {
    Lamp,
    TwoSided,
    Ball,
    Point,
    Spot,
    Directional,
    Sky,
    AllThroughLens,
    AllAlongParallelRays,
}

impl Lights {
    pub(super) fn has_sky(self) -> bool {
        matches!(self, Self::Sky | Self::AllThroughLens | Self::AllAlongParallelRays)
    }
}

pub(super) fn scene(lights: Lights) -> Scene {
    let mut b = SceneBuilder::new();
    walls(&mut b);
    balls(&mut b);
    let view = View { position: Vec3::new(0.0, 0.0, 3.4), look_at: Vec3::ZERO, up: Vec3::Y };
    let eye = Perspective::new(&view, 38.0, 1.5).unwrap();
    let all = matches!(lights, Lights::AllThroughLens | Lights::AllAlongParallelRays);
    match lights {
        Lights::AllThroughLens => b.camera(eye.with_lens(0.4, 3.0).unwrap()),
        Lights::AllAlongParallelRays => {
            b.camera(Orthographic::new(&view, 2.1, 1.5).unwrap().with_lens(0.4, 3.0).unwrap());
        }
        _ => b.camera(eye),
    }
    let has = |l| all || lights == l;
    if has(Lights::Lamp) {
        shine(&mut b, lamp(0.9), Sides::One);
    }
    if has(Lights::TwoSided) {
        shine(&mut b, lamp(0.4), Sides::Two);
    }
    if has(Lights::Ball) {
        shine(&mut b, ball([0.3, 0.4, 0.2], 0.2), Sides::One);
    }
    if has(Lights::Point) {
        b.light(PointLight { p: Vec3::new(0.2, 0.7, 0.3), intensity: Vec3::ONE.into() });
    }
    if has(Lights::Spot) {
        let d = Vec3::new(0.4, -1.0, -0.2);
        b.light(SpotLight::new(Vec3::new(-0.4, 0.8, 0.4), d, Vec3::splat(4.0), [0.5, 1.1]).unwrap());
    }
    if has(Lights::Directional) {
        b.light(DirectionalLight::new(Vec3::new(0.3, -0.4, -1.0), Vec3::ONE).unwrap());
    }
    if lights.has_sky() {
        // So wide that light from outside is better aimed.
        let far = Parallelogram::new(Vec3::new(-150.0, -1.01, -150.0), 300.0 * Vec3::Z, 300.0 * Vec3::X);
        let ground = matt(&mut b, 0.3);
        b.add(Shape::Parallelogram(far), ground);
        let sky = (0..128).map(|i| Vec3::splat(if i == 45 { 12.0 } else { 0.5 })).collect();
        let image = ImageTexture::new(16, 8, sky, Wrap::Repeat).unwrap();
        b.light(EnvironmentLight::panorama(image, Vec3::ONE, Mat3::IDENTITY).unwrap());
    }
    b.build().unwrap()
}

fn matt(b: &mut SceneBuilder, c: f32) -> MaterialId {
    let reflectance = b.constant(Vec3::splat(c));
    b.material(DiffuseMaterial { reflectance })
}

fn ball(centre: [f32; 3], radius: f32) -> Shape {
    Shape::Sphere(Sphere { centre: Vec3::from(centre), radius })
}

fn lamp(y: f32) -> Shape {
    Shape::Parallelogram(Parallelogram::new(Vec3::new(-0.4, y, -0.4), 0.8 * Vec3::X, 0.8 * Vec3::Z))
}

fn shine(b: &mut SceneBuilder, shape: Shape, sides: Sides) {
    let material = matt(b, 0.0);
    b.surface(SurfaceDef { shape, material, emission: Some((Vec3::splat(5.0).into(), sides)) });
}

/// Open toward the eye.
fn walls(b: &mut SceneBuilder) {
    let white = matt(b, 0.7);
    let mut wall = |p: [f32; 3], u: Vec3, v: Vec3| {
        b.add(Shape::Parallelogram(Parallelogram::new(Vec3::from(p), 2.0 * u, 2.0 * v)), white);
    };
    wall([-1.0, -1.0, -1.0], Vec3::Z, Vec3::X);
    wall([-1.0, 1.0, -1.0], Vec3::X, Vec3::Z);
    wall([-1.0, -1.0, -1.0], Vec3::X, Vec3::Y);
    wall([-1.0, -1.0, -1.0], Vec3::Y, Vec3::Z);
    wall([1.0, -1.0, -1.0], Vec3::Z, Vec3::Y);
}

/// Mirror, glass, frosted glass, rough metal, glossy paint, and a mesh whose normals lean.
fn balls(b: &mut SceneBuilder) {
    let [white, eta, k, grey] = [1.0, 0.2, 3.5, 0.4].map(|c| b.constant(Vec3::splat(c)));
    let mirror = b.material(MirrorMaterial { reflect: white });
    let clear = || DielectricMaterial { eta: 1.5.into(), reflectance: white, transmittance: white };
    let glass = b.material(clear());
    let frosted = b.material(RoughDielectricMaterial { glass: clear(), alpha: 0.09.into() });
    let metal = ConductorMaterial { eta, k, reflectance: white };
    let gold = b.material(RoughConductorMaterial { metal, alpha: 0.2.into() });
    let paint = b.material(PhongMaterial { diffuse: grey, specular: grey, exponent: 15.0 });
    b.add(ball([-0.6, -0.6, 0.0], 0.35), mirror);
    b.add(ball([0.1, -0.6, 0.3], 0.35), glass);
    b.add(ball([0.65, -0.6, 0.1], 0.3), frosted);
    b.add(ball([-0.6, 0.3, -0.4], 0.35), gold);
    b.add(ball([0.6, 0.1, -0.5], 0.35), paint);
    let corners = [[-0.5, -0.3, -0.9], [0.4, -0.3, -0.9], [0.4, 0.5, -0.8], [-0.5, 0.5, -0.8]].map(Vec3::from).to_vec();
    let lean = |x: f32, y: f32| Vec3::new(x, y, 1.0).normalize();
    let normals = vec![lean(-0.5, -0.4), lean(0.6, -0.3), lean(0.5, 0.6), lean(-0.4, 0.5)];
    let patch = Mesh::new(corners, normals, vec![], vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    let white = matt(b, 0.8);
    b.add(Shape::Mesh(patch), white);
}
