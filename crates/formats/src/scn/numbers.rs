//! Numbers of an `.scn` line, with NRenderer's comma in both readings.

use super::Comma;
use super::lines::Line;
use super::parser::Parser;
use crate::diagnostic::{Diagnostic, Span};
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

    /// A finite single-precision number, or an error.
    fn float(&mut self, span: Span) -> Option<f32> {
        let text = self.source.text(span);
        let wrong = match text.parse::<f32>() {
            Ok(x) if x.is_finite() => return Some(x),
            Ok(_) if text.bytes().any(|b| b.is_ascii_digit()) => "too large for single precision",
            Ok(_) => "not a finite number",
            Err(_) => "not a number",
        };
        let mut error = Diagnostic::error("scn::bad-number", format!("`{}` is {wrong}", shortened(&text)))
            .at(self.source, span, "")
            .expected("a finite number such as 0.5, -3 or 1e-4");
        if text.strip_suffix(['f', 'F']).is_some_and(|t| t.parse::<f32>().is_ok()) {
            error = error.help("leave out the letter behind the number");
        }
        self.sink.error(error);
        None
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

/// Messages do not repeat kilobytes of input.
pub(super) fn shortened(text: &str) -> String {
    match text.char_indices().nth(60) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
