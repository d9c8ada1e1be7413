//! One stream of tokens out of a file and all that it includes.
//!
//! Inclusion works on tokens: the parameters of a directive may begin in an included file and go on in the includer.

use super::lexer::{self, Kind};
use crate::diagnostic::{Diagnostic, SourceFile, Span};
use std::rc::Rc;

/// Files may include one another this deep.
const MAX_DEPTH: usize = 32;
/// All files together include at most this many.
const MAX_FILES: usize = 10_000;

/// A token and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) at: At,
}

/// A place in one of the files.
#[derive(Clone, Debug)]
pub(super) struct At {
    pub(super) source: Rc<SourceFile>,
    pub(super) span: Span,
}

impl At {
    /// A finding at this place.
    pub(super) fn tell(&self, finding: Diagnostic, label: &str) -> Diagnostic {
        finding.at(&self.source, self.span, label)
    }
    /// The text, without quotes if it is a string.
    pub(super) fn text(&self) -> String {
        let text = self.source.slice(self.span);
        if text.len() >= 2 && text[0] == b'"' {
            lexer::unquoted(&self.source, self.span)
        } else {
            self.source.text(self.span)
        }
    }
}

/// The stream.
pub(super) struct Tokens {
    /// The file being read is the last one.
    open: Vec<(Rc<SourceFile>, usize)>,
    files: usize,
    peeked: Option<Token>,
}

impl Tokens {
    pub(super) fn new(source: Rc<SourceFile>) -> Self {
        Self { open: vec![(source, 0)], files: 1, peeked: None }
    }

    /// The next token, which stays.
    pub(super) fn peek(&mut self) -> Result<Option<&Token>, Box<Diagnostic>> {
        if self.peeked.is_none() {
            self.peeked = self.read()?;
        }
        Ok(self.peeked.as_ref())
    }

    /// The next token.
    pub(super) fn next(&mut self) -> Result<Option<Token>, Box<Diagnostic>> {
        match self.peeked.take() {
            Some(token) => Ok(Some(token)),
            None => self.read(),
        }
    }

    /// The next token if it is of this kind.
    pub(super) fn next_if(&mut self, kind: Kind) -> Result<Option<Token>, Box<Diagnostic>> {
        if self.peek()?.is_some_and(|t| t.kind == kind) { self.next() } else { Ok(None) }
    }

    fn read(&mut self) -> Result<Option<Token>, Box<Diagnostic>> {
        while let Some((source, at)) = self.open.last_mut() {
            if let Some((kind, span)) = lexer::next(source, *at)? {
                *at = span.end as usize;
                return Ok(Some(Token { kind, at: At { source: Rc::clone(source), span } }));
            }
            self.open.pop();
        }
        Ok(None)
    }

    /// Goes on in `source`, then comes back. Must not be called while a token is peeked at.
    pub(super) fn include(&mut self, source: Rc<SourceFile>, at: &At) -> Result<(), Box<Diagnostic>> {
        self.files += 1;
        let message = if self.open.len() >= MAX_DEPTH {
            format!("files include one another more than {MAX_DEPTH} deep")
        } else if self.files > MAX_FILES {
            format!("more than {MAX_FILES} files are included")
        } else {
            self.open.push((source, 0));
            return Ok(());
        };
        Err(Box::new(at.tell(Diagnostic::error("pbrt::include", message), "")))
    }
}
