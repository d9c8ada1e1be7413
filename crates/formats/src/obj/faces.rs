//! `f` statements: corners with their indices.

use super::Corner;
use super::parser::{MAX_CORNERS, Parser};
use crate::diagnostic::{Diagnostic, Span};
use crate::lines::{Line, shortened};

/// A polygon: a run of the file's corners.
pub(super) struct Face {
    pub(super) mesh: usize,
    pub(super) first: usize,
    pub(super) count: usize,
}

/// The arrays that a corner points into, as messages call them: positions, texture coordinates, normals.
const ARRAYS: [(&str, &str); 3] = [("vertex", "v"), ("texture coordinate", "vt"), ("normal", "vn")];

impl Parser<'_> {
    pub(super) fn face(&mut self, line: &mut Line, word: Span) {
        let (first, forward) = (self.corners.len(), self.forward.len());
        while let Some(span) = line.word_before_comment() {
            match self.corner(span) {
                Ok(corner) => self.corners.push(corner),
                Err(error) => {
                    self.forward.truncate(forward);
                    self.corners.truncate(first);
                    return self.sink.error(*error);
                }
            }
        }
        let count = self.corners.len() - first;
        if self.corners.len() > MAX_CORNERS {
            let message = format!("the faces have more than {MAX_CORNERS} corners together");
            return self.sink.error(Diagnostic::error("obj::too-many", message).at(self.source, word, "up to here"));
        }
        if count < 3 {
            self.corners.truncate(first);
            let source = self.source;
            return self.sink.warn("obj::few-corners", || {
                let message = format!("a face needs 3 corners, found {count}");
                Diagnostic::warning("obj::few-corners", message).at(source, word, "skipped")
            });
        }
        let mesh = self.current_mesh();
        self.faces.push(Face { mesh, first, count });
    }

    /// `v`, `v/t`, `v//n` or `v/t/n`; the parts behind `v` may be empty.
    fn corner(&mut self, span: Span) -> Result<Corner, Box<Diagnostic>> {
        let mut indices = [None; 3];
        let mut start = span.start as usize;
        for (part, text) in self.source.slice(span).split(|b| *b == b'/').enumerate() {
            let place = Span::new(start, start + text.len());
            start += text.len() + 1;
            if part == 3 {
                return Err(self.bad_corner(span));
            }
            indices[part] = if text.is_empty() { None } else { Some(self.index(part, text, place, span)?) };
        }
        match indices {
            [Some(position), uv, normal] => Ok(Corner::new(position, uv, normal)),
            _ => Err(self.bad_corner(span)),
        }
    }

    fn bad_corner(&self, span: Span) -> Box<Diagnostic> {
        let message = format!("`{}` is not the corner of a face", shortened(&self.source.text(span)));
        let error = Diagnostic::error("obj::bad-corner", message).at(self.source, span, "");
        Box::new(error.expected("v, v/vt, v//vn or v/vt/vn, each a whole number"))
    }

    /// From the file's index (1 is the first, −1 the last so far) to one from 0.
    fn index(&mut self, array: usize, text: &[u8], place: Span, corner: Span) -> Result<u32, Box<Diagnostic>> {
        let count = self.count(array);
        let parsed = std::str::from_utf8(text).ok().and_then(|t| t.parse::<i64>().ok());
        let Some(number) = parsed else { return Err(self.bad_corner(corner)) };
        let index = if number > 0 { number - 1 } else { count as i64 + number };
        if number == 0 || !(0..i64::from(u32::MAX)).contains(&index) {
            return Err(self.bad_index(array, number, place));
        }
        if index >= count as i64 {
            // The element may follow later in the file.
            self.forward.push((array, index as u32, place));
        }
        Ok(index as u32)
    }

    fn count(&self, array: usize) -> usize {
        [self.tree.positions.len(), self.tree.uvs.len(), self.tree.normals.len()][array]
    }

    fn bad_index(&self, array: usize, number: i64, place: Span) -> Box<Diagnostic> {
        let ((what, keyword), count) = (ARRAYS[array], self.count(array));
        let error = Diagnostic::error("obj::bad-index", format!("there is no {what} {number}"));
        let error = error.at(self.source, place, "");
        Box::new(match (number, count) {
            (0, _) => error.help("indices count from 1; −1 is the last one so far"),
            (_, 0) => error.help(format!("there are no `{keyword}` lines")),
            _ if number < 0 => error.expected(format!("−{count} to −1, or 1 to {count}")),
            _ => error.expected(format!("1 to {count}")),
        })
    }

    /// Indices that pointed ahead are checked when the whole file is read.
    pub(super) fn check_forward(&mut self) {
        let mut forward = std::mem::take(&mut self.forward);
        forward.retain(|(array, index, _)| *index as usize >= self.count(*array));
        for (array, index, place) in forward {
            if self.sink.is_full() {
                break;
            }
            let error = self.bad_index(array, i64::from(index) + 1, place);
            self.sink.error(*error);
        }
    }
}
