//! How this reader speaks: each finding names the place in the JSON, as `meshes[3].primitives[0].indices`.

use crate::diagnostic::{Diagnostic, Sink};
use std::fmt::Display;

/// What is said of lapses.
const READ_ANYWAY: &str = "the file is read all the same; `--strict` refuses it";

/// Makes findings about one file.
#[derive(Clone, Debug)]
pub(super) struct Findings {
    /// The file as the user named it.
    pub(super) file: String,
    /// Whether what breaks the rules but does no harm to the picture is an error.
    pub(super) is_strict: bool,
}

impl Findings {
    /// An error about the file as a whole.
    pub(super) fn file_error(&self, code: &'static str, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(code, message).in_file(&self.file)
    }

    /// What makes the file, or a part of it, unreadable or without a clear meaning.
    pub(super) fn error(&self, sink: &mut Sink, code: &'static str, path: impl Display, message: impl Display) {
        sink.error(self.file_error(code, format!("{path}: {message}")));
    }

    /// What breaks the rules of the format but has one plain meaning for a picture: told of as an error, but the file is read all
    /// the same unless one is strict.
    pub(super) fn lapse(&self, sink: &mut Sink, code: &'static str, path: impl Display, message: impl Display) {
        if self.is_strict {
            return self.error(sink, code, path, message);
        }
        let finding = || self.file_error(code, format!("{path}: {message}")).help(READ_ANYWAY);
        sink.warn(code, finding);
    }

    /// What is odd, or left out.
    pub(super) fn warn(&self, sink: &mut Sink, code: &'static str, path: impl Display, message: impl Display) {
        sink.warn(code, || Diagnostic::warning(code, format!("{path}: {message}")).in_file(&self.file));
    }
}
