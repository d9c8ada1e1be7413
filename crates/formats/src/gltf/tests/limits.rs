use super::{Maker, check, told};
use proptest::prelude::*;
use serde_json::{Value, json};

#[test]
fn small_files_cannot_ask_for_much_memory() {
    let huge = |accessor: Value| {
        json!({
            "asset": { "version": "2.0" },
            "accessors": [accessor],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
            "nodes": [{ "mesh": 0 }],
        })
    };
    let text = told(&huge(json!({ "componentType": 5126, "type": "VEC3", "count": 4_000_000_000_u64 })));
    assert!(text.contains("without data are too many"), "{text}");
    // A meshopt stream of eight bytes that is said to unpack to a gigabyte.
    let mut m = Maker::new();
    let stream = m.view(&[0xA0, 0, 0, 0, 0, 0, 0, 0]);
    let mut file = m.file(&json!({ "extensionsUsed": ["EXT_meshopt_compression"] }));
    file["bufferViews"][stream]["extensions"] = json!({ "EXT_meshopt_compression": {
        "buffer": 0, "byteLength": 8, "byteStride": 16, "count": 1 << 26, "mode": "ATTRIBUTES",
    } });
    assert!(told(&file).contains("which no such stream does"), "{}", told(&file));
    // Many primitives over the same vertices: what comes out is measured by what went in.
    let mut m = Maker::new();
    let positions = m.floats("VEC3", 30_000, &[0.0, 1.0, 3.0, 2.0, 5.0, 4.0, 9.0, 7.0, 0.5].repeat(10_000));
    let primitives = vec![json!({ "attributes": { "POSITION": positions } }); 3000];
    let file = m.file(&json!({ "meshes": [{ "primitives": primitives }], "nodes": [{ "mesh": 0 }] }));
    assert!(told(&file).contains("more than a file of this size can mean"));
}

/// A file with most of what there is to read.
fn rich() -> Vec<u8> {
    let mut m = Maker::new();
    let positions = m.floats("VEC3", 3, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    let joints = m.list(5121, "VEC4", 3, &[0; 12]);
    let weights = m.floats("VEC4", 3, &[1.0, 0.0, 0.0, 0.0].repeat(3));
    let indices = m.list(5123, "SCALAR", 3, &[0, 0, 1, 0, 2, 0]);
    let file = m.file(&json!({
        "extensionsUsed": ["KHR_materials_transmission", "EXT_mesh_gpu_instancing", "KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point" }] } },
        "materials": [{ "alphaMode": "BLEND", "emissiveFactor": [1, 0, 0], "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.5] },
            "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.5 } } }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": positions, "JOINTS_0": joints, "WEIGHTS_0": weights },
            "indices": indices, "material": 0, "targets": [{ "POSITION": 0 }] }], "weights": [1] }],
        "skins": [{ "joints": [1] }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 1, "znear": 1 } }],
        "nodes": [{ "mesh": 0, "skin": 0, "children": [1, 2] }, { "camera": 0, "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "mesh": 0, "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 0 } } } }],
        "scenes": [{ "nodes": [0] }], "scene": 0,
    }));
    file.to_string().into_bytes()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]
    #[test]
    fn no_mutation_of_a_file_makes_the_reader_panic(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), prop_oneof![Just(b'9'), Just(b'0'), Just(b'-'), any::<u8>()]), 1..6),
        strict in any::<bool>(),
    ) {
        let mut bytes = rich();
        for (at, value) in &edits {
            let at = at.index(bytes.len());
            bytes[at] = *value;
        }
        match check("a.gltf", bytes, strict) {
            Ok((builder, _)) => { let _ = builder.build(); }
            Err(error) => prop_assert!(error.errors.iter().all(|e| e.place.is_some() && !e.render(false).is_empty())),
        }
    }
}

#[test]
fn the_rich_file_itself_is_read_without_a_word() {
    let (builder, warnings) = check("a.gltf", rich(), false).unwrap();
    let texts: Vec<String> = warnings.iter().map(|w| w.message.clone()).filter(|t| !t.contains("min")).collect();
    assert!(texts.is_empty(), "{texts:?}");
    let counts = builder.build().unwrap().counts();
    assert_eq!((counts.surfaces, counts.lights), (4, 5));
}
