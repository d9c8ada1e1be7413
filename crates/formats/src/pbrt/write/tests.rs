//! What is written is read back as it was.

use super::{Report, Written, write};
use crate::load::{CameraSettings, LoadOptions, Loaded, Projection, load};
use glam::{Affine2, Vec2, Vec3, Vec4};
use std::path::{Path, PathBuf};
use sunfleck::bsdf::{DiffuseMaterial, MaskMaterial, NormalMapMaterial, TwoSidedMaterial};
use sunfleck::camera::{Project, Unrolling, View};
use sunfleck::film::{FilmSpec, Filter, PassImage};
use sunfleck::integrator::{Params, Pass, find};
use sunfleck::light::{EnvironmentLight, PointLight};
use sunfleck::scene::{SceneBuilder, SurfaceDef};
use sunfleck::shape::{Attributes, Mesh, Shape};
use sunfleck::spectrum::Wavelengths;
use sunfleck::texture::{ImageTexture, Lookup, Mapped, Mix, Texture, UvSet, VertexColour, Wrap};

const SIDE: u32 = 32;
const BLOCKS: u32 = 4;
const PASSES: u64 = 16;

/// Means of blocks after a few passes of the path tracer.
fn blocks(loaded: Loaded) -> Vec<f32> {
    let mut builder = loaded.builder;
    builder.camera(loaded.camera.build(loaded.camera.aspect.unwrap_or(1.0)).unwrap());
    let scene = builder.build().unwrap();
    let spec = FilmSpec { width: SIDE, height: SIDE, filter: Filter::Box };
    let integrator = find("path").unwrap().build(Params::default()).unwrap();
    let prepared = integrator.prepare(&scene, spec, 7);
    let mut image = PassImage::new(spec);
    let mut sums = vec![0.0; (BLOCKS * BLOCKS) as usize];
    for index in 0..PASSES {
        image.clear();
        prepared.render_pass(&Pass::new(7, index), &mut image);
        for (i, p) in image.pixels().iter().enumerate() {
            let (x, y) = (i as u32 % SIDE * BLOCKS / SIDE, i as u32 / SIDE * BLOCKS / SIDE);
            sums[(y * BLOCKS + x) as usize] += p.element_sum();
        }
    }
    sums
}

fn loaded(path: &Path) -> Loaded {
    let options = LoadOptions { allow_outside: true, strict: false, ..LoadOptions::default() };
    load(&[path.to_owned()], &options).unwrap_or_else(|e| panic!("{}:\n{e}", path.display()))
}

/// How each surface scatters at some place; emitters that are black are written as matt and black.
fn closures(loaded: &Loaded) -> Vec<String> {
    let parts = loaded.builder.parts();
    let at = Lookup::new(parts.textures, Vec2::new(0.3, 0.6), Vec3::splat(0.1), Wavelengths::Rgb);
    // Curves are told to a millionth.
    let rounded = |word: &str| word.parse::<f32>().map_or_else(|_| word.to_owned(), |x| format!("{x:.4}"));
    let told = |s: &SurfaceDef| {
        let told = format!("{:?}", parts.materials[s.material.0 as usize].resolve(&at));
        told.split([' ', ',', '(', ')']).map(rounded).collect::<Vec<_>>().join(" ")
    };
    parts.surfaces.iter().filter(|s| s.emission.is_none()).map(told).collect()
}

/// Writes and reads back; block means must agree within 0.5 %.
fn round_trip(path: &Path) -> (Report, Loaded) {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("out scene.pbrt");
    let first = loaded(path);
    let report = write(&to, &Written::from(&first)).unwrap();
    let second = loaded(&to);
    let fresh: Vec<_> = second.warnings.iter().filter(|w| !first.warnings.iter().any(|f| f.code == w.code)).collect();
    assert!(fresh.is_empty(), "{}: {fresh:?}\n{}", path.display(), std::fs::read_to_string(&to).unwrap());
    let kept = loaded(&to);
    let counts = |l: &Loaded| (l.surfaces, l.lights, l.builder.parts().instances.len());
    assert_eq!(counts(&first), counts(&second), "{}", path.display());
    assert_eq!(closures(&first), closures(&second), "{}", path.display());
    assert_eq!(first.defaults.filter, second.defaults.filter, "{}", path.display());
    let (first, second) = (blocks(first), blocks(second));
    for (i, (a, b)) in first.iter().zip(&second).enumerate() {
        assert!(
            (a - b).abs() <= 5e-3 * a.abs().max(1e-3),
            "{}, block {i}: {a} became {b}\n{first:?}\n{second:?}",
            path.display()
        );
    }
    (report, kept)
}

/// A patch whose vertices know colours, tangents and second texture coordinates, and a picture that is turned on them.
fn patch(builder: &mut SceneBuilder) {
    let pixels = (0..16).map(|i| Vec3::new((i % 4) as f32 / 3.0, (i / 4) as f32 / 3.0, 0.2)).collect();
    let image = builder.texture(Texture::Image(ImageTexture::new(4, 4, pixels, Wrap::Mirror).unwrap()));
    let map = Affine2::from_scale_angle_translation(Vec2::new(3.0, 2.0), 0.4, Vec2::new(0.1, 0.2));
    let turned = builder.texture(Texture::Mapped(Mapped { of: image, map, set: UvSet::Second }));
    let first = builder.texture(Texture::Mapped(Mapped { of: image, map, set: UvSet::First }));
    let [rgb, alpha] = [VertexColour::Rgb, VertexColour::Alpha].map(|v| builder.texture(Texture::Vertex(v)));
    let mixed = builder.texture(Texture::Mix(Mix { from: rgb, to: turned, amount: alpha }));
    let paint = builder.material(DiffuseMaterial { reflectance: mixed });
    let holes = builder.material(MaskMaterial { of: paint, opacity: alpha.into() });
    let bent = builder.material(NormalMapMaterial { of: paint, map: first, scale: 0.7 });
    let bent = builder.material(TwoSidedMaterial { front: Some(bent), back: None });
    let positions = |x: f32| [[x, 0.0], [x + 0.8, 0.0], [x + 0.8, 1.0], [x, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.3));
    let uv = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    let colours =
        vec![Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(0.0, 1.0, 0.0, 0.3), Vec4::ONE, Vec4::new(0.2, 0.2, 1.0, 0.5)];
    for (x, material) in [(-0.9, holes), (0.1, bent)] {
        let uv2 = uv.iter().map(|p| Vec2::ONE - *p).collect();
        let tangents = vec![Vec4::new(0.6, 0.8, 0.0, -1.0); 4];
        let extra = Attributes { uv2, colours: colours.clone(), tangents };
        let mesh = Mesh::new(positions(x).to_vec(), vec![], uv.clone(), vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        builder.add(Shape::Mesh(mesh.with_attributes(extra).unwrap()), material);
    }
}

#[test]
fn what_vertices_know_and_turned_coordinates_come_back_as_they_were() {
    let mut first = loaded(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/cornell-glass.scn"));
    let mut builder = SceneBuilder::new();
    patch(&mut builder);
    builder.light(EnvironmentLight::constant(Vec3::ONE));
    builder.light(PointLight { p: Vec3::new(0.3, 0.5, 4.0), intensity: Vec3::splat(9.0).into() });
    first.builder = builder;
    let view = View { position: Vec3::new(0.0, 0.5, 3.0), look_at: Vec3::new(0.0, 0.5, 0.0), up: Vec3::Y };
    first.camera = CameraSettings { view, aspect: Some(1.0), ..CameraSettings::default() };
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("a.pbrt");
    let report = write(&to, &Written::from(&first)).unwrap();
    assert!(report.notes.is_empty(), "{:?}", report.notes);
    let (first, second) = (blocks(first), blocks(loaded(&to)));
    assert!(first.iter().all(|b| *b > 0.0));
    for (i, (a, b)) in first.iter().zip(&second).enumerate() {
        assert!((a - b).abs() <= 1e-3 * a, "block {i}: {a} became {b}\n{first:?}\n{second:?}");
    }
}

fn from_text(text: &str) -> (Report, Loaded) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.pbrt");
    std::fs::write(&path, text).unwrap();
    round_trip(&path)
}

#[test]
fn our_own_scenes_come_back_as_they_were() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut scenes: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    scenes.retain(|p| p.extension().is_some_and(|e| e == "scn"));
    scenes.sort();
    assert!(scenes.len() >= 3);
    for scene in scenes {
        let (report, _) = round_trip(&scene);
        assert!(report.notes.is_empty(), "{}: {:?}", scene.display(), report.notes);
    }
}

#[test]
fn materials_textures_and_lights_come_back_as_they_were() {
    let text = "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 40 \"float lensradius\" 0.02 \"float focaldistance\" 5\n\
        Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 32\nWorldBegin\n\
        Texture \"c\" \"spectrum\" \"checkerboard\" \"float uscale\" 8 \"float vscale\" 8 \"rgb tex1\" [0.1 0.5 0.8]\n\
        Texture \"f\" \"float\" \"checkerboard\" \"float uscale\" 8 \"float vscale\" 8\n\
        Texture \"w\" \"float\" \"wrinkled\" Texture \"m\" \"spectrum\" \"marble\"\n\
        Texture \"x\" \"spectrum\" \"mix\" \"texture tex1\" \"c\" \"texture tex2\" \"m\" \"texture amount\" \"w\"\n\
        Texture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"c\" \"rgb scale\" [0.9 0.4 0.2]\n\
        MakeNamedMaterial \"g\" \"string type\" \"dielectric\" \"spectrum eta\" \"glass-BK7\"\n\
        MakeNamedMaterial \"r\" \"string type\" \"dielectric\" \"texture roughness\" \"f\" \"bool remaproughness\" false\n\
        MakeNamedMaterial \"k\" \"string type\" \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" \"float uroughness\" 0.1 \"float vroughness\" 0.3\n\
        MakeNamedMaterial \"d\" \"string type\" \"diffuse\" \"texture reflectance\" \"x\" \"texture displacement\" \"w\"\n\
        MakeNamedMaterial \"e\" \"string type\" \"coateddiffuse\" \"texture reflectance\" \"s\" \"float roughness\" 0.3\n\
        MakeNamedMaterial \"i\" \"string type\" \"interface\" MakeNamedMaterial \"l\" \"string type\" \"mirror\" \"rgb Kr\" [0.9 0.5 0.3]\n\
        MakeNamedMaterial \"j\" \"string type\" \"mix\" \"string materials\" [\"k\" \"d\"] \"texture amount\" \"f\"\n\
        MakeNamedMaterial \"cc\" \"string type\" \"coatedconductor\" \"float interface.roughness\" 0.1 \"float conductor.roughness\" 0.2\n\
        MakeNamedMaterial \"dt\" \"string type\" \"diffusetransmission\" \"float scale\" 1.5 \"texture reflectance\" \"c\"\n\
        MakeNamedMaterial \"sb\" \"string type\" \"substrate\" \"texture roughness\" \"f\" \"rgb Ks\" [0.3 0.2 0.1]\n\
        MakeNamedMaterial \"di\" \"string type\" \"disney\" \"float metallic\" 0.5 \"float clearcoat\" 1 \"float sheen\" 0.5\n\
        AttributeBegin Translate 0 0 1.5 NamedMaterial \"cc\" Shape \"sphere\" \"float radius\" 0.2 Translate 0.5 0 0 NamedMaterial \"dt\" Shape \"sphere\" \"float radius\" 0.2\n\
        Translate 0 0.5 0 NamedMaterial \"sb\" Shape \"sphere\" \"float radius\" 0.2 Translate -0.5 0 0 NamedMaterial \"di\" Shape \"sphere\" \"float radius\" 0.2 AttributeEnd\n\
        LightSource \"infinite\" \"rgb L\" [0.2 0.3 0.4] LightSource \"point\" \"blackbody I\" 3000 \"float scale\" 9 \"point3 from\" [2 3 4]\n\
        LightSource \"spot\" \"rgb I\" [9 8 7] \"point3 from\" [-2 3 4] \"point3 to\" [0 0 0] LightSource \"distant\" \"rgb L\" [0.3 0.2 0.1] \"point3 from\" [0 2 1]\n\
        NamedMaterial \"d\" Translate 0 -1.2 0 Shape \"trianglemesh\" \"point3 P\" [-9 0 -9 9 0 -9 9 0 9 -9 0 9] \"integer indices\" [0 2 1 0 3 2]\n\
        Translate -1.5 0.6 0 NamedMaterial \"g\" Shape \"sphere\" \"float radius\" 0.5 Translate 1 0 0 NamedMaterial \"r\" Shape \"sphere\" \"float radius\" 0.5\n\
        Translate 1 0 0 NamedMaterial \"k\" Shape \"sphere\" \"float radius\" 0.5 Translate 1 0 0 NamedMaterial \"e\" Shape \"sphere\" \"float radius\" 0.5\n\
        Translate -3 1.1 0 NamedMaterial \"l\" Shape \"sphere\" \"float radius\" 0.5 Translate 1 0 0 NamedMaterial \"j\" Shape \"sphere\" \"float radius\" 0.5\n\
        Translate 1 0 0 NamedMaterial \"d\" Shape \"sphere\" \"float radius\" 0.5 \"texture alpha\" \"f\" Shape \"cylinder\" \"float radius\" 0.3 \"float zmin\" 0\n\
        AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 4 3] \"bool twosided\" true Translate 0 1.2 0 Shape \"disk\" \"float radius\" 0.3 AttributeEnd\n\
        ObjectBegin \"o\" NamedMaterial \"e\" Shape \"disk\" \"float radius\" 0.3 ObjectEnd Translate 1 0 0.5 ObjectInstance \"o\" Scale -1 2 1 ObjectInstance \"o\"";
    let (report, loaded) = from_text(text);
    assert!(report.notes.is_empty(), "{:?}", report.notes);
    assert!(report.files >= 3, "{report:?}");
    let names: Vec<&str> = loaded.materials.iter().map(|(name, _)| name.as_str()).collect();
    assert!(["g", "k", "j"].iter().all(|n| names.contains(n)), "{names:?}");
    assert!((loaded.camera.aperture - 0.04).abs() < 1e-6 && (loaded.camera.focus_distance - 5.0).abs() < 1e-5);
}

#[test]
fn every_camera_comes_back_as_it_was() {
    let mut first = loaded(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/cornell-glass.scn"));
    let view =
        View { position: Vec3::new(1.0, 2.0, 3.0), look_at: Vec3::new(0.5, 1.0, -2.0), up: Vec3::new(0.1, 1.0, 0.2) };
    let plain = CameraSettings { view, aspect: Some(1.6), focus_distance: 2.0, ..CameraSettings::default() };
    for projection in [
        Projection::Perspective,
        Projection::Orthographic(3.0),
        Projection::Spherical(Unrolling::Equirectangular),
        Projection::Spherical(Unrolling::EqualArea),
    ] {
        for (is_mirrored, shift, aperture) in [(true, [0.0; 2], 0.0), (false, [0.2, -0.1], 0.3)] {
            first.camera = CameraSettings { projection, aperture, is_mirrored, shift, ..plain };
            let folder = tempfile::tempdir().unwrap();
            let to = folder.path().join("a.pbrt");
            write(&to, &Written::from(&first)).unwrap();
            let second = loaded(&to).camera;
            let open = |c: &CameraSettings| c.build(c.aspect.unwrap()).unwrap();
            for (x, y) in [(0.1, 0.2), (0.5, 0.5), (0.9, 0.3), (0.4, 0.8)] {
                let ray = |c| open(c).ray(Vec2::new(x, y), Vec2::new(0.7, 0.2)).ray;
                let (a, b) = (ray(&first.camera), ray(&second));
                assert!(
                    (a.o - b.o).length() < 1e-4 && (a.d - b.d).length() < 1e-4,
                    "{projection:?} {is_mirrored} {a:?} {b:?}"
                );
            }
        }
    }
}

#[test]
fn nothing_is_left_behind_where_it_cannot_be_written_and_old_files_go() {
    let folder = tempfile::tempdir().unwrap();
    let first = loaded(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/cornell-glass.scn"));
    let nowhere = folder.path().join("no folder/a.pbrt");
    assert!(write(&nowhere, &Written::from(&first)).unwrap_err().to_string().contains("cannot be written"));
    let to = folder.path().join("a.pbrt");
    std::fs::create_dir(folder.path().join("a.files")).unwrap();
    std::fs::write(folder.path().join("a.files/old.ply"), "").unwrap();
    write(&to, &Written::from(&first)).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let plain = folder.path().join("plain");
        std::fs::write(&plain, "").unwrap();
        let mode = |p: &Path| p.metadata().unwrap().permissions().mode();
        assert_eq!(mode(&to), mode(&plain));
        std::fs::remove_file(plain).unwrap();
    }
    assert!(!folder.path().join("a.files/old.ply").exists());
    let left = std::fs::read_dir(folder.path()).unwrap().count();
    assert!(left <= 2, "{left} entries");
}
