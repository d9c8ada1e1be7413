//! What fills surfaces.

use super::{LIGHT, loaded, told};
use crate::load::{LoadOptions, Loaded, load};
use crate::pbrt::write::{Written, write};
use glam::Vec3;
use sunfleck::medium::Interior;
use sunfleck::spectrum::Wavelengths;

const GLASS: &str = "Material \"dielectric\"\n";
const WINE: &str = "MakeNamedMedium \"wine\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 2 3] \"rgb sigma_s\" [0 0 0] \"float scale\" 2\n";

/// The absorption coefficient behind each surface, if something is there.
fn behind(file: &Loaded) -> Vec<Option<Vec3>> {
    let parts = file.builder.parts();
    let sigma = |i: &Interior| i.sigma_a(Wavelengths::Rgb).to_rgb(Wavelengths::Rgb);
    let filling = |m: u32| parts.fillings.get(m as usize).copied().flatten();
    parts.surfaces.iter().map(|s| filling(s.material.0).map(|id| sigma(&parts.interiors[usize::from(id.0)]))).collect()
}

fn close(got: &[Option<Vec3>], want: &[Option<Vec3>]) {
    let near = |(a, b): (&Option<Vec3>, &Option<Vec3>)| match (a, b) {
        (Some(a), Some(b)) => (*a - *b).abs().max_element() < 1e-4,
        (a, b) => a == b,
    };
    assert!(got.len() == want.len() && got.iter().zip(want).all(near), "{got:?} {want:?}");
}

#[test]
fn media_that_absorb_lie_behind_the_shapes_that_say_so() {
    let text = format!(
        "WorldBegin\n{LIGHT}{WINE}{GLASS}\
        AttributeBegin MediumInterface \"wine\" \"\" Shape \"sphere\" AttributeEnd\n\
        AttributeBegin MediumInterface \"\" \"wine\" Shape \"sphere\" AttributeEnd\n\
        AttributeBegin MediumInterface \"wine\" Shape \"sphere\" AttributeEnd\n\
        AttributeBegin MediumInterface \"wine\" \"\" NamedMaterial \"later\" Shape \"sphere\" AttributeEnd\n\
        AttributeBegin MediumInterface \"wine\" \"\" Material \"interface\" Shape \"sphere\" AttributeEnd\n\
        Material \"interface\" Shape \"sphere\"\n\
        MakeNamedMaterial \"later\" \"string type\" \"dielectric\" NamedMaterial \"later\" Shape \"sphere\"\n"
    );
    let wine = Some(Vec3::new(2.0, 4.0, 6.0));
    let file = loaded(&text);
    close(&behind(&file), &[wine, Some(Vec3::ZERO), None, wine, wine, None]);
    let parts = file.builder.parts();
    let names: Vec<_> = parts.surfaces.iter().map(|s| parts.materials[s.material.0 as usize].name()).collect();
    assert_eq!(names, ["dielectric", "dielectric", "dielectric", "dielectric", "null", "dielectric"]);
    assert_eq!(told(&text), "");
}

#[test]
fn media_that_scatter_are_left_out_and_told_of() {
    for medium in ["\"string type\" \"homogeneous\"", "\"string type\" \"homogeneous\" \"rgb sigma_a\" [1 1 1]"] {
        let text = format!(
            "WorldBegin\n{LIGHT}MakeNamedMedium \"fog\" {medium}\nMediumInterface \"fog\" \"\" {GLASS} Shape \"sphere\"\n"
        );
        close(&behind(&loaded(&text)), &[None]);
        assert!(told(&text).contains("media do not scatter yet"), "{}", told(&text));
    }
}

#[test]
fn interiors_are_read_back_as_they_were_written() {
    let file = loaded(&format!(
        "WorldBegin\n{LIGHT}{WINE}\
        MakeNamedMedium \"glass\" \"string type\" \"homogeneous\" \"spectrum sigma_a\" [400 1 700 3] \"rgb sigma_s\" [0 0 0]\n\
            #sunfleck \"spectrum ior\" [400 1.6 700 1.5] \"integer priority\" 3\n\
        {GLASS}MediumInterface \"wine\" \"\" Shape \"sphere\" MediumInterface \"glass\" \"\" Shape \"sphere\" \"float radius\" 2\n\
        MediumInterface \"\" \"\" Shape \"sphere\" \"float radius\" 3\n"
    ));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.pbrt");
    write(&path, &Written::from(&file)).unwrap();
    let again = load(std::slice::from_ref(&path), &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    assert!(again.warnings.is_empty(), "{:?}", again.warnings);
    close(&behind(&again), &behind(&file));
    assert!(behind(&file)[2].is_none() && behind(&file)[1].is_some());
    let told = |l: &Loaded| {
        l.builder
            .parts()
            .interiors
            .iter()
            // Where nothing is dispersed, Abbe's number is infinite or none.
            .map(|i| (i.priority, format!("{:.1} {:.4}", i.ior.abbe(), i.ior.d())))
            .collect::<Vec<_>>()
    };
    assert_eq!(told(&again), told(&file));
    assert_eq!(told(&again)[1].0, 3);
}
