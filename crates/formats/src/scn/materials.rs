//! `Begin Material`: names, type numbers and properties.

use super::parser::Parser;
use super::{PropValue, ScnMaterial, ScnProp};
use crate::diagnostic::{Diagnostic, Span};
use crate::lines::Line;
use crate::lines::shortened;

const KEYWORDS: [&str; 2] = ["Material", "Prop"];

impl Parser<'_> {
    pub(super) fn material_line(&mut self, line: &mut Line, word: Span) {
        match self.source.slice(word) {
            b"Material" => self.material(line, word),
            b"Prop" => self.prop(line, word),
            _ => self.unknown("keyword in a material section", word, &KEYWORDS),
        }
    }

    fn material(&mut self, line: &mut Line, word: Span) {
        let Some(name) = self.name(line, word, "a name") else { return };
        let type_id = match line.clone().word_before_comment() {
            None => 0,
            Some(_) => self.whole(line, name.span, "a material type: a whole number from 0").unwrap_or(0),
        };
        if let Some(&first) = self.material_of.get(&name.value) {
            let first = self.tree.materials[first].name.span;
            let message = format!("two materials are named `{}`", shortened(&name.value));
            self.sink.error(
                Diagnostic::error("scn::duplicate-material", message).at(self.source, name.span, "defined again").see(
                    self.source,
                    first,
                    "defined first here",
                ),
            );
        }
        self.count_object(word);
        self.material_of.entry(name.value.clone()).or_insert(self.tree.materials.len());
        self.tree.materials.push(ScnMaterial { name, type_id, props: Vec::new() });
    }

    fn prop(&mut self, line: &mut Line, word: Span) {
        if self.tree.materials.is_empty() {
            let error = Diagnostic::error("scn::no-material", "`Prop` before any `Material`");
            return self.sink.error(error.at(self.source, word, "no material to describe"));
        }
        let Some(key) = self.name(line, word, "a property name") else { return };
        let Some(kind) = self.name(line, key.span, "a property type") else { return };
        let Some(value) = self.prop_value(line, &kind.value, kind.span) else { return };
        let Some(material) = self.tree.materials.last_mut() else { return };
        if let Some(first) = material.prop(&key.value) {
            let (source, first) = (self.source, first.key.span);
            return self.sink.warn("scn::duplicate-property", || {
                let message = format!("`{}` is given twice", shortened(&key.value));
                Diagnostic::warning("scn::duplicate-property", message).at(source, key.span, "ignored").see(
                    source,
                    first,
                    "the first one counts",
                )
            });
        }
        material.props.push(ScnProp { key, value });
        self.count_object(word);
    }

    fn prop_value(&mut self, line: &mut Line, kind: &str, span: Span) -> Option<PropValue> {
        match kind {
            "Int" => self.whole(line, span, "a whole number").map(PropValue::Int),
            "Float" => self.number(line, span).map(PropValue::Float),
            "Vec3" => self.numbers(line, span).map(PropValue::Vec3),
            "Vec4" => self.numbers(line, span).map(PropValue::Vec4),
            "RGB" => self.numbers(line, span).map(PropValue::Rgb),
            "RGBA" => self.numbers(line, span).map(PropValue::Rgba),
            _ if PropValue::TYPES.iter().any(|t| t.eq_ignore_ascii_case(kind)) => {
                self.unknown("property type", span, &PropValue::TYPES);
                None
            }
            _ => {
                let source = self.source;
                self.sink.warn("scn::unknown-property-type", || {
                    let message = format!("unknown property type `{}`", shortened(kind));
                    Diagnostic::warning("scn::unknown-property-type", message)
                        .at(source, span, "the property is ignored")
                        .one_of(kind, PropValue::TYPES)
                });
                None
            }
        }
    }
}
