//! Brushed metal.

use super::{Maker, read};
use crate::diagnostic::Diagnostic;
use glam::{Vec2, Vec3};
use serde_json::{Value, json};
use sunfleck::bsdf::{Covering, Lookup, Material};
use sunfleck::scene::{Parts, SceneBuilder};
use sunfleck::spectrum::Wavelengths;

/// A triangle of a material with these words of the extension; texture 0 is of one pixel, (64, 191, 128) of 255.
fn brushed(pbr: &Value, extension: &Value) -> (SceneBuilder, Vec<Diagnostic>) {
    let mut m = Maker::new();
    let positions = m.floats("VEC3", 3, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let uvs = m.floats("VEC2", 3, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let mut bytes = Vec::new();
    let pixel = image::RgbImage::from_pixel(1, 1, image::Rgb([64, 191, 128]));
    pixel.write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png).unwrap();
    let picture = m.view(&bytes);
    let attributes = json!({ "POSITION": positions, "TEXCOORD_0": uvs });
    let material = json!({ "pbrMetallicRoughness": pbr, "extensions": { "KHR_materials_anisotropy": extension } });
    read(&m.file(&json!({
        "extensionsUsed": ["KHR_materials_anisotropy"],
        "images": [{ "bufferView": picture, "mimeType": "image/png" }],
        "textures": [{ "source": 0 }],
        "materials": [material],
        "meshes": [{ "primitives": [{ "attributes": attributes, "material": 0 }] }],
        "nodes": [{ "mesh": 0 }],
    })))
}

/// Perceived roughness along and across.
fn roughness(parts: &Parts) -> [f32; 2] {
    let model = parts.materials.iter().find_map(|m| if let Material::Principled(p) = m { Some(p) } else { None });
    let at = Lookup::new(parts.textures, Vec2::splat(0.5), Vec3::ZERO, Wavelengths::Rgb);
    let r = model.unwrap().roughness;
    [at.scalar(r.u), at.scalar(r.v)]
}

fn is_near(got: [f32; 2], want: [f32; 2]) -> bool {
    got.iter().zip(want).all(|(g, w)| (g - w).abs() < 2e-3)
}

#[test]
fn metal_is_brushed_by_the_square_of_the_strength_and_at_an_angle() {
    let (b, told) =
        brushed(&json!({ "roughnessFactor": 0.5 }), &json!({ "anisotropyStrength": 0.5, "anisotropyRotation": 1.2 }));
    assert!(told.iter().all(|t| t.code == "gltf::bounds"), "{told:?}");
    // α across is 0.25, and along 0.25 + 0.75 · 0.25.
    assert!(is_near(roughness(&b.parts()), [0.4375_f32.sqrt(), 0.5]), "{:?}", roughness(&b.parts()));
    let Some(Material::Covering(Covering::Turned(t))) = b.parts().materials.last() else { panic!("not turned") };
    assert!((t.angle - 1.2).abs() < 1e-6 && t.direction.is_none());
}

#[test]
fn a_picture_gives_direction_and_strength_and_roughness_may_be_one_too() {
    let by_picture = json!({ "anisotropyStrength": 0.5, "anisotropyTexture": { "index": 0 } });
    let (b, told) = brushed(&json!({ "roughnessFactor": 0.5 }), &by_picture);
    assert!(told.iter().all(|t| t.code == "gltf::bounds"), "{told:?}");
    let strength = 0.5 * 128.0 / 255.0;
    let alpha = 0.25 + 0.75 * strength * strength;
    assert!(is_near(roughness(&b.parts()), [f32::sqrt(alpha), 0.5]), "{:?}", roughness(&b.parts()));
    let Some(Material::Covering(Covering::Turned(t))) = b.parts().materials.last() else { panic!("not turned") };
    let at = Lookup::new(b.parts().textures, Vec2::splat(0.5), Vec3::ZERO, Wavelengths::Rgb);
    let drawn = at.rgb(t.direction.unwrap());
    assert!((drawn - Vec3::new(64.0, 191.0, 128.0) / 255.0).abs().max_element() < 1e-3, "{drawn}");

    let rough = json!({ "roughnessFactor": 0.8, "metallicRoughnessTexture": { "index": 0 } });
    let (b, told) = brushed(&rough, &json!({ "anisotropyStrength": 1.0 }));
    assert!(told.iter().all(|t| t.code == "gltf::bounds"), "{told:?}");
    assert!(is_near(roughness(&b.parts()), [1.0, 0.8 * 191.0 / 255.0]), "{:?}", roughness(&b.parts()));
}
