//! Materials laid over others, lights with pictures, and what the film makes of light.

use super::{LIGHT, load_files, loaded, scene, told};
use crate::image::{RgbImage32, Tone, write_image};
use crate::load::{LoadOptions, load};
use glam::{Vec2, Vec3};
use sunfleck::bsdf::{Covering, Material, Scalar};
use sunfleck::light::{Emitter, Light, Surroundings};
use sunfleck::spectrum::Wavelengths;

const AROUND: Surroundings = Surroundings { centre: Vec3::ZERO, radius: 1.0, lambda: Wavelengths::Rgb };

/// The model names of all surfaces, through coverings.
fn covers(text: &str) -> Vec<String> {
    let file = loaded(&format!("WorldBegin\n{LIGHT}{text}"));
    let parts = file.builder.parts();
    let name = |m: &Material| -> String {
        let of: Vec<&str> = m.parts().iter().map(|id| parts.materials[id.0 as usize].name()).collect();
        if of.is_empty() { m.name().to_owned() } else { format!("{}({})", m.name(), of.join(" ")) }
    };
    parts.surfaces.iter().map(|s| name(&parts.materials[s.material.0 as usize])).collect()
}

#[test]
fn holes_reliefs_and_mixes_are_laid_over_materials() {
    let text = "Texture \"t\" \"float\" \"checkerboard\"\n\
        MakeNamedMaterial \"a\" \"string type\" \"conductor\" MakeNamedMaterial \"b\" \"string type\" \"diffuse\"\n\
        Material \"diffuse\" \"texture displacement\" \"t\" Shape \"sphere\" Shape \"sphere\" \"texture alpha\" \"t\"\n\
        Shape \"sphere\" \"float alpha\" 0.5 Shape \"sphere\" \"float alpha\" 0 Shape \"sphere\" \"float alpha\" 1\n\
        Material \"mix\" \"string materials\" [\"a\" \"b\"] \"texture amount\" \"t\" Shape \"sphere\"\n\
        Material \"thindielectric\" Shape \"sphere\"\n\
        Material \"uber\" \"rgb opacity\" 0.3 \"float index\" 1 Shape \"sphere\"\n\
        Material \"plastic\" \"rgb Ks\" [0 0 0] Shape \"sphere\"\n\
        Material \"dielectric\" \"texture roughness\" \"t\" Shape \"sphere\"\n\
        Material \"coateddiffuse\" Shape \"sphere\" Material \"coatedconductor\" Shape \"sphere\" Material \"translucent\" Shape \"sphere\"\n\
        Material \"substrate\" Shape \"sphere\" Material \"disney\" Shape \"sphere\"";
    assert_eq!(
        covers(text),
        [
            "bumpmap(diffuse)",
            "mask(bumpmap)",
            "mask(bumpmap)",
            "bumpmap(diffuse)",
            "mix(conductor diffuse)",
            "thindielectric",
            "mask(diffuse)",
            "diffuse",
            "roughdielectric",
            "plastic",
            "coatedconductor",
            "diffusetransmission",
            "principled",
            "principled",
        ]
    );
}

#[test]
fn a_material_may_be_named_before_it_is_made() {
    let text = "ObjectBegin \"o\" NamedMaterial \"later\" Shape \"sphere\" ObjectEnd ObjectInstance \"o\"\n\
        NamedMaterial \"later\" Shape \"sphere\" AttributeBegin NamedMaterial \"later\"\n\
        MakeNamedMaterial \"later\" \"string type\" \"conductor\" Shape \"sphere\" AttributeEnd Shape \"sphere\"";
    assert_eq!(covers(text), ["conductor"; 3]);
    let file = loaded(&format!("WorldBegin\n{LIGHT}{text}"));
    let parts = file.builder.parts();
    assert_eq!(parts.materials[parts.objects[0][0].material.0 as usize].name(), "conductor");
    assert_eq!(file.materials, [("later".to_owned(), parts.objects[0][0].material)]);
    let pierced = "NamedMaterial \"x\" Shape \"sphere\" \"float alpha\" 0.5 MakeNamedMaterial \"x\" \"string type\" \"conductor\"";
    assert_eq!(covers(pierced), ["mask(conductor)"]);
    let never =
        told("WorldBegin NamedMaterial \"x\" Shape \"sphere\" MakeNamedMaterial \"xx\" \"string type\" \"diffuse\"");
    assert!(never.starts_with("error: no material `x`") && never.contains("xx"), "{never}");
}

#[test]
fn a_mix_of_version_3_gives_the_share_of_the_first() {
    let mix = |film: &str, amount: &str| {
        let text = format!(
            "Film \"{film}\" WorldBegin {LIGHT} MakeNamedMaterial \"a\" \"string type\" \"mirror\"\n\
             MakeNamedMaterial \"b\" \"string type\" \"matte\"\n\
             Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" {amount} Shape \"sphere\""
        );
        let file = loaded(&text);
        let Some(Material::Covering(Covering::Mix(mix))) = file.builder.parts().materials.last().cloned() else {
            panic!("no mix")
        };
        let names = mix.of.map(|id| file.builder.parts().materials[id.0 as usize].name());
        (names, mix.amount)
    };
    assert_eq!(mix("image", "\"rgb amount\" [0.2 0.2 0.2]"), (["diffuse", "mirror"], Scalar::Constant(0.2)));
    assert_eq!(mix("rgb", "\"float amount\" 0.2"), (["mirror", "diffuse"], Scalar::Constant(0.2)));
}

#[test]
fn paths_are_as_long_as_pbrts_when_the_file_says_nothing() {
    let depth = |said: &str| loaded(&format!("{said} WorldBegin {LIGHT}")).hints.scatterings;
    assert_eq!(depth(""), Some(5));
    assert_eq!(depth("Integrator \"path\""), Some(5));
    assert_eq!(depth("Integrator \"volpath\" \"integer maxdepth\" 9"), Some(9));
    assert_eq!(depth("Integrator \"sppm\" \"integer maxdepth\" 7"), Some(14));
}

#[test]
fn a_crop_has_the_pixels_that_pbrts_precision_gives_it() {
    // 0.3 · 1400 is a little more than 420 in single precision.
    let text = format!(
        "Film \"image\" \"integer xresolution\" 1400 \"integer yresolution\" 2000 \"float cropwindow\" [.3 .7 .4 .7]\n\
         WorldBegin {LIGHT}"
    );
    let file = loaded(&text);
    assert_eq!((file.defaults.width, file.defaults.height), (559, 600));
}

#[test]
fn a_camera_moves_between_the_transformations_of_both_times() {
    let text = format!(
        // The camera looks along -z, with -x at its right.
        "ActiveTransform EndTime Translate -1 0 0 ActiveTransform All LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\"\n\
         WorldBegin {LIGHT}"
    );
    let file = loaded(&text);
    assert_eq!(file.camera.view.position, Vec3::new(0.0, 0.0, 5.0));
    let to = file.camera_to.unwrap();
    assert!((to.view.position - Vec3::new(-1.0, 0.0, 5.0)).length() < 1e-6, "{to:?}");
    assert_eq!(loaded(&format!("Camera \"perspective\" WorldBegin {LIGHT}")).camera_to, None);
}

#[test]
fn white_balance_turns_the_light_it_is_made_for_white() {
    let light = |film: &str| {
        let text = format!("Film \"rgb\" {film} WorldBegin LightSource \"point\" \"blackbody I\" 5000");
        let file = loaded(&text);
        let Light::Point(p) = &file.builder.parts().lights[0] else { panic!("no point") };
        p.intensity.rgb()
    };
    let plain = light("");
    let seen = light("\"float whitebalance\" 5000");
    assert!(plain.x > 1.2 * plain.z, "{plain}");
    // A black body is a little off daylight.
    assert!((seen - seen.y).abs().max_element() < 0.09 * seen.y, "{seen}");
    assert!((light("\"string sensor\" \"canon_eos_100d\"") - plain).abs().max_element() < 0.02);
}

/// A folder with the square picture `p.exr` (white where u > 1/2) and `a.pbrt`.
fn with_picture(text: &str) -> sunfleck::scene::Scene {
    let folder = tempfile::tempdir().unwrap();
    let mut image = RgbImage32::filled(16, 16, [0.0; 3]);
    (0..256).filter(|i| i % 16 >= 8).for_each(|i| image.data[i] = [1.0; 3]);
    write_image(&folder.path().join("p.exr"), &image.into(), Tone::Srgb).unwrap();
    std::fs::write(folder.path().join("a.pbrt"), text).unwrap();
    let options = LoadOptions { strict: true, ..LoadOptions::default() };
    load(&[folder.path().join("a.pbrt")], &options).unwrap_or_else(|e| panic!("{e}")).builder.build().unwrap()
}

#[test]
fn a_goniometric_light_shines_where_its_picture_is_bright() {
    let scene = with_picture("WorldBegin LightSource \"goniometric\" \"string filename\" \"p.exr\" \"rgb I\" [2 2 2]");
    let seen = |to: Vec3| scene.lights()[0].sample_li(to, Vec2::ZERO, &AROUND).map_or(0.0, |s| s.li.mean() * 4.0 / 3.0);
    // In the equal-area map x grows to the right.
    assert!((seen(Vec3::X) - 2.0).abs() < 1e-3 && seen(Vec3::NEG_X) < 1e-3, "{} {}", seen(Vec3::X), seen(Vec3::NEG_X));
    assert!((seen(Vec3::new(1.0, 1.0, -1.0).normalize()) - 2.0).abs() < 1e-3);
}

#[test]
fn a_projection_shines_along_z_and_power_sets_its_flux() {
    let light = "LightSource \"projection\" \"string filename\" \"p.exr\" \"float fov\" 90";
    let scene = with_picture(&format!("WorldBegin {light}"));
    let seen = |x: f32| scene.lights()[0].sample_li(Vec3::new(x, 0.0, 1.0), Vec2::ZERO, &AROUND);
    assert!(seen(0.5).is_some() && seen(-0.5).is_none() && seen(1.1).is_none());
    let scene = with_picture(&format!("WorldBegin {light} \"float power\" 7"));
    assert!((scene.lights()[0].power(&AROUND).y - 7.0).abs() < 1e-2);
}

#[test]
fn what_is_missing_is_an_error_where_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.pbrt");
    let texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"no.png\"";
    std::fs::write(&path, format!("WorldBegin {LIGHT} {texture} Shape \"plymesh\" \"string filename\" \"no.ply\""))
        .unwrap();
    let lenient = load(std::slice::from_ref(&path), &LoadOptions::default()).unwrap();
    assert_eq!((lenient.surfaces, lenient.warnings.len()), (1, 2));
    let options = LoadOptions { strict: true, ..LoadOptions::default() };
    let error = load(&[path], &options).unwrap_err();
    let codes: Vec<&str> = error.errors.iter().map(|e| e.code).collect();
    assert_eq!(codes, ["pbrt::missing-picture", "pbrt::missing-mesh"]);
}

#[test]
fn a_mesh_is_read_once_however_often_it_is_used() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 0 0\n";
    let shape = "Shape \"plymesh\" \"string filename\" \"m.ply\"\n";
    let main = format!("WorldBegin {LIGHT}{shape}Translate 3 0 0\n{shape}{shape}");
    let (told, file) = load_files(&[("a.pbrt", &main), ("m.ply", ply)]);
    let file = file.unwrap();
    assert_eq!(file.surfaces, 3);
    // The face without area is told of.
    assert!(told.contains("1 of 2 faces have no area"), "{told}");
    let (centre, _) = file.builder.build().unwrap().bounding_sphere();
    assert!((centre - Vec3::new(2.0, 0.5, 0.0)).length() < 1e-4, "{centre}");
    assert!(scene(&format!("WorldBegin {LIGHT} Shape \"sphere\"")).counts().spheres == 1);
}
