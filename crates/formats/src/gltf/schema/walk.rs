//! Compares a file with the tables.

use super::super::document::{Fields, kind_of, whole};
use super::super::findings::Findings;
use super::tables::ROOT;
use super::{Kind, Length, Property, Range, Schema, UNDERSTOOD};
use crate::diagnostic::Sink;
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::fmt::{Display, Formatter, Result};

/// A place in the JSON, on the way down.
#[derive(Clone, Copy)]
struct Path<'p> {
    parent: Option<&'p Path<'p>>,
    step: Step<'p>,
}

#[derive(Clone, Copy)]
enum Step<'p> {
    Key(&'p str),
    Item(usize),
}

impl<'p> Path<'p> {
    fn key(&'p self, key: &'p str) -> Self {
        Self { parent: Some(self), step: Step::Key(key) }
    }
    fn item(&'p self, index: usize) -> Self {
        Self { parent: Some(self), step: Step::Item(index) }
    }
    fn is_root(&self) -> bool {
        self.parent.is_none()
    }
}

impl Display for Path<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let Some(parent) = self.parent else { return Ok(()) };
        parent.fmt(f)?;
        match self.step {
            Step::Key(key) if parent.is_root() => f.write_str(key),
            Step::Key(key) => write!(f, ".{key}"),
            Step::Item(index) => write!(f, "[{index}]"),
        }
    }
}

/// Tells of all that is not as the tables say.
pub(in super::super) fn check(root: &Value, told: &Findings, sink: &mut Sink) {
    let declared: BTreeSet<&str> = root.items("extensionsUsed").iter().filter_map(Value::as_str).collect();
    let walk = Walk { root, declared, told };
    if let Some(object) = root.as_object() {
        walk.object(object, &ROOT, &Path { parent: None, step: Step::Key("") }, sink);
    }
}

struct Walk<'w> {
    root: &'w Value,
    /// The extensions that the file says it uses.
    declared: BTreeSet<&'w str>,
    told: &'w Findings,
}

impl Walk<'_> {
    fn object(&self, object: &Map<String, Value>, schema: &Schema, path: &Path, sink: &mut Sink) {
        for property in schema.properties.iter().filter(|p| p.is_required && !object.contains_key(p.name)) {
            let place = if path.is_root() { "the file".to_owned() } else { path.to_string() };
            self.told.error(sink, "gltf::missing", place, format_args!("`{}` is missing", property.name));
        }
        for (key, value) in object {
            let path = path.key(key);
            match schema.properties.iter().find(|p| p.name == key) {
                Some(Property { kind, .. }) => self.value(value, kind, &path, sink),
                None if key == "extensions" => self.extensions(value, schema, &path, sink),
                None if key == "extras" => {}
                None => {
                    self.told.warn(sink, "gltf::unknown-property", path, "no property of this name is known; ignored");
                }
            }
        }
    }

    fn extensions(&self, value: &Value, schema: &Schema, path: &Path, sink: &mut Sink) {
        let Some(extensions) = value.as_object() else { return self.misfit(value, "an object", path, sink) };
        for (name, value) in extensions {
            let path = path.key(name);
            if !self.declared.contains(name.as_str()) {
                self.told.lapse(sink, "gltf::undeclared", path, "the extension is not named in `extensionsUsed`");
            }
            let Some(object) = value.as_object() else {
                self.misfit(value, "an object", &path, sink);
                continue;
            };
            match schema.extensions.iter().find(|(n, _)| n == name) {
                Some((_, schema)) => self.object(object, schema, &path, sink),
                None if UNDERSTOOD.contains(&name.as_str()) => {
                    self.told.error(sink, "gltf::misplaced", path, "this extension has no meaning here");
                }
                None => {}
            }
        }
    }

    fn value(&self, value: &Value, kind: &Kind, path: &Path, sink: &mut Sink) {
        let fits = match *kind {
            Kind::Flag => value.is_boolean().then_some(()).ok_or("true or false"),
            Kind::Text => value.is_string().then_some(()).ok_or("a text"),
            Kind::Word(words) => value.as_str().map(|w| self.word(w, words, path, sink)).ok_or("a text"),
            Kind::Code(codes) => whole(value).map(|c| self.code(c, codes, path, sink)).ok_or("a whole number"),
            Kind::Whole(low, high) => self.whole(value, low, high, path, sink),
            Kind::Number(range) => value.as_f64().map(|v| self.number(v, range, path, sink)).ok_or("a number"),
            Kind::Index(list) => whole(value).map(|i| self.reference(i, list, path, sink)).ok_or("an index"),
            Kind::Object(schema) => value.as_object().map(|o| self.object(o, schema, path, sink)).ok_or("an object"),
            Kind::Map(of) => value.as_object().map(|o| self.map(o, of, path, sink)).ok_or("an object"),
            Kind::List(of, length) => value.as_array().map(|l| self.list(l, of, length, path, sink)).ok_or("a list"),
        };
        if let Err(expected) = fits {
            self.misfit(value, expected, path, sink);
        }
    }

    fn misfit(&self, value: &Value, expected: &str, path: &Path, sink: &mut Sink) {
        let message = format!("this is {}", kind_of(value));
        sink.error(self.told.file_error("gltf::kind", format!("{path}: {message}")).expected(expected));
    }

    fn word(&self, word: &str, words: &[&str], path: &Path, sink: &mut Sink) {
        if !words.contains(&word) {
            let message = format!("`{word}` is none of {}", words.join(", "));
            self.told.warn(sink, "gltf::unknown-value", path, message);
        }
    }

    fn code(&self, code: usize, codes: &[u64], path: &Path, sink: &mut Sink) {
        if !codes.contains(&(code as u64)) {
            let known = codes.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
            self.told.warn(sink, "gltf::unknown-value", path, format_args!("{code} is none of {known}"));
        }
    }

    fn whole(
        &self,
        value: &Value,
        low: u64,
        high: u64,
        path: &Path,
        sink: &mut Sink,
    ) -> std::result::Result<(), &'static str> {
        let number = value.as_f64().filter(|v| v.fract() == 0.0).ok_or("a whole number")?;
        self.number(number, Range { low: low as f64, is_open: false, high: high as f64 }, path, sink);
        Ok(())
    }

    fn number(&self, number: f64, range: Range, path: &Path, sink: &mut Sink) {
        let Range { low, is_open, high } = range;
        let is_above = if is_open { number > low } else { number >= low };
        // What does not fit into 32 bits is infinite to all who read it.
        let is_finite = (number as f32).is_finite() || high == u64::MAX as f64;
        if is_above && number <= high && is_finite {
            return;
        }
        let range = match (is_open, high.is_infinite() || high > 1e15) {
            _ if low.is_infinite() => "a finite number".to_owned(),
            (true, true) => format!("more than {low}"),
            (false, true) => format!("{low} or more"),
            (true, false) => format!("more than {low} and at most {high}"),
            (false, false) => format!("{low} to {high}"),
        };
        let error = self.told.file_error("gltf::range", format!("{path}: the value is {number}"));
        sink.error(error.expected(range));
    }

    fn reference(&self, index: usize, list: &str, path: &Path, sink: &mut Sink) {
        let (count, list) = match list.split_once('.') {
            None => (self.root.items(list).len(), list),
            Some((extension, list)) => {
                let Some(object) = self.root.extension(extension) else {
                    let message = format!("the file has no `extensions.{extension}` that this could point to");
                    return self.told.error(sink, "gltf::reference", path, message);
                };
                (object.items(list).len(), list)
            }
        };
        if index >= count {
            let message = format!("there is no {list}[{index}]; the file has {count} {list}");
            self.told.error(sink, "gltf::reference", path, message);
        }
    }

    fn map(&self, map: &Map<String, Value>, of: &Kind, path: &Path, sink: &mut Sink) {
        if map.is_empty() {
            self.told.lapse(sink, "gltf::empty", path, "the object is empty");
        }
        map.iter().for_each(|(key, value)| self.value(value, of, &path.key(key), sink));
    }

    fn list(&self, list: &[Value], of: &Kind, length: Length, path: &Path, sink: &mut Sink) {
        if list.is_empty() {
            return self.told.lapse(sink, "gltf::empty", path, "the list is empty");
        }
        if let Length::Exactly(count) = length
            && list.len() != count
        {
            let error = self.told.file_error("gltf::length", format!("{path}: the list has {} elements", list.len()));
            return sink.error(error.expected(format!("{count} elements")));
        }
        for (i, value) in list.iter().enumerate() {
            self.value(value, of, &path.item(i), sink);
        }
        if let Length::Distinct = length {
            let mut seen = BTreeSet::new();
            let repeated = list.iter().position(|v| !seen.insert(v.to_string()));
            if let Some(i) = repeated {
                self.told.lapse(sink, "gltf::repeated", path.item(i), "this element stands in the list already");
            }
        }
    }
}
