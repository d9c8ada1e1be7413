//! `KIND[:PRESET][:KEY=VALUE]...`, and what else is told in one word.
use crate::failure::Failure;
use formats::diagnostic::Diagnostic;
use formats::load::Projection;
use glam::Vec3;
use std::cell::RefCell;
use sunfleck::camera::Unrolling;

/// A thing with its settings.
pub(super) struct Spec<'a> {
    flag: &'static str,
    pub(super) kind: &'a str,
    pub(super) preset: Option<&'a str>,
    pairs: Vec<(&'a str, &'a str)>,
    asked: RefCell<Vec<&'static str>>,
}

impl<'a> Spec<'a> {
    pub(super) fn read(flag: &'static str, text: &'a str) -> Result<Self, Failure> {
        let mut words = text.split(':');
        let kind = words.next().unwrap_or_default();
        let mut spec = Self { flag, kind, preset: None, pairs: Vec::new(), asked: RefCell::default() };
        for word in words {
            match word.split_once('=') {
                Some(pair) => spec.pairs.push(pair),
                None if spec.preset.is_none() && spec.pairs.is_empty() => spec.preset = Some(word),
                None => return Err(spec.bad(&format!("`{word}` is no `key=value`"))),
            }
        }
        Ok(spec)
    }

    /// An error about this thing.
    pub(super) fn bad(&self, why: &str) -> Failure {
        Failure::input(format!("{} {}: {why}", self.flag, self.kind))
    }

    /// That a name is none of those that are known.
    pub(super) fn unknown<'n>(&self, what: &str, name: &str, known: impl IntoIterator<Item = &'n str>) -> Failure {
        let message = format!("{}: no {what} `{name}`", self.flag);
        formats::Error::from(Diagnostic::error("flag::unknown", message).one_of(name, known)).into()
    }

    fn get(&self, key: &'static str) -> Option<&'a str> {
        self.asked.borrow_mut().push(key);
        self.pairs.iter().rev().find(|(k, _)| *k == key).map(|(_, v)| *v)
    }

    /// A number that is `ok`, or `default`.
    pub(super) fn number(
        &self,
        key: &'static str,
        default: f32,
        ok: impl Fn(f32) -> bool,
        range: &str,
    ) -> Result<f32, Failure> {
        let Some(text) = self.get(key) else { return Ok(default) };
        let number = text.trim().parse::<f32>().ok().filter(|v| v.is_finite() && ok(*v));
        number.ok_or_else(|| self.bad(&format!("`{key}` is `{text}`, but must be {range}")))
    }

    /// Three numbers with commas between.
    pub(super) fn vector(&self, key: &'static str) -> Result<Option<Vec3>, Failure> {
        let Some(text) = self.get(key) else { return Ok(None) };
        match numbers(text)[..] {
            [x, y, z] => Ok(Some(Vec3::new(x, y, z))),
            _ => Err(self.bad(&format!("`{key}` is `{text}`, but must be three numbers such as 0,1,0"))),
        }
    }

    /// Three numbers of 0 or more with commas between, or one for grey.
    pub(super) fn colour(&self, key: &'static str, default: Vec3) -> Result<Vec3, Failure> {
        let Some(text) = self.get(key) else { return Ok(default) };
        let colour = match numbers(text)[..] {
            [grey] => Some(Vec3::splat(grey)),
            [r, g, b] => Some(Vec3::new(r, g, b)),
            _ => None,
        };
        let ok = colour.filter(|c| c.min_element() >= 0.0);
        ok.ok_or_else(|| self.bad(&format!("`{key}` is `{text}`, but must be a number of 0 or more, or three")))
    }

    /// An error for the first key that means nothing here.
    pub(super) fn tell_unknown(&self) -> Result<(), Failure> {
        let asked = self.asked.borrow();
        match self.pairs.iter().find(|(key, _)| !asked.contains(key)) {
            Some((key, _)) => Err(self.unknown(&format!("setting of `{}`", self.kind), key, asked.iter().copied())),
            None => Ok(()),
        }
    }
}

/// All numbers with commas between; none if one of them is no finite number.
fn numbers(text: &str) -> Vec<f32> {
    let all: Option<Vec<f32>> =
        text.split(',').map(|t| t.trim().parse().ok().filter(|v: &f32| v.is_finite())).collect();
    all.unwrap_or_default()
}

/// `NAME=WHAT` of `--material`.
pub(crate) fn replacement(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, what)) if !name.is_empty() && !what.is_empty() => Ok((name.to_owned(), what.to_owned())),
        _ => Err("expected a name, an equals sign and a material, such as `Ball=glass:bk7`".to_owned()),
    }
}

/// The kind of camera of `--camera`.
pub(crate) fn projection(text: &str) -> Result<Projection, String> {
    let expected = || "expected `perspective`, `orthographic:HEIGHT`, `spherical` or `spherical:equal-area`".to_owned();
    match text.split_once(':').unwrap_or((text, "")) {
        ("perspective", "") => Ok(Projection::Perspective),
        ("spherical", "") => Ok(Projection::Spherical(Unrolling::Equirectangular)),
        ("spherical", "equal-area") => Ok(Projection::Spherical(Unrolling::EqualArea)),
        ("orthographic", height) => {
            let height = height.parse::<f32>().ok().filter(|h| *h > 0.0 && h.is_finite());
            height.map(Projection::Orthographic).ok_or_else(expected)
        }
        _ => Err(expected()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spec_has_a_kind_a_preset_and_settings() {
        let spec = Spec::read("--material", "glass:bk7:tint=0.9,0.8,0.7:ior=1.6").unwrap();
        assert_eq!((spec.kind, spec.preset), ("glass", Some("bk7")));
        assert_eq!(spec.colour("tint", Vec3::ONE).unwrap(), Vec3::new(0.9, 0.8, 0.7));
        assert!(spec.tell_unknown().is_err());
        assert_eq!(spec.number("ior", 1.5, |v| v > 0.0, "positive").unwrap(), 1.6);
        assert!(spec.tell_unknown().is_ok());
        assert!(spec.number("ior", 1.5, |v| v > 2.0, "above 2").is_err());
        assert!(Spec::read("--material", "glass:ior=1.5:bk7").is_err());
    }

    #[test]
    fn cameras_and_replacements_are_read() {
        assert_eq!(projection("orthographic:2.5"), Ok(Projection::Orthographic(2.5)));
        assert!(
            projection("orthographic").is_err() && projection("orthographic:-1").is_err() && projection("x").is_err()
        );
        assert_eq!(replacement("a b=glass:ior=2"), Ok(("a b".into(), "glass:ior=2".into())));
        assert!(replacement("glass").is_err() && replacement("=glass").is_err());
    }
}
