//! The numbers themselves.

use super::super::data::{Component, Reference, reference};
use super::super::document::{Fields, whole};
use super::Rules;
use glam::Vec3;
use serde_json::Value;

/// How far from 1 the length of a direction may be, and the sum of weights for each of them.
const UNIT_ERROR: f32 = 5e-4;
const WEIGHT_ERROR: f32 = 2e-3;

impl Rules<'_> {
    pub(super) fn values(&mut self) {
        for (i, json) in self.list("accessors").iter().enumerate() {
            self.bounds(i, json);
        }
        for (m, mesh) in self.list("meshes").iter().enumerate() {
            for (p, primitive) in mesh.items("primitives").iter().enumerate() {
                self.vertices(primitive, &format!("meshes[{m}].primitives[{p}]"));
            }
        }
        for (s, skin) in self.list("skins").iter().enumerate() {
            let matrices = skin.index("inverseBindMatrices").and_then(|a| self.open(a)).map(|a| a.floats::<16>());
            let is_affine = |m: &[f32; 16]| [m[3], m[7], m[11], m[15]] == [0.0, 0.0, 0.0, 1.0];
            if !matrices.unwrap_or_default().iter().all(is_affine) {
                self.lapse(
                    "gltf::skin",
                    format_args!("skins[{s}].inverseBindMatrices"),
                    "the last row of one is not 0 0 0 1",
                );
            }
        }
        for (i, node) in self.list("nodes").iter().enumerate() {
            if node.get("matrix").is_some() && !is_decomposable(&node.numbers("matrix", [0.0; 16])) {
                self.lapse("gltf::transform", format_args!("nodes[{i}].matrix"), "it shears, or is no placing at all");
            }
        }
        self.pictures();
        self.times();
    }

    /// Floats are finite, and `min` and `max` are those of the elements.
    fn bounds(&mut self, index: usize, json: &Value) {
        let Some(list) = self.open(index) else { return };
        let (width, is_float) = (list.width, list.component == Component::F32);
        let values = list.raw::<16>();
        let path = format!("accessors[{index}]");
        let used = |v: &[f32; 16]| v.iter().take(width).all(|x| x.is_finite());
        if is_float && !values.iter().all(used) {
            return self.lapse("gltf::not-finite", path, "an element is infinite, or no number");
        }
        for (key, pick) in [("min", f32::min as fn(f32, f32) -> f32), ("max", f32::max)] {
            let said: Vec<f32> = json.items(key).iter().filter_map(Value::as_f64).map(|v| v as f32).collect();
            if said.len() != width {
                continue;
            }
            let found = (0..width).map(|i| values.iter().map(|v| v[i]).reduce(pick).unwrap_or(said[i]));
            if found.zip(&said).any(|(found, said)| found != *said) {
                self.lapse("gltf::bounds", &path, format_args!("`{key}` is not that of the elements"));
            }
        }
    }

    fn vertices(&mut self, primitive: &Value, path: &str) {
        let attributes = primitive.field("attributes");
        let vertices = whole(attributes.field("POSITION")).and_then(|a| self.format(a)).map(|f| f.count);
        if let Some(list) = primitive.index("indices").and_then(|a| self.open(a)) {
            // The largest number of the type is kept free; graphics cards begin anew there.
            let limit = vertices.unwrap_or(usize::MAX).min(list.component.largest().unwrap_or(0.0) as usize);
            if let Some([index]) = list.wholes::<1>().iter().find(|[i]| *i as usize >= limit) {
                self.error("gltf::indices", format_args!("{path}.indices"), format_args!("{index} is no vertex"));
            }
        }
        for (name, index) in attributes.as_object().into_iter().flatten() {
            let Some(list) = whole(index).and_then(|a| self.open(a)) else { continue };
            let values = list.floats::<4>();
            let (path, width) = (format!("{path}.attributes.{name}"), list.width);
            let length = |v: &[f32; 4]| Vec3::new(v[0], v[1], v[2]).length();
            match name.as_str() {
                "NORMAL" | "TANGENT" if values.iter().any(|v| (length(v) - 1.0).abs() > UNIT_ERROR) => {
                    self.lapse("gltf::unit", path, "an element has not the length 1");
                }
                "TANGENT" if values.iter().any(|v| v[3].abs() != 1.0) => {
                    self.lapse("gltf::unit", path, "the sign of an element is neither 1 nor -1");
                }
                _ if name.starts_with("COLOR")
                    && values.iter().any(|v| v[..width.min(4)].iter().any(|c| !(0.0..=1.0).contains(c))) =>
                {
                    self.lapse("gltf::colour", path, "a value is not between 0 and 1");
                }
                _ if name.starts_with("WEIGHTS") => self.weights(&values, &path),
                _ => {}
            }
        }
    }

    fn weights(&mut self, values: &[[f32; 4]], path: &str) {
        // Several lists of weights add up to 1 together; one alone cannot tell.
        let is_alone = path.ends_with("WEIGHTS_0");
        let is_off =
            |v: &[f32; 4]| v.iter().any(|w| *w < 0.0) || is_alone && (v.iter().sum::<f32>() - 1.0).abs() > WEIGHT_ERROR;
        if values.iter().any(is_off) {
            self.lapse("gltf::weights", path, "weights are negative, or do not add up to 1");
        }
    }

    /// Pictures that nobody uses are read, too.
    fn pictures(&mut self) {
        for (i, image) in self.list("images").iter().enumerate() {
            let view = image.index("bufferView").and_then(|v| self.buffers.view(self.root, v));
            let bytes = match (view, image.text("uri").map(reference)) {
                (Some(view), _) => Ok(view.to_vec()),
                (None, Some(Ok(Reference::Data { bytes, .. }))) => Ok(bytes),
                (None, Some(Ok(Reference::File(name)))) => self.files.read(&self.files.find(&name, "")),
                _ => continue,
            };
            let read = bytes.and_then(|bytes| crate::image::read_image_bytes("", &bytes));
            // What no reader knows is odd, but no damage.
            if let Err(error) = read
                && error.errors.iter().all(|e| e.code != "image::unknown-format")
            {
                let reason = error.errors.first().map_or("it cannot be read", |e| e.message.as_str());
                self.lapse("gltf::picture", format_args!("images[{i}]"), reason);
            }
        }
    }

    /// Times of animations grow, and their turns are turns.
    fn times(&mut self) {
        for (a, animation) in self.list("animations").iter().enumerate() {
            let samplers = animation.items("samplers");
            for (s, sampler) in samplers.iter().enumerate() {
                let times =
                    sampler.index("input").and_then(|i| self.open(i)).map(|l| l.floats::<1>()).unwrap_or_default();
                let path = format!("animations[{a}].samplers[{s}]");
                if times.iter().any(|[t]| *t < 0.0) || times.windows(2).any(|w| w[0] >= w[1]) {
                    self.lapse("gltf::animation", &path, "times are negative, or do not grow");
                }
                let turns =
                    |c: &&Value| c.index("sampler") == Some(s) && c.field("target").text("path") == Some("rotation");
                if !animation.items("channels").iter().any(|c| turns(&c)) {
                    continue;
                }
                let values =
                    sampler.index("output").and_then(|i| self.open(i)).map(|l| l.floats::<4>()).unwrap_or_default();
                // Of splines only the middle one of three is a value.
                let step = if sampler.text("interpolation") == Some("CUBICSPLINE") { (1, 3) } else { (0, 1) };
                let mut turns = values.iter().skip(step.0).step_by(step.1);
                if turns.any(|q| (q.iter().map(|v| v * v).sum::<f32>().sqrt() - 1.0).abs() > UNIT_ERROR) {
                    self.lapse("gltf::animation", &path, "a rotation is no quaternion of length 1");
                }
            }
        }
    }
}

/// Whether a matrix is a shift, a turn and a stretch along the axes.
fn is_decomposable(m: &[f32; 16]) -> bool {
    let column = |i: usize| Vec3::new(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
    let [x, y, z] = [column(0), column(1), column(2)];
    let right = |a: Vec3, b: Vec3| a.dot(b).abs() <= 1e-3 * a.length() * b.length();
    let is_placing = [m[3], m[7], m[11], m[15]] == [0.0, 0.0, 0.0, 1.0];
    is_placing && right(x, y) && right(y, z) && right(z, x) && x.cross(y).dot(z) != 0.0
}
