//! Where cameras look from and to.

use super::{LIGHT, load_files, loaded};
use crate::load::Loaded;
use glam::{Vec2, Vec3};
use sunfleck::camera::Project;

#[test]
fn x_is_at_the_right_of_the_picture_and_the_shorter_side_has_the_angle() {
    let head = "Camera \"perspective\" \"float fov\" 90\nFilm \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100\n";
    for (mirror, sign) in [("", 1.0), ("Scale -1 1 1\n", -1.0)] {
        let text = format!("{mirror}LookAt 0 0 0  0 0 1  0 1 0\n{head}WorldBegin\n{LIGHT}");
        let file = loaded(&text);
        let camera = file.camera.build(file.camera.aspect.unwrap()).unwrap();
        let right = camera.ray(Vec2::new(1.0, 0.5), Vec2::ZERO).ray.d;
        assert!((right - Vec3::new(sign * 2.0, 0.0, 1.0).normalize()).length() < 1e-5, "{right}");
        let top = camera.ray(Vec2::new(0.5, 0.0), Vec2::ZERO).ray.d;
        assert!((top - Vec3::new(0.0, 1.0, 1.0).normalize()).length() < 1e-5, "{top}");
        assert_eq!((file.defaults.width, file.defaults.height), (200, 100));
    }
}

#[test]
fn a_crop_is_a_part_of_the_whole_picture() {
    let text = |crop: &str| {
        let film = "Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100";
        format!("Camera \"perspective\"\n{film} {crop}\nWorldBegin\n{LIGHT}")
    };
    let ray = |file: &Loaded, raster: Vec2| {
        file.camera.build(file.camera.aspect.unwrap()).unwrap().ray(raster, Vec2::ZERO).ray.d
    };
    let (whole, part) = (loaded(&text("")), loaded(&text("\"float cropwindow\" [0.5 0.75 0 0.5]")));
    assert_eq!((part.defaults.width, part.defaults.height), (50, 50));
    for corner in [Vec2::ZERO, Vec2::ONE, Vec2::new(0.3, 0.8)] {
        let same = Vec2::new(0.5, 0.0) + corner * Vec2::new(0.25, 0.5);
        assert!((ray(&part, corner) - ray(&whole, same)).length() < 1e-5);
    }
}

#[test]
fn parallel_and_spherical_cameras_see_what_pbrts_do() {
    let look = |camera: &str| {
        let text = format!(
            "Scale 0.5 0.5 1 LookAt 1 2 3 1 2 4 0 1 0\n{camera}\nFilm \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100\n\
             WorldBegin\n{LIGHT}Shape \"sphere\""
        );
        let (told, file) = load_files(&[("main.pbrt", &text)]);
        assert_eq!(told, "", "{camera}");
        let camera = file.unwrap().camera;
        camera.build(camera.aspect.unwrap()).unwrap()
    };
    let flat = look("Camera \"orthographic\"");
    // Camera space is scaled by the directives before `Camera`, as any other: the shorter side is 4 units high.
    let corner = flat.ray(Vec2::new(1.0, 0.0), Vec2::ZERO).ray;
    assert!(
        (corner.o - Vec3::new(5.0, 4.0, 3.0)).length() < 1e-5 && (corner.d - Vec3::Z).length() < 1e-6,
        "{corner:?}"
    );
    let window = look(
        "Camera \"orthographic\" \"float screenwindow\" [ 0 4 -1 1 ] \"float lensradius\" 0.1 \"float focaldistance\" 5",
    );
    let middle = window.ray(Vec2::splat(0.5), Vec2::new(0.2, 0.9)).ray;
    // Uneven scaling: only the distance is that of z.
    assert!((middle.at(5.0 / middle.d.z) - Vec3::new(5.0, 2.0, 8.0)).length() < 1e-5, "{middle:?}");
    // Longitude from x over z to -x; the pole y at the top.
    for camera in ["\"environment\"", "\"spherical\" \"string mapping\" \"equirectangular\""] {
        let around = look(&format!("Camera {camera}"));
        let d = |x, y| around.ray(Vec2::new(x, y), Vec2::ZERO).ray.d;
        assert!(
            (d(0.0, 0.5) - Vec3::X).length() < 1e-5 && (d(0.25, 0.5) - Vec3::Z).length() < 1e-5,
            "{}",
            d(0.25, 0.5)
        );
        assert!((d(0.25, 0.25) - Vec3::new(0.0, 0.5f32.sqrt(), 0.5f32.sqrt())).length() < 1e-5);
    }
    // In the square, y is in the middle, x at the right and z below.
    let square = look("Camera \"spherical\"");
    let d = |x, y| square.ray(Vec2::new(x, y), Vec2::ZERO).ray.d;
    for (place, want) in
        [((0.5, 0.5), Vec3::Y), ((1.0, 0.5), Vec3::X), ((0.5, 1.0), Vec3::Z), ((0.0, 0.0), Vec3::NEG_Y)]
    {
        assert!((d(place.0, place.1) - want).length() < 1e-4, "{place:?} {}", d(place.0, place.1));
    }
}

#[test]
fn a_barrel_of_lenses_becomes_a_thin_lens() {
    let scene = |lens: &str| {
        format!(
            "Camera \"realistic\" \"string lensfile\" \"{lens}\" \"float aperturediameter\" 10 \"float focusdistance\" 2\n\
             Film \"rgb\" \"integer xresolution\" 300 \"integer yresolution\" 400 \"float diagonal\" 50\nWorldBegin\n{LIGHT}"
        )
    };
    // A ball of glass, seen as thin: f = R / (2 (n − 1)) for surfaces that touch.
    let (told, file) =
        load_files(&[("main.pbrt", &scene("a b.dat")), ("a b.dat", "50 0 1.5 30\n-50 40 1 30\n0 9 0 8\n")]);
    assert!(told.starts_with("warning: a camera with a barrel") && !told.contains("50 mm"), "{told}");
    let camera = file.unwrap().camera;
    assert!((camera.aperture - 0.008).abs() < 1e-6 && (camera.focus_distance - 2.0).abs() < 1e-6);
    let film_distance = 0.05f32 * 2.0 / 1.95;
    assert!(((0.5 * camera.fov).to_radians().tan() - 0.02 / film_distance).abs() < 1e-4, "{camera:?}");
    let told = load_files(&[("main.pbrt", &scene("none.dat"))]).0;
    assert!(told.contains("50 mm are taken"), "{told}");
}
