//! Collects findings while a reader goes on, so that one run reports several problems, but not thousands.

use super::{Diagnostic, Error};
use std::collections::BTreeMap;

/// A reader gives up after this many errors.
pub const MAX_ERRORS: usize = 20;

/// Of each kind of warning this many are kept; the others are only counted.
pub const WARNINGS_PER_CODE: usize = 3;

/// Errors and warnings found so far.
#[derive(Debug, Default)]
pub struct Sink {
    errors: Vec<Diagnostic>,
    warnings: Vec<Diagnostic>,
    counts: BTreeMap<&'static str, usize>,
}

impl Sink {
    /// Records an error. Errors beyond [`MAX_ERRORS`] are dropped.
    pub fn error(&mut self, error: Diagnostic) {
        if !self.is_full() {
            self.errors.push(error);
        }
    }

    /// Records a warning of kind `code`; `make` runs only if the warning is kept, since finding a line takes time.
    pub fn warn(&mut self, code: &'static str, make: impl FnOnce() -> Diagnostic) {
        let count = self.counts.entry(code).or_default();
        *count += 1;
        if *count <= WARNINGS_PER_CODE {
            self.warnings.push(make());
        }
    }

    /// True once reading on would only add noise.
    pub fn is_full(&self) -> bool {
        self.errors.len() >= MAX_ERRORS
    }

    /// True if no error was recorded.
    pub fn is_ok(&self) -> bool {
        self.errors.is_empty()
    }

    /// `value` if no error was recorded.
    ///
    /// # Errors
    /// All errors recorded, in the order of their places, with the warnings.
    pub fn finish<T>(&mut self, value: T) -> Result<T, Error> {
        if self.is_ok() {
            return Ok(value);
        }
        self.errors.sort_by_key(|e| {
            let at = e.place.as_ref().map(|p| (p.file.clone(), p.at.as_ref().map(|at| (at.line, at.column))));
            at.unwrap_or_default()
        });
        if self.is_full()
            && let Some(last) = self.errors.last_mut()
        {
            last.help.push(format!("reading stopped after {MAX_ERRORS} errors"));
        }
        Err(Error { errors: std::mem::take(&mut self.errors), warnings: self.take_warnings() })
    }

    /// The warnings kept, with a note on the last of each kind about those that were only counted.
    pub fn take_warnings(&mut self) -> Vec<Diagnostic> {
        for (code, count) in std::mem::take(&mut self.counts) {
            let left_out = count.saturating_sub(WARNINGS_PER_CODE);
            if left_out > 0
                && let Some(last) = self.warnings.iter_mut().rfind(|w| w.code == code)
            {
                last.help.push(format!("{left_out} more of this kind in this file"));
            }
        }
        std::mem::take(&mut self.warnings)
    }
}
