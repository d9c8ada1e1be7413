//! Whole scenes, written to a folder of their own.

mod lights;
mod looks;
mod media;

use super::serialized::tests::file as serialized_file;
use crate::image::{RgbImage32, Tone, write_image};
use crate::load::{LoadOptions, Loaded, load};
use crate::{Diagnostic, Error};
use glam::{Vec2, Vec3};
use insta::assert_snapshot;
use proptest::prelude::*;
use sunfleck::bsdf::{Covering, Lookup, Material, TextureId};
use sunfleck::camera::Project;
use sunfleck::light::{Emitter, Light, Surroundings};
use sunfleck::math::Ray;
use sunfleck::scene::Scene;
use sunfleck::spectrum::Wavelengths;

const AROUND: Surroundings = Surroundings { centre: Vec3::ZERO, radius: 1.0, lambda: Wavelengths::Rgb };

/// Loads `main.xml` among these files. Messages call their folder FOLDER.
fn load_files(files: &[(&str, &[u8])], defines: &[(&str, &str)]) -> (String, Result<Loaded, Error>) {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene");
    for (name, bytes) in files {
        let path = scene.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    let defines = defines.iter().map(|(n, v)| ((*n).to_owned(), (*v).to_owned())).collect();
    let options = LoadOptions { defines, ..LoadOptions::default() };
    let loaded = load(&[scene.join("main.xml")], &options);
    let (errors, warnings) = match &loaded {
        Ok(loaded) => (&[][..], &loaded.warnings),
        Err(error) => (&error.errors[..], &error.warnings),
    };
    let texts: Vec<String> = errors.iter().chain(warnings).map(Diagnostic::to_string).collect();
    (texts.join("\n\n").replace(&folder.path().display().to_string(), "FOLDER"), loaded)
}

/// The scene with this in it.
fn wrapped(inner: &str) -> String {
    format!("<scene version=\"3.0.0\">\n{inner}\n</scene>")
}

fn loaded(inner: &str) -> Loaded {
    load_files(&[("main.xml", wrapped(inner).as_bytes())], &[]).1.unwrap_or_else(|e| panic!("{e}"))
}

fn scene(inner: &str) -> Scene {
    loaded(inner).builder.build().unwrap()
}

fn told(inner: &str) -> String {
    load_files(&[("main.xml", wrapped(inner).as_bytes())], &[]).0
}

/// The normal of the outer side where a ray from `from` to `to` arrives.
fn outer_normal(scene: &Scene, from: Vec3, to: Vec3) -> Option<Vec3> {
    let world = scene.world(Wavelengths::Rgb, 0.0);
    let ray = Ray { o: from, d: (to - from).normalize(), tmin: 0.0, tmax: f32::INFINITY };
    world.intersect(&ray).map(|hit| hit.ng)
}

fn sensor(inner: &str) -> String {
    format!(
        "<sensor type='perspective'>{inner}<film type='hdrfilm'><integer name='width' value='200'/>
        <integer name='height' value='100'/></film></sensor>"
    )
}

#[test]
fn x_is_at_the_left_of_the_picture() {
    let look = "<lookat origin='0,0,0' target='0,0,1' up='0,1,0'/>";
    for (steps, sign) in [(look.to_owned(), -1.0), (format!("<scale x='-1'/>{look}"), 1.0)] {
        let file =
            loaded(&sensor(&format!("<float name='fov' value='90'/><transform name='to_world'>{steps}</transform>")));
        let camera = file.camera.build(file.camera.aspect.unwrap()).unwrap();
        let right = camera.ray(Vec2::new(1.0, 0.5), Vec2::ZERO).ray.d;
        assert!((right - Vec3::new(sign, 0.0, 1.0).normalize()).length() < 1e-5, "{right}");
        let top = camera.ray(Vec2::new(0.5, 0.0), Vec2::ZERO).ray.d;
        assert!((top - Vec3::new(0.0, 0.5, 1.0).normalize()).length() < 1e-5, "{top}");
        assert_eq!((file.defaults.width, file.defaults.height), (200, 100));
    }
}

#[test]
fn the_angle_of_view_lies_along_its_axis() {
    let half_width = |inner: &str| {
        let file = loaded(&sensor(inner));
        let camera = file.camera.build(file.camera.aspect.unwrap()).unwrap();
        let d = camera.ray(Vec2::new(1.0, 0.5), Vec2::ZERO).ray.d;
        -d.x / d.z
    };
    let axis = |name| half_width(&format!("<float name='fov' value='90'/><string name='fov_axis' value='{name}'/>"));
    for (name, want) in [("x", 1.0), ("larger", 1.0), ("y", 2.0), ("smaller", 2.0), ("diagonal", 2.0 / 5.0_f32.sqrt())]
    {
        assert!((axis(name) - want).abs() < 1e-4, "{name}: {}", axis(name));
    }
    // 50 mm before a diagonal of 43.27 mm.
    let by_length = half_width("<string name='focalLength' value='50mm'/>");
    assert!((by_length - 0.432_67 * 2.0 / 5.0_f32.sqrt()).abs() < 1e-4, "{by_length}");
}

#[test]
fn a_crop_is_a_part_of_the_whole_picture() {
    let text = |crop: &str| {
        format!(
            "<sensor type='perspective'><float name='fov' value='70'/><film type='hdrfilm'>
            <integer name='width' value='200'/><integer name='height' value='100'/>{crop}</film></sensor>"
        )
    };
    let ray = |file: &Loaded, raster: Vec2| {
        file.camera.build(file.camera.aspect.unwrap()).unwrap().ray(raster, Vec2::ZERO).ray.d
    };
    let crop = "<integer name='crop_offset_x' value='100'/><integer name='crop_width' value='50'/>
        <integer name='crop_offset_y' value='0'/><integer name='crop_height' value='50'/>";
    let (whole, part) = (loaded(&text("")), loaded(&text(crop)));
    assert_eq!((part.defaults.width, part.defaults.height), (50, 50));
    for corner in [Vec2::ZERO, Vec2::ONE, Vec2::new(0.3, 0.8)] {
        let same = Vec2::new(0.5, 0.0) + corner * Vec2::new(0.25, 0.5);
        assert!((ray(&part, corner) - ray(&whole, same)).length() < 1e-5);
    }
}

#[test]
fn steps_of_a_transformation_follow_one_another() {
    let steps = "<scale value='2'/><rotate z='1' angle='90'/><translate x='5'/>
        <matrix value='1 0 0 0  0 1 0 1  0 0 1 0  0 0 0 1'/>";
    // The same in the names of version 0.5.
    for name in ["to_world", "toWorld"] {
        let text = format!("<shape type='rectangle'><transform name='{name}'>{steps}</transform></shape>");
        let scene = scene(&text);
        // [-1, 1]² doubled, turned and moved to [3, 7] × [-1, 3].
        for (x, y, hits) in [(3.1, -0.9, true), (6.9, 2.9, true), (2.9, 0.0, false), (5.0, 3.1, false)] {
            let hit = outer_normal(&scene, Vec3::new(x, y, 5.0), Vec3::new(x, y, 0.0));
            assert_eq!(hit, hits.then_some(Vec3::Z), "{x} {y}");
        }
    }
}

#[test]
fn names_are_filled_in_the_command_line_first() {
    let text = "<scene version='3.0.0'><default name='res' value='10'/><default name='resx' value='20'/>
        <default name='spp' value='$res'/><sensor type='perspective'><sampler type='independent'>
        <integer name='sample_count' value='$spp'/></sampler><film type='hdrfilm'>
        <integer name='width' value='$resx'/><integer name='height' value='$res'/></film></sensor></scene>";
    let size = |defines: &[(&str, &str)]| {
        let (told, file) = load_files(&[("main.xml", text.as_bytes())], defines);
        let file = file.unwrap();
        (told.contains("no file uses `$"), file.defaults.width, file.defaults.height, file.hints.passes)
    };
    assert_eq!(size(&[]), (false, 20, 10, Some(10)));
    assert_eq!(size(&[("res", "30")]), (false, 20, 30, Some(30)));
    assert_eq!(size(&[("resz", "1")]), (true, 20, 10, Some(10)));
}

#[test]
fn includes_paths_references_and_aliases_join_files() {
    let main = "<scene version='3.0.0'><default name='grey' value='0.25'/><path value='assets'/>
        <include filename='parts/more.xml'/><alias id='lamp' as='lamp2'/>
        <shape type='ply'><string name='filename' value='mesh.ply'/><ref id='lamp2'/></shape></scene>";
    let more = "<scene version='3.0.0'><default name='grey' value='0.75'/><emitter type='area' id='lamp'>
        <rgb name='radiance' value='$grey'/></emitter></scene>";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n";
    let files: [(&str, &[u8]); 3] =
        [("main.xml", main.as_bytes()), ("parts/more.xml", more.as_bytes()), ("assets/mesh.ply", ply.as_bytes())];
    let scene = load_files(&files, &[]).1.unwrap().builder.build().unwrap();
    let power = scene.lights()[0].power(&AROUND).x;
    // π·A·L with an area of 2.
    assert!((power - std::f32::consts::PI * 2.0 * 0.25).abs() < 1e-5, "{power}");
}

#[test]
fn surfaces_look_to_mitsubas_side() {
    let far = Vec3::new(0.3, 0.2, 9.0);
    for (shape, transform, want) in [
        ("rectangle", "", Vec3::Z),
        ("rectangle", "<scale x='-1'/>", Vec3::Z),
        ("disk", "<scale y='-1'/>", Vec3::Z),
        ("cube", "", Vec3::Z),
        ("cube", "<scale x='-1'/>", Vec3::Z),
        ("cylinder", "<rotate x='1' angle='90'/><translate y='0.5'/>", Vec3::Z),
    ] {
        for (flip, sign) in [("false", 1.0), ("true", -1.0)] {
            let text = format!(
                "<shape type='{shape}'><transform name='to_world'>{transform}</transform>
                <boolean name='flip_normals' value='{flip}'/></shape>"
            );
            let n = outer_normal(&scene(&text), far, Vec3::new(0.3, 0.2, 0.0)).unwrap();
            assert!(n.dot(sign * want) > 0.8, "{shape} {transform} {flip}: {n}");
        }
    }
}

#[test]
fn spheres_stay_exact_unless_stretched() {
    let counts = |inner: &str| scene(&format!("<shape type='sphere'>{inner}</shape>")).counts();
    let round = counts("<point name='center' x='1' y='2' z='3'/><float name='radius' value='2'/>");
    assert_eq!((round.spheres, round.triangles), (1, 0));
    let flat = counts("<transform name='to_world'><scale x='2'/></transform>");
    assert!(flat.spheres == 0 && flat.triangles > 1000);
}

#[test]
fn one_of_several_serialized_meshes_is_placed() {
    let main = wrapped(
        "<shape type='serialized'><string name='filename' value='a.serialized'/>
        <integer name='shapeIndex' value='2'/></shape>",
    );
    let bytes = serialized_file(4, 3, false);
    let scene =
        load_files(&[("main.xml", main.as_bytes()), ("a.serialized", &bytes)], &[]).1.unwrap().builder.build().unwrap();
    let world = scene.world(Wavelengths::Rgb, 0.0);
    let ray = Ray { o: Vec3::new(0.2, 0.2, 9.0), d: Vec3::NEG_Z, tmin: 0.0, tmax: f32::INFINITY };
    assert!((world.intersect(&ray).unwrap().p.z - 2.0).abs() < 1e-5);
}

#[test]
fn a_group_is_seen_where_it_is_placed_only() {
    let scene = scene(
        "<shape type='shapegroup' id='g'><shape type='rectangle'/></shape>
        <shape type='instance'><ref id='g'/><transform name='to_world'><translate x='10'/></transform></shape>
        <shape type='instance'><ref id='g'/><transform name='to_world'><translate x='20'/></transform></shape>",
    );
    assert_eq!(scene.counts().instances, 2);
    for (x, hits) in [(0.0, false), (10.0, true), (20.0, true)] {
        assert_eq!(outer_normal(&scene, Vec3::new(x, 0.0, 5.0), Vec3::new(x, 0.0, 0.0)).is_some(), hits, "{x}");
    }
}

#[test]
fn what_reflects_has_one_side_unless_it_says_otherwise() {
    let kinds = |bsdf: &str| {
        let scene = scene(&format!("<shape type='rectangle'>{bsdf}</shape>"));
        scene.materials().iter().map(Material::name).collect::<Vec<_>>()
    };
    assert_eq!(kinds("<bsdf type='diffuse'/>"), ["diffuse", "twosided"]);
    assert_eq!(kinds("<bsdf type='twosided'><bsdf type='diffuse'/></bsdf>"), ["diffuse"]);
    assert_eq!(kinds("<bsdf type='dielectric'/>"), ["dielectric"]);
    assert_eq!(kinds("<bsdf type='mask'><bsdf type='conductor'/></bsdf>"), ["conductor", "twosided", "mask"]);
    let blend =
        "<bsdf type='blendbsdf'><float name='weight' value='0.3'/><bsdf type='null'/><bsdf type='dielectric'/></bsdf>";
    assert_eq!(kinds(blend), ["null", "dielectric", "mix"]);
}

#[test]
fn pictures_begin_where_v_is_zero_and_sides_where_normals_point() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.pfm");
    let mut image = RgbImage32::filled(1, 2, [0.0; 3]);
    image.data[0] = [1.0, 0.0, 0.0];
    write_image(&path, &image.into(), Tone::Srgb).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    let main = wrapped("<shape type='rectangle'><bsdf type='diffuse'><texture name='reflectance' type='bitmap'>
        <string name='filename' value='a.pfm'/><transform name='to_uv'><translate y='0.5'/></transform></texture></bsdf></shape>");
    let file = load_files(&[("main.xml", main.as_bytes()), ("a.pfm", &bytes)], &[]).1.unwrap();
    let parts = file.builder.parts();
    let value = |v: f32| {
        let at = Lookup::new(parts.textures, Vec2::new(0.5, v), Vec3::ZERO, Wavelengths::Rgb);
        at.spectrum(TextureId(parts.textures.len() as u32 - 1)).lanes()[0]
    };
    // Half a picture further down.
    assert_eq!((value(0.75), value(0.25)), (1.0, 0.0));
    let Some(Material::Covering(Covering::TwoSided(sides))) = parts.materials.last() else { panic!("no sides") };
    assert!(sides.front.is_some() && sides.back.is_none());
}

#[test]
fn filters_are_those_of_the_film_and_a_bell_without_one() {
    use sunfleck::film::{Curve, Filter};
    let filter = |said: &str| {
        let film = format!("<sensor type='perspective'><film type='hdrfilm'>{said}</film></sensor>");
        loaded(&film).defaults.filter
    };
    let shaped = |curve, radius| Filter::shaped(curve, Vec2::splat(radius)).unwrap();
    assert_eq!(filter(""), shaped(Curve::Gaussian { sigma: 0.5 }, 2.0));
    assert_eq!(filter("<rfilter type='box'/>"), Filter::Box);
    assert_eq!(filter("<rfilter type='tent'/>"), shaped(Curve::Tent, 1.0));
    let mitchell = "<rfilter type='mitchell'><float name='B' value='0.5'/></rfilter>";
    assert_eq!(filter(mitchell), shaped(Curve::Cubic { b: 0.5, c: 1.0 / 3.0 }, 2.0));
    let lanczos = "<rfilter type='lanczos'><integer name='lobes' value='2'/></rfilter>";
    assert_eq!(filter(lanczos), shaped(Curve::Lanczos { tau: 2.0 }, 2.0));
}

#[test]
fn the_integrators_depth_counts_scatterings() {
    let depth = |inner: &str| loaded(&format!("<integrator {inner}</integrator>")).hints.scatterings;
    assert_eq!(depth("type='path'><integer name='max_depth' value='6'/>"), Some(5));
    assert_eq!(depth("type='path'><integer name='maxDepth' value='-1'/>"), None);
    assert_eq!(
        depth("type='moment'><integrator type='path'><integer name='max_depth' value='2'/></integrator>"),
        Some(1)
    );
    assert_eq!(depth("type='direct'>"), Some(1));
}

#[test]
fn mistakes_are_told_with_their_place() {
    assert_snapshot!("number", told("<shape type='sphere'>\n  <float name='radius' value='1.5m'/>\n</shape>"));
    assert_snapshot!("plugin", told("<bsdf type='diffus' id='a'/>\n<shape type='cube'><ref id='a'/></shape>"));
    assert_snapshot!(
        "reference",
        told("<bsdf type='diffuse' id='white'/>\n<shape type='cube'><ref id='wite'/></shape>")
    );
    assert_snapshot!(
        "define",
        told("<default name='spp' value='4'/>\n<integrator type='path'><integer name='a' value='$sp'/></integrator>")
    );
    assert_snapshot!("unused", told("<shape type='sphere'><float name='radus' value='2'/></shape>"));
    assert_snapshot!("element", told("<shapes type='sphere'/>\n<shape type='sphere'/>"));
    assert_snapshot!(
        "unclosed",
        load_files(&[("main.xml", b"<scene version='3.0.0'>\n  <shape type='cube'>\n</scene>\n")], &[]).0
    );
    assert_snapshot!("root", load_files(&[("main.xml", b"<?xml version='1.0'?>\n<COLLADA/>")], &[]).0);
    assert_snapshot!("kind", told("<shape type='sphere'><string name='radius' value='2'/></shape>"));
    assert_snapshot!(
        "circle",
        told("<bsdf type='twosided' id='a'><ref id='a'/></bsdf>\n<shape type='cube'><ref id='a'/></shape>")
    );
    assert_snapshot!("same_id", told("<bsdf type='diffuse' id='a'/>\n<bsdf type='plastic' id='a'/>"));
    assert_snapshot!(
        "metal",
        told("<shape type='cube'><bsdf type='conductor'><string name='material' value='Agg'/></bsdf></shape>")
    );
    assert_snapshot!("missing", told("<shape type='obj'><string name='filename' value='no.obj'/></shape>"));
}

#[test]
fn includes_stay_in_the_scenes_folder_and_come_to_an_end() {
    let outside = wrapped("<include filename='../../other.xml'/>");
    let (told, file) = load_files(&[("main.xml", outside.as_bytes()), ("../../other.xml", b"<scene/>")], &[]);
    drop(told);
    assert_eq!(file.unwrap_err().errors[0].code, "file::outside");
    let (_, file) = load_files(&[("main.xml", wrapped("<include filename='main.xml'/>").as_bytes())], &[]);
    assert_eq!(file.unwrap_err().errors[0].code, "mitsuba::include");
}

#[test]
fn depth_is_limited() {
    let deep = "<shape type='merge'>".repeat(5000) + &"</shape>".repeat(5000);
    assert!(told(&deep).contains("too deep"));
}

const GOOD: &str = "<scene version='3.0.0'><default name='r' value='1'/><integrator type='path'/>
<sensor type='thinlens'><float name='aperture_radius' value='0.1'/><float name='focus_distance' value='2'/></sensor>
<texture type='checkerboard' id='t'><rgb name='color0' value='0.1'/></texture>
<bsdf type='twosided' id='b'><bsdf type='roughconductor'><ref name='alpha' id='t'/></bsdf></bsdf>
<shape type='sphere'><float name='radius' value='$r'/><ref id='b'/><emitter type='area'>
<spectrum name='radiance' value='400:1, 700:2'/></emitter></shape><emitter type='sunsky'/></scene>";

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn changed_bytes_never_panic(changes in proptest::collection::vec((0..GOOD.len(), any::<u8>()), 0..6), cut in 0..GOOD.len()) {
        let mut bytes = GOOD.as_bytes().to_vec();
        for (at, byte) in changes {
            bytes[at] = byte;
        }
        if cut % 4 == 0 {
            bytes.truncate(cut);
        }
        match super::check("fuzz.xml", bytes) {
            Ok((builder, warnings)) => {
                prop_assert!(builder.build().is_ok());
                warnings.iter().for_each(|w| assert!(!w.render(false).is_empty()));
            }
            Err(error) => prop_assert!(error.errors.iter().all(|e| e.place.is_some())),
        }
    }
}
