//! Pictures by wavelength: white stays white, RGB and wavelengths agree where they must, and light bends as tables say.
use glam::{Vec2, Vec3, Vec4};
use std::ops::ControlFlow;
use sunfleck::{
    bsdf::{DielectricMaterial, DiffuseMaterial, Lookup, Material, Scatter, Transport},
    camera::{Perspective, View},
    film::{Film, FilmSpec, Filter, PassImage},
    integrator::{Params, Pass, REGISTRY, find},
    light::{EnvironmentLight, Sides},
    math::Local,
    render::{Budget, Settings, render},
    scene::{Scene, SceneBuilder, SurfaceDef},
    shape::{Parallelogram, Shape, Sphere},
    spectrum::{ColorMode, Colour, Illuminant, Ior, Named, Rgb, Wavelengths, named},
    texture::{ImageTexture, Texture, Wrap},
};

fn film(scene: &Scene, name: &str, color: ColorMode, passes: u64, settings: &[(&str, &str)]) -> Film {
    let mut params = Params::default();
    settings.iter().for_each(|(k, v)| params.set(*k, *v));
    let integrator = find(name).expect("in the list").build(params).expect("settings of this file");
    let spec = FilmSpec { width: 16, height: 16, filter: Filter::Box };
    let settings = Settings { spec, seed: 3, color, budget: Budget { passes: Some(passes), time: None } };
    render(scene, &*integrator, &settings, |_, _| ControlFlow::Continue(()))
}

fn mean(film: &Film) -> Rgb {
    let pixels = film.mean();
    pixels.iter().sum::<Rgb>() / pixels.len() as f32
}

fn eye() -> Perspective {
    Perspective::new(&View { position: Vec3::new(0.0, 0.0, 3.4), look_at: Vec3::ZERO, up: Vec3::Y }, 42.0, 1.0).unwrap()
}

/// A room with an open front, a ball in it, walls and a lamp of these colours.
fn room(walls: [Colour; 3], lamp: Illuminant) -> Scene {
    let mut b = SceneBuilder::new();
    let [white, left, right] = walls.map(|c| {
        let reflectance = b.constant(c);
        b.material(DiffuseMaterial { reflectance })
    });
    let wall = |p: Vec3, u: Vec3, v: Vec3| Shape::Parallelogram(Parallelogram::new(p, 2.0 * u, 2.0 * v));
    let corner = Vec3::splat(-1.0);
    b.add(wall(corner, Vec3::Z, Vec3::X), white);
    b.add(wall(corner + 2.0 * Vec3::Y, Vec3::X, Vec3::Z), white);
    b.add(wall(corner, Vec3::X, Vec3::Y), white);
    b.add(wall(corner, Vec3::Y, Vec3::Z), left);
    b.add(wall(corner + 2.0 * Vec3::X, Vec3::Z, Vec3::Y), right);
    b.add(Shape::Sphere(Sphere { centre: Vec3::new(0.2, -0.5, 0.0), radius: 0.5 }), white);
    let shape = Shape::Parallelogram(Parallelogram::new(Vec3::new(-0.4, 0.95, -0.4), 0.8 * Vec3::X, 0.8 * Vec3::Z));
    let black = b.constant(Rgb::ZERO);
    let material = b.material(DiffuseMaterial { reflectance: black });
    b.surface(SurfaceDef { shape, material, emission: Some((lamp, Sides::One)) });
    b.camera(eye());
    b.build().expect("a room")
}

fn close(what: &str, got: Rgb, want: Rgb, bound: f32) {
    assert!((got / want - 1.0).abs().max_element() < bound, "{what}: {got} but {want}");
}

#[test]
fn a_white_furnace_stays_white() {
    let mut b = SceneBuilder::new();
    let white = b.constant(Rgb::ONE);
    let white = b.material(DiffuseMaterial { reflectance: white });
    b.add(Shape::Sphere(Sphere { centre: Vec3::ZERO, radius: 0.8 }), white);
    b.light(EnvironmentLight::constant(Rgb::ONE));
    b.camera(eye());
    let scene = b.build().unwrap();
    for passes in [64, 100, 256] {
        close("path", mean(&film(&scene, "path", ColorMode::Spectral, passes, &[])), Rgb::ONE, 3e-3);
    }
}

#[test]
fn each_pass_over_a_grey_room_is_its_picture_by_rgb_in_the_colour_of_its_wavelengths() {
    let grey = |v| Colour::from(Rgb::splat(v));
    let scene = room([grey(0.7), grey(0.2), grey(0.5)], Rgb::splat(9.0).into());
    let spec = FilmSpec { width: 16, height: 16, filter: Filter::Box };
    for entry in REGISTRY {
        let integrator = entry.build(Params::default()).unwrap();
        let prepared = integrator.prepare(&scene, spec, 1);
        for index in [0, 7] {
            let [rgb, spectral] = [ColorMode::Rgb, ColorMode::Spectral].map(|color| {
                let mut image = PassImage::new(spec);
                prepared.render_pass(&Pass::new(1, index).colored(color), &mut image);
                image.pixels().to_vec()
            });
            let lambda = ColorMode::Spectral.wavelengths(1, index);
            let white = Illuminant::from(Rgb::ONE).at(lambda).to_rgb(lambda);
            for (a, b) in spectral.iter().zip(rgb) {
                let error = (*a - b * white).abs().max_element();
                // A pass of sppm is a difference of sums, which rounds to some 1e-7 where the pass itself adds nothing.
                let allowed = 1e-4 * (b.x * white).abs().max_element() + 1e-6;
                assert!(error <= allowed, "{} {index}: {a} is not {white} times {b}", entry.name);
            }
        }
    }
}

#[test]
fn direct_light_from_a_white_lamp_has_the_same_colours_by_rgb_and_by_wavelength() {
    let walls = [Rgb::new(0.7, 0.6, 0.4), Rgb::new(0.6, 0.05, 0.03), Rgb::new(0.1, 0.5, 0.09)].map(Colour::from);
    let scene = room(walls, Rgb::splat(9.0).into());
    let once = [("scatterings", "1")];
    let [rgb, spectral] = [ColorMode::Rgb, ColorMode::Spectral].map(|c| mean(&film(&scene, "path", c, 8192, &once)));
    close("mean", spectral, rgb, 3e-3);
}

#[test]
fn light_between_coloured_walls_is_of_like_colour_by_rgb_and_by_wavelength() {
    // Products of spectra are not products of their colours: a few percent is what real red and green walls differ by.
    let walls = [Rgb::new(0.73, 0.71, 0.68), Rgb::new(0.6, 0.05, 0.03), Rgb::new(0.1, 0.5, 0.09)].map(Colour::from);
    let scene = room(walls, Rgb::new(9.0, 7.0, 5.0).into());
    let [rgb, spectral] = [ColorMode::Rgb, ColorMode::Spectral].map(|c| mean(&film(&scene, "path", c, 512, &[])));
    close("mean", spectral, rgb, 0.04);
}

#[test]
fn pictures_on_walls_and_around_the_scene_keep_their_colours() {
    let colours = [Rgb::new(0.8, 0.1, 0.1), Rgb::new(0.1, 0.3, 0.9), Rgb::new(0.2, 0.9, 0.3), Rgb::new(0.9, 0.8, 0.1)];
    let mut b = SceneBuilder::new();
    let picture = |scale: f32| ImageTexture::new(2, 2, colours.map(|c| c * scale).to_vec(), Wrap::Clamp).unwrap();
    let reflectance = b.texture(Texture::Image(picture(1.0)));
    let paper = b.material(DiffuseMaterial { reflectance });
    let p = Parallelogram::new(Vec3::new(-1.0, -1.0, 0.0), 2.0 * Vec3::X, 2.0 * Vec3::Y);
    b.add(Shape::Parallelogram(p), paper);
    // White from the front, so that the paper shows its colours, and colours behind it.
    let sky: Vec<Rgb> = (0..8).map(|i| if (2..6).contains(&i) { Rgb::ONE } else { colours[i % 4] * 3.0 }).collect();
    let sky = ImageTexture::new(8, 1, sky, Wrap::Repeat).unwrap();
    b.light(EnvironmentLight::panorama(sky, Rgb::ONE, glam::Mat3::IDENTITY).unwrap());
    b.camera(eye());
    let scene = b.build().unwrap();
    // No light falls onto the paper but from the sky; looking at the sky itself needs no scattering.
    for (depth, bound) in [("0", 3e-3), ("1", 0.03)] {
        let settings = [("scatterings", depth)];
        let [rgb, spectral] =
            [ColorMode::Rgb, ColorMode::Spectral].map(|c| mean(&film(&scene, "path", c, 512, &settings)));
        close(depth, spectral, rgb, bound);
    }
}

/// Cosine and sine of the refracted ray that the hero of `nm` takes from air into glass, for light at 60 degrees.
fn refracted(ior: Ior, nm: f32) -> (f32, bool) {
    let textures = [Texture::Constant(Rgb::ONE.into())];
    let white = sunfleck::scene::TextureId(0);
    let lambda = Wavelengths::Spectral(Vec4::new(nm, 500.0, 600.0, 700.0));
    let at = Lookup::new(&textures, Vec2::ZERO, Vec3::ZERO, lambda);
    let glass = Material::from(DielectricMaterial { eta: ior, reflectance: white, transmittance: white }).resolve(&at);
    let wo = Local(Vec3::new(0.75f32.sqrt(), 0.0, 0.5));
    let s = glass.sample(wo, 0.999, Vec2::ZERO, Transport::Radiance).expect("most of it passes");
    assert!(s.wi.cos_theta() < 0.0);
    (-s.wi.0.x, s.disperses)
}

#[test]
fn each_wavelength_bends_by_its_published_index() {
    // Schott N-BK7 and SF11 by line (h, F, d, C); diamond (Peter 1923) and water (Daimon & Masumura 2007) at d.
    for (glass, nm, n) in [
        ("glass-BK7", 404.66, 1.530_24),
        ("glass-BK7", 486.13, 1.522_38),
        ("glass-BK7", 587.56, 1.516_80),
        ("glass-BK7", 656.27, 1.514_32),
        ("glass-F11", 486.13, 1.806_45),
        ("glass-F11", 587.56, 1.784_72),
        ("glass-F11", 656.27, 1.775_99),
        ("diamond", 587.56, 2.4175),
        ("water", 587.56, 1.3334),
    ] {
        let ior = named(glass).and_then(Named::ior).expect("a glass");
        let (sin, disperses) = refracted(ior, nm);
        assert!((0.75f64.sqrt() / f64::from(sin) - n).abs() < 1e-4, "{glass} at {nm}: {}", 0.75f32.sqrt() / sin);
        assert!(disperses);
    }
    assert!(!refracted(Ior::Constant(1.5), 500.0).1);
}

#[test]
fn a_clear_ball_that_parts_colours_vanishes_before_a_white_sky() {
    let mut b = SceneBuilder::new();
    let white = b.constant(Rgb::ONE);
    let eta = Ior::Cauchy([1.35, 0.06, 0.0]);
    let glass = b.material(DielectricMaterial { eta, reflectance: white, transmittance: white });
    b.add(Shape::Sphere(Sphere { centre: Vec3::ZERO, radius: 1.2 }), glass);
    b.light(EnvironmentLight::constant(Rgb::ONE));
    b.camera(eye());
    let scene = b.build().unwrap();
    for name in ["path", "ppm"] {
        close(name, mean(&film(&scene, name, ColorMode::Spectral, 1024, &[])), Rgb::ONE, 3e-3);
    }
}

/// A gem under a lamp of three bands.
fn glass_ball() -> Scene {
    let mut b = SceneBuilder::new();
    let [white, grey] = [1.0, 0.6].map(|v| b.constant(Rgb::splat(v)));
    let matt = b.material(DiffuseMaterial { reflectance: grey });
    let eta = named("diamond").and_then(Named::ior).expect("a gem");
    let glass = b.material(DielectricMaterial { eta, reflectance: white, transmittance: white });
    b.add(Shape::Sphere(Sphere { centre: Vec3::new(0.1, -0.3, 0.2), radius: 0.5 }), glass);
    let floor = Parallelogram::new(Vec3::new(-2.0, -0.9, -2.0), 4.0 * Vec3::Z, 4.0 * Vec3::X);
    b.add(Shape::Parallelogram(floor), matt);
    let lamp = Parallelogram::new(Vec3::new(-0.5, 1.5, -0.5), Vec3::X, Vec3::Z);
    let black = b.constant(Rgb::ZERO);
    let material = b.material(DiffuseMaterial { reflectance: black });
    let light = named("stdillum-F11").expect("a lamp").illuminant() * 4.0;
    b.surface(SurfaceDef { shape: Shape::Parallelogram(lamp), material, emission: Some((light, Sides::One)) });
    b.camera(eye());
    b.build().expect("a scene")
}

#[test]
fn dispersion_is_the_same_for_any_number_of_threads() {
    let scene = glass_ball();
    assert!(scene.is_dispersive());
    for entry in REGISTRY {
        let of = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| film(&scene, entry.name, ColorMode::Spectral, 2, &[]))
        };
        let one = of(1);
        assert!(one == of(2) && one == of(7), "{}", entry.name);
    }
}
