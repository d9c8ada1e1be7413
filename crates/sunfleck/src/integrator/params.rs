//! Named settings of algorithms, as they come from a command line or a scene file.
use super::Entry;
use crate::walk::Limits;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// What a setting is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ParamInfo {
    /// Word.
    pub name: &'static str,
    /// One line: meaning, range, default.
    pub about: &'static str,
}

/// Settings by name; those taken are removed, so that what is left over can be reported.
#[derive(Clone, Debug, Default)]
pub struct Params(BTreeMap<String, String>);

/// A setting that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParamError {
    /// A name that the algorithm does not know.
    #[error("`{name}` is not a setting of `{integrator}`; it knows {}", known.join(", "))]
    Unknown {
        /// The name.
        name: String,
        /// The algorithm.
        integrator: &'static str,
        /// What it knows.
        known: Vec<&'static str>,
    },
    /// A value of the wrong kind or out of range.
    #[error("{name}={value} is not {expected}")]
    Value {
        /// The setting.
        name: &'static str,
        /// Its value.
        value: String,
        /// What it should be.
        expected: String,
    },
}

/// Settings common to all algorithms.
const COMMON: [ParamInfo; 3] = [
    ParamInfo {
        name: "scatterings",
        about: "scatterings on a path from light to eye at most, 0 to 10000 (default 64)",
    },
    ParamInfo {
        name: "roulette-after",
        about: "scatterings before Russian roulette on camera paths, 0 to 10000 (default 3)",
    },
    ParamInfo {
        name: "texture-filter",
        about: "colours that the camera sees are means over its pixel, which gets narrower with each pass: on or off (default on)",
    },
];

impl Entry {
    /// All settings it takes: its own, then those common to all algorithms.
    pub fn settings(&self) -> impl Iterator<Item = &'static ParamInfo> {
        self.params.iter().chain(&COMMON)
    }
}

impl Params {
    /// Sets `name` to `value`, replacing an earlier one.
    pub fn set(&mut self, name: impl Into<String>, value: impl Into<String>) {
        self.0.insert(name.into(), value.into());
    }
    /// Takes a number in `range`, or `default`.
    ///
    /// # Errors
    /// Not a number, or out of range.
    pub fn number(&mut self, name: &'static str, default: f64, range: RangeInclusive<f64>) -> Result<f64, ParamError> {
        let Some(value) = self.0.remove(name) else { return Ok(default) };
        let parsed = value.parse::<f64>().ok().filter(|v| range.contains(v));
        parsed.ok_or_else(|| ParamError::Value {
            name,
            value,
            expected: format!("a number from {} to {}", range.start(), range.end()),
        })
    }
    /// Takes a whole number in `range`, or `default`. Exponents are welcome: `1e6`.
    ///
    /// # Errors
    /// Not a whole number, or out of range.
    pub fn count(&mut self, name: &'static str, default: u64, range: RangeInclusive<u64>) -> Result<u64, ParamError> {
        let Some(value) = self.0.remove(name) else { return Ok(default) };
        let parsed =
            value.parse::<f64>().ok().filter(|v| v.fract() == 0.0 && (0.0..=9e15).contains(v)).map(|v| v as u64);
        parsed.filter(|v| range.contains(v)).ok_or_else(|| ParamError::Value {
            name,
            value,
            expected: format!("a whole number from {} to {}", range.start(), range.end()),
        })
    }
    /// Takes one of `words` and returns its place, or `default`.
    ///
    /// # Errors
    /// Another word.
    pub fn word(&mut self, name: &'static str, default: usize, words: &[&str]) -> Result<usize, ParamError> {
        let Some(value) = self.0.remove(name) else { return Ok(default) };
        let found = words.iter().position(|w| *w == value);
        found.ok_or_else(|| ParamError::Value { name, value, expected: format!("one of {}", words.join(", ")) })
    }
    /// Takes `on` or `off`, or `default`.
    ///
    /// # Errors
    /// Another word.
    pub fn switch(&mut self, name: &'static str, default: bool) -> Result<bool, ParamError> {
        self.word(name, usize::from(default), &["off", "on"]).map(|i| i == 1)
    }
    /// Takes the settings common to all algorithms.
    ///
    /// # Errors
    /// A value out of range.
    pub fn limits(&mut self) -> Result<Limits, ParamError> {
        let d = Limits::default();
        let scatterings = self.count(COMMON[0].name, u64::from(d.scatterings), 0..=10_000)? as u32;
        let roulette_after = self.count(COMMON[1].name, u64::from(d.roulette_after), 0..=10_000)? as u32;
        let filter = self.switch(COMMON[2].name, d.filter)?;
        Ok(Limits { scatterings, roulette_after, filter, ..d })
    }
    /// Complains of what nobody took.
    pub(super) fn finish(self, entry: &Entry) -> Result<(), ParamError> {
        match self.0.into_keys().next() {
            None => Ok(()),
            Some(name) => {
                let known = entry.settings().map(|p| p.name).collect();
                Err(ParamError::Unknown { name, integrator: entry.name, known })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::integrator::{Params, REGISTRY, find};

    #[test]
    fn every_algorithm_takes_the_common_settings_and_all_that_it_lists() {
        for e in REGISTRY {
            let mut p = Params::default();
            p.set("scatterings", "5");
            p.set("roulette-after", "2");
            assert!(e.build(p).is_ok(), "{}", e.name);
            for info in e.params {
                let mut p = Params::default();
                p.set(info.name, "no such value");
                let message =
                    e.build(p).err().unwrap_or_else(|| panic!("{} does not read {}", e.name, info.name)).to_string();
                assert!(message.starts_with(info.name), "{message}");
            }
        }
    }

    #[test]
    fn unknown_names_and_bad_values_say_what_is_right() {
        let entry = find("path").unwrap();
        let message = |k: &str, v: &str| {
            let mut p = Params::default();
            p.set(k, v);
            entry.build(p).err().unwrap().to_string()
        };
        assert_eq!(
            message("scaterings", "1"),
            "`scaterings` is not a setting of `path`; it knows scatterings, roulette-after, texture-filter"
        );
        assert_eq!(message("scatterings", "-1"), "scatterings=-1 is not a whole number from 0 to 10000");
    }
}
