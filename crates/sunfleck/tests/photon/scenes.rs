//! Small scenes and measurements shared by the tests of photons and of the algorithms that use them.
use glam::{DVec3, Vec3};
use std::ops::ControlFlow;
use sunfleck::{
    bsdf::{DielectricMaterial, DiffuseMaterial},
    camera::{Perspective, View},
    film::{Film, FilmSpec, Filter},
    integrator::{Integrator, Params, find},
    light::Sides,
    render::{Budget, Settings, render},
    scene::{MaterialId, Scene, SceneBuilder, SurfaceDef},
    shape::{Mesh, Parallelogram, Shape, Sphere},
    spectrum::{ColorMode, Rgb},
};

/// A square picture.
pub(crate) fn spec(size: u32) -> FilmSpec {
    FilmSpec { width: size, height: size, filter: Filter::Box }
}

/// The algorithm `name` with settings given as `"key=value key=value"`.
pub(crate) fn make(name: &str, settings: &str) -> Box<dyn Integrator> {
    let mut p = Params::default();
    for word in settings.split_whitespace() {
        let (k, v) = word.split_once('=').expect("key=value");
        p.set(k, v);
    }
    find(name).expect("an algorithm").build(p).unwrap_or_else(|e| panic!("{e}"))
}

/// Renders `passes` passes.
pub(crate) fn shoot(scene: &Scene, integrator: &dyn Integrator, spec: FilmSpec, passes: u64) -> Film {
    let budget = Budget { passes: Some(passes), time: None };
    render(scene, integrator, &Settings { spec, seed: 1, color: ColorMode::Rgb, budget }, |_, _| {
        ControlFlow::Continue(())
    })
}

/// Mean over the picture.
pub(crate) fn mean(film: &Film) -> Rgb {
    let pixels = film.mean();
    (pixels.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / pixels.len() as f64).as_vec3()
}

/// A perspective camera of square pictures.
pub(crate) fn eye(position: Vec3, look_at: Vec3, fov: f32) -> Perspective {
    Perspective::new(&View { position, look_at, up: Vec3::Y }, fov, 1.0).expect("a camera")
}

/// A matt material.
pub(crate) fn matt(b: &mut SceneBuilder, colour: Rgb) -> MaterialId {
    let reflectance = b.constant(colour);
    b.material(DiffuseMaterial { reflectance })
}

/// Clear glass of index `eta`.
pub(crate) fn glass(b: &mut SceneBuilder, eta: f32) -> MaterialId {
    let white = b.constant(Rgb::ONE);
    b.material(DielectricMaterial { eta: eta.into(), reflectance: white, transmittance: white })
}

/// A patch whose outer side is that of `u × v`.
pub(crate) fn patch(p: [f32; 3], u: [f32; 3], v: [f32; 3]) -> Shape {
    Shape::Parallelogram(Parallelogram::new(p.into(), u.into(), v.into()))
}

/// A sphere.
pub(crate) fn ball(centre: [f32; 3], radius: f32) -> Shape {
    Shape::Sphere(Sphere { centre: centre.into(), radius })
}

/// The six sides of the cube [−1, 1]³, outer side inward.
pub(crate) fn walls() -> [Shape; 6] {
    [
        patch([-1.0, -1.0, -1.0], [0.0, 0.0, 2.0], [2.0, 0.0, 0.0]),
        patch([-1.0, 1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]),
        patch([-1.0, -1.0, -1.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]),
        patch([1.0, -1.0, -1.0], [0.0, 0.0, 2.0], [0.0, 2.0, 0.0]),
        patch([-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]),
        patch([-1.0, -1.0, 1.0], [0.0, 2.0, 0.0], [2.0, 0.0, 0.0]),
    ]
}

/// A closed room [−1, 1]³ with a lamp of `size` below its ceiling; the camera stands inside. Red and green side walls.
pub(crate) fn room(lamp: Rgb, size: f32) -> SceneBuilder {
    let mut b = SceneBuilder::new();
    let white = matt(&mut b, Rgb::new(0.7, 0.7, 0.7));
    let red = matt(&mut b, Rgb::new(0.6, 0.07, 0.05));
    let green = matt(&mut b, Rgb::new(0.14, 0.45, 0.09));
    for (shape, material) in walls().into_iter().zip([white, white, red, green, white, white]) {
        b.add(shape, material);
    }
    let black = matt(&mut b, Rgb::ZERO);
    let h = 0.5 * size;
    let shape = patch([-h, 0.98, -h], [size, 0.0, 0.0], [0.0, 0.0, size]);
    b.surface(SurfaceDef { shape, material: black, emission: Some((lamp.into(), Sides::One)) });
    b.camera(eye(Vec3::new(0.0, 0.0, -0.95), Vec3::new(0.0, -0.1, 1.0), 90.0));
    b
}

/// [`room`] with a matt ball in it.
pub(crate) fn small_cornell() -> Scene {
    let mut b = room(Rgb::new(10.0, 8.0, 6.0), 0.6);
    let white = matt(&mut b, Rgb::new(0.7, 0.6, 0.5));
    b.add(ball([0.3, -0.6, 0.3], 0.4), white);
    b.build().expect("a scene")
}

/// [`room`] with a glass ball under a large lamp, which a path tracer can still hit through the glass.
pub(crate) fn caustic() -> Scene {
    let mut b = room(Rgb::splat(4.0), 1.2);
    let glass = glass(&mut b, 1.5);
    b.add(ball([0.1, -0.3, 0.2], 0.4), glass);
    b.build().expect("a scene")
}

/// [`room`] seen from inside a small ball of glass, so that every camera path has scattered before it meets a wall.
pub(crate) fn eye_in_glass() -> Scene {
    let mut b = room(Rgb::splat(10.0), 0.6);
    let glass = glass(&mut b, 1.5);
    b.add(ball([0.0, 0.0, -0.95], 0.03), glass);
    b.build().expect("a scene")
}

/// The inside of a sphere that emits `le` and reflects `albedo`, seen from off its centre.
pub(crate) fn furnace_ball(le: Rgb, albedo: Rgb) -> Scene {
    let mut b = SceneBuilder::new();
    let grey = matt(&mut b, albedo);
    // Both sides emit, of which only the inner one can be seen.
    b.surface(SurfaceDef { shape: ball([0.0; 3], 1.0), material: grey, emission: Some((le.into(), Sides::Two)) });
    b.camera(eye(Vec3::new(0.3, 0.1, -0.2), Vec3::Z, 60.0));
    b.build().expect("a scene")
}

/// The inside of a cube whose walls emit `le` and reflect `albedo`.
pub(crate) fn furnace_box(le: Rgb, albedo: Rgb) -> Scene {
    let mut b = SceneBuilder::new();
    let grey = matt(&mut b, albedo);
    for shape in walls() {
        b.surface(SurfaceDef { shape, material: grey, emission: Some((le.into(), Sides::One)) });
    }
    b.camera(eye(Vec3::new(0.3, 0.1, -0.9), Vec3::Z, 80.0));
    b.build().expect("a scene")
}

/// [`room`] with a floor mat whose shading normals lean by 35 degrees, of a material made by `material`.
pub(crate) fn leaning(material: impl Fn(&mut SceneBuilder) -> MaterialId) -> Scene {
    let mut b = room(Rgb::splat(10.0), 0.6);
    let m = material(&mut b);
    let p = [[-0.8, -0.9, -0.6], [-0.8, -0.9, 0.8], [0.8, -0.9, 0.8], [0.8, -0.9, -0.6]].map(Vec3::from).to_vec();
    let lean = Vec3::new(0.35f32.sin(), 0.35f32.cos(), 0.2).normalize();
    let mat = Mesh::new(p, vec![lean; 4], vec![], vec![[0, 1, 2], [2, 3, 0]]).expect("a mesh");
    b.add(Shape::Mesh(mat), m);
    b.build().expect("a scene")
}

/// Means and variances of the mean, by block of pixels and channel.
pub(crate) struct Blocks(Vec<(DVec3, DVec3)>);

/// Renders `batches` times `passes` passes, each batch with a seed of its own, so that what photons do to several pixels
/// at once is part of the variance.
pub(crate) fn measure(scene: &Scene, integrator: &dyn Integrator, size: u32, batches: u64, passes: u64) -> Blocks {
    const BLOCK: usize = 8;
    let w = size as usize / BLOCK;
    let mut sums = vec![(DVec3::ZERO, DVec3::ZERO); w * w];
    for seed in 0..batches {
        let budget = Budget { passes: Some(passes), time: None };
        let settings = Settings { spec: spec(size), seed: seed + 100, color: ColorMode::Rgb, budget };
        let film = render(scene, integrator, &settings, |_, _| ControlFlow::Continue(()));
        let mut blocks = vec![DVec3::ZERO; w * w];
        for (i, p) in film.mean().iter().enumerate() {
            let (x, y) = (i % size as usize / BLOCK, i / size as usize / BLOCK);
            blocks[y * w + x] += p.as_dvec3() / (BLOCK * BLOCK) as f64;
        }
        for (sum, b) in sums.iter_mut().zip(&blocks) {
            *sum = (sum.0 + b, sum.1 + b * b);
        }
    }
    let n = batches as f64;
    let finish = |(s, sq): (DVec3, DVec3)| (s / n, (sq / n - (s / n) * (s / n)).max(DVec3::ZERO) / (n - 1.0));
    Blocks(sums.into_iter().map(finish).collect())
}

impl Blocks {
    /// Mean over all blocks and channels.
    pub(crate) fn mean(&self) -> f64 {
        self.0.iter().map(|(m, _)| m.element_sum() / 3.0).sum::<f64>() / self.0.len() as f64
    }
    /// Holds two pictures against each other: deviations in units of their standard error, to which `bias`, a fraction
    /// of the value, is added; the worst of all blocks and channels, and their root mean square.
    pub(crate) fn deviation(&self, other: &Self, bias: f64) -> (f64, f64) {
        let mut worst = 0.0f64;
        let mut sum = 0.0;
        for ((a, va), (b, vb)) in self.0.iter().zip(&other.0) {
            let blur = bias * 0.5 * (a + b);
            let z = (a - b) / (va + vb + blur * blur + 1e-20).map(f64::sqrt);
            worst = worst.max(z.abs().max_element());
            sum += z.length_squared();
        }
        (worst, (sum / (3 * self.0.len()) as f64).sqrt())
    }
}
