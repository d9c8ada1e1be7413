//! What an element says: its values and the objects in it, by name.

use super::document::{At, Attribute, Document, Element, Found};
use super::{transforms, words};
use crate::diagnostic::Diagnostic;
use crate::lines::shortened;
use glam::{DAffine3, DVec3};
use std::cell::{Cell, RefCell};
use std::ops::RangeInclusive;

/// The values and objects of one element. What nobody asks for can be told of.
pub(super) struct Props<'d> {
    document: &'d Document,
    pub(super) element: &'d Element,
    entries: Vec<Entry<'d>>,
    /// Names that were asked for.
    asked: RefCell<Vec<&'static str>>,
}

struct Entry<'d> {
    number: usize,
    element: &'d Element,
    is_used: Cell<bool>,
}

impl<'d> Props<'d> {
    pub(super) fn new(document: &'d Document, number: usize) -> Self {
        let element = &document.elements[number];
        let entry = |n: &usize| Entry { number: *n, element: &document.elements[*n], is_used: Cell::new(false) };
        let entries = element.children.iter().map(entry).collect();
        Self { document, element, entries, asked: RefCell::default() }
    }

    /// Where the element is.
    pub(super) fn at(&self) -> &'d At {
        &self.element.at
    }

    /// An error about the element as a whole.
    pub(super) fn bad(&self, message: &str) -> Box<Diagnostic> {
        self.at().bad("mitsuba::value", message)
    }

    /// None of the plugins of a kind has this element's name.
    pub(super) fn unknown_plugin(&self, kind: &str, names: &[&str]) -> Box<Diagnostic> {
        match self.element.plugin() {
            Ok((name, at)) => at.unknown(kind, name, names.iter().copied()),
            Err(error) => error,
        }
    }

    /// The child that is the property `name`; of several the last one.
    pub(super) fn get(&self, name: &'static str) -> Option<(usize, &'d Element)> {
        self.asked.borrow_mut().push(name);
        let mut found = None;
        for entry in self.entries.iter().filter(|e| e.element.name.as_deref() == Some(name)) {
            entry.is_used.set(true);
            found = Some((entry.number, entry.element));
        }
        found
    }

    /// Whether the property is given.
    pub(super) fn has(&self, name: &'static str) -> bool {
        self.get(name).is_some()
    }

    /// These mean nothing here, and that is no surprise.
    pub(super) fn ignore(&self, names: &[&'static str]) {
        for name in names {
            self.get(name);
        }
    }

    /// Numbers of objects in this one of the kind `tag`, references followed.
    pub(super) fn objects(&self, tag: &str) -> Found<Vec<usize>> {
        let mut found = Vec::new();
        for entry in &self.entries {
            if entry.element.tag != tag && entry.element.tag != "ref" {
                continue;
            }
            let number = self.document.resolve(entry.number)?;
            if self.document.elements[number].tag == tag {
                entry.is_used.set(true);
                found.push(number);
            }
        }
        Ok(found)
    }

    /// One object of the kind `tag`, the last one.
    pub(super) fn object(&self, tag: &str) -> Found<Option<usize>> {
        Ok(self.objects(tag)?.pop())
    }

    /// The value of a property of one of the kinds `tags`.
    fn value(&self, name: &'static str, tags: &[&str], what: &str) -> Found<Option<&'d Attribute>> {
        let Some((_, element)) = self.get(name) else { return Ok(None) };
        if !tags.contains(&element.tag.as_str()) {
            let error = element.at.bad("mitsuba::kind", format!("`{name}` is given as `{}`", element.tag));
            return Err(Box::new(error.expected(what)));
        }
        element.required("value").map(Some)
    }

    /// A number, if it is given.
    pub(super) fn maybe_float(&self, name: &'static str) -> Found<Option<f64>> {
        let Some(value) = self.value(name, &["float", "integer"], "a number (`float`)")? else { return Ok(None) };
        number(value).map(Some)
    }

    /// A number.
    pub(super) fn float(&self, name: &'static str, default: f64) -> Found<f64> {
        Ok(self.maybe_float(name)?.unwrap_or(default))
    }

    /// A whole number within `range`, if it is given.
    pub(super) fn integer(&self, name: &'static str, range: RangeInclusive<i64>) -> Found<Option<i64>> {
        let Some(value) = self.value(name, &["integer", "float"], "a whole number (`integer`)")? else {
            return Ok(None);
        };
        let n = number(value)?;
        let whole = (n.fract() == 0.0 && n.abs() < 1e18).then_some(n as i64).filter(|n| range.contains(n));
        let expected = format!("a whole number from {} to {}", range.start(), range.end());
        let wrong = || Box::new(value.at.bad("mitsuba::value", format!("`{name}` is {n}")).expected(expected));
        whole.ok_or_else(wrong).map(Some)
    }

    /// Yes or no.
    pub(super) fn boolean(&self, name: &'static str, default: bool) -> Found<bool> {
        let Some(value) = self.value(name, &["boolean"], "`true` or `false` (`boolean`)")? else { return Ok(default) };
        match value.value.trim().to_ascii_lowercase().as_str() {
            "true" => Ok(true),
            "false" => Ok(false),
            other => Err(Box::new(
                value.at.bad("mitsuba::value", format!("`{}`", shortened(other))).expected("`true` or `false`"),
            )),
        }
    }

    /// A text, if it is given.
    pub(super) fn string(&self, name: &'static str) -> Found<Option<&'d Attribute>> {
        self.value(name, &["string"], "a text (`string`)")
    }

    /// A word out of a list.
    pub(super) fn word(&self, name: &'static str, default: &'d str, words: &[&str]) -> Found<&'d str> {
        let Some(value) = self.string(name)? else { return Ok(default) };
        if words.contains(&value.value.as_str()) {
            return Ok(&value.value);
        }
        Err(value.at.unknown(&format!("`{name}`"), &value.value, words.iter().copied()))
    }

    /// A point or a vector, if it is given.
    pub(super) fn vector(&self, name: &'static str) -> Found<Option<DVec3>> {
        let Some((_, element)) = self.get(name) else { return Ok(None) };
        if !["point", "vector"].contains(&element.tag.as_str()) {
            let error = element.at.bad("mitsuba::kind", format!("`{name}` is given as `{}`", element.tag));
            return Err(Box::new(error.expected("`point` or `vector`")));
        }
        transforms::xyz(element, 0.0).map(Some)
    }

    /// A transformation; by default none. Of one that changes with time that of the first moment.
    pub(super) fn transform(&self, name: &'static str) -> Found<DAffine3> {
        let Some((number, element)) = self.get(name) else { return Ok(DAffine3::IDENTITY) };
        match element.tag.as_str() {
            "transform" => transforms::transform(self.document, number),
            "animation" => match element.children.first() {
                Some(first) => transforms::transform(self.document, *first),
                None => Ok(DAffine3::IDENTITY),
            },
            _ => {
                let error = element.at.bad("mitsuba::kind", format!("`{name}` is given as `{}`", element.tag));
                Err(Box::new(error.expected("`transform`")))
            }
        }
    }

    /// Warnings about values and objects that nobody asked for.
    pub(super) fn unused(&self) -> Vec<Diagnostic> {
        let asked = self.asked.borrow();
        let mut names = asked.clone();
        names.sort_unstable();
        names.dedup();
        let tell = |entry: &Entry| {
            let Element { tag, name, at, .. } = entry.element;
            let place = entry.element.attribute("name").map_or(at, |a| &a.at);
            let (message, found) = match name {
                Some(name) => (format!("`{}` means nothing here", shortened(name)), name.as_str()),
                None => (format!("`{tag}` means nothing here"), ""),
            };
            let told = place.tell(Diagnostic::warning("mitsuba::unused", message), "passed over");
            if words::VALUES.contains(&tag.as_str()) { told.one_of(found, names.iter().copied()) } else { told }
        };
        self.entries.iter().filter(|e| !e.is_used.get()).map(tell).collect()
    }
}

/// Numbers between blanks or commas.
pub(super) fn numbers(value: &Attribute) -> Found<Vec<f64>> {
    let words = value.value.split([',', ' ', '\t', '\n', '\r']).filter(|w| !w.is_empty());
    words.map(|word| parsed(word, value)).collect()
}

/// One number.
fn number(value: &Attribute) -> Found<f64> {
    parsed(value.value.trim(), value)
}

/// Three numbers.
pub(super) fn triple(value: &Attribute) -> Found<DVec3> {
    match numbers(value)?[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        _ => Err(value.at.bad("mitsuba::value", "three numbers are needed")),
    }
}

fn parsed(word: &str, value: &Attribute) -> Found<f64> {
    let parsed = word.parse::<f64>().ok().filter(|x| x.is_finite() && x.abs() <= f64::from(f32::MAX));
    parsed.ok_or_else(|| {
        let error = value.at.bad("mitsuba::number", format!("`{}` is not a number", shortened(word)));
        Box::new(error.expected("finite numbers such as 0.5, -3 or 1e-4"))
    })
}
