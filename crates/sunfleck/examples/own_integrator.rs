//! An algorithm of one's own: direct light, seen straight, in mirrors and through glass.
//!
//! `cargo run --release -p sunfleck --example own_integrator -- picture.pfm` renders a small room with it.
use glam::Vec3;
use std::{env, error::Error, fs, io, ops::ControlFlow, path::Path};
use sunfleck::{
    bsdf::{DielectricMaterial, DiffuseMaterial, MirrorMaterial, Transport},
    camera::{Perspective, Project, View},
    film::{Film, FilmSpec, Filter, PassImage, Sample},
    integrator::{Entry, Integrator, ParamInfo, Params, Pass, PassRenderer},
    light::Sides,
    render::{Budget, Settings, render},
    sampler::{Domain, Sampler},
    scene::{Interaction, Scene, SceneBuilder, SurfaceDef, World},
    shape::{Parallelogram, Shape, Sphere},
    spectrum::{ColorMode, Spectrum},
    walk::{Arrival, Escape, Limits, Start, Step, Visit, walk},
};

/// What the command line and the tests would know of it.
const ENTRY: Entry = Entry {
    name: "direct",
    about: "direct light only, seen straight, in mirrors and through glass",
    params: &[ParamInfo { name: "shadow-rays", about: "light samples per surface met, 1 to 1000 (default 1)" }],
    mergeable: true,
    make: |p| {
        let shadow_rays = p.count("shadow-rays", 1, 1..=1000)? as u32;
        Ok(Box::new(DirectLight { limits: p.limits()?, shadow_rays }))
    },
};

/// The algorithm with its settings.
struct DirectLight {
    /// When paths end.
    limits: Limits,
    /// Light samples per surface met, at least 1.
    shadow_rays: u32,
}

impl Integrator for DirectLight {
    fn prepare<'s>(&'s self, scene: &'s Scene, _: FilmSpec, _: u64) -> Box<dyn PassRenderer + 's> {
        Box::new(Prepared { scene, settings: self })
    }
}

/// The algorithm and the scene it was prepared for.
struct Prepared<'s> {
    scene: &'s Scene,
    settings: &'s DirectLight,
}

impl PassRenderer for Prepared<'_> {
    fn render_pass(&self, pass: &Pass, image: &mut PassImage) {
        let world = self.scene.world(pass.lambda, pass.time);
        let spec = image.spec();
        image.fill(|x, y, counts| {
            let pixel = u64::from(y) * u64::from(spec.width) + u64::from(x);
            let mut sampler = Sampler::new(pass.seed, Domain::Camera, pass.index, pixel);
            let Sample { raster, weight } = spec.sample(x, y, sampler.next_2d());
            let ray = world.camera().ray(raster, sampler.next_2d()).ray;
            let start = Start::from_camera(&world, ray);
            let mut look = Look { world: &world, settings: self.settings, sum: Spectrum::BLACK, rays: 0 };
            counts.rays += walk(&world, &start, &self.settings.limits, &mut sampler, &mut look) + look.rays;
            look.sum.to_rgb(pass.lambda) * weight
        });
    }
}

/// Adds up what one camera walk finds.
struct Look<'w> {
    world: &'w World<'w>,
    settings: &'w DirectLight,
    sum: Spectrum,
    rays: u64,
}

impl Visit for Look<'_> {
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        // Every scattering so far was from a delta lobe, so no light connection has counted this lamp already.
        self.sum += a.beta * self.world.emitted(a.at);
        if a.scatterings < self.settings.limits.scatterings && a.at.is_connectible() {
            let n = self.settings.shadow_rays;
            for _ in 0..n {
                let reflected = self.connect(a.at, sampler);
                self.sum += a.beta * reflected / n as f32;
            }
            self.rays += u64::from(n);
        }
        Step::OnIfDelta
    }

    fn escape(&mut self, e: &Escape) {
        for sky in self.world.escaped(e.ray.o, e.ray.d) {
            self.sum += e.beta * sky.le;
        }
    }
}

impl Look<'_> {
    /// One estimate of the radiance that `at` reflects of light straight from the lights: `f cos L / pdf`.
    fn connect(&self, at: &Interaction, sampler: &mut Sampler) -> Spectrum {
        let (u_light, u) = (sampler.next_1d(), sampler.next_2d());
        let Some(d) = self.world.sample_direct(at.p, u_light, u) else { return Spectrum::BLACK };
        let f_cos = at.f_cos(d.li.wi, Transport::Radiance);
        if f_cos.is_black() || self.world.occluded(&at.spawn_toward(d.li.wi, &d.li.end)) {
            return Spectrum::BLACK;
        }
        f_cos * d.li.li / d.li.pdf
    }
}

/// A floor, a wall, a mirror ball and a glass ball under a lamp.
fn scene() -> Result<Scene, Box<dyn Error>> {
    let mut b = SceneBuilder::new();
    let [white, blue, black] =
        [Vec3::splat(0.7), Vec3::new(0.2, 0.3, 0.6), Vec3::ZERO].map(|colour| b.constant(colour));
    let [floor, wall, lamp] = [white, blue, black].map(|reflectance| b.material(DiffuseMaterial { reflectance }));
    let mirror = b.material(MirrorMaterial { reflect: white });
    let clear = b.constant(Vec3::ONE);
    let glass = b.material(DielectricMaterial { eta: 1.5.into(), reflectance: clear, transmittance: clear });
    let patch = |p: [f32; 3], u, v| Shape::Parallelogram(Parallelogram::new(p.into(), u, v));
    let ball = |centre: [f32; 3]| Shape::Sphere(Sphere { centre: centre.into(), radius: 0.5 });
    b.add(patch([-3.0, 0.0, -2.0], 6.0 * Vec3::Z, 6.0 * Vec3::X), floor);
    b.add(patch([-3.0, 0.0, -2.0], 6.0 * Vec3::X, 4.0 * Vec3::Y), wall);
    b.add(ball([-0.7, 0.5, 0.0]), mirror);
    b.add(ball([0.7, 0.5, 0.0]), glass);
    // The outer side is that of u × v, here the lower one: only it emits.
    let shape = patch([-0.5, 3.0, -0.5], Vec3::X, Vec3::Z);
    b.surface(SurfaceDef { shape, material: lamp, emission: Some((Vec3::splat(12.0).into(), Sides::One)) });
    let view = View { position: Vec3::new(0.0, 1.5, 4.0), look_at: Vec3::new(0.0, 0.6, 0.0), up: Vec3::Y };
    b.camera(Perspective::new(&view, 40.0, 1.5)?);
    Ok(b.build()?)
}

/// Writes linear RGB as a portable float map: a header of three lines, then the rows from the bottom up.
fn write_pfm(path: &Path, film: &Film) -> io::Result<()> {
    let (width, height) = (film.spec().width, film.spec().height);
    let mut bytes = format!("PF\n{width} {height}\n-1.0\n").into_bytes();
    for row in film.mean().chunks(width as usize).rev() {
        bytes.extend(row.iter().flat_map(Vec3::to_array).flat_map(f32::to_le_bytes));
    }
    fs::write(path, bytes)
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = env::args_os().nth(1).unwrap_or_else(|| "own_integrator.pfm".into());
    let mut params = Params::default();
    params.set("shadow-rays", "4");
    let integrator = ENTRY.build(params)?;
    let settings = Settings {
        spec: FilmSpec { width: 360, height: 240, filter: Filter::Box },
        seed: 0,
        color: ColorMode::Rgb,
        budget: Budget { passes: Some(16), time: None },
    };
    let film = render(&scene()?, &*integrator, &settings, |_, _| ControlFlow::Continue(()));
    write_pfm(Path::new(&path), &film)?;
    println!("{} passes of `{}` are in {}", film.passes(), ENTRY.name, Path::new(&path).display());
    Ok(())
}
