//! Numbers of an `.scn` line, with NRenderer's comma in both readings.

use super::Comma;
use super::parser::Parser;
use crate::diagnostic::{Diagnostic, Span};
use crate::lines::{Line, finite, shortened};
use glam::Vec3;

impl Parser<'_> {
    /// `N` finite numbers for the keyword at `what`; an error is recorded and `None` returned if they are not there.
    pub(super) fn numbers<const N: usize>(&mut self, line: &mut Line, what: Span) -> Option<[f32; N]> {
        let mut values = [0.0; N];
        let mut last = what;
        for (i, value) in values.iter_mut().enumerate() {
            if i > 0 && line.peek() == Some(b',') && self.comma(line, last) {
                return Some(values);
            }
            let Some(span) = line.number() else {
                self.missing_number(line, what, last, (i, N));
                return None;
            };
            *value = self.float(span)?;
            last = span;
        }
        self.end_of_line(line);
        Some(values)
    }

    /// Three numbers as a vector.
    pub(super) fn vec3(&mut self, line: &mut Line, what: Span) -> Option<Vec3> {
        self.numbers(line, what).map(Vec3::from_array)
    }

    /// One number.
    pub(super) fn number(&mut self, line: &mut Line, what: Span) -> Option<f32> {
        self.numbers(line, what).map(|[x]| x)
    }

    /// Steps over a comma. True if it ends the numbers.
    fn comma(&mut self, line: &mut Line, last: Span) -> bool {
        let (source, mode) = (self.source, self.comma);
        let place = Span::new(last.end as usize, last.end as usize + 1);
        self.sink.warn("scn::comma", || {
            let warning = Diagnostic::warning("scn::comma", "a comma between numbers");
            match mode {
                Comma::Separates => warning
                    .at(source, place, "read as a separator")
                    .help("NRenderer reads the numbers behind a comma as 0; the compatibility mode does so too"),
                Comma::EndsNumbers => {
                    warning.at(source, place, "the numbers behind it are read as 0, as NRenderer does")
                }
            }
        });
        line.bump();
        mode == Comma::EndsNumbers
    }

    fn missing_number(&mut self, line: &mut Line, what: Span, last: Span, (found, wanted): (usize, usize)) {
        let keyword = self.source.text(what);
        let numbers = if wanted == 1 { "number" } else { "numbers" };
        let place = if line.peek().is_some() { line.rest() } else { last.after() };
        self.sink.error(
            Diagnostic::error("scn::missing-number", format!("`{keyword}` needs {wanted} {numbers}, found {found}"))
                .at(self.source, place, "a number is missing here"),
        );
    }

    fn float(&mut self, span: Span) -> Option<f32> {
        finite(self.source, span, "scn::bad-number").map_err(|error| self.sink.error(*error)).ok()
    }

    /// A whole number, or an error.
    pub(super) fn whole<T: std::str::FromStr>(&mut self, line: &mut Line, what: Span, range: &str) -> Option<T> {
        let Some(span) = line.number() else {
            self.missing_number(line, what, what, (0, 1));
            return None;
        };
        let text = self.source.text(span);
        if let Ok(value) = text.parse() {
            self.end_of_line(line);
            return Some(value);
        }
        let message = format!("`{}` is not a whole number", shortened(&text));
        self.sink.error(Diagnostic::error("scn::bad-number", message).at(self.source, span, "").expected(range));
        None
    }
}
