//! What all parts of the reader share.

use super::super::data::{Accessor, Buffers};
use super::super::document::Fields;
use super::super::findings::Findings;
use super::materials::Materials;
use super::textures::Textures;
use crate::files::Files;
use crate::load::Target;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Display;

/// Corners of triangles that any file may have,
const FREE_CORNERS: usize = 1 << 22;
/// and beyond that so many for each of its bytes: shared vertices and packing make up for a lot.
const CORNERS_PER_BYTE: usize = 64;

/// A file on its way into a scene.
pub(in super::super) struct Importer<'g> {
    pub(super) root: &'g Value,
    pub(super) buffers: &'g Buffers,
    pub(super) files: &'g Files,
    pub(super) told: &'g Findings,
    pub(super) target: &'g mut Target,
    pub(super) textures: Textures,
    pub(super) materials: Materials,
    /// Findings that are told of once a file.
    once: BTreeSet<(&'static str, String)>,
    /// Corners that may still be made.
    corners: usize,
}

impl<'g> Importer<'g> {
    /// For a file of so many bytes, all of its parts together.
    pub(in super::super) fn new(
        root: &'g Value,
        buffers: &'g Buffers,
        files: &'g Files,
        told: &'g Findings,
        (target, bytes): (&'g mut Target, usize),
    ) -> Self {
        Self {
            root,
            buffers,
            files,
            told,
            target,
            textures: Textures::default(),
            materials: Materials::default(),
            once: BTreeSet::new(),
            corners: FREE_CORNERS.max(bytes.saturating_mul(CORNERS_PER_BYTE)),
        }
    }

    /// Tells of something that is left out or replaced, once for each `about`.
    pub(super) fn note(&mut self, code: &'static str, about: impl Into<String>, message: impl Display) {
        let about = about.into();
        if self.once.insert((code, about.clone())) {
            self.told.warn(&mut self.target.sink, code, about, message);
        }
    }

    pub(super) fn error(&mut self, code: &'static str, path: impl Display, message: impl Display) {
        self.told.error(&mut self.target.sink, code, path, message);
    }

    /// The list that an accessor means; `None` after an error, which is in the sink.
    pub(super) fn accessor(&mut self, index: usize, path: &str) -> Option<Accessor<'g>> {
        match Accessor::open(self.root, self.buffers, index) {
            Ok(accessor) => Some(accessor),
            Err(reason) => {
                let view = self.root.items("accessors").get(index).and_then(|a| a.index("bufferView"));
                if view.is_some_and(|view| self.buffers.is_absent(self.root, view)) {
                    self.note("gltf::absent", path, format_args!("{reason}; what needs it is left out"));
                } else {
                    self.error("gltf::accessor", path, reason);
                }
                None
            }
        }
    }

    /// Takes from what a file of its size may make; false, with an error, once that is used up.
    pub(super) fn afford(&mut self, corners: usize, path: &str) -> bool {
        let left = self.corners.checked_sub(corners);
        if let Some(left) = left {
            self.corners = left;
            return true;
        }
        if self.once.insert(("gltf::size", String::new())) {
            let message = "the triangles up to here are more than a file of this size can mean";
            self.error("gltf::size", path, message);
        }
        false
    }

    /// The name of an element, for people: its place in the file, and what its author called it.
    pub(super) fn called(&self, list: &str, index: usize) -> String {
        match self.root.items(list).get(index).and_then(|e| e.text("name")) {
            Some(name) if !name.is_empty() => format!("{list}[{index}] `{name}`"),
            _ => format!("{list}[{index}]"),
        }
    }
}
