//! Whole scenes, written to a folder of their own.

mod cameras;
mod looks;
mod media;

use crate::load::{LoadOptions, Loaded, load};
use crate::{Diagnostic, Error};
use glam::Vec3;
use insta::assert_snapshot;
use proptest::prelude::*;
use sunfleck::light::Light;
use sunfleck::math::Ray;
use sunfleck::scene::Scene;
use sunfleck::spectrum::Wavelengths;

/// Loads the first of these files; the others lie beside it. Messages call the folder FOLDER.
fn load_files(files: &[(&str, &str)]) -> (String, Result<Loaded, Error>) {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let loaded = load(&[folder.path().join(files[0].0)], &LoadOptions::default());
    let (errors, warnings) = match &loaded {
        Ok(loaded) => (&[][..], &loaded.warnings),
        Err(error) => (&error.errors[..], &error.warnings),
    };
    let texts: Vec<String> = errors.iter().chain(warnings).map(Diagnostic::to_string).collect();
    (texts.join("\n\n").replace(&folder.path().display().to_string(), "FOLDER"), loaded)
}

fn loaded(text: &str) -> Loaded {
    load_files(&[("a.pbrt", text)]).1.unwrap_or_else(|e| panic!("{e}"))
}

fn scene(text: &str) -> Scene {
    loaded(text).builder.build().unwrap()
}

fn told(text: &str) -> String {
    load_files(&[("a.pbrt", text)]).0
}

/// Whether a ray from far away along `-from` meets the outer side at the distance of `at`.
fn outer_normal(scene: &Scene, from: Vec3, to: Vec3) -> Option<Vec3> {
    let world = scene.world(Wavelengths::Rgb, 0.0);
    let ray = Ray { o: from, d: (to - from).normalize(), tmin: 0.0, tmax: f32::INFINITY };
    world.intersect(&ray).map(|hit| hit.ng)
}

const LIGHT: &str = "LightSource \"point\"\n";

#[test]
fn the_outer_side_is_pbrts() {
    let square = "\"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0] \"integer indices\" [0 1 2 0 2 3]";
    let normals = "\"normal N\" [0 0 -1 0 0 -1 0 0 -1 0 0 -1]";
    let cases = [
        (format!("Shape \"trianglemesh\" {square}"), 1.0),
        (format!("ReverseOrientation Shape \"trianglemesh\" {square}"), -1.0),
        (format!("Scale -1 1 1 Shape \"trianglemesh\" {square}"), 1.0),
        (format!("Shape \"trianglemesh\" {square} {normals}"), -1.0),
        (format!("ReverseOrientation Shape \"trianglemesh\" {square} {normals}"), 1.0),
        ("Shape \"disk\"".to_owned(), 1.0),
        ("ReverseOrientation Shape \"disk\"".to_owned(), -1.0),
        ("Shape \"sphere\"".to_owned(), 1.0),
        ("Scale 1 1 2 Shape \"sphere\"".to_owned(), 1.0),
        ("ReverseOrientation Shape \"sphere\"".to_owned(), -1.0),
        ("Rotate 90 1 0 0 Shape \"cylinder\"".to_owned(), 1.0),
    ];
    for (text, sign) in cases {
        let scene = scene(&format!("WorldBegin\n{LIGHT}{text}\n"));
        let n = outer_normal(&scene, Vec3::new(0.3, 0.2, 9.0), Vec3::new(0.3, 0.2, 0.0)).unwrap();
        assert!(n.z * sign > 0.5, "{text}: {n}");
    }
}

#[test]
fn transformations_nest_and_come_back() {
    let text = "WorldBegin\nLightSource \"point\"\nTranslate 5 0 0\nAttributeBegin\nScale 2 2 2\nTranslate 1 0 0\n\
        CoordinateSystem \"there\"\nAttributeEnd\nTransformBegin Identity TransformEnd\n\
        AttributeBegin CoordSysTransform \"there\" Shape \"sphere\" AttributeEnd\nShape \"sphere\" \"float radius\" 0.5";
    let (centre, radius) = scene(text).bounding_sphere();
    // Spheres of radius 2 at 7, and of 0.5 at 5.
    assert!((centre.x - 6.75).abs() < 1e-3 && radius > 2.0, "{centre} {radius}");
}

#[test]
fn what_a_block_says_ends_with_it() {
    let counts = |text: &str| {
        let file = loaded(&format!("WorldBegin\n{LIGHT}{text}"));
        (file.surfaces, file.lights)
    };
    let hidden = "AttributeBegin Material \"\" Shape \"sphere\" AttributeEnd Shape \"disk\"";
    assert_eq!(counts(hidden), (1, 1));
    assert_eq!(counts("Shape \"disk\" TransformBegin Material \"\" TransformEnd Shape \"sphere\""), (1, 1));
    assert_eq!(
        counts("AttributeBegin AreaLightSource \"diffuse\" Shape \"disk\" AttributeEnd Shape \"sphere\""),
        (2, 2)
    );
}

#[test]
fn objects_are_placed_by_both_transformations() {
    let text = "WorldBegin\nLightSource \"point\"\nObjectBegin \"o\" Translate 1 0 0 Shape \"sphere\" ObjectEnd\n\
        Translate 0 5 0 ObjectInstance \"o\" Translate 0 5 0 ObjectInstance \"o\"";
    let scene = scene(text);
    assert_eq!(scene.counts().instances, 2);
    for y in [5.0, 10.0] {
        assert!(outer_normal(&scene, Vec3::new(1.0, y, 9.0), Vec3::new(1.0, y, 0.0)).is_some());
    }
    assert!(outer_normal(&scene, Vec3::new(1.0, 0.0, 9.0), Vec3::new(1.0, 0.0, 0.0)).is_none());
}

#[test]
fn what_turns_turns_about_the_origin_of_its_own_space() {
    let turn = "Translate 5 0 0 ActiveTransform EndTime Rotate 90 0 0 1 ActiveTransform All";
    // Its origin goes straight from one place to the other, as in pbrt.
    let cases = [("", [[5.0, 0.0], [5.0, 0.0], [5.0, 0.0]]), ("Translate 2 0 0", [[7.0, 0.0], [6.0, 1.0], [5.0, 2.0]])];
    for (more, way) in cases {
        let scene = scene(&format!("WorldBegin\n{LIGHT}{turn} {more} Shape \"sphere\""));
        for (time, [x, y]) in [0.0, 0.5, 1.0].into_iter().zip(way) {
            let ray = Ray { o: Vec3::new(x, y, 9.0), d: -Vec3::Z, tmin: 0.0, tmax: f32::INFINITY };
            let n = scene.world(Wavelengths::Rgb, time).intersect(&ray).map(|hit| hit.ng);
            assert!(n.is_some_and(|n| n.z > 0.9999), "{more} at {time}: {n:?}");
        }
    }
}

#[test]
fn light_has_pbrts_units() {
    let light = |text: &str| match &scene(text).lights()[0] {
        Light::Point(light) => light.intensity.rgb(),
        Light::Area(light) => light.radiance.rgb(),
        other => panic!("{other:?}"),
    };
    let is_near = |a: Vec3, b: Vec3| assert!((a - b).abs().max_element() < 1e-4, "{a} {b}");
    // The exposure of the film multiplies all light.
    let film = "Film \"rgb\" \"float iso\" 150\nCamera \"perspective\" \"float shutterclose\" 0.5\nWorldBegin\n";
    is_near(light(&format!("{film}LightSource \"point\" \"rgb I\" [4 8 12]")), Vec3::new(3.0, 6.0, 9.0));
    // 4π lumens from a source of 1 candela.
    is_near(light("WorldBegin\nLightSource \"point\" \"float power\" 12.566371"), Vec3::ONE);
    // A lamp of 2 m² and radiance 1 gives 2π lumens.
    let text = "WorldBegin\nAreaLightSource \"diffuse\" \"float power\" 6.2831855\nShape \"trianglemesh\" \
        \"point3 P\" [0 0 0 1 0 0 1 2 0 0 2 0] \"integer indices\" [0 1 2 0 2 3]";
    is_near(light(text), Vec3::ONE);
    // What is no RGB has luminance 1 in version 4; version 3 divides by the largest value.
    let luminance = |rgb: Vec3| rgb.dot(Vec3::new(0.2126, 0.7152, 0.0722));
    let body = light("WorldBegin\nLightSource \"point\" \"blackbody I\" 3000 \"float scale\" 2");
    assert!((luminance(body) - 2.0).abs() < 0.01, "{body}");
    let body = light("Film \"image\"\nWorldBegin\nLightSource \"point\" \"blackbody I\" [5500 10]");
    assert!((9.0..10.0).contains(&luminance(body)), "{body}");
}

#[test]
fn the_quirks_of_the_wild_are_read() {
    let main = "Integrator \"path\" \"integer maxdepth\" 7\nInclude \"open.pbrt\"\n\
        \"float fov\" [ 40 ] \"float fov\" [ 50 ]\nCamera \"perspective\" \" float fov\" 60\nWorldBegin\n\
        LightSource \"infinite\" \"color L\" [1 1 1]\nMaterial \"\"\nShape \"sphere\"\n\
        Material \"dielectric\" \"bool remaproughness\" \"false\" \"float eta\" 1.25\nShape \"sphere\"\n\
        Material \"glass\" \"bool remaproughness\" [ false ] \"float index\" [1.25]\nShape \"sphere\" \"float alpha\" 0\n";
    let (told, file) = load_files(&[("main.pbrt", main), ("open.pbrt", "Camera \"perspective\"")]);
    let file = file.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(told, "");
    assert_eq!((file.surfaces, file.lights), (1, 1));
    assert_eq!(file.hints.scatterings, Some(7));
    let short = 720.0 / 1280.0;
    assert!(short < 1.0 && (file.camera.fov - 60.0).abs() < 1e-3, "{}", file.camera.fov);
}

#[test]
fn mistakes_are_told_with_their_places() {
    let cases = [
        "WorldBegin\nShap \"sphere\"\n",
        "WorldBegin\nShape \"spher\"\n",
        "WorldBegin\nShape \"sphere\" \"float raduis\" 2\n",
        "WorldBegin\nShape \"sphere\" \"flaot radius\" 2\n",
        "WorldBegin\nShape \"sphere\" \"float radius\" [ 2\n",
        "WorldBegin\nShape \"sphere\" \"float radius\" \"two\"\n",
        "WorldBegin\nShape \"sphere\" \"float radius\" 1e99\n",
        "WorldBegin\nMaterial \"dielectic\"\nNamedMaterial \"a\"\n",
        "WorldBegin\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\n",
        "WorldBegin\nShape \"sphere\nAttributeEnd\n",
        "WorldBegin\nAttributeBegin\nTransformEnd\n",
        "Translate 1 2\nWorldBegin\nObjectInstance \"tree\"\n",
        "WorldBegin\nShape \"plymesh\" \"string filename\" \"gone.ply\"\nLightSource \"point\"\n",
        "Include \"gone.pbrt\"\n",
        "Transform [1 0 0 0 0 1 0 0 0 0 1 1 0 0 0 1]\n",
        "WorldBegin\nMaterial \"conductor\" \"spectrum eta\" \"metal-Ag\"\n",
        "17\n",
    ];
    assert_snapshot!(cases.map(|c| format!("{c}---\n{}", told(c))).join("\n\n"));
}

#[test]
fn included_mistakes_name_the_included_file_and_outside_is_closed() {
    let (text, _) = load_files(&[("main.pbrt", "WorldBegin\nInclude \"b.pbrt\"\n"), ("b.pbrt", "\n Shape \"sper\"\n")]);
    assert!(text.contains("FOLDER/b.pbrt:2:2"), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    std::fs::write(folder.path().join("secret"), "WorldBegin\n").unwrap();
    let main = inner.join("main.pbrt");
    std::fs::write(&main, "Include \"../secret\"\n").unwrap();
    let error = load(std::slice::from_ref(&main), &LoadOptions::default()).unwrap_err();
    assert_eq!(error.errors[0].code, "file::outside");
    assert!(load(std::slice::from_ref(&main), &LoadOptions { allow_outside: true, ..LoadOptions::default() }).is_ok());
    // A link that was stored as text, as Git does where it cannot make one.
    std::fs::write(inner.join("link"), "../secret").unwrap();
    std::fs::write(&main, "Include \"link\"\n").unwrap();
    let error = load(std::slice::from_ref(&main), &LoadOptions::default()).unwrap_err();
    assert_eq!(error.errors[0].code, "file::outside");
    assert!(load(&[main], &LoadOptions { allow_outside: true, ..LoadOptions::default() }).is_ok());
}

#[test]
fn each_version_has_its_filters_and_its_own_default() {
    use sunfleck::film::{Curve, Filter};
    let filter = |film: &str, said: &str| {
        let text = format!("Film \"{film}\" {said} WorldBegin\n");
        load_files(&[("main.pbrt", &text)]).1.unwrap().defaults.filter
    };
    let shaped = |curve, x, y| Filter::shaped(curve, glam::Vec2::new(x, y)).unwrap();
    let cubic = |b, c| Curve::Cubic { b, c };
    assert_eq!(filter("image", ""), Filter::Box);
    assert_eq!(filter("rgb", ""), shaped(Curve::Gaussian { sigma: 0.5 }, 1.5, 1.5));
    assert_eq!(filter("image", "PixelFilter \"gaussian\""), shaped(Curve::Gaussian { sigma: 0.5 }, 2.0, 2.0));
    assert_eq!(filter("rgb", "PixelFilter \"triangle\" \"float xradius\" 1"), shaped(Curve::Tent, 1.0, 2.0));
    assert_eq!(filter("rgb", "PixelFilter \"box\""), Filter::Box);
    assert_eq!(filter("rgb", "PixelFilter \"mitchell\" \"float B\" 0.5"), shaped(cubic(0.5, 1.0 / 3.0), 2.0, 2.0));
    assert_eq!(filter("rgb", "PixelFilter \"sinc\""), shaped(Curve::Lanczos { tau: 3.0 }, 4.0, 4.0));
    let (told, _) = load_files(&[("main.pbrt", "PixelFilter \"box\" \"float xradius\" -1 WorldBegin\n")]);
    assert!(told.contains("FOLDER/main.pbrt:1:1") && told.contains("radii"), "{told}");
}

/// One of everything.
const ALL: &str = "Film \"rgb\" \"integer xresolution\" 64 \"float iso\" 200 \"float cropwindow\" [0 1 0 .5]\n\
    Sampler \"halton\" \"integer pixelsamples\" 4 PixelFilter \"gaussian\" Integrator \"sppm\" \"integer maxdepth\" 5\n\
    LookAt 0 0 -5 0 0 0 0 1 0 Camera \"perspective\" \"float lensradius\" 0.1 \"float focaldistance\" 3\n\
    WorldBegin Attribute \"shape\" \"float radius\" 2 CoordinateSystem \"c\" ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 1 2 3 1]\n\
    Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 0 0] Texture \"s\" \"float\" \"scale\" \"float tex\" 2\n\
    MakeNamedMaterial \"m\" \"string type\" \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"float roughness\" 0.1\n\
    AttributeBegin NamedMaterial \"m\" Shape \"cylinder\" Shape \"cone\" Shape \"paraboloid\" Shape \"hyperboloid\" AttributeEnd\n\
    Material \"dielectric\" \"spectrum eta\" \"glass-BK7\" Shape \"sphere\" \"float phimax\" 90 Shape \"disk\"\n\
    NamedMaterial \"later\" Shape \"sphere\" \"texture alpha\" \"s\" MakeNamedMaterial \"later\" \"string type\" \"thindielectric\"\n\
    MakeNamedMaterial \"p\" \"string type\" \"diffuse\" \"texture displacement\" \"s\" #sunfleck \"string type\" \"sunfleck-phong\"\n\
    NamedMaterial \"p\"\n\
    Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] \"point2 uv\" [0 0 1 0 1 1 0 1] \"integer indices\" [0 1 2 2 3 0]\n\
    Material \"mix\" \"string materials\" [\"m\" \"later\"] \"texture amount\" \"s\" Shape \"disk\" Material \"uber\" \"texture Kd\" \"t\"\n\
    Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1] Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 1]\n\
    Shape \"loopsubdiv\" \"integer levels\" 2 \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1] \"integer indices\" [0 2 1 0 1 3 1 2 3 2 0 3]\n\
    ObjectBegin \"o\" Shape \"sphere\" ObjectEnd Rotate 30 0 1 0 ActiveTransform EndTime Translate 1 0 0 ActiveTransform All\n\
    ObjectInstance \"o\" ReverseOrientation AreaLightSource \"diffuse\" \"blackbody L\" 4000 \"float power\" 10 Shape \"sphere\"\n\
    LightSource \"infinite\" \"float illuminance\" 3 LightSource \"spot\" \"spectrum I\" [400 1 700 2] LightSource \"projection\" \"string filename\" \"a.png\"\n\
    LightSource \"distant\" LightSource \"point\" LightSource \"goniometric\" \"string filename\" \"a.png\" MakeNamedMedium \"f\" MediumInterface \"\" \"f\" CoordSysTransform \"c\"\n";

#[test]
fn one_of_everything_is_read() {
    let (builder, warnings) = super::check("all.pbrt", ALL.into()).unwrap_or_else(|e| panic!("{e}"));
    let told: Vec<String> = warnings.into_iter().map(|w| format!("{}: {}", w.code, w.message)).collect();
    assert_snapshot!(told.join("\n"));
    let counts = builder.build().unwrap().counts();
    assert_eq!((counts.lights, counts.instances), (7, 2));
}

#[test]
fn little_text_does_not_become_much_geometry() {
    let text = format!("WorldBegin\n{}", "Shape \"sphere\" \"float zmax\" 0\n".repeat(20));
    let (builder, _) = super::check("a.pbrt", text.into()).unwrap_or_else(|e| panic!("{e}"));
    // Of 65,536 triangles each, the first eight take half a million; then there are fewer.
    assert!(builder.build().unwrap().counts().triangles < 700_000);
}

proptest! {
    // Each case cuts a dozen shapes into triangles; the fuzz target does many more.
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn no_damage_makes_the_reader_panic(
        damage in proptest::collection::vec((any::<prop::sample::Index>(), 0..5, any::<prop::sample::Index>()), 1..6),
    ) {
        let mut bytes = ALL.as_bytes().to_vec();
        for (at, kind, other) in damage {
            let (i, j) = (at.index(bytes.len()), other.index(bytes.len()));
            match kind {
                0 => bytes[i] = b"\"[]#\n 09.-eE\xFF"[j % 13],
                1 => drop(bytes.drain(i..(i + j % 40).min(bytes.len()))),
                2 => {
                    let piece = bytes[i..(i + j % 40).min(bytes.len())].to_vec();
                    bytes.splice(j..j, piece);
                }
                3 => bytes.truncate(i.max(200)),
                _ => drop(bytes.splice(i..i, *b" 1e30 ")),
            }
        }
        match super::check("a.pbrt", bytes) {
            Ok((_, warnings)) => prop_assert!(warnings.iter().all(|w| !w.render(false).is_empty())),
            Err(error) => prop_assert!(error.errors.iter().all(|e| e.place.is_some())),
        }
    }
}

#[test]
fn a_file_that_includes_itself_is_an_error() {
    assert!(told("Include \"a.pbrt\"\n").contains("include one another"));
}
