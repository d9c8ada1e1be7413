//! Whole files to scenes.

use super::{CameraSettings, LoadOptions, Loaded, load};
use crate::diagnostic::{Diagnostic, Error};
use crate::image::Tone;
use crate::scn::{Comma, ScnOptions};
use glam::Vec3;
use proptest::prelude::*;
use std::path::PathBuf;
use sunfleck::bsdf::Material;
use sunfleck::film::Filter;
use sunfleck::light::{Light, Sides};
use sunfleck::scene::Scene;
use tempfile::TempDir;

/// Loads files of these names and contents together; messages call their folder FOLDER.
fn load_files(files: &[(&str, &str)], options: &LoadOptions) -> (TempDir, Result<Loaded, Error>) {
    let folder = tempfile::tempdir().unwrap();
    let write = |(name, text): &(&str, &str)| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let paths: Vec<PathBuf> = files.iter().map(write).collect();
    let scenes: Vec<PathBuf> = paths.into_iter().filter(|p| p.extension().is_none_or(|e| e != "mtl")).collect();
    let loaded = load(&scenes, options);
    (folder, loaded)
}

fn load_scn(text: &str, options: ScnOptions) -> Loaded {
    load_files(&[("a.scn", text)], &LoadOptions { scn: options, ..LoadOptions::default() }).1.unwrap()
}

fn scene(loaded: Loaded) -> Scene {
    loaded.builder.build().unwrap()
}

/// All errors and warnings as text.
fn told(files: &[(&str, &str)]) -> String {
    let (folder, result) = load_files(files, &LoadOptions::default());
    let (errors, warnings) = match result {
        Ok(loaded) => (Vec::new(), loaded.warnings),
        Err(error) => (error.errors, error.warnings),
    };
    let texts: Vec<String> = errors.iter().chain(&warnings).map(Diagnostic::to_string).collect();
    texts.join("\n\n").replace(&folder.path().display().to_string(), "FOLDER")
}

/// The only material of a file with these properties.
fn material(type_id: u32, props: &str, compat: bool) -> (Scene, Vec<Diagnostic>) {
    let text = format!("Begin Material\nMaterial M {type_id}\n{props}\nEnd\n");
    let loaded = load_scn(&text, ScnOptions { compat, ..ScnOptions::default() });
    let warnings = loaded.warnings.iter().filter(|w| w.code.starts_with("scn")).cloned().collect();
    (scene(loaded), warnings)
}

#[test]
fn properties_decide_the_model_and_the_number_only_where_they_leave_it_open() {
    let cases = [
        (0, "Prop diffuseColor RGB 1 0 0", "diffuse"),
        (0, "", "diffuse"),
        (1, "Prop ratio Float 1.5", "dielectric"),
        (2, "Prop ior Float 1.5\nProp absorbed RGB 1 1 1", "dielectric"),
        (2, "Prop ior Float 1.5\nProp diffuseColor RGB 0 0 0\nProp specularColor RGB 1 1 1", "dielectric"),
        (2, "Prop absorbed RGB 1 1 1", "dielectric"),
        (2, "Prop reflect RGB 1 1 1", "mirror"),
        (3, "Prop reflect RGB 1 1 1", "mirror"),
        (3, "Prop ratio Float 1.5", "dielectric"),
        (1, "Prop eta_r Vec3 0.1 0.3 1.4\nProp eta_i Vec3 4 2 1\nProp albedo RGB 1 0.8 0", "conductor"),
        (3, "Prop albedo RGB 1 1 1\nProp roughness Float 0.3\nProp F0 Float 0.04", "cooktorrance"),
        (3, "Prop albedo RGB 1 1 1", "cooktorrance"),
        (0, "Prop albedo RGB 1 1 1", "diffuse"),
        (
            5,
            "Prop baseColor RGB 1 1 1\nProp metallic Float 1\nProp roughness Float 0.1\nProp F0 RGB 1 1 1",
            "cooktorrance",
        ),
        (
            2,
            "Prop F0 RGB 1 1 1\nProp roughness Float 0.1\nProp ior Float 1.5\nProp transparency Float 1",
            "roughdielectric",
        ),
        (2, "Prop F0 RGB 1 1 1\nProp roughness Float 0.1\nProp ior Float 1.5", "cooktorrance"),
        (1, "Prop diffuseColor RGB 1 1 1\nProp specularColor RGB 1 1 1\nProp specularEx Float 10", "phong"),
        (4, "Prop diffuseColor RGB 1 1 1\nProp specularColor RGB 1 1 1\nProp refractIndex Float 1.5", "cooktorrance"),
    ];
    for (id, props, model) in cases {
        let (scene, _) = material(id, props, false);
        assert_eq!(scene.materials()[0].name(), model, "{id} {props}");
    }
    let phong = material(1, "Prop diffuseColor RGB 1 1 1\nProp specularEx Float 10", true).0;
    assert_eq!(phong.materials()[0].name(), "nrenderer-phong");
}

#[test]
fn tints_and_indices_arrive_in_the_material() {
    let text = "Begin Material\nMaterial G 2\nProp ior Float 1.33\nProp absorbed RGB 0.9 0.8 0.7\nEnd\n";
    let loaded = load_scn(text, ScnOptions::default());
    let debug = format!("{:?}", loaded.builder);
    assert!(debug.contains("0.9, 0.8, 0.7"), "{debug}");
    let scene = scene(loaded);
    let Material::Dielectric(glass) = &scene.materials()[0] else { panic!("not glass") };
    assert_eq!(glass.eta, 1.33.into());
}

const ROOM: &str = "Begin Material\nMaterial W\nProp diffuseColor RGB 0.63 0.065, 0.05\nEnd\n\
    Begin Model\nModel A\nTranslation 0 0 1000\nSphere s W\nP 1 2 3\nR 5\nPlane p W\nN 0 0 1\nP 0 0 0\nU 0 1 0\nV 1 0 0\n\
    Triangle t W\nN 0 0 1\nV1 0 0 0\nV2 1 0 0\nV3 0 1 0\nEnd\n\
    Begin Light\nArea a\nIRV 1 2 3\nP 0 9 0\nU 1 0 0\nV 0 0 1\nPoint b\nSpot c\nD 0 0 1\nDirectional d\nD 0 1 0\nEnd\n";

#[test]
fn shapes_are_moved_and_lights_are_not() {
    let loaded = load_scn(ROOM, ScnOptions::default());
    assert_eq!((loaded.surfaces, loaded.lights), (4, 4));
    let scene = scene(loaded);
    let counts = scene.counts();
    assert_eq!((counts.surfaces, counts.spheres, counts.lights), (4, 1, 4));
    let (centre, radius) = scene.bounding_sphere();
    // z from 0 (the light) to 1008 (the far end of the sphere).
    assert!((centre.z - 504.0).abs() < 1.0 && radius < 520.0, "{centre} {radius}");
    let area = scene.lights().iter().find_map(|l| if let Light::Area(a) = l { Some(a) } else { None }).unwrap();
    assert_eq!((area.radiance.rgb(), area.sides), (Vec3::new(1.0, 2.0, 3.0), Sides::One));
}

#[test]
fn compatibility_follows_nrenderer_and_each_point_can_be_chosen_alone() {
    let colour = |options| format!("{:?}", load_scn(ROOM, options).builder);
    let compat = ScnOptions { compat: true, ..ScnOptions::default() };
    assert!(colour(ScnOptions::default()).contains("0.63, 0.065, 0.05"));
    assert!(colour(compat).contains("0.63, 0.065, 0.0)") && colour(compat).contains("Two"));
    let chosen = ScnOptions { comma: Some(Comma::Separates), area_light_sides: Some(Sides::One), ..compat };
    assert!(colour(chosen).contains("0.63, 0.065, 0.05") && !colour(chosen).contains("Two"));
    let (plain, compat) = (load_scn(ROOM, ScnOptions::default()).defaults, load_scn(ROOM, compat).defaults);
    assert_eq!((plain.filter, plain.tone), (Filter::Box, Tone::Srgb));
    assert_eq!((compat.filter, compat.tone), (Filter::NRenderer, Tone::SquareRoot));
    assert_eq!((plain.width, plain.height), (500, 500));
}

#[test]
fn the_default_camera_is_that_of_nrenderer() {
    let camera = CameraSettings::default();
    assert_eq!((camera.view.position, camera.view.look_at, camera.fov), (Vec3::new(0.0, 0.0, -3.0), Vec3::ZERO, 40.0));
    assert!(camera.build(1.5).is_ok());
    assert!(CameraSettings { fov: 180.0, ..camera }.build(1.0).is_err());
}

#[test]
fn several_files_become_one_scene_and_names_stay_apart() {
    let scn = "Begin Material\nMaterial W\nEnd\nBegin Model\nModel A\nSphere s W\nR 1\nEnd\n";
    let obj = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl W\nf 1 2 3\no b\nf 3 2 1\n";
    let mtl = "newmtl W\nKd 0.2 0.3 0.4\nKe 5 5 5\n";
    let files = [("a.scn", scn), ("b.scn", scn), ("c.mtl", mtl), ("c.obj", obj)];
    let loaded = load_files(&files, &LoadOptions::default()).1.unwrap();
    assert_eq!((loaded.surfaces, loaded.lights), (4, 2));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    assert_eq!(scene(loaded).materials().len(), 3);
}

#[test]
fn the_hash_depends_on_every_input_and_nothing_else() {
    let obj = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let hash =
        |mtl: &str, options: &LoadOptions| load_files(&[("c.mtl", mtl), ("c.obj", obj)], options).1.unwrap().hash;
    let plain = LoadOptions::default();
    let first = hash("newmtl A\n", &plain);
    assert_eq!(first.len(), 32);
    assert_eq!(first, hash("newmtl A\n", &plain));
    assert_ne!(first, hash("newmtl B\n", &plain));
    let compat = LoadOptions { scn: ScnOptions { compat: true, ..ScnOptions::default() }, ..LoadOptions::default() };
    assert_ne!(first, hash("newmtl A\n", &compat));
}

#[test]
fn what_is_odd_in_a_scene_is_told_with_its_place() {
    let shapes = "Begin Material\nMaterial W\nEnd\nBegin Model\nModel A\nScale 2 2 2\nSphere s W\nR -1\nPlane p W\nU 1 0 0\n\
                  V 2 0 0\nPlane q W\nN 1 1 0\nU 1 0 0\nV 0 1 0\nTriangle t W\nEnd\nBegin Light\nPoint l\nIRV -1 1 1\nArea a\nEnd\n";
    insta::assert_snapshot!("odd_shapes", told(&[("a.scn", shapes)]));
    let materials = "Begin Material\nMaterial A\nProp diffuseColour RGB 1 1 1\nMaterial B\nProp diffuseColor RGB 1.5 1 1\n\
                     Material C 2\nProp absorbed RGB 1 1 1\nMaterial D 1\nProp ambientColor RGB 1 1 1\nMaterial E\n\
                     Prop roughness Float 2\nEnd\n";
    insta::assert_snapshot!("odd_materials", told(&[("a.scn", materials)]));
    let wrong = "Begin Material\nMaterial A\nProp ior RGB 1 1 1\nMaterial B\nProp ior Float 0\nEnd\n\
                 Begin Light\nSpot s\nSpot t\nD 0 0 1\nHotSpot 2\nFallout 1\nDirectional d\nEnd\n";
    insta::assert_snapshot!("wrong_values", told(&[("a.scn", wrong)]));
    insta::assert_snapshot!("nothing_to_see", told(&[("a.scn", "# empty\n")]));
}

#[test]
fn files_that_cannot_be_loaded_say_what_could() {
    insta::assert_snapshot!("no_faces", told(&[("a.obj", "v 0 0 0\n")]));
    insta::assert_snapshot!("other_formats", told(&[("a.ply", ""), ("b.scn.bak", ""), ("c", ""), ("d.obi", "")]));
    insta::assert_snapshot!("no_file", load(&[], &LoadOptions::default()).unwrap_err().to_string());
    let (folder, _) = load_files(&[("cornell.scn", "")], &LoadOptions::default());
    let error = load(&[folder.path().join("cornel.scn")], &LoadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("cornell.scn"));
}

#[test]
fn the_errors_of_all_files_are_told_at_once() {
    let text = told(&[("a.scn", "begin"), ("b.ply", ""), ("c.obj", "f 1 2 3\n")]);
    for name in ["a.scn:1:1", "b.ply", "c.obj:1:3"] {
        assert!(text.contains(name), "{name} is missing in\n{text}");
    }
}

#[test]
fn mtl_materials_become_models() {
    let cases = [
        ("Kd 0.5 0.5 0.5", "diffuse"),
        ("", "diffuse"),
        ("Kd 0.5\nKs 0.5\nNs 20\nillum 2", "phong"),
        ("Kd 0.5\nKs 0.5\nNs 20\nillum 1", "diffuse"),
        ("Kd 0\nKs 0.9\nillum 3", "mirror"),
        ("d 0.1\nNi 1.5", "dielectric"),
        ("illum 7\nNi 1.5", "dielectric"),
        ("illum 2\nNi 1.5", "diffuse"),
        ("Tr 0.5\nillum 4", "dielectric"),
        ("d 0.5\nNi 1", "diffuse"),
        ("Kd 0.5\nPr 0.3\nPm 1", "principled"),
        ("Kd 0.5\nPc 1", "principled"),
    ];
    for (statements, model) in cases {
        let mtl = format!("newmtl A\n{statements}\n");
        let obj = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl A\nf 1 2 3\n";
        let loaded = load_files(&[("c.mtl", &mtl), ("c.obj", obj)], &LoadOptions::default()).1.unwrap();
        assert_eq!(scene(loaded).materials()[0].name(), model, "{statements}");
    }
}

#[test]
fn a_missing_texture_is_a_warning_and_flat_triangles_are_dropped() {
    let mtl = "newmtl A\nKd 0.5\nmap_Kd wood.png\nnewmtl B\nd 0.5\n";
    let obj = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl A\nf 1 2 3\nf 1 2 2\nusemtl B\nf 1 1 2\n";
    insta::assert_snapshot!("odd_mesh", told(&[("c.mtl", mtl), ("c.obj", obj)]));
}

#[test]
fn a_texture_is_read_once_and_multiplied_by_its_colour() {
    let folder = tempfile::tempdir().unwrap();
    let picture = crate::image::RgbImage32::filled(2, 2, [1.0, 0.0, 1.0]);
    crate::image::write_image(&folder.path().join("a b.png"), &picture.into(), Tone::Srgb).unwrap();
    let mtl = "newmtl A\nKd 0.5 0.25 1\nmap_Kd a b.png\nnewmtl B\nKd 0.5 0.25 1\nmap_Kd a b.png\n";
    std::fs::write(folder.path().join("c.mtl"), mtl).unwrap();
    let obj = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl A\nf 1/1 2/1 3/1\nusemtl B\nf 1/1 2/1 3/1\n";
    std::fs::write(folder.path().join("c.obj"), obj).unwrap();
    let loaded = load(&[folder.path().join("c.obj")], &LoadOptions::default()).unwrap();
    assert!(!loaded.warnings.iter().any(|w| w.code == "mtl::texture"));
    let debug = format!("{:?}", loaded.builder);
    assert_eq!(debug.matches("ImageTexture").count(), 1);
    assert!(debug.contains("Vec3(0.5, 0.0, 1.0)"), "{debug}");
}

#[test]
fn mtl_pictures_of_normals_holes_and_roughness_are_data() {
    let folder = tempfile::tempdir().unwrap();
    // 188 of 255 is 0.5 through the sRGB curve, but 0.737 as it is stored.
    for (name, colour) in [("n.png", [0.216, 0.216, 1.0]), ("d.png", [0.5; 3]), ("h.png", [0.5; 3])] {
        let picture = crate::image::RgbImage32::filled(2, 2, colour);
        crate::image::write_image(&folder.path().join(name), &picture.into(), Tone::Srgb).unwrap();
    }
    let obj = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl A\nf 1/1 2/1 3/1\n";
    std::fs::write(folder.path().join("c.obj"), obj).unwrap();
    let read = |statements: &str| {
        std::fs::write(folder.path().join("c.mtl"), format!("newmtl A\nKd 0.5\n{statements}\n")).unwrap();
        let loaded = load(&[folder.path().join("c.obj")], &LoadOptions::default()).unwrap();
        let codes: Vec<&str> = loaded.warnings.iter().map(|w| w.code).filter(|c| c.starts_with("mtl")).collect();
        (format!("{:?}", loaded.builder), codes)
    };
    let (all, codes) = read("map_Pr d.png\nPm 1\nmap_Bump -bm 0.5 n.png\nmap_d d.png");
    assert!(codes.is_empty(), "{codes:?}");
    assert!(all.contains("roughness: Roughness { u: Texture(") && all.contains("metallic: Constant(1.0)"), "{all}");
    assert!(all.contains("NormalMapMaterial") && all.contains("MaskMaterial"), "{all}");
    assert!(all.contains("Vec3(0.73725"), "{all}");
    assert!(read("Tr 1").1 == ["mtl::opacity"], "a thing that cannot be seen is a mistake");
    let (half, codes) = read("d 0.5");
    assert!(codes.is_empty() && half.contains("MaskMaterial") && half.contains("Constant(0.5)"), "{half}");
    let (_, codes) = read("bump h.png");
    assert_eq!(codes, ["mtl::heights"]);
}

#[test]
fn the_extension_of_mtl_is_the_principled_model() {
    use sunfleck::bsdf::{Covering, Material, Scalar};
    let mtl = "newmtl A\nKd 0.5\nNi 1.4\nPr 0.36\nPm 0.25\nPc 0.5\nPcr 0.1\nPs 0.2\naniso 0.5\nanisor 0.25\n";
    let obj = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl A\nf 1 2 3\n";
    let scene = scene(load_files(&[("c.mtl", mtl), ("c.obj", obj)], &LoadOptions::default()).1.unwrap());
    let [Material::Principled(m), Material::Covering(Covering::Turned(turned))] = &scene.materials()[..2] else {
        panic!("{:?}", scene.materials())
    };
    let constants = [m.metallic, m.ior, m.coat, m.coat_roughness];
    assert_eq!(constants, [0.25, 1.4, 0.5, 0.1].map(Scalar::Constant));
    let (Scalar::Constant(u), Scalar::Constant(v)) = (m.roughness.u, m.roughness.v) else { panic!("pictures") };
    // Slopes are squares; Burley's aspect is the root of 1 − 0.9 · 0.5.
    assert!((u * v - 0.36 * 0.36).abs() < 1e-5 && ((v * v) / (u * u) - 0.55).abs() < 1e-5, "{u} {v}");
    assert!(m.sheen.is_some() && (turned.angle - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
}

#[test]
fn faces_shine_by_the_picture_that_mtl_names() {
    let folder = tempfile::tempdir().unwrap();
    let mut picture = crate::image::RgbImage32::filled(1, 2, [0.0; 3]);
    picture.data[0] = [1.0, 0.0, 0.0];
    crate::image::write_image(&folder.path().join("e.png"), &picture.into(), Tone::Srgb).unwrap();
    std::fs::write(folder.path().join("c.mtl"), "newmtl A\nKe 4 4 4\nmap_Ke e.png\n").unwrap();
    let obj = "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
               usemtl A\nf 1/1 2/2 3/3 4/4\n";
    std::fs::write(folder.path().join("c.obj"), obj).unwrap();
    let loaded = load(&[folder.path().join("c.obj")], &LoadOptions::default()).unwrap();
    let mut sums = (0.0, 0.0);
    for s in loaded.builder.parts().surfaces {
        let red = s.emission.as_ref().map_or(0.0, |(radiance, _)| radiance.rgb().x) * s.shape.area();
        let sunfleck::shape::Shape::Mesh(mesh) = &s.shape else { panic!("no mesh") };
        sums.0 += red;
        sums.1 += red * mesh.positions().iter().map(|p| p.y).sum::<f32>() / mesh.positions().len() as f32;
    }
    // Repeated, the picture is 1 − y within a quarter of its edges: on the mean half of 4, and bright where v is large.
    assert!((sums.0 - 2.0).abs() < 0.1 && sums.1 / sums.0 > 0.55, "{sums:?}");
}

/// Numbers that break arithmetic.
fn number() -> impl Strategy<Value = String> {
    prop::sample::select(vec!["0", "-0", "1", "-1", "0.5", "3e38", "-3e38", "1e20", "1e-20", "1e-45", "1e-38", "7"])
        .prop_map(str::to_owned)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn no_numbers_make_loading_or_building_panic(n in prop::collection::vec(number(), 48)) {
        let v = |i: usize| format!("{} {} {}", n[i], n[i + 1], n[i + 2]);
        let text = format!(
            "Begin Material\nMaterial W\nProp ior Float 1.5\nProp absorbed RGB {}\nEnd\nBegin Model\nModel A\n\
             Translation {}\nSphere s W\nP {}\nR {}\nPlane p W\nN {}\nP {}\nU {}\nV {}\nTriangle t W\nN {}\nV1 {}\n\
             V2 {}\nV3 {}\nEnd\nBegin Light\nArea a\nIRV {}\nP {}\nU {}\nV {}\nPoint b\nIRV {}\nEnd\n",
            v(0), v(3), v(6), n[9], v(10), v(13), v(16), v(19), v(20), v(22), v(25), v(28), v(31), v(34), v(37), v(40),
            v(43)
        );
        if let Ok(loaded) = load_files(&[("a.scn", &text)], &LoadOptions::default()).1 {
            let _ = loaded.builder.build();
        }
        let obj = format!("v {}\nv {}\nv {}\nv {}\nvn {}\nvt {}\nf 1/1/1 2//1 3 4\n", v(0), v(3), v(6), v(9), v(12), v(15));
        if let Ok(loaded) = load_files(&[("a.obj", &obj)], &LoadOptions::default()).1 {
            let _ = loaded.builder.build();
        }
    }
}
