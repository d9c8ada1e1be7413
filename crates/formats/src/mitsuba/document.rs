//! What the files of a scene say, as a tree.

use crate::diagnostic::{Diagnostic, SourceFile, Span};
use std::collections::HashMap;
use std::rc::Rc;

/// A value, or what is wrong with it.
pub(super) type Found<T> = Result<T, Box<Diagnostic>>;

/// A place in one of the files.
#[derive(Clone, Debug)]
pub(super) struct At {
    pub(super) source: Rc<SourceFile>,
    pub(super) span: Span,
}

impl At {
    /// A finding at this place.
    pub(super) fn tell(&self, finding: Diagnostic, label: &str) -> Diagnostic {
        finding.at(&self.source, self.span, label)
    }
    /// An error at this place.
    pub(super) fn bad(&self, code: &'static str, message: impl Into<String>) -> Box<Diagnostic> {
        Box::new(self.tell(Diagnostic::error(code, message), ""))
    }
    /// A name that is none of `names`.
    pub(super) fn unknown<'n>(
        &self,
        what: &str,
        name: &str,
        names: impl IntoIterator<Item = &'n str>,
    ) -> Box<Diagnostic> {
        let mut names: Vec<&str> = names.into_iter().collect();
        names.sort_unstable();
        let message = format!("no {what} `{}`", crate::lines::shortened(name));
        Box::new(self.tell(Diagnostic::error("mitsuba::unknown-name", message), "").one_of(name, names))
    }
}

/// An attribute, with `$names` filled in.
#[derive(Clone, Debug)]
pub(super) struct Attribute {
    pub(super) name: String,
    pub(super) value: String,
    /// Where the value stands.
    pub(super) at: At,
}

/// An element.
#[derive(Clone, Debug)]
pub(super) struct Element {
    /// Its kind, such as `shape` or `float`; older names are turned into those of version 3.
    pub(super) tag: String,
    /// Where its kind stands.
    pub(super) at: At,
    pub(super) attributes: Vec<Attribute>,
    /// Numbers of elements in the document.
    pub(super) children: Vec<usize>,
    /// The name of the property that it is, in snake case.
    pub(super) name: Option<String>,
    /// Whether its file is older than version 2.
    pub(super) is_old: bool,
}

impl Element {
    /// The attribute of that name.
    pub(super) fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.name == name)
    }
    /// The attribute of that name, which must be there.
    pub(super) fn required(&self, name: &str) -> Found<&Attribute> {
        let missing = || self.at.bad("mitsuba::no-attribute", format!("`{}` needs the attribute `{name}`", self.tag));
        self.attribute(name).ok_or_else(missing)
    }
    /// Which plugin it asks for, and where it says so.
    pub(super) fn plugin(&self) -> Found<(&str, &At)> {
        self.required("type").map(|a| (a.value.as_str(), &a.at))
    }
}

/// A scene's elements.
#[derive(Debug, Default)]
pub(super) struct Document {
    pub(super) elements: Vec<Element>,
    /// What stands directly in the scene.
    pub(super) top: Vec<usize>,
    /// Elements by their name.
    pub(super) ids: HashMap<String, usize>,
}

impl Document {
    /// The children of an element.
    pub(super) fn children(&self, element: usize) -> impl Iterator<Item = &Element> {
        self.elements[element].children.iter().map(|i| &self.elements[*i])
    }
    /// What an element stands for: that which a `ref` names, or itself.
    pub(super) fn resolve(&self, element: usize) -> Found<usize> {
        let found = &self.elements[element];
        if found.tag != "ref" {
            return Ok(element);
        }
        let id = found.required("id")?;
        match self.ids.get(&id.value) {
            Some(target) => Ok(*target),
            None => Err(id.at.unknown("object with the id", &id.value, self.ids.keys().map(String::as_str))),
        }
    }
}

/// `toWorld` to `to_world`, `intIOR` to `int_ior`.
pub(super) fn snake_case(name: &str) -> String {
    let mut snake = String::with_capacity(name.len() + 4);
    let mut previous_is_small = false;
    for c in name.chars() {
        if c.is_ascii_uppercase() && previous_is_small {
            snake.push('_');
        }
        previous_is_small = c.is_ascii_lowercase() || c.is_ascii_digit();
        snake.push(c.to_ascii_lowercase());
    }
    snake
}

#[cfg(test)]
mod tests {
    use super::snake_case;

    #[test]
    fn old_names_become_new_ones() {
        for (old, new) in [("toWorld", "to_world"), ("intIOR", "int_ior"), ("alphaU", "alpha_u"), ("fov", "fov")] {
            assert_eq!(snake_case(old), new);
            assert_eq!(snake_case(new), new);
        }
    }
}
