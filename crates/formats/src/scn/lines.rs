//! Lines and words of an `.scn` file.

use crate::diagnostic::{SourceFile, Span};

/// Walks over the lines of a source, without those that are blank or comments.
#[derive(Clone)]
pub(super) struct Lines<'s> {
    bytes: &'s [u8],
    at: usize,
}

impl<'s> Lines<'s> {
    /// Starts at byte `at`.
    pub(super) fn new(source: &'s SourceFile, at: usize) -> Self {
        Self { bytes: source.bytes(), at }
    }
}

impl<'s> Iterator for Lines<'s> {
    type Item = Line<'s>;

    fn next(&mut self) -> Option<Line<'s>> {
        while self.at < self.bytes.len() {
            let rest = &self.bytes[self.at..];
            let len = rest.iter().position(|b| crate::diagnostic::is_line_end(*b)).unwrap_or(rest.len());
            let mut line = Line { bytes: self.bytes, at: self.at, end: self.at + len };
            self.at += len + 1;
            line.skip_blanks();
            if line.at < line.end && self.bytes[line.at] != b'#' {
                return Some(line);
            }
        }
        None
    }
}

/// What is left of a line.
#[derive(Clone)]
pub(super) struct Line<'s> {
    bytes: &'s [u8],
    at: usize,
    end: usize,
}

impl Line<'_> {
    /// The next byte that is not a blank, if any.
    pub(super) fn peek(&mut self) -> Option<u8> {
        self.skip_blanks();
        (self.at < self.end).then(|| self.bytes[self.at])
    }

    /// Steps over one byte.
    pub(super) fn bump(&mut self) {
        self.at = (self.at + 1).min(self.end);
    }

    /// The next word: everything up to a blank.
    pub(super) fn word(&mut self) -> Option<Span> {
        self.token(is_blank)
    }

    /// The next word, unless a comment begins here.
    pub(super) fn word_before_comment(&mut self) -> Option<Span> {
        self.skip_blanks();
        if self.bytes[self.at..self.end].starts_with(b"#") || self.bytes[self.at..self.end].starts_with(b"//") {
            return None;
        }
        self.word()
    }

    /// The next number as written: everything up to a blank, a comma or a `#`.
    pub(super) fn number(&mut self) -> Option<Span> {
        self.token(|b| is_blank(b) || b == b',' || b == b'#')
    }

    /// What is left, without blanks around it.
    pub(super) fn rest(&mut self) -> Span {
        self.skip_blanks();
        let text = self.bytes[self.at..self.end].trim_ascii_end();
        Span::new(self.at, self.at + text.len())
    }

    fn token(&mut self, ends: impl Fn(u8) -> bool) -> Option<Span> {
        self.skip_blanks();
        let rest = &self.bytes[self.at..self.end];
        let len = rest.iter().position(|b| ends(*b)).unwrap_or(rest.len());
        let span = Span::new(self.at, self.at + len);
        self.at += len;
        (len > 0).then_some(span)
    }

    fn skip_blanks(&mut self) {
        while self.at < self.end && is_blank(self.bytes[self.at]) {
            self.at += 1;
        }
    }
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x0B | 0x0C)
}
