//! Where in a file something is.

use std::ops::Range;

/// A range of bytes of a source file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte; equal to `start` for a point.
    pub end: u32,
}

impl Span {
    /// The span from `start` up to, not including, `end`.
    pub fn new(start: usize, end: usize) -> Self {
        Self { start: start as u32, end: end.max(start) as u32 }
    }

    /// The smallest span that holds both.
    pub fn to(self, other: Self) -> Self {
        Self { start: self.start.min(other.start), end: self.end.max(other.end) }
    }

    /// The empty span just behind this one.
    pub fn after(self) -> Self {
        Self { start: self.end, end: self.end }
    }
}

/// A place as a person reads it. It holds its own copy of the line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file as the user named it.
    pub file: String,
    /// Line and column; `None` means the file as a whole (binary files, missing files).
    pub at: Option<Position>,
    /// Text under the caret; may be empty.
    pub label: String,
}

/// A position in a text file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Position {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1. A byte sequence that is not UTF-8 counts as one character.
    pub column: usize,
    /// The line, or the part of a very long one around the mark.
    pub excerpt: Excerpt,
}

/// A piece of a source line with the marked part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// The text, valid UTF-8, without its line end. Control characters are shown as U+FFFD.
    pub text: String,
    /// The marked bytes of `text`.
    pub mark: Range<usize>,
    /// Whether `text` begins in the middle of its line, because the line is very long.
    pub begins_late: bool,
}
