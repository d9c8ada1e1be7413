//! Bytes to tokens.

use crate::diagnostic::{Diagnostic, SourceFile, Span};

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A directive, `true` or `false`.
    Word,
    /// A string; the span holds its quotes.
    String,
    /// Something that begins like a number.
    Number,
    /// `[`
    Open,
    /// `]`
    Close,
}

/// The next token of `source` from byte `at`: its kind and place. `None` at the end.
pub(super) fn next(source: &SourceFile, at: usize) -> Result<Option<(Kind, Span)>, Box<Diagnostic>> {
    let bytes = source.bytes();
    let Some(start) = skip(bytes, at) else { return Ok(None) };
    let span = |length: usize| Span::new(start, start + length);
    let rest = &bytes[start..];
    match rest[0] {
        b'[' => Ok(Some((Kind::Open, span(1)))),
        b']' => Ok(Some((Kind::Close, span(1)))),
        b'"' => string(source, start).map(|span| Some((Kind::String, span))),
        first => {
            let ends = |b: &u8| b.is_ascii_whitespace() || matches!(b, b'"' | b'[' | b']' | b'#');
            let length = rest.iter().position(ends).unwrap_or(rest.len());
            let is_number = first.is_ascii_digit() || matches!(first, b'-' | b'+' | b'.');
            Ok(Some((if is_number { Kind::Number } else { Kind::Word }, span(length))))
        }
    }
}

/// What follows this in a line is no comment: what our own writer has to say that pbrt has no words for.
pub(super) const OURS: &[u8] = b"#sunfleck ";

/// The first byte from `at` that is no blank and in no comment. A byte order mark is a blank.
fn skip(bytes: &[u8], mut at: usize) -> Option<usize> {
    if at == 0 && bytes.starts_with(&[0xEF, 0xBB, 0xBF]) {
        at = 3;
    }
    while let Some(byte) = bytes.get(at) {
        if bytes[at..].starts_with(OURS) {
            at += OURS.len();
        } else if *byte == b'#' {
            at += bytes[at..].iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(bytes.len() - at);
        } else if byte.is_ascii_whitespace() {
            at += 1;
        } else {
            return Some(at);
        }
    }
    None
}

/// A string ends at its quote, in the same line; a backslash takes the next byte with it.
fn string(source: &SourceFile, start: usize) -> Result<Span, Box<Diagnostic>> {
    let bytes = source.bytes();
    let mut at = start + 1;
    while let Some(byte) = bytes.get(at) {
        match byte {
            b'"' => return Ok(Span::new(start, at + 1)),
            b'\n' | b'\r' => break,
            b'\\' => at += 2,
            _ => at += 1,
        }
    }
    let error = Diagnostic::error("pbrt::open-string", "this string does not end in its line");
    Err(Box::new(error.at(source, Span::new(start, start + 1), "begins here").expected("a closing quote")))
}

/// The text of a string token without its quotes, escapes resolved.
pub(super) fn unquoted(source: &SourceFile, span: Span) -> String {
    let text = source.text(Span { start: span.start + 1, end: span.end - 1 });
    if !text.contains('\\') {
        return text;
    }
    let mut plain = String::new();
    let mut letters = text.chars();
    while let Some(letter) = letters.next() {
        // A Windows path is no escape: only what pbrt knows is.
        match (letter, letters.clone().next()) {
            ('\\', Some(next @ ('"' | '\\'))) => {
                plain.push(next);
                letters.next();
            }
            _ => plain.push(letter),
        }
    }
    plain
}
