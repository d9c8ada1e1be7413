//! Animations. A picture at rest does not need them, so all of these are lapses.

use super::super::data::Component;
use super::super::document::Fields;
use super::Rules;
use serde_json::Value;
use std::collections::BTreeSet;

impl Rules<'_> {
    pub(super) fn animations(&mut self) {
        for (a, animation) in self.list("animations").iter().enumerate() {
            let samplers = animation.items("samplers");
            let mut seen = BTreeSet::new();
            for (c, channel) in animation.items("channels").iter().enumerate() {
                let path = format!("animations[{a}].channels[{c}]");
                let target = channel.field("target");
                let aim = (target.index("node"), target.text("path"));
                if aim.0.is_some() && !seen.insert(aim) {
                    self.lapse("gltf::animation", &path, "another channel has the same target");
                }
                self.target(target, &path);
                match channel.index("sampler").and_then(|s| samplers.get(s)) {
                    Some(sampler) => self.channel(sampler, target.text("path").unwrap_or(""), &path),
                    None => self.lapse("gltf::animation", &path, "its sampler does not exist"),
                }
            }
            for (s, sampler) in samplers.iter().enumerate() {
                self.sampler(sampler, &format!("animations[{a}].samplers[{s}]"));
            }
        }
    }

    fn target(&mut self, target: &Value, path: &str) {
        let Some(node) = target.index("node").and_then(|n| self.list("nodes").get(n)) else { return };
        if target.text("path") == Some("weights") {
            let mesh = node.index("mesh").and_then(|m| self.list("meshes").get(m));
            let has_targets = |m: &Value| m.items("primitives").iter().any(|p| !p.items("targets").is_empty());
            if !mesh.is_some_and(has_targets) {
                self.lapse("gltf::animation", path, "its node has no morph targets");
            }
        } else if node.get("matrix").is_some() {
            self.lapse("gltf::animation", path, "its node has a `matrix`");
        }
    }

    fn sampler(&mut self, sampler: &Value, path: &str) {
        for key in ["input", "output"] {
            let view = sampler.index(key).and_then(|a| self.view_of(a));
            if view.is_some_and(|(_, json)| json.get("byteStride").is_some()) {
                self.lapse("gltf::animation", format_args!("{path}.{key}"), "its view must not have a `byteStride`");
            }
        }
        let Some(input) = sampler.index("input") else { return };
        let Some(format) = self.format(input) else { return };
        if format.kind != "SCALAR" || format.component != Component::F32 {
            self.lapse("gltf::animation", format_args!("{path}.input"), "times must be single floats");
        }
        let json = &self.list("accessors")[input];
        if json.get("min").is_none() || json.get("max").is_none() {
            self.lapse("gltf::animation", format_args!("{path}.input"), "times must have `min` and `max`");
        }
        if sampler.text("interpolation") == Some("CUBICSPLINE") && format.count < 2 {
            self.lapse("gltf::animation", format_args!("{path}.input"), "splines need two times");
        }
    }

    /// Whether what a sampler gives is what its target takes.
    fn channel(&mut self, sampler: &Value, aim: &str, path: &str) {
        let input = sampler.index("input").and_then(|a| self.format(a));
        let output = sampler.index("output").and_then(|a| self.format(a));
        let (Some(input), Some(output)) = (input, output) else { return };
        let kind = match aim {
            "rotation" => "VEC4",
            "translation" | "scale" => "VEC3",
            "weights" => "SCALAR",
            _ => return,
        };
        let is_number =
            output.component == Component::F32 || output.normalized && aim != "translation" && aim != "scale";
        if output.kind != kind || !is_number {
            self.lapse("gltf::animation", path, format_args!("the output of its sampler is no list of {kind}"));
        }
        let each = if sampler.text("interpolation") == Some("CUBICSPLINE") { 3 } else { 1 };
        if aim != "weights" && output.count != input.count.saturating_mul(each) {
            self.lapse("gltf::animation", path, "its sampler has not as many values as times");
        }
    }
}
