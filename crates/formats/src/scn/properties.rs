//! Typed access to the properties of a material, with a message for each that cannot be used.

use super::{PropValue, ScnMaterial, ScnProp};
use crate::diagnostic::{Diagnostic, SourceFile, Span};
use crate::load::Target;
use glam::Vec3;
use std::ops::RangeInclusive;
use sunfleck::scene::TextureId;

/// All keys that some version of NRenderer knows.
const KEYS: [&str; 20] = [
    "diffuseColor",
    "specularColor",
    "specularEx",
    "ambientColor",
    "ior",
    "ratio",
    "absorbed",
    "reflect",
    "reflective",
    "transparency",
    "eta_r",
    "eta_i",
    "albedo",
    "roughness",
    "metallic",
    "baseColor",
    "F0",
    "refractIndex",
    "diffuseMap",
    "specularMap",
];

/// Keys without effect on any of the models.
const UNUSED: [&str; 3] = ["ambientColor", "diffuseMap", "specularMap"];

/// The properties of one material.
pub(super) struct Properties<'a> {
    material: &'a ScnMaterial,
    source: &'a SourceFile,
    target: &'a mut Target,
}

impl<'a> Properties<'a> {
    pub(super) fn new(material: &'a ScnMaterial, source: &'a SourceFile, target: &'a mut Target) -> Self {
        Self { material, source, target }
    }

    /// The number behind the material's name.
    pub(super) fn type_id(&self) -> u32 {
        self.material.type_id
    }

    /// Whether the property is given.
    pub(super) fn has(&self, key: &str) -> bool {
        self.material.prop(key).is_some()
    }

    /// A texture of one colour.
    pub(super) fn constant(&mut self, colour: Vec3) -> TextureId {
        self.target.builder().constant(colour)
    }

    /// Warns of keys that no version of NRenderer knows, and of those that change nothing here.
    pub(super) fn warn_of_unknown(&mut self) {
        let source = self.source;
        for ScnProp { key, .. } in &self.material.props {
            let name = key.value.as_str();
            if UNUSED.contains(&name) {
                self.target.sink.warn("scn::unused-property", || {
                    let message = format!("`{name}` has no effect");
                    Diagnostic::warning("scn::unused-property", message).at(source, key.span, "ignored")
                });
            } else if !KEYS.contains(&name) {
                self.target.sink.warn("scn::unknown-property", || {
                    Diagnostic::warning("scn::unknown-property", format!("unknown property `{name}`"))
                        .at(source, key.span, "ignored")
                        .one_of(name, KEYS)
                });
            }
        }
    }

    /// A number, if given. A property of another type is an error.
    pub(super) fn number(&mut self, key: &str) -> Option<f32> {
        let prop = self.material.prop(key)?;
        let number = prop.value.as_number();
        if number.is_none() {
            self.wrong_type(prop, "a single number (`Float`)");
        }
        number
    }

    /// A number above 0, if given. Any other number is an error.
    pub(super) fn positive(&mut self, key: &str) -> Option<f32> {
        let number = self.number(key)?;
        if number > 0.0 {
            return Some(number);
        }
        let span = self.span(key);
        let error = Diagnostic::error("scn::range", format!("`{key}` is {number}")).at(self.source, span, "");
        self.target.sink.error(error.expected("a number above 0, such as 1.5 for glass"));
        None
    }

    /// Three numbers, if given; a single number counts for all three.
    pub(super) fn colour(&mut self, key: &str) -> Option<Vec3> {
        let value = self.material.prop(key)?.value;
        value.as_triple().map(Vec3::from_array).or(value.as_number().map(Vec3::splat))
    }

    /// A colour from 0 to 1, clamped with a warning; `default` if not given.
    pub(super) fn reflectance(&mut self, key: &str, default: Vec3) -> Vec3 {
        let Some(colour) = self.colour(key) else { return default };
        let clamped = colour.clamp(Vec3::ZERO, Vec3::ONE);
        if clamped != colour {
            self.warn_of_range(key, "0 to 1: it would give off more light than it gets, or less than none");
        }
        clamped
    }

    /// A number from 0 to 1, clamped with a warning; `default` if not given.
    pub(super) fn unit(&mut self, key: &str, default: f32) -> f32 {
        self.within(key, default, 0.0..=1.0)
    }

    /// A number in a range, clamped with a warning; `default` if not given.
    pub(super) fn within(&mut self, key: &str, default: f32, range: RangeInclusive<f32>) -> f32 {
        let Some(number) = self.number(key) else { return default };
        let clamped = number.clamp(*range.start(), *range.end());
        if clamped != number {
            self.warn_of_range(key, &format!("{} to {}", range.start(), range.end()));
        }
        clamped
    }

    /// Warns that `key` is not given, and returns what is taken for it.
    pub(super) fn assume(&mut self, key: &str, value: f32) -> f32 {
        let (source, span) = (self.source, self.material.name.span);
        self.target.sink.warn("scn::assumed", || {
            let message = format!("this material needs `{key}`");
            Diagnostic::warning("scn::assumed", message).at(source, span, format!("{key} = {value} is assumed"))
        });
        value
    }

    fn warn_of_range(&mut self, key: &str, range: &str) {
        let (source, span) = (self.source, self.span(key));
        self.target.sink.warn("scn::range", || {
            let message = format!("`{key}` is out of its range, {range}");
            Diagnostic::warning("scn::range", message).at(source, span, "cut to the range")
        });
    }

    fn wrong_type(&mut self, prop: &ScnProp, expected: &str) {
        let found = match prop.value {
            PropValue::Int(_) | PropValue::Float(_) => "a number",
            PropValue::Vec3(_) | PropValue::Rgb(_) => "three numbers",
            PropValue::Vec4(_) | PropValue::Rgba(_) => "four numbers",
        };
        let message = format!("`{}` has the wrong type: {found}", prop.key.value);
        let error = Diagnostic::error("scn::property-type", message).at(self.source, prop.key.span, "");
        self.target.sink.error(error.expected(expected));
    }

    fn span(&self, key: &str) -> Span {
        self.material.prop(key).map_or(self.material.name.span, |p| p.key.span)
    }
}
