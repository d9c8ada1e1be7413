//! What every light promises: its densities are those of its samples, and what it sends out is what arrives.
use glam::{Mat3, Vec2, Vec3};
use std::f64::consts::PI;
use sunfleck::{
    bsdf::DiffuseMaterial,
    light::{
        AreaLight, DirectionalLight, Emitter, EmitterHit, EnvironmentLight, GoniometricLight, LeSample, LiSample,
        Light, LightEnd, PointLight, ProjectionLight, Rim, Sides, SpotLight, SunLight, Surroundings,
    },
    math::{Ray, warp::square_to_sphere},
    sampler::{Domain, Sampler},
    scene::{Scene, SceneBuilder, SurfaceDef},
    shape::{Mesh, Parallelogram, Shape, Sphere},
    spectrum::{Rgb, Spectrum, Wavelengths},
    texture::{ImageTexture, Wrap},
};

const AROUND: Surroundings = Surroundings { centre: Vec3::ZERO, radius: 3.0, lambda: Wavelengths::Rgb };

/// Every kind of light, with the variations that take other branches. All but the infinite ones shine down on the plane
/// z = 0 from above.
fn lights() -> Vec<(&'static str, Light)> {
    let area = |shape: Shape, sides| Light::from(AreaLight { shape, radiance: Rgb::new(2.0, 1.0, 0.5).into(), sides });
    let quad = Parallelogram::new(Vec3::new(-0.6, 0.3, 1.0), Vec3::new(0.2, 0.9, 0.3), Vec3::new(1.2, 0.1, 0.0));
    let ball = Sphere { centre: Vec3::new(0.4, 0.2, 1.2), radius: 0.7 };
    let vertices = vec![quad.p(), quad.p() + quad.v(), quad.p() + quad.u(), Vec3::new(0.9, -0.5, 1.6)];
    let mesh = Mesh::new(vertices, vec![], vec![], vec![[0, 2, 1], [0, 1, 3]]).unwrap();
    let spot_with = |rim, angles| {
        let (p, d) = (Vec3::new(0.2, -0.3, 1.5), Vec3::new(0.3, 0.1, -2.0));
        Light::from(SpotLight::new(p, d, Rgb::new(3.0, 2.0, 1.0), angles).unwrap().with_rim(rim))
    };
    let spot = |angles| spot_with(Rim::Smooth, angles);
    vec![
        ("quad, one side", area(Shape::Parallelogram(quad), Sides::One)),
        ("quad, two sides", area(Shape::Parallelogram(quad), Sides::Two)),
        ("sphere, one side", area(Shape::Sphere(ball), Sides::One)),
        ("sphere, two sides", area(Shape::Sphere(ball), Sides::Two)),
        ("mesh, one side", area(Shape::Mesh(mesh.clone()), Sides::One)),
        ("mesh, two sides", area(Shape::Mesh(mesh), Sides::Two)),
        ("point", PointLight { p: Vec3::new(0.5, -0.2, 1.0), intensity: Rgb::new(1.0, 2.0, 3.0).into() }.into()),
        ("spot, soft", spot([0.3, 0.8])),
        ("spot, steep", spot_with(Rim::Fourth, [0.3, 0.8])),
        ("spot, even", spot_with(Rim::Even, [0.3, 0.8])),
        ("spot, even and sharp", spot_with(Rim::Even, [0.5, 0.5])),
        ("spot, as in glTF", spot_with(Rim::Square, [0.0, 0.8])),
        ("spot, sharp", spot([0.5, 0.5])),
        ("spot, all rim", spot([0.0, 1.0])),
        ("spot, wide", spot([1.2, 2.6])),
        ("goniometric", goniometric()),
        ("projection", projection(picture())),
        ("projection, dark in part", projection(halves())),
        ("directional", DirectionalLight::new(Vec3::new(1.0, 2.0, -3.0), Rgb::new(4.0, 3.0, 2.0)).unwrap().into()),
        ("sun", SunLight::new(Vec3::new(1.0, 2.0, -3.0), 4.7e-3, Rgb::new(4.0, 3.0, 2.0)).unwrap().into()),
        ("sun, wide", SunLight::new(Vec3::new(0.3, 1.0, -2.0), 0.6, Rgb::new(4.0, 3.0, 2.0)).unwrap().into()),
        ("environment, constant", EnvironmentLight::constant(Rgb::new(0.3, 0.6, 0.9)).into()),
        ("environment, picture", EnvironmentLight::panorama(sky(), Rgb::splat(0.7), turn()).unwrap().into()),
        ("environment, two pixels", EnvironmentLight::panorama(halves(), Rgb::ONE, turn()).unwrap().into()),
    ]
}

fn goniometric() -> Light {
    let intensity = Rgb::new(2.0, 1.5, 1.0);
    GoniometricLight::new(Vec3::new(0.1, 0.4, 1.3), intensity, sky(), turn()).unwrap().into()
}

/// Down at a slant, mirrored.
fn projection(picture: ImageTexture) -> Light {
    let forward = Vec3::new(0.3, -0.2, -1.0).normalize();
    let (right, up) = forward.any_orthonormal_pair();
    let (p, size) = (Vec3::new(-0.2, 0.1, 1.4), Vec2::new(1.6, 0.9));
    let axes = Mat3::from_cols(right, up, forward);
    ProjectionLight::new(p, axes, size, Rgb::new(3.0, 2.0, 2.5), picture).unwrap().into()
}

fn picture() -> ImageTexture {
    let pixel = |i: usize| Rgb::new(0.2 + (i % 5) as f32, 0.5, if i == 7 { 20.0 } else { 0.1 });
    ImageTexture::new(5, 3, (0..15).map(pixel).collect(), Wrap::Repeat).unwrap()
}

/// A dim gradient, a dark patch and a small sun.
fn sky() -> ImageTexture {
    let (w, h) = (24, 12);
    let pixel = |i: usize| match (i % w, i / w) {
        (17, 3) => Rgb::new(90.0, 80.0, 60.0),
        (3..=8, 4..=7) => Rgb::ZERO,
        (x, y) => Rgb::new(0.2 + 0.1 * (x as f32 * 0.8).sin(), 0.3, 1.0 / (1.0 + y as f32)),
    };
    ImageTexture::new(w, h, (0..w * h).map(pixel).collect(), Wrap::Repeat).unwrap()
}

fn halves() -> ImageTexture {
    ImageTexture::new(2, 1, vec![Rgb::new(1.0, 0.0, 0.0), Rgb::new(0.0, 0.2, 0.5)], Wrap::Repeat).unwrap()
}

/// A turn about a crooked axis, mirrored.
fn turn() -> Mat3 {
    Mat3::from_axis_angle(Vec3::new(1.0, 2.0, -0.5).normalize(), 1.1) * Mat3::from_diagonal(Vec3::new(1.0, 1.0, -1.0))
}

fn sampler(i: u64) -> Sampler<'static> {
    Sampler::new(5, Domain::Prepare, 0, i)
}

fn sum(s: Spectrum) -> f64 {
    f64::from(s.to_rgb(Wavelengths::Rgb).element_sum())
}

/// A scene of the light alone: what a ray sees of it.
fn scene_of(light: &Light) -> Scene {
    let mut b = SceneBuilder::new();
    let grey = b.constant(Rgb::splat(0.5));
    let material = b.material(DiffuseMaterial { reflectance: grey });
    match light {
        Light::Area(a) => {
            let emission = Some((a.radiance.clone(), a.sides));
            b.surface(SurfaceDef { shape: a.shape.clone(), material, emission });
        }
        other => b.light(other.clone()),
    }
    b.build().unwrap()
}

/// What a ray from `from` sees of the light: radiance, and where.
fn seen(scene: &Scene, light: &Light, from: Vec3, d: Vec3) -> (Spectrum, Option<EmitterHit>) {
    let world = scene.world(Wavelengths::Rgb, 0.0);
    match world.intersect(&Ray::new(from, d)) {
        Some(at) => (light.le(&at.emitter_hit(), -d, Wavelengths::Rgb), Some(at.emitter_hit())),
        None => (light.le_escaped(d, Wavelengths::Rgb), None),
    }
}

fn end_of(s: &LiSample) -> Option<EmitterHit> {
    match s.end {
        LightEnd::Surface(q) => Some(EmitterHit { p: q.p, ng: q.ng }),
        _ => None,
    }
}

/// 12 bands of equal area times 16 sectors.
fn bin(d: Vec3) -> usize {
    let band = ((0.5 - 0.5 * d.z) * 12.0).clamp(0.0, 11.0) as usize;
    let sector = (d.y.atan2(d.x) / std::f32::consts::TAU + 0.5) * 16.0;
    band * 16 + (sector as usize).min(15)
}
const BINS: usize = 12 * 16;

/// A sum of random numbers and of their squares, by bin, and the largest of them.
struct Tally(Vec<[f64; 2]>, f64);

impl Tally {
    fn new(bins: usize) -> Self {
        Self(vec![[0.0; 2]; bins], 0.0)
    }
    fn add(&mut self, bin: usize, x: f64) {
        self.0[bin][0] += x;
        self.0[bin][1] += x * x;
        self.1 = self.1.max(x);
    }
    /// Mean over `n` draws and its variance, as if one draw more had been the largest: an empty bin is not a sure zero.
    fn mean(&self, bin: usize, n: f64) -> [f64; 2] {
        let [s, s2] = self.0[bin];
        [s / n, ((s2 - s * s / n).max(0.0) + self.1 * self.1) / (n * n)]
    }
    /// Whether two estimates of the same means agree: every bin within 5 standard errors, and χ² as a whole.
    fn agree(&self, n: f64, other: &Self, m: f64) -> Result<(), String> {
        let (mut chi2, mut used) = (0.0, 0.0);
        for i in 0..self.0.len() {
            let ([a, va], [b, vb]) = (self.mean(i, n), other.mean(i, m));
            let scale = 1e-4 * (a.abs() + b.abs());
            let z = (a - b).abs() / (va + vb + scale * scale).sqrt().max(1e-9);
            if z > 5.0 {
                return Err(format!("bin {i}: {a:.6} against {b:.6}, {z:.1} standard errors"));
            }
            if a != 0.0 || b != 0.0 {
                (chi2, used) = (chi2 + z * z, used + 1.0);
            }
        }
        let limit = used + 4.0 * (2.0f64 * used).sqrt() + 4.0;
        if chi2 < limit { Ok(()) } else { Err(format!("chi2 {chi2:.0} over {used} bins")) }
    }
}

#[test]
fn the_list_of_lights_is_complete() {
    // A new kind of light does not compile here until it is listed.
    let kind = |l: &Light| match l {
        Light::Area(_) => 0,
        Light::Point(_) => 1,
        Light::Spot(_) => 2,
        Light::Directional(_) => 3,
        Light::Environment(_) => 4,
        Light::Goniometric(_) => 5,
        Light::Projection(_) => 6,
        Light::Sun(_) => 7,
    };
    assert!((0..8).all(|k| lights().iter().any(|(_, l)| kind(l) == k)));
}

const FROM: [Vec3; 3] = [Vec3::ZERO, Vec3::new(0.3, -0.8, 0.4), Vec3::new(0.5, 0.3, 1.15)];

#[test]
fn a_drawn_direction_has_the_density_and_the_radiance_that_a_ray_finds_there() {
    for (name, light) in lights() {
        let scene = scene_of(&light);
        for from in FROM {
            let mut drawn = 0;
            for i in 0..2000 {
                let Some(s) = light.sample_li(from, sampler(i).next_2d(), &AROUND) else { continue };
                drawn += 1;
                assert!((s.wi.length() - 1.0).abs() < 1e-4 && s.pdf.is_finite() && s.pdf > 0.0, "{name}: {s:?}");
                let pdf = light.pdf_li(from, s.wi, end_of(&s).as_ref());
                if s.delta {
                    assert!(light.is_delta() && pdf == 0.0 && s.pdf == 1.0, "{name}");
                    continue;
                }
                assert!((pdf / s.pdf - 1.0).abs() < 1e-3, "{name}: drawn with {}, found with {pdf}", s.pdf);
                let (le, hit) = seen(&scene, &light, from, s.wi);
                // A grazing ray may miss the very edge.
                if hit.is_some() == end_of(&s).is_some() {
                    assert!((sum(le) - sum(s.li)).abs() < 1e-3 * sum(s.li), "{name}: {le:?} against {:?}", s.li);
                }
            }
            assert!(drawn > 0 || from != FROM[0], "{name} does not reach the origin");
        }
    }
}

#[test]
fn directions_toward_a_light_are_spread_by_their_density() {
    const DRAWN: u64 = 40_000;
    const LOOKED: u64 = 150_000;
    for (name, light) in lights().into_iter().filter(|(_, l)| !l.is_delta()) {
        let scene = scene_of(&light);
        for from in FROM {
            let (mut drawn, mut looked) = (Tally::new(BINS), Tally::new(BINS));
            for i in 0..DRAWN {
                if let Some(s) = light.sample_li(from, sampler(i).next_2d(), &AROUND) {
                    drawn.add(bin(s.wi), 1.0);
                }
            }
            for i in 0..LOOKED {
                let d = square_to_sphere(sampler(i).next_2d());
                let (le, hit) = seen(&scene, &light, from, d);
                if !le.is_black() {
                    looked.add(bin(d), 4.0 * PI * f64::from(light.pdf_li(from, d, hit.as_ref())));
                }
            }
            drawn.agree(DRAWN as f64, &looked, LOOKED as f64).unwrap_or_else(|e| panic!("{name} from {from}: {e}"));
        }
    }
}

/// The emitter that an emitted ray came from, by going back along it.
fn origin_of(scene: &Scene, ray: &Ray) -> Option<EmitterHit> {
    let back = Ray::new(ray.o + 1e-3 * ray.d, -ray.d);
    scene.world(Wavelengths::Rgb, 0.0).intersect(&back).map(|at| at.emitter_hit())
}

#[test]
fn an_emitted_ray_has_the_densities_that_are_asked_for_later() {
    for (name, light) in lights() {
        let scene = scene_of(&light);
        for i in 0..2000 {
            let s = &mut sampler(i);
            let Some(e) = light.sample_le(s.next_2d(), s.next_2d(), &AROUND) else { continue };
            assert!(
                (e.ray.d.length() - 1.0).abs() < 1e-4 && e.flux().is_finite() && !e.flux().is_black(),
                "{name}: {e:?}"
            );
            let hit = if light.is_delta() { None } else { origin_of(&scene, &e.ray) };
            if matches!(light, Light::Area(_)) {
                let Some(hit) = hit else { continue };
                assert!((light.le(&hit, e.ray.d, Wavelengths::Rgb).max() - e.le.max()).abs() < 1e-6, "{name}");
                assert!((hit.ng.dot(e.ray.d).abs() - e.cos).abs() < 1e-3, "{name}");
            } else if !light.is_delta() {
                assert!(
                    (sum(light.le_escaped(-e.ray.d, Wavelengths::Rgb)) - sum(e.le)).abs() < 1e-3 * sum(e.le),
                    "{name}"
                );
            }
            let (pdf_area, pdf_dir) = light.pdf_le(hit.as_ref(), e.ray.d, &AROUND);
            assert!((pdf_area / e.pdf_area - 1.0).abs() < 1e-3, "{name}: {pdf_area} {e:?}");
            assert!((pdf_dir - e.pdf_dir).abs() < 1e-3 * e.pdf_dir.max(0.1), "{name}: {pdf_dir} {e:?}");
        }
    }
}

#[test]
fn emitted_directions_are_spread_by_their_density() {
    const N: u64 = 100_000;
    for (name, light) in lights().into_iter().filter(|(_, l)| !l.is_delta()) {
        let scene = scene_of(&light);
        let (mut drawn, mut expected) = (Tally::new(BINS), Tally::new(BINS));
        for i in 0..N {
            let s = &mut sampler(i);
            let (u_area, u_dir) = (s.next_2d(), s.next_2d());
            let Some(e) = light.sample_le(u_area, u_dir, &AROUND) else { continue };
            drawn.add(bin(e.ray.d), 1.0);
            // The same point, and a direction drawn evenly.
            let (hit, d) = (origin_of(&scene, &e.ray), square_to_sphere(s.next_2d()));
            expected.add(bin(d), 4.0 * PI * f64::from(light.pdf_le(hit.as_ref(), d, &AROUND).1));
        }
        if !matches!(light, Light::Environment(_)) {
            drawn.agree(N as f64, &expected, N as f64).unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
}

/// A square of side 1.5 in the plane z = 0 that counts light from above, in 4 x 4 fields.
mod receiver {
    use super::*;
    pub(super) const FIELDS: usize = 16;
    const SIDE: f32 = 1.5;
    pub(super) const FIELD_AREA: f64 = (SIDE * SIDE) as f64 / FIELDS as f64;

    pub(super) fn field(p: Vec3) -> Option<usize> {
        let q = (Vec2::new(p.x, p.y) / SIDE + 0.5) * 4.0;
        let inside = q.cmpge(Vec2::ZERO).all() && q.cmplt(Vec2::splat(4.0)).all();
        inside.then(|| q.y as usize * 4 + q.x as usize)
    }
    pub(super) fn point(u: Vec2) -> Vec3 {
        (SIDE * (u - 0.5)).extend(0.0)
    }
    /// The field that an emitted ray falls on from above, and how far away.
    pub(super) fn reached(e: &LeSample) -> Option<(usize, f32)> {
        let t = -e.ray.o.z / e.ray.d.z;
        (e.ray.d.z < 0.0 && t > 0.0).then(|| field(e.ray.at(t)).map(|f| (f, t)))?
    }
}

#[test]
fn light_sent_out_is_light_that_arrives() {
    const SENT: u64 = 200_000;
    const ASKED: u64 = 50_000;
    for (name, light) in lights() {
        let scene = scene_of(&light);
        let blocked = |ray: &Ray, end: f32| scene.world(Wavelengths::Rgb, 0.0).occluded(&Ray { tmax: end, ..*ray });
        let (mut sent, mut asked) = (Tally::new(receiver::FIELDS), Tally::new(receiver::FIELDS));
        for i in 0..SENT {
            let s = &mut sampler(i);
            let Some(e) = light.sample_le(s.next_2d(), s.next_2d(), &AROUND) else { continue };
            if let Some((field, end)) = receiver::reached(&e)
                && !blocked(&e.ray, end)
            {
                sent.add(field, sum(e.flux()) / receiver::FIELD_AREA);
            }
        }
        for i in 0..ASKED {
            let s = &mut sampler(i);
            let p = receiver::point(s.next_2d());
            if let Some(li) = light.sample_li(p, s.next_2d(), &AROUND) {
                // The inside of a two-sided ball stays inside, and one triangle may hide another.
                if end_of(&li).is_some_and(|q| blocked(&Ray::new(p, q.p - p), 0.999)) {
                    continue;
                }
                let cos = f64::from(li.wi.z.max(0.0)) * receiver::FIELDS as f64;
                asked.add(receiver::field(p).unwrap(), sum(li.li) * cos / f64::from(li.pdf));
            }
        }
        let total = |t: &Tally, n: u64| t.0.iter().map(|b| b[0]).sum::<f64>() / n as f64;
        let (a, b) = (total(&sent, SENT), total(&asked, ASKED));
        assert!(b > 0.1 && (a / b - 1.0).abs() < 0.02, "{name}: {a} sent, {b} arrived");
        sent.agree(SENT as f64, &asked, ASKED as f64).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn the_mean_flux_of_emitted_rays_is_the_power() {
    const N: u64 = 1 << 17;
    for (name, light) in lights() {
        let mut total = glam::DVec3::ZERO;
        for i in 0..N {
            let s = &mut sampler(i);
            if let Some(e) = light.sample_le(s.next_2d(), s.next_2d(), &AROUND) {
                total += e.flux().to_rgb(Wavelengths::Rgb).as_dvec3() / N as f64;
            }
        }
        let power = light.power(&AROUND).as_dvec3();
        let error = (total - power).abs().max_element() / power.max_element();
        assert!(error < 0.003, "{name}: {total} W sent, {power} W stated");
    }
}

#[test]
fn a_projector_shows_its_picture_upright_and_nothing_beside_it() {
    // Red, green / blue, white; projected along −z with x to the right and y up.
    let pixels = vec![Rgb::X, Rgb::Y, Rgb::Z, Rgb::ONE];
    let picture = ImageTexture::new(2, 2, pixels, Wrap::Clamp).unwrap();
    let axes = Mat3::from_cols(Vec3::X, Vec3::Y, Vec3::NEG_Z);
    let light = ProjectionLight::new(2.0 * Vec3::Z, axes, Vec2::new(2.0, 1.0), Rgb::ONE, picture).unwrap();
    let seen = |x: f32, y: f32| {
        let li = light.sample_li(Vec3::new(x, y, 0.0), Vec2::ZERO, &AROUND).map(|s| s.li.to_rgb(Wavelengths::Rgb));
        li.unwrap_or(Rgb::ZERO) * (x * x + y * y + 4.0)
    };
    for (x, y, want) in [(-1.0, 0.5, Rgb::X), (1.0, 0.5, Rgb::Y), (-1.0, -0.5, Rgb::Z), (1.0, -0.5, Rgb::ONE)] {
        assert!((seen(x, y) - want).abs().max_element() < 1e-5, "({x}, {y}): {}", seen(x, y));
    }
    assert_eq!((seen(2.1, 0.0), seen(0.0, 1.1)), (Rgb::ZERO, Rgb::ZERO));
}
