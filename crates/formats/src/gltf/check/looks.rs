//! Pictures, cameras and lights.

use super::super::data::{Reference, reference};
use super::super::document::Fields;
use super::Rules;
use serde_json::Value;

/// The kinds of pictures that the format has, and the extensions that add others.
const PNG_JPEG: [&str; 2] = ["image/png", "image/jpeg"];
const EXTENDED: [(&str, &str); 2] = [("image/webp", "EXT_texture_webp"), ("image/ktx2", "KHR_texture_basisu")];

impl Rules<'_> {
    pub(super) fn looks(&mut self) {
        for (i, image) in self.list("images").iter().enumerate() {
            self.image(image, &format!("images[{i}]"));
        }
        for (i, texture) in self.list("textures").iter().enumerate() {
            self.texture(texture, &format!("textures[{i}]"));
        }
        for (i, camera) in self.list("cameras").iter().enumerate() {
            self.camera(camera, &format!("cameras[{i}]"));
        }
        let lights = self.root.extension("KHR_lights_punctual").map_or(&[][..], |e| e.items("lights"));
        for (i, light) in lights.iter().enumerate() {
            self.light(light, &format!("extensions.KHR_lights_punctual.lights[{i}]"));
        }
    }

    fn image(&mut self, image: &Value, path: &str) {
        let (view, uri) = (image.index("bufferView"), image.text("uri"));
        if view.is_some() == uri.is_some() {
            self.lapse("gltf::image", path, "exactly one of `uri` and `bufferView` must be there");
        }
        let said = image.text("mimeType");
        if view.is_some() && said.is_none() {
            self.lapse("gltf::mime", path, "an image in a buffer must have a `mimeType`");
        }
        if view.and_then(|v| self.list("bufferViews").get(v)).is_some_and(|v| v.get("byteStride").is_some()) {
            self.lapse("gltf::stride", path, "the view of an image must not have a `byteStride`");
        }
        let mut found = view.and_then(|v| self.buffers.view(self.root, v)).map(|b| kind_of(b).to_owned());
        let mut declared = said.map(str::to_owned);
        match uri.map(reference) {
            Some(Err(reason)) => self.lapse("gltf::uri", path, reason),
            Some(Ok(Reference::Data { mime, bytes })) => {
                found = Some(kind_of(&bytes).to_owned());
                if !PNG_JPEG.contains(&mime.as_str()) && EXTENDED.iter().all(|(m, _)| *m != mime) {
                    self.lapse("gltf::uri", path, format_args!("`{mime}` is no kind of picture that glTF has"));
                }
                declared = declared.or(Some(mime));
            }
            _ => {}
        }
        let Some(found) = found.filter(|f| !f.is_empty()) else { return };
        if declared.as_ref().is_some_and(|d| *d != found) {
            let message = format!("the picture is of the kind {found}, not {}", declared.unwrap_or_default());
            return self.lapse("gltf::mime", path, message);
        }
        let used = self.list("extensionsUsed");
        if let Some((_, needed)) =
            EXTENDED.iter().find(|(m, e)| *m == found && !used.iter().any(|u| u.as_str() == Some(e)))
        {
            self.lapse("gltf::mime", path, format_args!("{found} needs the extension {needed}"));
        }
    }

    fn texture(&mut self, texture: &Value, path: &str) {
        for (mime, name) in EXTENDED {
            let source = texture.extension(name).and_then(|e| e.index("source"));
            let Some(image) = source.and_then(|s| self.list("images").get(s)) else { continue };
            if image.text("mimeType").is_some_and(|m| m != mime) {
                self.lapse(
                    "gltf::mime",
                    format_args!("{path}.extensions.{name}"),
                    format_args!("its picture is not of the kind {mime}"),
                );
            }
        }
    }

    fn camera(&mut self, camera: &Value, path: &str) {
        let has = |key: &str| camera.get(key).is_some();
        if has("orthographic") == has("perspective") {
            let message = "exactly one of `orthographic` and `perspective` must be there";
            self.lapse("gltf::camera", path, message);
        }
        for kind in ["orthographic", "perspective"] {
            let lens = camera.field(kind);
            let depth = |key: &str| lens.field(key).as_f64();
            if let (Some(near), Some(far)) = (depth("znear"), depth("zfar"))
                && far <= near
            {
                self.lapse("gltf::camera", format_args!("{path}.{kind}"), "`zfar` is not more than `znear`");
            }
        }
        let lens = camera.field("orthographic");
        if lens.is_object() && (lens.number("xmag", 1.0) == 0.0 || lens.number("ymag", 1.0) == 0.0) {
            self.error("gltf::camera", format_args!("{path}.orthographic"), "`xmag` and `ymag` must not be 0");
        }
    }

    fn light(&mut self, light: &Value, path: &str) {
        if light.text("type") != Some("spot") {
            return;
        }
        let Some(cone) = light.get("spot") else { return self.error("gltf::missing", path, "`spot` is missing") };
        let (inner, outer) =
            (cone.number("innerConeAngle", 0.0), cone.number("outerConeAngle", std::f32::consts::FRAC_PI_4));
        if inner >= outer {
            self.lapse("gltf::light", path, "`innerConeAngle` is not less than `outerConeAngle`");
        }
    }
}

/// The kind of a picture by its first bytes; empty if it is not known.
fn kind_of(bytes: &[u8]) -> &'static str {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => "image/png",
        [0xFF, 0xD8, 0xFF, ..] => "image/jpeg",
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => "image/webp",
        [0xAB, b'K', b'T', b'X', b' ', b'2', b'0', ..] => "image/ktx2",
        _ => "",
    }
}
