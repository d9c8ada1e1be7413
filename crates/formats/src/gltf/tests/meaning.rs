use super::{Maker, below, scene, triangle};
use crate::{LoadOptions, load};
use glam::{Vec2, Vec3};
use serde_json::{Value, json};
use sunfleck::camera::Project;
use sunfleck::light::Emitter;
use sunfleck::math::Ray;
use sunfleck::spectrum::Wavelengths;

#[test]
fn nodes_place_what_hangs_at_them_and_keep_the_outer_side_out() {
    // Moved by 10 along x within a parent that doubles all and moves by 1 along z.
    let file = triangle(&json!([
        { "children": [1], "scale": [2, 2, 2], "translation": [0, 0, 1] },
        { "mesh": 0, "translation": [10, 0, 0] },
    ]));
    let (p, n) = below(&scene(&file), 20.5, 0.5).unwrap();
    assert!(p.distance(Vec3::new(20.5, 0.5, 1.0)) < 1e-5 && n == Vec3::Z);
    assert!(below(&scene(&file), 0.5, 0.5).is_none());
    // A mirror image still faces +z; a matrix does the same.
    let mirrored = triangle(&json!([{ "mesh": 0, "scale": [-1, 1, 1] }]));
    assert_eq!(below(&scene(&mirrored), -0.2, 0.2).unwrap().1, Vec3::Z);
    let matrix = triangle(&json!([{ "mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1] }]));
    assert_eq!(below(&scene(&matrix), 4.8, 0.2).unwrap().1, Vec3::Z);
    // Turned by 90 degrees about z: x becomes y.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let turned = triangle(&json!([{ "mesh": 0, "rotation": [0, 0, half, half] }]));
    assert!(below(&scene(&turned), -0.2, 0.2).is_some() && below(&scene(&turned), 0.2, 0.2).is_none());
    // Shared by two nodes it is one object.
    let twice = scene(&triangle(&json!([{ "mesh": 0 }, { "mesh": 0, "translation": [3, 0, 0] }])));
    assert_eq!((twice.counts().instances, twice.counts().triangles), (2, 1));
    assert!(below(&twice, 3.2, 0.2).is_some());
}

#[test]
fn accessors_may_be_sparse_normalized_strided_and_of_any_kind() {
    let mut m = Maker::new();
    // Zeros but for vertices 2 and 3, as bytes of which 127 means 1.
    let (places, values) = (m.view(&[2, 3]), m.view(&[127, 0, 0, 0, 127, 0]));
    m.accessors.push(json!({
        "componentType": 5120, "type": "VEC3", "count": 4, "normalized": true,
        "sparse": {
            "count": 2,
            "indices": { "bufferView": places, "componentType": 5121 },
            "values": { "bufferView": values },
        },
    }));
    let indices = m.list(5123, "SCALAR", 3, &[0, 0, 2, 0, 3, 0]);
    let file = m.file(&json!({
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": indices }] }],
        "nodes": [{ "mesh": 0 }],
    }));
    assert_eq!(below(&scene(&file), 0.6, 0.3).unwrap().1, Vec3::Z);
    assert!(below(&scene(&file), 0.6, 0.6).is_none());
}

#[test]
fn skins_stand_at_rest_and_morphs_at_their_weights() {
    let mut m = Maker::new();
    let positions = m.floats("VEC3", 3, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let shift = m.floats("VEC3", 3, &[0.0, 0.0, 8.0].repeat(3));
    let joints = m.list(5121, "VEC4", 3, &[0, 1, 0, 0].repeat(3));
    let weights = m.floats("VEC4", 3, &[0.75, 0.25, 0.0, 0.0].repeat(3));
    let bind: Vec<f32> =
        [0.0, 2.0].iter().flat_map(|x| glam::Mat4::from_translation(Vec3::X * *x).to_cols_array()).collect();
    let matrices = m.floats("MAT4", 2, &bind);
    let file = m.file(&json!({
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": positions, "JOINTS_0": joints, "WEIGHTS_0": weights },
            "targets": [{ "POSITION": shift }],
        }], "weights": [0.5] }],
        "skins": [{ "joints": [1, 2], "inverseBindMatrices": matrices }],
        "nodes": [{ "mesh": 0, "skin": 0, "translation": [1000, 0, 0] }, { "translation": [4, 0, 0] }, { "translation": [6, 0, 0] }],
    }));
    // Half of the morph along z; ¾·4 + ¼·(6 + 2) = 5 along x; the place of the node itself does not count.
    let (p, _) = below(&scene(&file), 5.2, 0.2).unwrap();
    assert!((p.z - 4.0).abs() < 1e-5, "{p}");
    assert!(below(&scene(&file), 4.9, 0.2).is_none());
}

#[test]
fn lights_have_the_units_of_the_file_but_for_blenders() {
    let lights = |generator: &str, intensity: f32| {
        let mut file = triangle(&json!([
            { "mesh": 0 },
            { "translation": [0, 0, 2], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        ]));
        file["asset"]["generator"] = json!(generator);
        file["extensionsUsed"] = json!(["KHR_lights_punctual"]);
        let light =
            json!({ "type": "spot", "intensity": intensity, "color": [1, 0.5, 0], "spot": { "outerConeAngle": 0.5 } });
        file["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
        let scene = scene(&file);
        let around = scene.surroundings(Wavelengths::Rgb);
        let at = |from: Vec3| {
            let li = scene.lights()[0].sample_li(from, Vec2::splat(0.5), &around);
            li.map_or(Vec3::ZERO, |s| s.li.to_rgb(Wavelengths::Rgb))
        };
        // On the axis, half-way out in the cosine, and outside.
        let half = (0.5 * (1.0 + 0.5_f32.cos())).acos().tan();
        [at(Vec3::ZERO), at(Vec3::new(2.0 * half, 0.0, 0.0)), at(Vec3::new(2.0 * 0.51_f32.tan(), 0.0, 0.0))]
    };
    let [axis, between, outside] = lights("somebody", 400.0);
    assert!(axis.distance(Vec3::new(100.0, 50.0, 0.0)) < 1e-3, "{axis}");
    let d2 = 4.0 / (0.5 * (1.0 + 0.5_f32.cos())).powi(2);
    assert!((between.x - 400.0 / d2 * 0.25).abs() < 0.02, "{between}");
    assert_eq!(outside, Vec3::ZERO);
    let [blender, ..] = lights("Khronos glTF Blender I/O v4.2", 400.0 * 683.0);
    assert!(blender.distance(axis) < 1e-2, "{blender}");
}

#[test]
fn the_camera_looks_along_minus_z_with_y_up() {
    let mut file =
        triangle(&json!([{ "mesh": 0 }, { "camera": 0, "translation": [1, 2, 3], "rotation": [0, 0.6, 0, 0.8] }]));
    file["cameras"] =
        json!([{ "type": "perspective", "perspective": { "yfov": 1.0, "aspectRatio": 1.5, "znear": 0.1 } }]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gltf");
    std::fs::write(&path, file.to_string()).unwrap();
    let loaded = load(std::slice::from_ref(&path), &LoadOptions { stage: true, ..LoadOptions::default() }).unwrap();
    assert_eq!((loaded.defaults.width, loaded.defaults.height), (750, 500));
    let ray = loaded.camera.build(1.5).unwrap().ray(Vec2::splat(0.5), Vec2::ZERO).ray;
    // A turn about y by twice the angle of sine 0.6.
    let forward = Vec3::new(-0.96, 0.0, -0.28);
    assert!(ray.o == Vec3::new(1.0, 2.0, 3.0) && ray.d.distance(forward) < 1e-6, "{}", ray.d);
    let right = loaded.camera.build(1.5).unwrap().ray(Vec2::new(1.0, 0.5), Vec2::ZERO).ray;
    let edge = (0.5_f32.tan() * 1.5).atan().cos();
    assert!((right.d.dot(forward) - edge).abs() < 1e-6 && right.d.cross(forward).y > 0.0);
    // An orthographic one sees from −ymag to ymag.
    file["cameras"] =
        json!([{ "type": "orthographic", "orthographic": { "xmag": 6, "ymag": 4, "znear": 0, "zfar": 9 } }]);
    std::fs::write(&path, file.to_string()).unwrap();
    let flat = load(std::slice::from_ref(&path), &LoadOptions::default()).unwrap().camera.build(1.5).unwrap();
    let ray = flat.ray(Vec2::new(0.5, 0.0), Vec2::ZERO).ray;
    assert!(ray.d.distance(forward) < 1e-6 && (ray.o.y - 6.0).abs() < 1e-5, "{} {}", ray.o, ray.d);
    // It has an eye, so it gets light and no floor.
    assert_eq!((loaded.surfaces, loaded.lights), (1, 2));
}

#[test]
fn textures_are_turned_as_the_extension_says() {
    // A picture of two pixels, red on the left and green on the right, as the base colour of a quad that is seen head on.
    let png = {
        let pixels =
            image::RgbImage::from_fn(2, 1, |x, _| image::Rgb([255 * u8::from(x == 0), 255 * u8::from(x == 1), 0]));
        let mut bytes = Vec::new();
        pixels.write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png).unwrap();
        bytes
    };
    let seen = |transform: Value, x: f32, y: f32| {
        let mut m = Maker::new();
        let positions = m.floats("VEC3", 4, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
        // v grows downwards: the lower left corner is (0, 1).
        let uvs = m.floats("VEC2", 4, &[0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
        let picture = m.view(&png);
        let file = m.file(&json!({
            "extensionsUsed": ["KHR_texture_transform"],
            "images": [{ "bufferView": picture, "mimeType": "image/png" }],
            "samplers": [{ "wrapS": 33071, "wrapT": 33071 }],
            "textures": [{ "source": 0, "sampler": 0 }],
            "materials": [{ "pbrMetallicRoughness": { "metallicFactor": 0, "baseColorTexture":
                { "index": 0, "extensions": { "KHR_texture_transform": transform } } } }],
            "meshes": [{ "primitives": [{
                "attributes": { "POSITION": positions, "TEXCOORD_0": uvs }, "mode": 6, "material": 0,
            }] }],
            "nodes": [{ "mesh": 0 }],
        }));
        let scene = scene(&file);
        let world = scene.world(Wavelengths::Rgb, 0.5);
        let ray = Ray { o: Vec3::new(x, y, 1.0), d: Vec3::NEG_Z, tmin: 0.0, tmax: f32::INFINITY };
        let hit = world.intersect(&ray).unwrap();
        let f = hit.f(Vec3::new(0.0, 0.6, 0.8), sunfleck::bsdf::Transport::Radiance).to_rgb(Wavelengths::Rgb);
        if f.x > f.y { 'r' } else { 'g' }
    };
    let plain = json!({});
    assert_eq!((seen(plain.clone(), 0.1, 0.5), seen(plain, 0.9, 0.5)), ('r', 'g'));
    let moved = json!({ "offset": [-0.5, 0] });
    assert_eq!((seen(moved.clone(), 0.6, 0.5), seen(moved, 0.9, 0.5)), ('r', 'r'));
    // By a quarter: u' = v, v' = 1 − u. The upper edge (v = 0) shows red, the lower one green.
    let turned = json!({ "offset": [0, 1], "rotation": std::f32::consts::FRAC_PI_2 });
    assert_eq!((seen(turned.clone(), 0.5, 0.9), seen(turned, 0.5, 0.1)), ('r', 'g'));
}

#[test]
fn a_body_absorbs_what_its_volume_says_and_a_sheet_nothing() {
    let sigma = |extensions: Value| {
        let mut file = triangle(&json!([{ "mesh": 0 }]));
        file["materials"] = json!([{ "extensions": extensions }]);
        file["meshes"][0]["primitives"][0]["material"] = json!(0);
        let scene = scene(&file);
        let lanes = Wavelengths::Rgb;
        scene.interiors().iter().map(|i| i.sigma_a(lanes).to_rgb(lanes)).collect::<Vec<_>>()
    };
    let clear = json!({ "transmissionFactor": 1 });
    let volume = |thickness: f32| json!({ "thicknessFactor": thickness, "attenuationColor": [0.5, 0.25, 1], "attenuationDistance": 0.5 });
    let body = sigma(json!({ "KHR_materials_transmission": clear, "KHR_materials_volume": volume(1.0) }));
    // What is left after 0.5 is halved twice as often after 1.
    let want = Vec3::new(4.0f32.ln(), 16.0f32.ln(), 0.0);
    assert!(body.len() == 1 && body[0].distance(want) < 1e-4, "{body:?}");
    assert!(sigma(json!({ "KHR_materials_transmission": clear, "KHR_materials_volume": volume(0.0) })).is_empty());
    assert!(sigma(json!({ "KHR_materials_volume": volume(1.0) })).is_empty());
    let endless = json!({ "thicknessFactor": 1, "attenuationColor": [0.5, 0.25, 1] });
    assert!(sigma(json!({ "KHR_materials_transmission": clear, "KHR_materials_volume": endless })).is_empty());
}
