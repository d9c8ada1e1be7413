//! The frame of an `.scn` file: sections, and what all of them share.

use super::{Comma, ScnFile};
use crate::diagnostic::{Diagnostic, Sink, SourceFile, Span};
use crate::lines::shortened;
use crate::lines::{Line, Lines};
use std::collections::HashMap;

/// A file may define at most this many materials, properties, models, shapes and lights together.
pub const MAX_OBJECTS: usize = 1 << 22;

const SECTIONS: [&str; 3] = ["Material", "Model", "Light"];

/// Reads an `.scn` file. Errors go to `sink`, and reading goes on behind them; the tree is whole only if there are none.
pub fn parse(source: &SourceFile, comma: Comma, sink: &mut Sink) -> ScnFile {
    let mut parser = Parser::new(source, comma, sink);
    parser.file();
    parser.tree
}

/// The shape that an attribute line describes: (model, shape).
pub(super) type ShapeIndex = (usize, usize);

pub(super) struct Parser<'s> {
    pub(super) source: &'s SourceFile,
    pub(super) comma: Comma,
    pub(super) sink: &'s mut Sink,
    pub(super) tree: ScnFile,
    pub(super) material_of: HashMap<String, usize>,
    /// The last sphere, triangle and plane.
    pub(super) last_of_kind: [Option<ShapeIndex>; 3],
    lines: Lines<'s>,
    objects: usize,
}

impl<'s> Parser<'s> {
    fn new(source: &'s SourceFile, comma: Comma, sink: &'s mut Sink) -> Self {
        let bom = source.bytes().starts_with(b"\xEF\xBB\xBF");
        if bom {
            sink.warn("scn::byte-order-mark", || {
                Diagnostic::warning("scn::byte-order-mark", "the file begins with a byte order mark")
                    .at(source, Span::default(), "")
                    .help("NRenderer refuses such a file; save it as UTF-8 without a mark")
            });
        }
        Self {
            source,
            comma,
            sink,
            tree: ScnFile::default(),
            material_of: HashMap::new(),
            last_of_kind: [None; 3],
            lines: Lines::new(source, if bom { 3 } else { 0 }),
            objects: 0,
        }
    }

    fn file(&mut self) {
        let mut lost = false;
        while let Some(mut line) = self.next_line() {
            let Some(word) = line.word() else { continue };
            if self.source.slice(word) == b"Begin" {
                lost = false;
                self.section(&mut line, word);
            } else if !lost {
                // One message for a run of lines outside of sections.
                lost = true;
                self.stray(word);
            }
        }
    }

    fn next_line(&mut self) -> Option<Line<'s>> {
        if self.sink.is_full() || self.objects > MAX_OBJECTS { None } else { self.lines.next() }
    }

    fn section(&mut self, line: &mut Line, begin: Span) {
        let Some(name) = line.word() else {
            let error = Diagnostic::error("scn::section", "`Begin` without the name of a section");
            self.sink.error(error.at(self.source, begin, "").one_of("", SECTIONS));
            return self.lines_until_end(begin, |_, _, _| {});
        };
        self.end_of_line(line);
        match self.source.slice(name) {
            b"Material" => self.lines_until_end(begin, Self::material_line),
            b"Model" => self.lines_until_end(begin, Self::model_line),
            b"Light" => self.lines_until_end(begin, Self::light_line),
            _ => {
                self.unknown("section", name, &SECTIONS);
                self.lines_until_end(begin, |_, _, _| {});
            }
        }
    }

    /// Hands the lines of a section to `read`, with their first word, up to `End`.
    fn lines_until_end(&mut self, begin: Span, mut read: impl FnMut(&mut Self, &mut Line, Span)) {
        loop {
            let before = self.lines.clone();
            let Some(mut line) = self.next_line() else { break };
            let Some(word) = line.word() else { continue };
            match self.source.slice(word) {
                b"End" => return self.end_of_line(&mut line),
                b"Begin" => {
                    self.sink.error(
                        Diagnostic::error("scn::unclosed-section", "a section begins inside of another")
                            .at(self.source, word, "expected `End` before this")
                            .see(self.source, begin, "this section is still open"),
                    );
                    // The line is read again as the begin of a section.
                    self.lines = before;
                    return;
                }
                _ => read(self, &mut line, word),
            }
        }
        let source = self.source;
        self.sink.warn("scn::missing-end", || {
            Diagnostic::warning("scn::missing-end", "the file ends before the `End` of this section").at(
                source,
                begin,
                "opened here",
            )
        });
    }

    fn stray(&mut self, word: Span) {
        let text = self.source.text(word);
        let message = match text.as_str() {
            "End" => "`End` without `Begin`".to_owned(),
            _ => format!("`{}` outside of a section", shortened(&text)),
        };
        let expected = "`Begin Material`, `Begin Model` or `Begin Light`";
        let mut error = Diagnostic::error("scn::stray", message).at(self.source, word, "").expected(expected);
        error.nearest = crate::diagnostic::nearest(&text, ["Begin"]).map(str::to_owned);
        self.sink.error(error);
    }

    /// Counts an object; an error once there are too many.
    pub(super) fn count_object(&mut self, at: Span) {
        self.objects += 1;
        if self.objects > MAX_OBJECTS {
            let message = format!("more than {MAX_OBJECTS} objects in one file");
            self.sink.error(Diagnostic::error("scn::too-many", message).at(self.source, at, "this is one too many"));
        }
    }

    /// An error for a word that is none of `names`.
    pub(super) fn unknown(&mut self, what: &str, word: Span, names: &[&str]) {
        let text = self.source.text(word);
        self.sink.error(
            Diagnostic::error("scn::unknown-keyword", format!("unknown {what} `{}`", shortened(&text)))
                .at(self.source, word, "")
                .one_of(&text, names.iter().copied()),
        );
    }

    /// The name that follows `keyword`; an error if there is none.
    pub(super) fn name(&mut self, line: &mut Line, keyword: Span, what: &str) -> Option<super::Spanned<String>> {
        if let Some(span) = line.word_before_comment() {
            return Some(super::Spanned { value: self.source.text(span), span });
        }
        let message = format!("`{}` without {what}", self.source.text(keyword));
        self.sink.error(Diagnostic::error("scn::missing-name", message).at(
            self.source,
            keyword.after(),
            format!("expected {what}"),
        ));
        None
    }

    /// Warns of text that nothing reads. Comments are fine, and so is a last comma or semicolon.
    pub(super) fn end_of_line(&mut self, line: &mut Line) {
        let (source, rest) = (self.source, line.rest());
        let text = source.slice(rest);
        if text.is_empty() || matches!(text, b"," | b";") || text.starts_with(b"#") || text.starts_with(b"//") {
            return;
        }
        self.sink.warn("scn::trailing-text", || {
            Diagnostic::warning("scn::trailing-text", "text behind the end of a statement").at(source, rest, "ignored")
        });
    }

    /// Looks for the definition of a material behind the current line, for a better message.
    pub(super) fn defined_later(&self, name: &[u8]) -> Option<Span> {
        self.lines.clone().find_map(|mut line| {
            let is_material = line.word().is_some_and(|w| self.source.slice(w) == b"Material");
            let word = line.word()?;
            (is_material && self.source.slice(word) == name).then_some(word)
        })
    }
}
