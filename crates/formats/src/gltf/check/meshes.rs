//! Meshes and their primitives (glTF 2.0, section 3.7).

use super::super::data::Component;
use super::super::document::{Fields, whole};
use super::{Format, Rules};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Views that hold indices, and views that hold vertices (`target`).
const INDICES: usize = 34_963;
const VERTICES: usize = 34_962;

/// Attributes with a number behind the name.
const NUMBERED: [&str; 4] = ["TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"];

impl Rules<'_> {
    pub(super) fn meshes(&mut self) {
        for (m, mesh) in self.list("meshes").iter().enumerate() {
            let primitives = mesh.items("primitives");
            let targets: Vec<usize> = primitives.iter().map(|p| p.items("targets").len()).collect();
            let path = format!("meshes[{m}]");
            if targets.windows(2).any(|pair| pair[0] != pair[1]) {
                self.lapse("gltf::morph", &path, "its primitives have different numbers of morph targets");
            }
            let weights = mesh.items("weights").len();
            if weights > 0 && targets.first().is_some_and(|t| *t != weights) {
                let message = format!("there are {weights} weights for {} morph targets", targets[0]);
                self.lapse("gltf::morph", &path, message);
            }
            for (p, primitive) in primitives.iter().enumerate() {
                self.primitive(primitive, &format!("{path}.primitives[{p}]"));
            }
        }
    }

    fn primitive(&mut self, primitive: &Value, path: &str) {
        let Some(attributes) = primitive.field("attributes").as_object() else { return };
        self.names(attributes, path);
        let count_of = |name: &str| whole(attributes.get(name)?).and_then(|a| self.format(a)).map(|f| f.count);
        let vertices = count_of("POSITION");
        let mut strideless: BTreeMap<usize, usize> = BTreeMap::new();
        for (name, index) in attributes {
            let Some(accessor) = whole(index) else { continue };
            let place = format!("{path}.attributes.{name}");
            self.attribute(name, accessor, false, &place);
            if let Some((view, json)) = self.view_of(accessor)
                && json.get("byteStride").is_none()
            {
                *strideless.entry(view).or_default() += 1;
            }
            let found = self.format(accessor).map(|f| f.count);
            if found.is_some() && vertices.is_some() && found != vertices {
                let [found, vertices] = [found, vertices].map(Option::unwrap_or_default);
                self.error("gltf::attributes", place, format_args!("{found} elements for {vertices} vertices"));
            }
        }
        if let Some((view, _)) = strideless.iter().find(|(_, uses)| **uses > 1) {
            self.lapse(
                "gltf::stride",
                path,
                format_args!("bufferViews[{view}] holds several attributes, so it needs a `byteStride`"),
            );
        }
        self.indices(primitive, path);
        self.targets(primitive, attributes, vertices, path);
        self.needs_of_material(primitive, attributes, path);
    }

    /// Names of attributes.
    fn names(&mut self, attributes: &Map<String, Value>, path: &str) {
        for name in attributes.keys().filter(|n| !is_known(n)) {
            self.lapse("gltf::attribute", format_args!("{path}.attributes.{name}"), "no attribute has this name");
        }
        let sets = |prefix: &str| {
            let mut sets: Vec<u32> = attributes.keys().filter_map(|n| numbered(n, prefix)).collect();
            sets.sort_unstable();
            sets
        };
        for prefix in NUMBERED {
            let found = sets(prefix);
            if found.iter().enumerate().any(|(i, set)| i as u32 != *set) {
                self.lapse("gltf::attribute", path, format_args!("the numbers of its {prefix} attributes have gaps"));
            }
        }
        if sets("JOINTS").len() != sets("WEIGHTS").len() {
            self.lapse("gltf::attribute", path, "there are not as many lists of joints as of weights");
        }
    }

    fn attribute(&mut self, name: &str, accessor: usize, is_shift: bool, path: &str) {
        let Some(format) = self.format(accessor) else {
            return self.error("gltf::format", path, format_args!("the type of accessors[{accessor}] is not known"));
        };
        if !fits(name, format, is_shift) {
            let message = format!(
                "{} of {:?}{} is no format for it",
                format.kind,
                format.component,
                if format.normalized { ", normalized," } else { "" }
            );
            if name == "POSITION" && format.kind != "VEC3" {
                self.error("gltf::format", path, message);
            } else {
                self.lapse("gltf::format", path, message);
            }
        }
        let json = &self.list("accessors")[accessor];
        if name == "POSITION" && (json.get("min").is_none() || json.get("max").is_none()) {
            self.lapse("gltf::bounds", path, format_args!("accessors[{accessor}] has no `min` and `max`"));
        }
        let Some((view, view_json)) = self.view_of(accessor) else { return };
        let size = super::super::data::element_bytes(format.kind, format.component).map_or(4, |(tight, _)| tight);
        let stride = view_json.index("byteStride").unwrap_or(size);
        if !json.index("byteOffset").unwrap_or(0).is_multiple_of(4) || stride % 4 != 0 {
            self.lapse("gltf::alignment", path, "vertices must begin at multiples of 4 bytes");
        }
        if view_json.index("target") == Some(INDICES) || self.holds_indices(view) {
            self.lapse("gltf::target", path, format_args!("bufferViews[{view}] is for indices"));
        }
    }

    /// Whether some primitive takes its indices from that view.
    fn holds_indices(&self, view: usize) -> bool {
        let primitives = self.list("meshes").iter().flat_map(|m| m.items("primitives"));
        let views = primitives.filter_map(|p| self.view_of(p.index("indices")?));
        // Only small files are looked through: this is for those who write exporters.
        self.list("meshes").len() < 256 && views.into_iter().any(|(v, _)| v == view)
    }

    fn indices(&mut self, primitive: &Value, path: &str) {
        let Some(accessor) = primitive.index("indices") else { return };
        let path = format!("{path}.indices");
        let Some(format) = self.format(accessor) else { return };
        if format.kind != "SCALAR" || !format.component.is_unsigned() || format.normalized {
            let message = format!("{} of {:?} is no format for indices", format.kind, format.component);
            return self.error("gltf::indices", path, message);
        }
        let Some((view, json)) = self.view_of(accessor) else { return };
        if json.get("byteStride").is_some() {
            self.lapse("gltf::stride", &path, format_args!("bufferViews[{view}] must not have a `byteStride`"));
        }
        if json.index("target") == Some(VERTICES) {
            self.lapse("gltf::target", &path, format_args!("bufferViews[{view}] is for vertices"));
        }
    }

    fn targets(&mut self, primitive: &Value, base: &Map<String, Value>, vertices: Option<usize>, path: &str) {
        for (t, target) in primitive.items("targets").iter().enumerate() {
            for (name, index) in target.as_object().into_iter().flatten() {
                let path = format!("{path}.targets[{t}].{name}");
                if !is_known(name) {
                    self.lapse("gltf::attribute", &path, "no attribute has this name");
                }
                if !base.contains_key(name) {
                    self.lapse("gltf::morph", &path, "the primitive has no attribute of this name");
                }
                let Some(accessor) = whole(index) else { continue };
                self.attribute(name, accessor, true, &path);
                let found = self.format(accessor).map(|f| f.count);
                if found.is_some() && vertices.is_some() && found != vertices {
                    self.error("gltf::morph", path, "it has another number of elements than there are vertices");
                }
            }
        }
    }

    /// Texture coordinates and tangents.
    fn needs_of_material(&mut self, primitive: &Value, attributes: &Map<String, Value>, path: &str) {
        let Some(material) = primitive.index("material").and_then(|m| self.list("materials").get(m)) else { return };
        let has = |set: usize| attributes.contains_key(&format!("TEXCOORD_{set}"));
        let mut infos = Vec::new();
        texture_infos(material, &mut infos);
        if let Some(set) = infos.iter().map(|info| super::super::scene::uv_set(info)).find(|set| !has(*set)) {
            let message = format!("the material needs TEXCOORD_{set}, which the primitive does not have");
            self.lapse("gltf::texture-coordinates", path, message);
        }
        let coat = material.extension("KHR_materials_clearcoat");
        let bare =
            coat.is_some_and(|c| c.get("clearcoatNormalTexture").is_some()) && material.get("normalTexture").is_none();
        if bare && !attributes.contains_key("TANGENT") {
            self.lapse("gltf::tangents", path, "the normal texture of the clear coat needs tangents");
        }
    }
}

/// All references to textures within a material.
fn texture_infos<'v>(value: &'v Value, found: &mut Vec<&'v Value>) {
    for (key, value) in value.as_object().into_iter().flatten() {
        if key == "extras" {
            continue;
        }
        if key.ends_with("Texture") && value.get("index").is_some() {
            found.push(value);
        } else {
            texture_infos(value, found);
        }
    }
}

/// The number behind a prefix, written as the format wants it.
fn numbered(name: &str, prefix: &str) -> Option<u32> {
    let digits = name.strip_prefix(prefix)?.strip_prefix('_')?;
    let number = digits.parse::<u32>().ok()?;
    (number.to_string() == digits).then_some(number)
}

fn is_known(name: &str) -> bool {
    let is_plain = ["POSITION", "NORMAL", "TANGENT"].contains(&name) || name.starts_with('_');
    is_plain || NUMBERED.iter().any(|p| numbered(name, p).is_some())
}

/// Formats of attributes, those of `KHR_mesh_quantization` included (section 3.7.2.1; `is_shift` for morph targets).
fn fits(name: &str, format: Format, is_shift: bool) -> bool {
    use Component::{F32, I8, I16, U8, U16, U32};
    let Format { kind, component, normalized, .. } = format;
    let is_plain = component == F32 && !normalized;
    let is_small = matches!(component, I8 | U8 | I16 | U16);
    let is_fraction = matches!(component, U8 | U16) && normalized;
    match name {
        "POSITION" => kind == "VEC3" && (is_plain || is_small),
        "NORMAL" => kind == "VEC3" && (is_plain || matches!(component, I8 | I16) && normalized),
        "TANGENT" => {
            kind == if is_shift { "VEC3" } else { "VEC4" } && (is_plain || matches!(component, I8 | I16) && normalized)
        }
        _ if name.starts_with("TEXCOORD") => kind == "VEC2" && (is_plain || is_small),
        _ if name.starts_with("COLOR") => ["VEC3", "VEC4"].contains(&kind) && (is_plain || is_fraction || is_shift),
        _ if name.starts_with("JOINTS") => kind == "VEC4" && matches!(component, U8 | U16) && !normalized,
        _ if name.starts_with("WEIGHTS") => kind == "VEC4" && (is_plain || is_fraction),
        // Attributes of one's own are free, but for this kind of number.
        _ => component != U32,
    }
}
