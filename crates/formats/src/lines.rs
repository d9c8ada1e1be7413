//! Lines and words of the line-oriented text formats.

use crate::diagnostic::{Diagnostic, SourceFile, Span, is_line_end};

/// Walks over the lines of a source, without those that are blank or comments.
#[derive(Clone)]
pub(crate) struct Lines<'s> {
    bytes: &'s [u8],
    at: usize,
    continued: bool,
}

impl<'s> Lines<'s> {
    /// Starts at byte `at`.
    pub(crate) fn new(source: &'s SourceFile, at: usize) -> Self {
        Self { bytes: source.bytes(), at, continued: false }
    }

    /// As [`Lines::new`], where a backslash at the end of a line joins it with the next.
    pub(crate) fn with_continuations(source: &'s SourceFile, at: usize) -> Self {
        Self { bytes: source.bytes(), at, continued: true }
    }

    /// The end of the line that begins at `from`.
    fn end_of_line(&self, mut from: usize) -> usize {
        loop {
            let rest = &self.bytes[from..];
            let Some(len) = rest.iter().position(|b| is_line_end(*b)) else { return self.bytes.len() };
            if !(self.continued && rest[..len].ends_with(b"\\")) {
                return from + len;
            }
            from += len + if rest[len..].starts_with(b"\r\n") { 2 } else { 1 };
        }
    }
}

impl<'s> Iterator for Lines<'s> {
    type Item = Line<'s>;

    fn next(&mut self) -> Option<Line<'s>> {
        while self.at < self.bytes.len() {
            let end = self.end_of_line(self.at);
            let mut line = Line { bytes: self.bytes, at: self.at, end };
            self.at = end + 1;
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
pub(crate) struct Line<'s> {
    bytes: &'s [u8],
    at: usize,
    end: usize,
}

impl Line<'_> {
    /// The next byte that is not a blank, if any.
    pub(crate) fn peek(&mut self) -> Option<u8> {
        self.skip_blanks();
        (self.at < self.end).then(|| self.bytes[self.at])
    }

    /// Steps over one byte.
    pub(crate) fn bump(&mut self) {
        self.at = (self.at + 1).min(self.end);
    }

    /// The next word: everything up to a blank.
    pub(crate) fn word(&mut self) -> Option<Span> {
        self.token(is_blank)
    }

    /// The next word, unless a comment begins here.
    pub(crate) fn word_before_comment(&mut self) -> Option<Span> {
        self.skip_blanks();
        if self.bytes[self.at..self.end].starts_with(b"#") || self.bytes[self.at..self.end].starts_with(b"//") {
            return None;
        }
        self.word()
    }

    /// The next number as written: everything up to a blank, a comma or a `#`.
    pub(crate) fn number(&mut self) -> Option<Span> {
        self.token(|b| is_blank(b) || b == b',' || b == b'#')
    }

    /// What is left, without blanks around it.
    pub(crate) fn rest(&mut self) -> Span {
        self.skip_blanks();
        let text = self.bytes[self.at..self.end].trim_ascii_end();
        Span::new(self.at, self.at + text.len())
    }

    fn token(&mut self, ends: impl Fn(u8) -> bool) -> Option<Span> {
        self.skip_blanks();
        let start = self.at;
        while self.at < self.end && !ends(self.bytes[self.at]) && self.join_len() == 0 {
            self.at += 1;
        }
        (self.at > start).then(|| Span::new(start, self.at))
    }

    fn skip_blanks(&mut self) {
        while self.at < self.end {
            match self.join_len() {
                0 if is_blank(self.bytes[self.at]) => self.at += 1,
                0 => break,
                join => self.at = (self.at + join).min(self.end),
            }
        }
    }

    /// The length of a backslash with a line end here, which only occurs inside of a joined line; else 0.
    fn join_len(&self) -> usize {
        match &self.bytes[self.at..self.end] {
            [b'\\', b'\r', b'\n', ..] => 3,
            [b'\\', b'\r' | b'\n', ..] => 2,
            _ => 0,
        }
    }
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0x0B | 0x0C)
}

/// A finite single-precision number, or what is wrong with it.
pub(crate) fn finite(source: &SourceFile, span: Span, code: &'static str) -> Result<f32, Box<Diagnostic>> {
    let parsed = std::str::from_utf8(source.slice(span)).ok().and_then(|text| text.parse::<f32>().ok());
    if let Some(x) = parsed.filter(|x| x.is_finite()) {
        return Ok(x);
    }
    let text = source.text(span);
    let wrong = match parsed {
        Some(_) if text.bytes().any(|b| b.is_ascii_digit()) => "too large for single precision",
        Some(_) => "not a finite number",
        None => "not a number",
    };
    let mut error = Diagnostic::error(code, format!("`{}` is {wrong}", shortened(&text)))
        .at(source, span, "")
        .expected("a finite number such as 0.5, -3 or 1e-4");
    if text.strip_suffix(['f', 'F']).is_some_and(|t| t.parse::<f32>().is_ok()) {
        error = error.help("leave out the letter behind the number");
    }
    Err(Box::new(error))
}

/// Messages do not repeat kilobytes of input.
pub(crate) fn shortened(text: &str) -> String {
    match text.char_indices().nth(60) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
