//! What is wrong with an input, where, and what would be right.
//!
//! Every reader of this crate speaks through [`Diagnostic`]: a message, the place (`file:line:column` with the line
//! itself), what was expected, the valid names and the nearest of them. The data are self-contained (no borrowed
//! source), so they can be kept, sorted, or drawn by a window; [`Diagnostic::render`] gives the text for a terminal.
//!
//! Neighbours: [`SourceFile`] reads the bytes, [`Sink`] collects while a reader goes on after an error.

mod place;
mod render;
mod sink;
mod source;
mod suggest;
#[cfg(test)]
mod tests;

pub use place::{Excerpt, Place, Position, Span};
pub use sink::{MAX_ERRORS, Sink, WARNINGS_PER_CODE};
pub use source::{MAX_FILE_BYTES, SourceFile, names_near};
pub(crate) use source::{is_line_end, read_bytes};
pub use suggest::nearest;

/// How grave a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The input was read, but not all of it means what its author may think.
    Warning,
    /// The input cannot be read, or breaks a rule of its format; the latter may be among the warnings of what was read.
    Error,
}

/// One finding about an input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// A stable name of the kind of finding, such as `scn::unknown-material`.
    pub code: &'static str,
    /// One line: what is wrong.
    pub message: String,
    /// Where; `None` when no file is at fault.
    pub place: Option<Place>,
    /// Another place that explains the first (an earlier definition).
    pub related: Vec<Place>,
    /// What would have been right here, in words.
    pub expected: Option<String>,
    /// All names that are valid here.
    pub valid: Vec<String>,
    /// The valid name most like the one found.
    pub nearest: Option<String>,
    /// Advice, one line each.
    pub help: Vec<String>,
}

impl Diagnostic {
    /// A finding that makes the input unreadable.
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, message.into())
    }

    /// A finding that leaves the input readable.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, message.into())
    }

    fn new(severity: Severity, code: &'static str, message: String) -> Self {
        Self {
            severity,
            code,
            message,
            place: None,
            related: Vec::new(),
            expected: None,
            valid: Vec::new(),
            nearest: None,
            help: Vec::new(),
        }
    }

    /// Adds the place: `span` of `source`, with `label` under the caret (may be empty).
    pub fn at(mut self, source: &SourceFile, span: Span, label: impl Into<String>) -> Self {
        self.place = Some(source.place(span, label));
        self
    }

    /// Adds a place without a line: the file as a whole.
    pub fn in_file(mut self, file: impl Into<String>) -> Self {
        self.place = Some(Place { file: file.into(), at: None, label: String::new() });
        self
    }

    /// Adds a second place that explains the first.
    pub fn see(mut self, source: &SourceFile, span: Span, label: impl Into<String>) -> Self {
        self.related.push(source.place(span, label));
        self
    }

    /// Says what would have been right.
    pub fn expected(mut self, what: impl Into<String>) -> Self {
        self.expected = Some(what.into());
        self
    }

    /// Lists the valid names and picks the one nearest to `found`, if any is near.
    pub fn one_of<'n>(mut self, found: &str, names: impl IntoIterator<Item = &'n str>) -> Self {
        self.valid = names.into_iter().take(suggest::MAX_NAMES).map(str::to_owned).collect();
        self.nearest = nearest(found, self.valid.iter().map(String::as_str)).map(str::to_owned);
        self
    }

    /// Adds a line of advice.
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help.push(text.into());
        self
    }

    /// The text for a person: message, `file:line:column`, the line with a caret, advice. `colour` adds ANSI styles.
    pub fn render(&self, colour: bool) -> String {
        render::render(self, colour)
    }
}

impl std::fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.render(false))
    }
}

/// An input that could not be read: at least one error, and the warnings found on the way.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}", self.render(false))]
pub struct Error {
    /// The errors, in the order of the input.
    pub errors: Vec<Diagnostic>,
    /// The warnings found before reading stopped.
    pub warnings: Vec<Diagnostic>,
}

impl Error {
    /// All errors as text, an empty line between two; `colour` adds ANSI styles. Warnings are left to the caller.
    pub fn render(&self, colour: bool) -> String {
        let texts: Vec<String> = self.errors.iter().map(|d| d.render(colour)).collect();
        texts.join("\n\n")
    }
}

impl From<Diagnostic> for Error {
    fn from(error: Diagnostic) -> Self {
        Self { errors: vec![error], warnings: Vec::new() }
    }
}
