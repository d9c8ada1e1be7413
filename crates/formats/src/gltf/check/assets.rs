//! The version of the format, and the extensions that a file uses.

use super::super::document::Fields;
use super::super::findings::Findings;
use super::super::schema::UNDERSTOOD;
use crate::diagnostic::Sink;
use serde_json::Value;

/// Extensions that change nothing in a picture at rest, so that a file may require them.
const HARMLESS: &[&str] = &["KHR_animation_pointer", "KHR_xmp", "KHR_xmp_json_ld", "EXT_structural_metadata"];

/// Extensions whose data cannot be read by those who do not know them.
const NEVER_OPTIONAL: &[&str] = &["KHR_mesh_quantization"];

/// Checks that this reader can make sense of the file.
pub(in super::super) fn version_and_extensions(root: &Value, told: &Findings, sink: &mut Sink) {
    let asset = root.field("asset");
    if let Some(text) = asset.text("version") {
        version(text, "asset.version", told, sink);
        let least = asset.text("minVersion");
        if let Some(least) = least {
            version(least, "asset.minVersion", told, sink);
            if number(least) > number(text) {
                told.lapse(sink, "gltf::version", "asset.minVersion", "it is higher than `version`");
            }
        }
    }
    let names = |key: &str| root.items(key).iter().filter_map(Value::as_str).collect::<Vec<_>>();
    let (used, required) = (names("extensionsUsed"), names("extensionsRequired"));
    let is_known = |name: &str| UNDERSTOOD.contains(&name) || HARMLESS.contains(&name);
    for (i, name) in required.iter().enumerate() {
        let path = format!("extensionsRequired[{i}]");
        if !is_known(name) {
            let message =
                format!("{path}: the file cannot be shown without the extension `{name}`, which is not supported");
            sink.error(told.file_error("gltf::extension", message).one_of(name, UNDERSTOOD.iter().copied()));
        }
        if !used.contains(name) {
            told.lapse(sink, "gltf::undeclared", path, format_args!("`{name}` is not named in `extensionsUsed`"));
        }
    }
    let unknown: Vec<&str> = used.iter().filter(|n| !is_known(n) && !required.contains(n)).copied().collect();
    if !unknown.is_empty() {
        let message = format!("not supported, and passed over: {}", unknown.join(", "));
        told.warn(sink, "gltf::extension", "extensionsUsed", message);
    }
    for name in used.iter().filter(|n| NEVER_OPTIONAL.contains(n) && !required.contains(n)) {
        told.lapse(sink, "gltf::undeclared", "extensionsUsed", format_args!("`{name}` must be required, too"));
    }
}

/// Major and minor version.
fn number(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}

fn version(text: &str, path: &str, told: &Findings, sink: &mut Sink) {
    match number(text) {
        None => {
            let error = told.file_error("gltf::version", format!("{path}: `{text}` is no version"));
            sink.error(error.expected("major and minor number such as 2.0"));
        }
        Some((2, 0)) => {}
        Some((2, _)) => told.warn(sink, "gltf::version", path, format_args!("`{text}` is read as 2.0")),
        Some((1, _)) => {
            let error = told.file_error("gltf::version", format!("{path}: this file is of the old version {text}"));
            sink.error(error.expected("2.0").help("convert it to glTF 2.0 first"));
        }
        Some(_) => {
            sink.error(
                told.file_error("gltf::version", format!("{path}: version {text} is not known")).expected("2.0"),
            );
        }
    }
}
