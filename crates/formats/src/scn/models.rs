//! `Begin Model`: models and their shapes.

use super::parser::Parser;
use super::{Plane, ScnModel, ScnShape, ShapeKind, Spanned, Sphere, Triangle};
use crate::diagnostic::{Diagnostic, Span};
use crate::lines::Line;
use crate::lines::shortened;
use glam::Vec3;

const KEYWORDS: [&str; 14] =
    ["Model", "Translation", "Scale", "Sphere", "Triangle", "Plane", "R", "N", "P", "U", "V", "V1", "V2", "V3"];

/// The default of a stored normal.
const DEFAULT_NORMAL: Vec3 = Vec3::Z;

impl Parser<'_> {
    pub(super) fn model_line(&mut self, line: &mut Line, word: Span) {
        match self.source.slice(word) {
            b"Model" => self.model(line, word),
            b"Translation" | b"Scale" => self.placement(line, word),
            b"Sphere" => self.shape(line, word, ShapeKind::Sphere(Sphere::default())),
            b"Triangle" => {
                let triangle = Triangle { vertices: [Vec3::ZERO; 3], normal: DEFAULT_NORMAL };
                self.shape(line, word, ShapeKind::Triangle(triangle));
            }
            b"Plane" => {
                let plane = Plane { corner: Vec3::ZERO, u: Vec3::ZERO, v: Vec3::ZERO, normal: DEFAULT_NORMAL };
                self.shape(line, word, ShapeKind::Plane(plane));
            }
            b"Mesh" => self.empty_mesh(word),
            b"R" | b"N" | b"P" | b"U" | b"V" | b"V1" | b"V2" | b"V3" => self.attribute(line, word),
            _ => self.unknown("keyword in a model section", word, &KEYWORDS),
        }
    }

    fn model(&mut self, line: &mut Line, word: Span) {
        let name = match line.word_before_comment() {
            Some(span) => Spanned { value: self.source.text(span), span },
            None => Spanned { value: "undefined".to_owned(), span: word },
        };
        self.end_of_line(line);
        self.count_object(word);
        self.tree.models.push(ScnModel { name, translation: Vec3::ZERO, scale: None, shapes: Vec::new() });
    }

    fn placement(&mut self, line: &mut Line, word: Span) {
        let Some(value) = self.vec3(line, word) else { return };
        let is_scale = self.source.slice(word) == b"Scale";
        match self.tree.models.last_mut() {
            None => self.no_model(word),
            Some(model) if is_scale => model.scale = Some(Spanned { value, span: word }),
            Some(model) => model.translation = value,
        }
    }

    fn shape(&mut self, line: &mut Line, word: Span, kind: ShapeKind) {
        let Some(name) = self.name(line, word, "a node name") else { return };
        let Some(material) = self.name(line, name.span, "a material name") else { return };
        self.end_of_line(line);
        if self.tree.models.is_empty() {
            self.no_model(word);
        }
        let material = if let Some(&index) = self.material_of.get(&material.value) {
            index
        } else {
            self.unknown_material(&material);
            // The shape is kept, so that its attribute lines are read.
            usize::MAX
        };
        self.count_object(word);
        let models = self.tree.models.len();
        if let Some(model) = self.tree.models.last_mut() {
            self.last_of_kind[kind.index()] = Some((models - 1, model.shapes.len()));
            model.shapes.push(ScnShape { name, material, kind });
        }
    }

    fn unknown_material(&mut self, name: &Spanned<String>) {
        let message = format!("no material is named `{}`", shortened(&name.value));
        let mut error = Diagnostic::error("scn::unknown-material", message).at(self.source, name.span, "");
        if let Some(later) = self.defined_later(self.source.slice(name.span)) {
            error = error
                .see(self.source, later, "defined only here")
                .help("a material must stand before the model that uses it");
        } else {
            let names = self.tree.materials.iter().map(|m| m.name.value.as_str());
            error = error.one_of(&name.value, names);
            if error.valid.is_empty() {
                error = error.help("no material is defined above this line");
            }
        }
        self.sink.error(error);
    }

    fn no_model(&mut self, word: Span) {
        let message = format!("`{}` before any `Model`", self.source.text(word));
        let error = Diagnostic::error("scn::no-model", message).at(self.source, word, "no model to belong to");
        self.sink.error(error.expected("a line `Model <name>` above"));
        // A stand-in, so that what follows is read.
        let name = Spanned { value: String::new(), span: word };
        self.tree.models.push(ScnModel { name, translation: Vec3::ZERO, scale: None, shapes: Vec::new() });
    }

    fn empty_mesh(&mut self, word: Span) {
        let source = self.source;
        self.sink.warn("scn::mesh", || {
            Diagnostic::warning("scn::mesh", "`Mesh` has no data in this format")
                .at(source, word, "ignored")
                .help("load the mesh itself from an .obj file")
        });
    }

    fn attribute(&mut self, line: &mut Line, word: Span) {
        let Some(index) = self.described_shape(word) else { return };
        let key = self.source.slice(word);
        if key == b"R" {
            let Some(radius) = self.number(line, word) else { return };
            if let ShapeKind::Sphere(sphere) = self.kind_mut(index) {
                sphere.radius = radius;
            }
            return;
        }
        let Some(value) = self.vec3(line, word) else { return };
        match (self.kind_mut(index), key) {
            (ShapeKind::Sphere(s), b"P") => s.centre = value,
            (ShapeKind::Triangle(t), b"V1") => t.vertices[0] = value,
            (ShapeKind::Triangle(t), b"V2") => t.vertices[1] = value,
            (ShapeKind::Triangle(t), b"V3") => t.vertices[2] = value,
            (ShapeKind::Triangle(t), b"N") => t.normal = value,
            (ShapeKind::Plane(p), b"P") => p.corner = value,
            (ShapeKind::Plane(p), b"U") => p.u = value,
            (ShapeKind::Plane(p), b"V") => p.v = value,
            (ShapeKind::Plane(p), b"N") => p.normal = value,
            // The axis of a sphere has no use; `P` of a triangle was warned of.
            _ => {}
        }
    }

    fn kind_mut(&mut self, (model, shape): (usize, usize)) -> &mut ShapeKind {
        &mut self.tree.models[model].shapes[shape].kind
    }

    /// The shape that the attribute `word` describes: the last one, or the last of the only kind that has it.
    fn described_shape(&mut self, word: Span) -> Option<(usize, usize)> {
        let source = self.source;
        let key = source.slice(word);
        let newest = self.last_of_kind.iter().copied().flatten().max();
        let found = match key {
            b"R" => self.last_of_kind[0],
            b"V1" | b"V2" | b"V3" => self.last_of_kind[1],
            b"U" | b"V" => self.last_of_kind[2],
            _ => newest,
        };
        let Some(index) = found else {
            let owner = match key {
                b"R" => "sphere",
                b"V1" | b"V2" | b"V3" => "triangle",
                b"U" | b"V" => "plane",
                _ => "shape",
            };
            let message = format!("`{}` before any {owner}", source.text(word));
            let error = Diagnostic::error("scn::no-shape", message);
            self.sink.error(error.at(source, word, format!("no {owner} to describe")));
            return None;
        };
        let (model, shape) = index;
        if key == b"P" && matches!(self.kind_mut(index), ShapeKind::Triangle(_)) {
            self.sink.warn("scn::ignored-attribute", || {
                Diagnostic::warning("scn::ignored-attribute", "a triangle has no `P`").at(source, word, "ignored")
            });
        } else if found != newest || model + 1 != self.tree.models.len() {
            let owner = self.tree.models[model].shapes[shape].name.span;
            self.sink.warn("scn::far-attribute", || {
                let message = format!("`{}` does not describe what stands above it", source.text(word));
                Diagnostic::warning("scn::far-attribute", message)
                    .at(source, word, "NRenderer gives it to the last shape of a fitting kind")
                    .see(source, owner, "which is this one")
            });
        }
        Some(index)
    }
}

impl ShapeKind {
    /// A number for the kind: sphere 0, triangle 1, plane 2.
    fn index(&self) -> usize {
        match self {
            Self::Sphere(_) => 0,
            Self::Triangle(_) => 1,
            Self::Plane(_) => 2,
        }
    }
}
