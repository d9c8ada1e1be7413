//! Small files, made here.

mod brushed;
mod limits;
mod meaning;
mod messages;

use super::check;
use crate::Error;
use crate::diagnostic::Diagnostic;
use glam::Vec3;
use serde_json::{Value, json};
use sunfleck::math::Ray;
use sunfleck::scene::{Scene, SceneBuilder};
use sunfleck::spectrum::Wavelengths;

/// Bytes as base64 (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let word = three.iter().fold(0, |w, b| w << 8 | u32::from(*b)) << (8 * (3 - three.len()));
        let digit = |i: usize| char::from(DIGITS[(word >> (18 - 6 * i)) as usize & 63]);
        text.extend((0..=three.len()).map(digit));
        text.extend(std::iter::repeat_n('=', 3 - three.len()));
    }
    text
}

/// A file in the making: accessors over one buffer.
struct Maker {
    data: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Maker {
    fn new() -> Self {
        Self { data: Vec::new(), views: Vec::new(), accessors: Vec::new() }
    }
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.data.resize(self.data.len().next_multiple_of(4), 0);
        self.views.push(json!({ "buffer": 0, "byteOffset": self.data.len(), "byteLength": bytes.len() }));
        self.data.extend(bytes);
        self.views.len() - 1
    }
    fn list(&mut self, component: u32, kind: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        self.accessors.push(json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }));
        self.accessors.len() - 1
    }
    fn floats(&mut self, kind: &str, count: usize, values: &[f32]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.list(5126, kind, count, &bytes)
    }
    /// The file, with what `more` has.
    fn file(self, more: &Value) -> Value {
        let uri = format!("data:application/octet-stream;base64,{}", base64(&self.data));
        let mut file = json!({
            "asset": { "version": "2.0" },
            "buffers": [{ "byteLength": self.data.len(), "uri": uri }],
            "bufferViews": self.views,
            "accessors": self.accessors,
        });
        for (key, value) in more.as_object().unwrap() {
            file[key] = value.clone();
        }
        file
    }
}

/// A triangle at z = 0 over (0, 0), (1, 0), (0, 1), facing +z, with nodes as given.
fn triangle(nodes: &Value) -> Value {
    let mut m = Maker::new();
    let positions = m.floats("VEC3", 3, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    m.file(&json!({
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": positions } }] }],
        "nodes": nodes,
    }))
}

fn read(file: &Value) -> (SceneBuilder, Vec<Diagnostic>) {
    check("a.gltf", file.to_string().into_bytes(), false).unwrap_or_else(|e| panic!("{e}"))
}

fn scene(file: &Value) -> Scene {
    read(file).0.build().unwrap()
}

/// Where a ray along −z above (x, y) meets something, and the normal there.
fn below(scene: &Scene, x: f32, y: f32) -> Option<(Vec3, Vec3)> {
    let ray = Ray { o: Vec3::new(x, y, 100.0), d: Vec3::NEG_Z, tmin: 0.0, tmax: f32::INFINITY };
    scene.world(Wavelengths::Rgb, 0.5).intersect(&ray).map(|i| (i.p, i.ng))
}

fn told(file: &Value) -> String {
    refusal(file.to_string().as_bytes()).to_string()
}

fn refusal(bytes: &[u8]) -> Error {
    check("a.gltf", bytes.to_vec(), false).map(|_| ()).unwrap_err()
}
