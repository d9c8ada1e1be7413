//! The parameters behind a directive: `"type name" value` or `"type name" [ values ]`, in any number and order.

use super::lexer::Kind;
use super::tokens::{At, Token, Tokens};
use crate::diagnostic::Diagnostic;
use crate::lines::shortened;
use glam::{DVec3, Vec2, Vec3};
use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

/// A finding that ends what is being read, or what was read.
pub(super) type Found<T> = Result<T, Box<Diagnostic>>;

const TYPES: [&str; 18] = [
    "bool",
    "integer",
    "float",
    "point2",
    "vector2",
    "point3",
    "vector3",
    "point",
    "vector",
    "normal",
    "normal3",
    "spectrum",
    "rgb",
    "xyz",
    "color",
    "blackbody",
    "texture",
    "string",
];

/// The values of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Values {
    Numbers(Vec<f64>),
    Strings(Vec<String>),
    Bools(Vec<bool>),
}

/// One parameter.
#[derive(Clone, Debug)]
pub(super) struct Param {
    /// `float`, `rgb`, ...
    pub(super) kind: String,
    pub(super) name: String,
    pub(super) values: Values,
    pub(super) at: At,
    used: Cell<bool>,
}

impl Param {
    pub(super) fn numbers(&self) -> Option<&[f64]> {
        if let Values::Numbers(numbers) = &self.values { Some(numbers) } else { None }
    }
    pub(super) fn strings(&self) -> Option<&[String]> {
        if let Values::Strings(strings) = &self.values { Some(strings) } else { None }
    }
    /// What is wrong with its values.
    pub(super) fn expected(&self, what: impl Into<String>) -> Box<Diagnostic> {
        let message = format!("`{}` has values that do not fit", self.name);
        Box::new(self.at.tell(Diagnostic::error("pbrt::value", message), "").expected(what))
    }
}

/// All parameters of a directive. Of one given twice, the last counts, as in pbrt.
#[derive(Clone, Debug)]
pub(super) struct Params {
    /// The directive.
    pub(super) at: At,
    list: Vec<Param>,
    /// Names that were looked for: those that mean something here.
    asked: RefCell<BTreeSet<&'static str>>,
}

impl Params {
    /// Reads all that follows.
    pub(super) fn read(tokens: &mut Tokens, at: At) -> Found<Self> {
        let mut list = Vec::new();
        while let Some(declaration) = tokens.next_if(Kind::String)? {
            list.push(param(tokens, declaration.at)?);
        }
        Ok(Self { at, list, asked: RefCell::default() })
    }

    /// Puts `defaults` in front, so that what was said here wins.
    pub(super) fn with_defaults(mut self, defaults: &[Param]) -> Self {
        self.list.splice(0..0, defaults.iter().cloned().inspect(|p| p.used.set(true)));
        self
    }

    /// Takes the list out, for directives that only pass it on.
    pub(super) fn into_list(self) -> Vec<Param> {
        self.list
    }

    /// The parameter, marked as used.
    pub(super) fn get(&self, name: &'static str) -> Option<&Param> {
        self.asked.borrow_mut().insert(name);
        let mut found = None;
        for param in self.list.iter().filter(|p| p.name == name) {
            param.used.set(true);
            found = Some(param);
        }
        found
    }

    /// Numbers, exactly `count` unless that is 0.
    pub(super) fn numbers(&self, name: &'static str, count: usize) -> Found<Option<&[f64]>> {
        let Some(param) = self.get(name) else { return Ok(None) };
        match param.numbers() {
            Some(numbers) if count == 0 || numbers.len() == count => Ok(Some(numbers)),
            // One number too many is common and harmless.
            Some(numbers) if count == 1 && !numbers.is_empty() => Ok(Some(&numbers[..1])),
            _ => Err(param.expected(match count {
                0 => "numbers".to_owned(),
                1 => "a number".to_owned(),
                n => format!("{n} numbers"),
            })),
        }
    }

    pub(super) fn number(&self, name: &'static str, default: f64) -> Found<f64> {
        Ok(self.numbers(name, 1)?.map_or(default, |n| n[0]))
    }

    pub(super) fn maybe_number(&self, name: &'static str) -> Found<Option<f64>> {
        Ok(self.numbers(name, 1)?.map(|n| n[0]))
    }

    /// A whole number in `range`.
    pub(super) fn integer(&self, name: &'static str, range: std::ops::RangeInclusive<i64>) -> Found<Option<i64>> {
        let Some(number) = self.maybe_number(name)? else { return Ok(None) };
        if number.fract() == 0.0 && range.contains(&(number as i64)) {
            return Ok(Some(number as i64));
        }
        let expected = format!("a whole number from {} to {}", range.start(), range.end());
        Err(self.misfit(name, expected))
    }

    pub(super) fn vec3(&self, name: &'static str) -> Found<Option<DVec3>> {
        Ok(self.numbers(name, 3)?.map(DVec3::from_slice))
    }

    /// Triples, such as positions.
    pub(super) fn triples(&self, name: &'static str) -> Found<Vec<DVec3>> {
        let Some(numbers) = self.numbers(name, 0)? else { return Ok(Vec::new()) };
        if numbers.len() % 3 == 0 {
            return Ok(numbers.chunks_exact(3).map(DVec3::from_slice).collect());
        }
        Err(self.misfit(name, "three numbers each"))
    }

    /// Pairs, such as texture coordinates.
    pub(super) fn pairs(&self, name: &'static str) -> Found<Vec<Vec2>> {
        let numbers = self.numbers(name, 0)?.unwrap_or_default();
        Ok(numbers.chunks_exact(2).map(|p| Vec2::new(p[0] as f32, p[1] as f32)).collect())
    }

    /// Indices of vertices below `count`.
    pub(super) fn indices(&self, name: &'static str) -> Found<Option<Vec<u32>>> {
        let Some(numbers) = self.numbers(name, 0)? else { return Ok(None) };
        let index = |n: &f64| {
            let whole = *n >= 0.0 && *n < f64::from(u32::MAX) && n.fract() == 0.0;
            if whole { *n as u32 } else { u32::MAX }
        };
        Ok(Some(numbers.iter().map(index).collect()))
    }

    pub(super) fn bool(&self, name: &'static str, default: bool) -> Found<bool> {
        let Some(param) = self.get(name) else { return Ok(default) };
        match &param.values {
            Values::Bools(values) if values.len() == 1 => Ok(values[0]),
            Values::Strings(values) if values.len() == 1 && values[0] == "true" => Ok(true),
            Values::Strings(values) if values.len() == 1 && values[0] == "false" => Ok(false),
            _ => Err(param.expected("`true` or `false`")),
        }
    }

    pub(super) fn string(&self, name: &'static str) -> Found<Option<&str>> {
        let Some(param) = self.get(name) else { return Ok(None) };
        match param.strings() {
            Some([one]) => Ok(Some(one)),
            _ => Err(param.expected("one string")),
        }
    }

    /// One of several words.
    pub(super) fn word(
        &self,
        name: &'static str,
        default: &'static str,
        words: &[&'static str],
    ) -> Found<&'static str> {
        let Some(found) = self.string(name)? else { return Ok(default) };
        if let Some(word) = words.iter().find(|w| **w == found) {
            return Ok(word);
        }
        let at = self.get(name).map_or(&self.at, |p| &p.at);
        let error = at.tell(Diagnostic::error("pbrt::word", format!("`{found}` is no value of `{name}`")), "");
        Err(Box::new(error.one_of(found, words.iter().copied())))
    }

    /// An error about the values of a parameter.
    pub(super) fn misfit(&self, name: &'static str, expected: impl Into<String>) -> Box<Diagnostic> {
        match self.get(name) {
            Some(param) => param.expected(expected),
            None => Box::new(self.bad("pbrt::value", name).expected(expected)),
        }
    }

    /// An error about the directive.
    pub(super) fn bad(&self, code: &'static str, message: &str) -> Box<Diagnostic> {
        Box::new(self.at.tell(Diagnostic::error(code, message), ""))
    }

    /// Says that these names are known here, but mean nothing to us.
    pub(super) fn ignore(&self, names: &[&'static str]) {
        self.asked.borrow_mut().extend(names);
        self.list.iter().filter(|p| names.contains(&p.name.as_str())).for_each(|p| p.used.set(true));
    }

    /// A warning for each parameter that nobody looked for.
    pub(super) fn unused(&self) -> Vec<Diagnostic> {
        let asked = self.asked.borrow();
        let unused = self.list.iter().filter(|p| !p.used.get());
        let tell = |p: &Param| {
            let message = format!("`{}` is no parameter here", shortened(&p.name));
            let warning = p.at.tell(Diagnostic::warning("pbrt::unused-parameter", message), "ignored");
            warning.one_of(&p.name, asked.iter().copied())
        };
        unused.map(tell).collect()
    }
}

/// f64 to f32.
pub(super) fn single(v: DVec3) -> Vec3 {
    v.as_vec3()
}

fn param(tokens: &mut Tokens, at: At) -> Found<Param> {
    let declaration = at.text();
    let mut words = declaration.split_whitespace();
    let (Some(kind), Some(name), None) = (words.next(), words.next(), words.next()) else {
        let message = format!("`{}` declares no parameter", shortened(&declaration));
        let error = at.tell(Diagnostic::error("pbrt::declaration", message), "");
        return Err(Box::new(error.expected("a type and a name, such as \"float radius\"")));
    };
    if !TYPES.contains(&kind) {
        let error = at.tell(Diagnostic::error("pbrt::type", format!("an unknown type `{}`", shortened(kind))), "");
        return Err(Box::new(error.one_of(kind, TYPES)));
    }
    let values = values(tokens, &at)?;
    Ok(Param { kind: kind.to_owned(), name: name.to_owned(), values, at, used: Cell::new(false) })
}

fn values(tokens: &mut Tokens, declaration: &At) -> Found<Values> {
    let mut values = Values::Numbers(Vec::new());
    let Some(first) = tokens.next()? else { return Err(no_value(declaration)) };
    if first.kind != Kind::Open {
        push(&mut values, &first, declaration)?;
        return Ok(values);
    }
    loop {
        let Some(token) = tokens.next()? else {
            let error = first.at.tell(Diagnostic::error("pbrt::open-list", "this list does not end"), "begins here");
            return Err(Box::new(error.expected("`]`")));
        };
        if token.kind == Kind::Close {
            return Ok(values);
        }
        push(&mut values, &token, declaration)?;
    }
}

fn no_value(declaration: &At) -> Box<Diagnostic> {
    Box::new(declaration.tell(Diagnostic::error("pbrt::no-value", "this parameter has no value"), ""))
}

fn push(values: &mut Values, token: &Token, declaration: &At) -> Found<()> {
    let mixed = || {
        let error = token.at.tell(Diagnostic::error("pbrt::mixed", "a value of another kind than the first"), "");
        Box::new(error)
    };
    let empty = matches!(values, Values::Numbers(n) if n.is_empty());
    match token.kind {
        Kind::Number => match values {
            Values::Numbers(numbers) => numbers.push(number(token)?),
            _ => return Err(mixed()),
        },
        Kind::String => match values {
            Values::Strings(strings) => strings.push(token.at.text()),
            _ if empty => *values = Values::Strings(vec![token.at.text()]),
            _ => return Err(mixed()),
        },
        Kind::Word => {
            let value = match token.at.source.slice(token.at.span) {
                b"true" => true,
                b"false" => false,
                _ => return Err(no_value(declaration)),
            };
            match values {
                Values::Bools(bools) => bools.push(value),
                _ if empty => *values = Values::Bools(vec![value]),
                _ => return Err(mixed()),
            }
        }
        Kind::Open | Kind::Close => return Err(no_value(declaration)),
    }
    Ok(())
}

/// The value of a number token.
pub(super) fn number(token: &Token) -> Found<f64> {
    let text = std::str::from_utf8(token.at.source.slice(token.at.span)).ok();
    let value = text.and_then(|t| t.parse::<f64>().ok()).filter(|v| v.abs() < 1e38);
    value.ok_or_else(|| {
        let message = format!("`{}` is no number", shortened(&token.at.text()));
        Box::new(token.at.tell(Diagnostic::error("pbrt::number", message), "").expected("a finite number"))
    })
}
