//! `Begin Light`: lights, in world space.

use super::parser::Parser;
use super::{LightKind, ScnLight, Spanned};
use crate::diagnostic::{Diagnostic, Span};
use crate::lines::Line;
use glam::Vec3;
use std::f32::consts::{FRAC_PI_3, FRAC_PI_4};

const KEYWORDS: [&str; 11] = ["Point", "Spot", "Directional", "Area", "IRV", "P", "D", "U", "V", "HotSpot", "Fallout"];

impl Parser<'_> {
    pub(super) fn light_line(&mut self, line: &mut Line, word: Span) {
        match self.source.slice(word) {
            b"Point" => self.light(line, word, LightKind::Point),
            b"Spot" => self.light(line, word, LightKind::Spot),
            b"Directional" => self.light(line, word, LightKind::Directional),
            b"Area" => self.light(line, word, LightKind::Area),
            b"IRV" | b"P" | b"D" | b"U" | b"V" | b"HotSpot" | b"Fallout" => self.light_attribute(line, word),
            _ => self.unknown("keyword in a light section", word, &KEYWORDS),
        }
    }

    fn light(&mut self, line: &mut Line, word: Span, kind: LightKind) {
        let name = match line.word_before_comment() {
            Some(span) => Spanned { value: self.source.text(span), span },
            None => Spanned { value: "undefined".to_owned(), span: word },
        };
        self.end_of_line(line);
        self.count_object(word);
        self.tree.lights.push(ScnLight {
            kind,
            name,
            irv: [1.0; 3],
            position: Vec3::ZERO,
            direction: Vec3::ZERO,
            u: Vec3::ZERO,
            v: Vec3::ZERO,
            hot_spot: FRAC_PI_4,
            fallout: FRAC_PI_3,
        });
    }

    fn light_attribute(&mut self, line: &mut Line, word: Span) {
        let source = self.source;
        let key = source.slice(word);
        let Some(kind) = self.tree.lights.last().map(|light| light.kind) else {
            let message = format!("`{}` before any light", source.text(word));
            let error = Diagnostic::error("scn::no-light", message).at(source, word, "no light to describe");
            return self.sink.error(error.expected("a line such as `Area <name>` above"));
        };
        if !kind.has(key) {
            self.sink.warn("scn::ignored-attribute", || {
                let message = format!("a light of kind `{}` has no `{}`", kind.word(), source.text(word));
                Diagnostic::warning("scn::ignored-attribute", message).at(source, word, "ignored")
            });
        }
        if matches!(key, b"HotSpot" | b"Fallout") {
            let Some(angle) = self.number(line, word) else { return };
            let Some(light) = self.tree.lights.last_mut() else { return };
            *(if key == b"HotSpot" { &mut light.hot_spot } else { &mut light.fallout }) = angle;
            return;
        }
        let Some(value) = self.vec3(line, word) else { return };
        let Some(light) = self.tree.lights.last_mut() else { return };
        match key {
            b"IRV" => light.irv = value.to_array(),
            b"P" => light.position = value,
            b"D" => light.direction = value,
            b"U" => light.u = value,
            _ => light.v = value,
        }
    }
}

impl LightKind {
    /// Whether a light of this kind uses the attribute.
    fn has(self, key: &[u8]) -> bool {
        match key {
            b"P" => self != Self::Directional,
            b"D" => matches!(self, Self::Spot | Self::Directional),
            b"U" | b"V" => self == Self::Area,
            b"HotSpot" | b"Fallout" => self == Self::Spot,
            _ => true,
        }
    }
}
