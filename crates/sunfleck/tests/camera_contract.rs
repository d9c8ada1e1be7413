//! What every camera promises: the ray through a place of the picture and the way back agree, and it measures radiance.
use glam::{Vec2, Vec3};
use std::f32::consts::PI;
use sunfleck::{
    camera::{Camera, CameraError, Orthographic, Perspective, Project, Spherical, Spread, Unrolling, View},
    math::warp::square_to_sphere,
    sampler::{Domain, Sampler},
};

const VIEW: View = View { position: Vec3::new(1.0, 2.0, -3.0), look_at: Vec3::new(0.5, 1.0, 4.0), up: Vec3::Y };
const FRONT: View = View { position: Vec3::ZERO, look_at: Vec3::Z, up: Vec3::Y };

fn cameras() -> Vec<(&'static str, Camera)> {
    let pinhole = || Perspective::new(&VIEW, 50.0, 1.6).unwrap();
    let flat = || Orthographic::new(&VIEW, 5.0, 0.8).unwrap();
    vec![
        ("pinhole", pinhole().into()),
        ("thin lens", pinhole().with_lens(0.4, 3.0).unwrap().into()),
        ("shifted and mirrored", pinhole().with_shift(Vec2::new(0.3, -0.2)).mirrored().into()),
        ("parallel", Orthographic::new(&VIEW, 6.0, 1.4).unwrap().into()),
        (
            "parallel with lenses",
            flat().with_lens(0.6, 4.0).unwrap().with_shift(Vec2::new(0.1, -0.2)).mirrored().into(),
        ),
        ("sphere", Spherical::new(&VIEW, Unrolling::Equirectangular).unwrap().into()),
        ("equal areas", Spherical::new(&VIEW, Unrolling::EqualArea).unwrap().mirrored().into()),
        ("wide thin lens", Perspective::new(&VIEW, 100.0, 0.7).unwrap().with_lens(0.5, 1.0).unwrap().into()),
    ]
}

fn sampler(i: u64) -> Sampler<'static> {
    Sampler::new(9, Domain::Prepare, 0, i)
}

#[test]
fn the_way_back_from_a_point_on_a_ray_leads_to_the_same_place() {
    for (name, camera) in cameras() {
        for i in 0..2000 {
            let s = &mut sampler(i);
            let (raster, u_lens) = (s.next_2d(), s.next_2d());
            let out = camera.ray(raster, u_lens);
            assert!((out.ray.d.length() - 1.0).abs() < 1e-5);
            let t = 0.5 + 20.0 * s.next_1d();
            let back = camera.sample_wi(out.ray.at(t), u_lens).unwrap();
            // Longitudes part at the poles.
            let near_pole = name == "sphere" && (raster.y - 0.5).abs() > 0.49;
            assert!(near_pole || (back.raster - raster).length() < 1e-4, "{name}: {raster} became {}", back.raster);
            assert!(
                (back.p - out.ray.o).length() < 1e-5 * (1.0 + t) && (back.wi + out.ray.d).length() < 1e-4,
                "{name}"
            );
            assert!(near_pole || (back.importance * out.spread.area_at(t) - 1.0).abs() < 1e-3, "{name}");
        }
    }
}

#[test]
fn what_is_behind_the_camera_is_not_seen() {
    for (name, camera) in cameras().into_iter().filter(|(name, _)| !matches!(*name, "sphere" | "equal areas")) {
        let away = VIEW.position - VIEW.look_at;
        for p in [VIEW.position + away, VIEW.position + 0.1 * away + 3.0 * Vec3::X] {
            assert!(camera.sample_wi(p, Vec2::splat(0.3)).is_none(), "{name}");
        }
    }
}

/// A sheet that fills the view and shines evenly must look even: every field of the picture collects
/// `L·cos·importance / pdf_area` of points spread over the sheet, with a mean of L.
#[test]
fn a_matt_sheet_of_radiance_one_measures_one_everywhere() {
    const N: u64 = 400_000;
    const FIELDS: usize = 6;
    let n = Vec3::new(0.3, 0.2, -1.0).normalize();
    let (u, v) = n.any_orthonormal_pair();
    for (name, camera) in cameras().into_iter().filter(|(name, _)| !matches!(*name, "sphere" | "equal areas")) {
        let (centre, half) = (VIEW.position + 4.0 * (VIEW.look_at - VIEW.position).normalize(), 14.0);
        let area = f64::from(4.0 * half * half);
        let mut tally = [[0.0f64; 2]; FIELDS * FIELDS];
        for i in 0..N {
            let s = &mut sampler(i);
            let at = half * (2.0 * s.next_2d() - 1.0);
            let p = centre + at.x * u + at.y * v;
            let Some(c) = camera.sample_wi(p, s.next_2d()) else { continue };
            let q = c.raster * FIELDS as f32;
            if q.cmpge(Vec2::ZERO).all() && q.cmplt(Vec2::splat(FIELDS as f32)).all() {
                let per_field = area * (FIELDS * FIELDS) as f64;
                let x = f64::from(n.dot(c.wi).max(0.0) * c.importance) * per_field;
                let t = &mut tally[q.y as usize * FIELDS + q.x as usize];
                *t = [t[0] + x, t[1] + x * x];
            }
        }
        let n = N as f64;
        for (i, [s, s2]) in tally.iter().enumerate() {
            let (mean, error) = (s / n, ((s2 - s * s / n).max(0.0)).sqrt() / n);
            assert!(error < 0.1 && (mean - 1.0).abs() < 4.5 * error, "{name}, field {i}: {mean} ± {error}");
        }
        let all = tally.iter().map(|t| t[0]).sum::<f64>() / n / (FIELDS * FIELDS) as f64;
        assert!((all - 1.0).abs() < 0.01, "{name}: {all}");
    }
}

#[test]
fn the_solid_angles_of_the_picture_add_up_to_the_pyramid_it_spans() {
    for (fov, aspect) in [(40.0f32, 1.0f32), (90.0, 2.0), (20.0, 0.5)] {
        let camera = Perspective::new(&VIEW, fov, aspect).unwrap();
        let b = (0.5 * fov.to_radians()).tan();
        let a = b * aspect;
        let want = 4.0 * (a * b / (1.0 + a * a + b * b).sqrt()).atan();
        let n = 200;
        let raster = |i: u32| Vec2::new((i % n) as f32 + 0.5, (i / n) as f32 + 0.5) / n as f32;
        let sum: f64 = (0..n * n).map(|i| f64::from(camera.ray(raster(i), Vec2::ZERO).spread.area_at(1.0))).sum();
        let mean = sum as f32 / (n * n) as f32;
        assert!((mean / want - 1.0).abs() < 1e-3, "{mean} against {want}");
    }
}

#[test]
fn looking_along_z_x_is_on_the_left_and_y_on_top() {
    let camera = Perspective::new(&FRONT, 90.0, 2.0).unwrap();
    let raster = |p: Vec3| camera.sample_wi(p, Vec2::ZERO).unwrap().raster;
    for (p, want) in [
        (Vec3::Z, (0.5, 0.5)),
        // 90 degrees from top to bottom; the picture is twice as wide.
        (Vec3::new(0.0, 1.0, 1.0), (0.5, 0.0)),
        (Vec3::new(0.0, -2.0, 2.0), (0.5, 1.0)),
        (Vec3::new(2.0, 0.0, 1.0), (0.0, 0.5)),
        (Vec3::new(-1.0, 0.5, 1.0), (0.75, 0.25)),
    ] {
        assert!((raster(p) - Vec2::from(want)).length() < 1e-5, "{p} is seen at {}", raster(p));
    }
}

/// The same of a ball around an eye that sees in all directions.
#[test]
fn a_shining_ball_around_the_eye_measures_one_everywhere() {
    const N: u64 = 400_000;
    const FIELDS: usize = 6;
    let (centre, radius) = (VIEW.position + Vec3::new(0.5, -1.0, 0.7), 4.0f32);
    for (name, camera) in cameras().into_iter().filter(|(name, _)| matches!(*name, "sphere" | "equal areas")) {
        let mut tally = [[0.0f64; 2]; FIELDS * FIELDS];
        for i in 0..N {
            let n = square_to_sphere(sampler(i).next_2d());
            let c = camera.sample_wi(centre + radius * n, Vec2::ZERO).unwrap();
            let q = (c.raster * FIELDS as f32).clamp(Vec2::ZERO, Vec2::splat(FIELDS as f32 - 0.5));
            let area = f64::from(4.0 * PI * radius * radius);
            let x = area * f64::from(-n.dot(c.wi) * c.importance) * (FIELDS * FIELDS) as f64;
            let t = &mut tally[q.y as usize * FIELDS + q.x as usize];
            *t = [t[0] + x, t[1] + x * x];
        }
        for (i, [s, s2]) in tally.iter().enumerate() {
            let n = N as f64;
            let (mean, error) = (s / n, ((s2 - s * s / n).max(0.0)).sqrt() / n);
            assert!(error < 0.1 && (mean - 1.0).abs() < 4.5 * error, "{name}, field {i}: {mean} ± {error}");
        }
    }
}

#[test]
fn what_surrounds_a_spherical_camera_lies_where_its_unrolling_says() {
    // Looking along z with y up, -x is at the right.
    let of = |unrolling| Spherical::new(&FRONT, unrolling).unwrap();
    let seen = |camera: &Spherical, d: Vec3| camera.sample_wi(3.0 * d, Vec2::ZERO).unwrap().raster;
    let (long, square) = (of(Unrolling::Equirectangular), of(Unrolling::EqualArea));
    for (d, in_long, in_square) in [
        (Vec3::Z, (0.5, 0.5), (0.5, 1.0)),
        (Vec3::NEG_X, (0.75, 0.5), (1.0, 0.5)),
        (Vec3::X, (0.25, 0.5), (0.0, 0.5)),
        (Vec3::new(0.0, 1.0, 1.0), (0.5, 0.25), (0.5, 0.5 + 0.5 * (1.0 - 0.5f32.sqrt()).sqrt())),
        (Vec3::new(0.0, -1.0, 1e-6), (0.5, 1.0), (0.5, 1.0)),
    ] {
        assert!(seen(&long, d).distance(Vec2::from(in_long)) < 1e-4, "{d} is seen at {}", seen(&long, d));
        if d.y >= 0.0 {
            assert!(seen(&square, d).distance(Vec2::from(in_square)) < 1e-4, "{d} is seen at {}", seen(&square, d));
        }
    }
}

#[test]
fn parallel_rays_keep_sizes_and_see_only_what_lies_ahead() {
    let camera = Orthographic::new(&FRONT, 4.0, 1.5).unwrap();
    let raster = |p: Vec3| camera.sample_wi(p, Vec2::ZERO).map(|c| c.raster);
    for z in [0.1, 1.0, 50.0] {
        assert!(raster(Vec3::new(-3.0, 2.0, z)).unwrap().distance(Vec2::new(1.0, 0.0)) < 1e-5);
        assert!(raster(Vec3::new(1.5, 0.0, z)).unwrap().distance(Vec2::new(0.25, 0.5)) < 1e-5);
    }
    assert_eq!(raster(Vec3::new(0.5, 0.5, -0.1)), None);
    // A pixel covers the same everywhere.
    let ray = camera.ray(Vec2::new(0.1, 0.8), Vec2::ZERO);
    assert_eq!((ray.ray.d, ray.spread), (Vec3::Z, Spread::Area(24.0)));
    assert_eq!(ray.spread.of_pixel(24).width_at(7.0), 1.0);
    let blurred = Orthographic::new(&FRONT, 4.0, 1.5).unwrap().with_lens(0.5, 2.0).unwrap();
    for i in 0..100 {
        let p = blurred.ray(Vec2::new(0.3, 0.6), sampler(i).next_2d()).ray;
        assert!((p.o + p.d * (2.0 / p.d.z)).distance(Vec3::new(1.2, -0.4, 2.0)) < 1e-5, "what is in focus is sharp");
    }
}

#[test]
fn a_tilted_or_useless_up_still_gives_an_upright_basis() {
    for up in [Vec3::new(0.0, 1.0, 5.0), Vec3::Z, Vec3::ZERO, Vec3::NEG_Z * 1e-20] {
        let camera = Perspective::new(&View { up, ..FRONT }, 60.0, 1.0).unwrap();
        let d = |x, y| camera.ray(Vec2::new(x, y), Vec2::ZERO).ray.d;
        assert!((d(0.5, 0.5) - Vec3::Z).length() < 1e-6);
        let (right, top) = (d(1.0, 0.5) - d(0.0, 0.5), d(0.5, 0.0) - d(0.5, 1.0));
        assert!((right.length() - 1.0).abs() < 1e-5 && (top.length() - 1.0).abs() < 1e-5, "{up}");
        assert!(right.dot(top).abs() < 1e-5 && right.cross(top).z < -0.99, "{up}");
    }
}

#[test]
fn points_in_focus_are_sharp_and_others_blur_to_the_circle_of_confusion() {
    let (aperture, focus) = (0.2, 4.0);
    let camera = Perspective::new(&FRONT, 53.13, 1.0).unwrap().with_lens(aperture, focus).unwrap();
    // 53.13 degrees: the picture is one unit high at distance one.
    let spread = |p: Vec3| {
        let seen: Vec<Vec2> = (0..500).map(|i| camera.sample_wi(p, sampler(i).next_2d()).unwrap().raster).collect();
        let middle = seen.iter().sum::<Vec2>() / 500.0;
        seen.iter().map(|r| r.distance(middle)).fold(0.0, f32::max)
    };
    for (x, y) in [(0.0, 0.0), (1.2, -0.7), (-1.9, 1.9)] {
        assert!(spread(Vec3::new(x, y, focus)) < 1e-5, "({x}, {y}) is in focus");
    }
    for z in [2.0f32, 8.0] {
        // A point at z is projected from the rim of the lens with an offset of r·|1/z − 1/focus| at distance one.
        let want = 0.5 * aperture * (1.0 / z - 1.0 / focus).abs();
        assert!((spread(Vec3::new(0.1, 0.2, z)) / want - 1.0).abs() < 0.05, "at {z}");
    }
}

#[test]
fn a_lens_is_sampled_all_over() {
    let camera = Perspective::new(&FRONT, 40.0, 1.0).unwrap().with_lens(2.0, 5.0).unwrap();
    let n = 4096;
    let p: Vec<Vec3> = (0..n).map(|i| camera.ray(Vec2::splat(0.5), sampler(i).next_2d()).ray.o).collect();
    let mean2 = p.iter().map(|p| f64::from(p.length_squared())).sum::<f64>() / n as f64;
    let mean = p.iter().sum::<Vec3>() / n as f32;
    assert!(p.iter().all(|p| p.length() < 1.0001 && p.z == 0.0), "the lens has radius 1");
    assert!((mean2 - 0.5).abs() < 0.01 && mean.length() < 0.01, "mean r² {mean2}, centre {mean}");
}

#[test]
fn numbers_that_make_no_camera_are_named() {
    let message = |r: Result<Perspective, CameraError>| r.err().map(|e| e.to_string()).unwrap_or_default();
    let new = |view: View, fov, aspect| message(Perspective::new(&view, fov, aspect));
    for (found, want) in [
        (new(FRONT, 0.0, 1.0), "the field of view is 0, but must be more than 0 and less than 180 degrees"),
        (new(FRONT, f32::NAN, 1.0), "the field of view is NaN, but must be more than 0 and less than 180 degrees"),
        (new(FRONT, 180.0, 1.0), "the field of view is 180, but must be more than 0 and less than 180 degrees"),
        (new(FRONT, 40.0, -1.0), "the aspect ratio is -1, but must be positive"),
        (
            new(View { look_at: FRONT.position, ..FRONT }, 40.0, 1.0),
            "the camera at [0, 0, 0] cannot look at [0, 0, 0]: the two must be finite and different points",
        ),
        (
            Orthographic::new(&FRONT, 0.0, 1.0).unwrap_err().to_string(),
            "the height of the picture is 0, but must be positive",
        ),
        (
            message(Perspective::new(&FRONT, 40.0, 1.0).unwrap().with_lens(-0.1, 1.0)),
            "the aperture is -0.1, but must be zero or positive",
        ),
        (
            message(Perspective::new(&FRONT, 40.0, 1.0).unwrap().with_lens(0.1, 0.0)),
            "the focus distance is 0, but must be positive",
        ),
    ] {
        assert_eq!(found, want);
    }
}
