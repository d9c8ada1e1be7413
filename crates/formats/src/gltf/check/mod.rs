//! Rules that tables cannot say.
//!
//! What makes a file unreadable, or leaves open what it means, is an error. What breaks a rule but no picture is a lapse: told of
//! as an error, too, but the file is read unless one is strict.

mod accessors;
mod animations;
mod assets;
mod looks;
mod meshes;
mod nodes;
mod skins;
mod values;

pub(super) use assets::version_and_extensions;

use super::data::{Accessor, Buffers, Component};
use super::document::Fields;
use super::findings::Findings;
use crate::diagnostic::Sink;
use crate::files::Files;
use serde_json::Value;
use std::fmt::Display;

/// What the rules look at.
struct Rules<'r> {
    root: &'r Value,
    buffers: &'r Buffers,
    files: &'r Files,
    told: &'r Findings,
    sink: &'r mut Sink,
}

/// Tells of all that breaks a rule of the specification.
pub(super) fn rules(root: &Value, (buffers, files): (&Buffers, &Files), told: &Findings, sink: &mut Sink) {
    let mut rules = Rules { root, buffers, files, told, sink };
    rules.views();
    rules.accessors();
    rules.nodes();
    rules.skins();
    rules.meshes();
    rules.looks();
    rules.animations();
    if rules.sink.is_ok() {
        rules.values();
    }
}

/// What an accessor says of itself.
#[derive(Clone, Copy, PartialEq)]
struct Format<'r> {
    kind: &'r str,
    component: Component,
    normalized: bool,
    count: usize,
}

impl<'r> Rules<'r> {
    fn error(&mut self, code: &'static str, path: impl Display, message: impl Display) {
        self.told.error(self.sink, code, path, message);
    }

    fn lapse(&mut self, code: &'static str, path: impl Display, message: impl Display) {
        self.told.lapse(self.sink, code, path, message);
    }

    /// Items of a list of the file.
    fn list(&self, key: &str) -> &'r [Value] {
        self.root.items(key)
    }

    /// `None` for kinds that are not known.
    fn format(&self, accessor: usize) -> Option<Format<'r>> {
        let json = self.list("accessors").get(accessor)?;
        let component = Component::of(json.index("componentType")?)?;
        let (normalized, count) = (json.flag("normalized"), json.index("count").unwrap_or(0));
        Some(Format { kind: json.text("type")?, component, normalized, count })
    }

    /// The view of an accessor.
    fn view_of(&self, accessor: usize) -> Option<(usize, &'r Value)> {
        let view = self.list("accessors").get(accessor)?.index("bufferView")?;
        Some((view, self.list("bufferViews").get(view)?))
    }

    /// The numbers of an accessor, if it has any and they can be read.
    fn open(&self, accessor: usize) -> Option<Accessor<'r>> {
        self.view_of(accessor)?;
        Accessor::open(self.root, self.buffers, accessor).ok()
    }
}
