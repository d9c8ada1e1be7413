//! Views and accessors: everything lies within what it is a part of.

use super::super::data::{Component, element_bytes};
use super::super::document::Fields;
use super::Rules;

impl Rules<'_> {
    pub(super) fn views(&mut self) {
        let buffers = self.root.items("buffers");
        for (i, view) in self.root.items("bufferViews").iter().enumerate() {
            let path = format!("bufferViews[{i}]");
            let (start, length) = (view.index("byteOffset").unwrap_or(0), view.index("byteLength").unwrap_or(0));
            let buffer = view.index("buffer").unwrap_or(0);
            let all = buffers.get(buffer).and_then(|b| b.index("byteLength")).unwrap_or(0);
            if start.checked_add(length).is_none_or(|end| end > all) {
                let message = format!("it needs {length} bytes from byte {start}, but buffers[{buffer}] has {all}");
                self.told.error(self.sink, "gltf::view", path, message);
                continue;
            }
            let Some(stride) = view.index("byteStride") else { continue };
            if stride > length {
                self.told.lapse(self.sink, "gltf::stride", &path, "`byteStride` is more than `byteLength`");
            }
            if stride % 4 != 0 {
                self.told.lapse(self.sink, "gltf::stride", &path, "`byteStride` is no multiple of 4");
            }
            if view.index("target") == Some(34_963) {
                self.told.lapse(self.sink, "gltf::stride", &path, "indices have no `byteStride`");
            }
        }
    }

    pub(super) fn accessors(&mut self) {
        for i in 0..self.root.items("accessors").len() {
            self.accessor(i, &format!("accessors[{i}]"));
        }
    }

    fn accessor(&mut self, index: usize, path: &str) {
        let accessor = &self.root.items("accessors")[index];
        let kind = accessor.text("type").unwrap_or("");
        let component = accessor.index("componentType").and_then(Component::of);
        // Unknown kinds are told of where they are used.
        let Some(component) = component else { return };
        let Some((tight, size)) = element_bytes(kind, component) else { return };
        if accessor.flag("normalized") && !matches!(component.bytes(), 1 | 2) {
            let message = "`normalized` has no meaning for floats and 32-bit numbers";
            self.told.lapse(self.sink, "gltf::normalized", path, message);
        }
        let start = accessor.index("byteOffset").unwrap_or(0);
        let Some(view) = accessor.index("bufferView") else {
            if accessor.get("byteOffset").is_some() {
                self.told.lapse(self.sink, "gltf::accessor", path, "`byteOffset` needs a `bufferView`");
            }
            return self.sparse(index, size, path);
        };
        let view_json = &self.root.items("bufferViews")[view];
        let (view_start, length) =
            (view_json.index("byteOffset").unwrap_or(0), view_json.index("byteLength").unwrap_or(0));
        let stride = view_json.index("byteStride");
        if stride.is_some_and(|s| s < size) {
            let message = format!("an element has {size} bytes, more than the `byteStride` of bufferViews[{view}]");
            return self.told.error(self.sink, "gltf::stride", path, message);
        }
        let own = if kind.starts_with("MAT") { component.bytes().max(4) } else { component.bytes() };
        if !start.is_multiple_of(own) || !(view_start + start).is_multiple_of(component.bytes()) {
            let message = format!("it does not begin at a multiple of {own} bytes");
            self.told.lapse(self.sink, "gltf::alignment", path, message);
        }
        let count = accessor.index("count").unwrap_or(0);
        let span = count.saturating_sub(1).checked_mul(stride.unwrap_or(tight)).and_then(|s| s.checked_add(size));
        let end = span.and_then(|s| s.checked_add(start));
        if end.is_none_or(|end| end > length) {
            let message =
                format!("{count} elements from byte {start} reach beyond the {length} bytes of bufferViews[{view}]");
            return self.told.error(self.sink, "gltf::accessor", path, message);
        }
        self.sparse(index, size, path);
    }

    fn sparse(&mut self, index: usize, size: usize, path: &str) {
        let accessor = &self.root.items("accessors")[index];
        let Some(sparse) = accessor.get("sparse") else { return };
        let (count, all) = (sparse.index("count").unwrap_or(0), accessor.index("count").unwrap_or(0));
        if count > all {
            let message = format!("{count} elements are said to differ, but there are {all}");
            return self.told.error(self.sink, "gltf::sparse", format_args!("{path}.sparse.count"), message);
        }
        let places = sparse.field("indices");
        let place = places.index("componentType").and_then(Component::of).map_or(1, Component::bytes);
        for (part, json, size) in [("indices", places, place), ("values", sparse.field("values"), size)] {
            let path = format!("{path}.sparse.{part}");
            let Some(view) = json.index("bufferView").and_then(|v| self.root.items("bufferViews").get(v)) else {
                continue;
            };
            let end = count.checked_mul(size).and_then(|s| s.checked_add(json.index("byteOffset").unwrap_or(0)));
            if end.is_none_or(|end| end > view.index("byteLength").unwrap_or(0)) {
                self.told.error(self.sink, "gltf::sparse", &path, "it reaches beyond the end of its view");
            }
            if view.get("byteStride").is_some() {
                self.told.lapse(self.sink, "gltf::stride", &path, "its view must not have a `byteStride`");
            }
        }
    }
}
