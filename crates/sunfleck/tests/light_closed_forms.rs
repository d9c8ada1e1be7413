//! Lights against textbook answers.
use glam::{Mat3, Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, PI};
use sunfleck::{
    light::{
        AreaLight, DirectionalLight, Emitter, EmitterHit, EnvironmentError, EnvironmentLight, Light, PointLight, Sides,
        SpotLight, SunLight, Surroundings,
    },
    sampler::{Domain, Sampler},
    shape::{Mesh, Parallelogram, Shape, Sphere},
    spectrum::{Rgb, Wavelengths},
    texture::{ImageTexture, Wrap},
};

const AROUND: Surroundings = Surroundings { centre: Vec3::ZERO, radius: 2.0, lambda: Wavelengths::Rgb };

/// Irradiance (of the red channel) at `p` on a surface facing `n`.
fn irradiance(light: &Light, p: Vec3, n: Vec3) -> f32 {
    let count = if light.is_delta() { 1 } else { 1 << 16 };
    let mut total = 0.0f64;
    for i in 0..count {
        let u = Sampler::new(3, Domain::Prepare, 0, i).next_2d();
        if let Some(s) = light.sample_li(p, u, &AROUND) {
            total += f64::from(s.li.to_rgb(Wavelengths::Rgb).x * s.wi.dot(n).max(0.0) / s.pdf);
        }
    }
    (total / count as f64) as f32
}

fn close(what: &str, found: f32, want: f32) {
    assert!((found - want).abs() <= 2e-3 * want.abs().max(1e-3), "{what}: {found}, expected {want}");
}

/// Form factor from a point to a rectangle a x b parallel to its surface at distance c, one corner straight above
/// (Howell, Mengüç & Siegel 2020, configuration C-1).
fn corner_form_factor(a: f32, b: f32, c: f32) -> f32 {
    let (x, y) = (a / c, b / c);
    let (rx, ry) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    (x / rx * (y / rx).atan() + y / ry * (x / ry).atan()) / (2.0 * PI)
}

/// A rectangle a x b at height c, one corner above the origin, emitting downward.
fn ceiling(a: f32, b: f32, c: f32) -> Parallelogram {
    Parallelogram::new(Vec3::new(0.0, 0.0, c), b * Vec3::Y, a * Vec3::X)
}

#[test]
fn a_rectangle_lights_a_parallel_surface_by_its_form_factor() {
    for (a, b, c) in [(1.0, 2.0, 1.5), (0.3, 0.3, 2.0), (4.0, 1.0, 0.5)] {
        let q = ceiling(a, b, c);
        let [p0, p1, p2, p3] = q.corners();
        let mesh = Mesh::new(vec![p0, p1, p2, p3], vec![], vec![], Parallelogram::TRIANGLES.to_vec()).unwrap();
        for shape in [Shape::Parallelogram(q), Shape::Mesh(mesh)] {
            for sides in [Sides::One, Sides::Two] {
                let light = AreaLight { shape: shape.clone(), radiance: Rgb::splat(3.0).into(), sides }.into();
                let want = PI * 3.0 * corner_form_factor(a, b, c);
                close("rectangle", irradiance(&light, Vec3::ZERO, Vec3::Z), want);
            }
        }
    }
}

#[test]
fn a_sphere_lights_a_surface_that_faces_it_by_the_square_of_its_sine() {
    let centre = Vec3::new(1.0, -2.0, 2.0);
    for radius in [0.01, 1.0, 2.9, 2.9999] {
        let light = AreaLight {
            shape: Shape::Sphere(Sphere { centre, radius }),
            radiance: Rgb::splat(5.0).into(),
            sides: Sides::One,
        };
        close("sphere", irradiance(&light.into(), Vec3::ZERO, centre / 3.0), PI * 5.0 * (radius / 3.0).powi(2));
    }
}

#[test]
fn from_inside_a_two_sided_sphere_every_surface_sees_pi_times_the_radiance() {
    let light = |sides| {
        let shape = Shape::Sphere(Sphere { centre: Vec3::X, radius: 2.0 });
        Light::from(AreaLight { shape, radiance: Rgb::splat(0.5).into(), sides })
    };
    for p in [Vec3::X, Vec3::ZERO, Vec3::new(1.5, 1.0, 0.3)] {
        close("inside", irradiance(&light(Sides::Two), p, Vec3::Y), PI * 0.5);
        assert_eq!(irradiance(&light(Sides::One), p, Vec3::Y), 0.0);
    }
}

#[test]
fn point_and_distant_lights_follow_the_cosine_and_the_inverse_square() {
    let n = Vec3::new(0.0, 0.6, 0.8);
    let p = Vec3::new(1.0, 1.0, 1.0);
    let point = PointLight { p: p + Vec3::new(0.0, 0.0, 2.5), intensity: Rgb::splat(10.0).into() }.into();
    close("point", irradiance(&point, p, n), 10.0 * 0.8 / 6.25);
    let distant = DirectionalLight::new(Vec3::new(0.0, 0.0, -7.0), Rgb::splat(4.0)).unwrap().into();
    close("directional", irradiance(&distant, p, n), 4.0 * 0.8);
    assert_eq!(irradiance(&distant, p, -n), 0.0);
    // A disc that is wholly above the surface gives as much as all its light in its middle.
    for radius in [4.7e-3, 0.5] {
        let sun = SunLight::new(Vec3::new(0.0, 0.0, -7.0), radius, Rgb::splat(4.0)).unwrap().into();
        close("sun", irradiance(&sun, p, n), 4.0 * 0.8);
    }
}

#[test]
fn a_spot_light_is_full_inside_half_at_the_middle_cosine_and_dark_outside() {
    let (hot, out) = (0.4f32, 0.9f32);
    let light = SpotLight::new(Vec3::ZERO, 2.0 * Vec3::X, Rgb::splat(8.0), [hot, out]).unwrap().into();
    let at = |angle: f32| {
        let d = Vec3::new(angle.cos(), angle.sin(), 0.0);
        irradiance(&light, 2.0 * d, -d)
    };
    for (angle, want) in
        [(0.0, 2.0), (0.39, 2.0), ((0.5 * (hot.cos() + out.cos())).acos(), 1.0), (0.91, 0.0), (2.0, 0.0), (PI, 0.0)]
    {
        close("spot", at(angle), want);
    }
    // A quarter of the way down in cosine from the hot rim: s = 3/4, s²(3 − 2s) = 27/32.
    close("rim", at((0.75 * hot.cos() + 0.25 * out.cos()).acos()), 2.0 * 27.0 / 32.0);
}

#[test]
fn a_hair_thin_beam_keeps_its_power() {
    let beam = SpotLight::new(Vec3::ZERO, Vec3::ONE, Rgb::ONE, [1e-4, 1e-4]).unwrap();
    close("beam", beam.power(&AROUND).x, PI * 1e-8);
    let s = beam.sample_li(Vec3::splat(5.0), Vec2::splat(0.5), &AROUND).unwrap();
    close("axis", s.li.to_rgb(Wavelengths::Rgb).x, 1.0 / 75.0);
}

#[test]
fn a_constant_environment_lights_every_surface_by_pi_times_its_radiance() {
    let constant = EnvironmentLight::constant(Rgb::splat(2.0));
    let grey = ImageTexture::new(7, 3, vec![Rgb::splat(4.0); 21], Wrap::Clamp).unwrap();
    let picture = EnvironmentLight::panorama(grey, Rgb::splat(0.5), Mat3::IDENTITY).unwrap();
    for light in [constant, picture].map(Light::from) {
        for n in [Vec3::X, Vec3::NEG_Y, Vec3::new(0.6, 0.0, -0.8)] {
            close("environment", irradiance(&light, Vec3::ZERO, n), 2.0 * PI);
        }
        close("power", light.power(&AROUND).x, 2.0 * 4.0 * PI * PI * 4.0);
    }
}

/// A picture that is white in one pixel.
fn one_pixel(w: usize, h: usize, x: usize, y: usize) -> ImageTexture {
    let pixels = (0..w * h).map(|i| if i == y * w + x { Rgb::ONE } else { Rgb::ZERO });
    ImageTexture::new(w, h, pixels.collect(), Wrap::Repeat).unwrap()
}

#[test]
fn pixels_of_a_panorama_shine_from_where_nrenderers_forks_look_them_up() {
    let quarter = Mat3::from_rotation_y(FRAC_PI_2);
    for (x, y, d) in [
        (8, 4, Vec3::X),
        (12, 4, Vec3::Z),
        (4, 4, Vec3::NEG_Z),
        (0, 4, Vec3::NEG_X),
        (8, 2, Vec3::new(1.0, 1.0, 0.0).normalize()),
        (8, 6, Vec3::new(1.0, -1.0, 0.0).normalize()),
    ] {
        // Pixel (x, y) spans from corner (x, y) to (x+1, y+1): look just inside, beyond its middle.
        for (turn, toward) in [(Mat3::IDENTITY, d), (quarter, quarter * d)] {
            let light = EnvironmentLight::panorama(one_pixel(16, 8, x, y), Rgb::ONE, turn).unwrap();
            let le = |d: Vec3| light.le_escaped(d, Wavelengths::Rgb).max();
            assert!(le(toward) > 0.2, "pixel ({x}, {y}) from {toward}: {}", le(toward));
            assert_eq!(le(-toward), 0.0);
            let s = light.sample_li(Vec3::ZERO, Vec2::splat(0.5), &AROUND).unwrap();
            assert!(s.wi.dot(toward) > 0.8, "pixel ({x}, {y}): sampled {}", s.wi);
        }
    }
}

#[test]
fn the_upper_half_of_a_picture_is_the_sky() {
    let (w, h) = (64, 64);
    let pixels = (0..w * h).map(|i| if i / w < h / 2 { Rgb::ONE } else { Rgb::ZERO });
    let image = ImageTexture::new(w, h, pixels.collect(), Wrap::Repeat).unwrap();
    let light = EnvironmentLight::panorama(image, Rgb::ONE, Mat3::IDENTITY).unwrap().into();
    let up = irradiance(&light, Vec3::ZERO, Vec3::Y);
    assert!((up - PI).abs() < 0.01 * PI, "{up}");
    let side = irradiance(&light, Vec3::ZERO, Vec3::X);
    assert!((side - 0.5 * PI).abs() < 0.01 * PI, "{side}");
}

#[test]
fn no_direction_is_out_of_reach_however_bright_the_sun() {
    let (w, h) = (512, 256);
    let pixels = (0..w * h).map(|i| Rgb::splat(if i == 40 * w + 300 { 1e8 } else { 1e-3 }));
    let image = ImageTexture::new(w, h, pixels.collect(), Wrap::Repeat).unwrap();
    let light = EnvironmentLight::panorama(image, Rgb::ONE, Mat3::IDENTITY).unwrap();
    for i in 0..10_000 {
        let d = sunfleck::math::warp::square_to_sphere(Sampler::new(1, Domain::Prepare, 0, i).next_2d());
        assert!(light.pdf_li(Vec3::ZERO, d, None) > 1e-3, "{d}");
    }
}

#[test]
fn stretched_or_unphysical_panoramas_are_refused() {
    let image = || ImageTexture::new(2, 1, vec![Rgb::ONE, Rgb::new(0.0, -1.0, 0.0)], Wrap::Repeat).unwrap();
    let stretched = Mat3::from_diagonal(Vec3::new(1.0, 2.0, 1.0));
    assert!(matches!(EnvironmentLight::panorama(image(), Rgb::ONE, stretched), Err(EnvironmentError::NotARotation(_))));
    assert!(matches!(
        EnvironmentLight::panorama(image(), Rgb::ONE, Mat3::IDENTITY),
        Err(EnvironmentError::Pixel { x: 1, y: 0, .. })
    ));
    assert!(DirectionalLight::new(Vec3::ZERO, Rgb::ONE).is_none());
}

#[test]
fn a_one_sided_light_sends_nothing_backward() {
    let hit = |n: Vec3| EmitterHit { p: Vec3::new(0.5, 0.5, 1.0), ng: n };
    let below = hit(Vec3::NEG_Z);
    for (sides, backward) in [(Sides::One, false), (Sides::Two, true)] {
        let light = AreaLight { shape: Shape::Parallelogram(ceiling(1.0, 1.0, 1.0)), radiance: Rgb::ONE.into(), sides };
        let up = Vec3::new(0.6, 0.0, 0.8);
        assert_eq!(!light.le(&below, up, Wavelengths::Rgb).is_black(), backward);
        assert_eq!(light.pdf_le(Some(&below), up, &AROUND).1 > 0.0, backward);
        assert_eq!(light.pdf_li(Vec3::new(0.5, 0.5, 2.0), Vec3::NEG_Z, Some(&below)) > 0.0, backward);
        assert_eq!(light.sample_li(Vec3::new(0.3, 0.3, 2.0), Vec2::splat(0.5), &AROUND).is_some(), backward);
        let upward = (0..1000).filter(|&i| {
            let s = &mut Sampler::new(2, Domain::Prepare, 0, i);
            light.sample_le(s.next_2d(), s.next_2d(), &AROUND).is_some_and(|e| e.ray.d.z > 0.0)
        });
        assert_eq!(upward.count(), if backward { 500 } else { 0 });
    }
}

#[test]
fn rays_of_distant_lights_start_outside_the_scene_and_cross_its_disk() {
    let around = Surroundings { centre: Vec3::new(5.0, -3.0, 2.0), radius: 4.0, ..AROUND };
    let sun = DirectionalLight::new(Vec3::new(0.2, -1.0, 0.4), Rgb::ONE).unwrap();
    for light in [Light::from(sun), EnvironmentLight::constant(Rgb::ONE).into()] {
        for i in 0..1000 {
            let s = &mut Sampler::new(4, Domain::Prepare, 0, i);
            let e = light.sample_le(s.next_2d(), s.next_2d(), &around).unwrap();
            let from_centre = e.ray.o - around.centre;
            assert!(from_centre.length() > around.radius && from_centre.dot(e.ray.d) < 0.0);
            assert!(from_centre.reject_from(e.ray.d).length() < 1.0001 * around.radius);
        }
    }
}
