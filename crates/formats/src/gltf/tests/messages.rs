use super::{check, read, refusal, told};
use crate::diagnostic::Severity;
use serde_json::json;

#[test]
fn mistakes_are_told_with_their_place_in_the_json() {
    let cut = "{\n  \"asset\": { \"version\": \"2.0\" },\n  \"nodes\": [ { \"mesh\": 0, ] }\n}";
    insta::assert_snapshot!("syntax", refusal(cut.as_bytes()).to_string());
    insta::assert_snapshot!("no_mesh", told(&json!({ "asset": { "version": "2.0" }, "nodes": [{ "mesh": 7 }] })));
    let required = json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_materials_sheem"],
        "extensionsRequired": ["KHR_materials_sheem"],
    });
    insta::assert_snapshot!("required_extension", told(&required));
    let several = json!({
        "asset": { "version": "2.0" },
        "materials": [{ "pbrMetallicRoughness": { "metallicFactor": 2, "baseColorFactor": [1, 1, 1] } }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": "wide" } }],
    });
    insta::assert_snapshot!("values", told(&several));
    let missing = json!({ "asset": { "version": "2.0" }, "buffers": [{ "byteLength": 3, "uri": "a.bin" }] });
    insta::assert_snapshot!("missing_file", told(&missing));
    insta::assert_snapshot!("old_version", told(&json!({ "asset": { "version": "1.0" } })));
    insta::assert_snapshot!(
        "loop",
        told(&json!({
            "asset": { "version": "2.0" },
            "nodes": [{ "children": [1] }, { "children": [2] }, { "children": [0] }],
        }))
    );
}

#[test]
fn lapses_are_told_as_errors_and_refused_by_the_strict() {
    let file = json!({ "asset": { "version": "2.0" }, "nodes": [], "extensionsUsed": ["EXT_unheard_of"] });
    let (_, warnings) = read(&file);
    let codes: Vec<&str> = warnings.iter().map(|w| w.code).collect();
    assert_eq!(codes, ["gltf::extension", "gltf::empty"]);
    assert!(warnings[0].message.contains("EXT_unheard_of"));
    assert_eq!(warnings.iter().map(|w| w.severity).collect::<Vec<_>>(), [Severity::Warning, Severity::Error]);
    let error = check("a.gltf", file.to_string().into_bytes(), true).map(|_| ()).unwrap_err();
    assert_eq!((error.errors.len(), error.errors[0].code), (1, "gltf::empty"));
}

#[test]
fn containers_are_taken_apart_with_care() {
    let json = br#"{"asset":{"version":"2.0"}}  "#;
    let glb = |length: u32, chunks: &[(&[u8; 4], u32, &[u8])]| {
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        bytes.extend(length.to_le_bytes());
        for (kind, size, data) in chunks {
            bytes.extend(size.to_le_bytes());
            bytes.extend(*kind);
            bytes.extend(*data);
        }
        bytes
    };
    let all = 20 + json.len() as u32 - 1;
    let text = &json[..json.len() - 1];
    assert!(check("a.glb", glb(all, &[(b"JSON", text.len() as u32, text)]), false).is_ok());
    for (bytes, word) in [
        (glb(all + 4, &[(b"JSON", text.len() as u32, text)]), "but it has"),
        (glb(all, &[(b"JSON", 1 << 30, text)]), "only 28 follow"),
        (glb(all, &[(b"BIN\0", text.len() as u32, text)]), "comes first"),
        (glb(20, &[(b"JSON", 0, b"")]), "empty"),
        (b"glTF\x01\0\0\0\0\0\0\0".to_vec(), "version 1"),
        (b"glTF\x02\0".to_vec(), "within its header"),
        (b"version https://git-lfs.github.com/spec/v1\n".to_vec(), "git lfs pull"),
    ] {
        let text = refusal(&bytes).to_string();
        assert!(text.contains(word), "{word}: {text}");
    }
}
