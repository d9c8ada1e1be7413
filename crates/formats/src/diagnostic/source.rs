//! The bytes of an input file, and from a span of bytes to a place for people.

use super::{Diagnostic, Error, Excerpt, Place, Position, Span, nearest};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The largest file that is read: 1 GiB.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// An excerpt shows at most this many bytes on each side of the mark.
const EXCERPT_REACH: usize = 200;

/// A text file in memory. Its bytes need not be UTF-8.
#[derive(Debug)]
pub struct SourceFile {
    name: String,
    bytes: Vec<u8>,
}

impl SourceFile {
    /// A source from memory; `name` is what messages call it. Bytes beyond [`MAX_FILE_BYTES`] are cut off.
    pub fn from_bytes(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        let mut bytes = bytes.into();
        bytes.truncate(MAX_FILE_BYTES as usize);
        Self { name: name.into(), bytes }
    }

    /// Reads a text file.
    ///
    /// # Errors
    /// Missing (with near names of that folder), a folder, unreadable, larger than [`MAX_FILE_BYTES`], UTF-16, or binary.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let source = Self { name: path.display().to_string(), bytes: read_bytes(path)? };
        let head = &source.bytes[..source.bytes.len().min(4096)];
        let error = match utf16_flavour(head) {
            Some(flavour) => Diagnostic::error("file::utf16", format!("the file is {flavour} text"))
                .help("save it again as UTF-8 (in a shell: iconv -f UTF-16 -t UTF-8)"),
            None if head.contains(&0) => Diagnostic::error("file::binary", "the file is binary, not text"),
            None => return Ok(source),
        };
        Err(error.in_file(source.name).expected("ASCII or UTF-8 text").into())
    }

    /// What messages call this file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The content.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The text of a span; bytes that are not UTF-8 are written `\xNN`, so that two different names stay different.
    pub fn text(&self, span: Span) -> String {
        let mut text = String::new();
        for chunk in self.slice(span).utf8_chunks() {
            text += chunk.valid();
            text.extend(chunk.invalid().iter().map(|b| format!("\\x{b:02X}")));
        }
        text
    }

    /// The bytes of a span, empty when it lies outside.
    pub fn slice(&self, span: Span) -> &[u8] {
        self.bytes.get(span.start as usize..span.end as usize).unwrap_or_default()
    }

    /// Line, column and excerpt of `span`, for a message. Takes time proportional to the file.
    pub fn place(&self, span: Span, label: impl Into<String>) -> Place {
        let start = (span.start as usize).min(self.bytes.len());
        let line_start = self.bytes[..start].iter().rposition(|b| is_line_end(*b)).map_or(0, |i| i + 1);
        let line_len = self.bytes[start..].iter().position(|b| is_line_end(*b));
        let line_end = line_len.map_or(self.bytes.len(), |i| start + i);
        let end = (span.end as usize).clamp(start, line_end);
        let from = line_start.max(start.saturating_sub(EXCERPT_REACH));
        let to = line_end.min(end.min(start + EXCERPT_REACH) + EXCERPT_REACH);
        let at = Position {
            line: 1 + count_line_ends(&self.bytes[..line_start]),
            column: 1 + shown(&self.bytes[line_start..start]).chars().count(),
            excerpt: Excerpt {
                begins_late: from > line_start,
                ..excerpt(&self.bytes[from..to], start - from, end.min(to) - from)
            },
        };
        Place { file: self.name.clone(), at: Some(at), label: label.into() }
    }
}

fn excerpt(line: &[u8], start: usize, end: usize) -> Excerpt {
    let (before, marked, after) = (shown(&line[..start]), shown(&line[start..end]), shown(&line[end..]));
    let mark = before.len()..before.len() + marked.len();
    Excerpt { text: before + &marked + &after, mark, begins_late: false }
}

fn shown(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    text.chars().map(|c| if c.is_control() && c != '\t' { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

pub(crate) fn is_line_end(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}

/// `\r\n` counts as one line end.
fn count_line_ends(bytes: &[u8]) -> usize {
    let mut previous = 0;
    let mut count = 0;
    for &byte in bytes {
        count += usize::from(byte == b'\r' || (byte == b'\n' && previous != b'\r'));
        previous = byte;
    }
    count
}

/// UTF-16 shows by its byte order mark, or by ASCII letters with a zero at every other byte.
fn utf16_flavour(bytes: &[u8]) -> Option<&'static str> {
    let head = &bytes[..bytes.len().min(64) & !1];
    let zeros = |parity: usize| head.iter().skip(parity).step_by(2).filter(|b| **b == 0).count();
    let half = head.len() / 2;
    let mostly = |zeros: usize, others: usize| half >= 4 && zeros * 4 >= half * 3 && others == 0;
    match head {
        [0xFF, 0xFE, ..] => Some("UTF-16 (little-endian)"),
        [0xFE, 0xFF, ..] => Some("UTF-16 (big-endian)"),
        _ if mostly(zeros(0), zeros(1)) => Some("UTF-16 (big-endian)"),
        _ if mostly(zeros(1), zeros(0)) => Some("UTF-16 (little-endian)"),
        _ => None,
    }
}

/// Reads a whole file of at most [`MAX_FILE_BYTES`].
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, Error> {
    let name = path.display().to_string();
    let cannot = |error: &std::io::Error| -> Error {
        match error.kind() {
            std::io::ErrorKind::NotFound => missing(path).into(),
            _ => Diagnostic::error("file::unreadable", format!("cannot read the file: {error}")).in_file(&name).into(),
        }
    };
    let meta = std::fs::metadata(path).map_err(|e| cannot(&e))?;
    if meta.is_dir() {
        return Err(Diagnostic::error("file::folder", "this is a folder, not a file").in_file(name).into());
    }
    if meta.len() > MAX_FILE_BYTES {
        let size = meta.len() as f64 / MAX_FILE_BYTES as f64;
        return Err(Diagnostic::error("file::too-large", format!("the file has {size:.1} GiB"))
            .in_file(name)
            .expected("at most 1 GiB")
            .into());
    }
    let mut bytes = Vec::with_capacity(meta.len() as usize);
    let file = File::open(path).map_err(|e| cannot(&e))?;
    file.take(MAX_FILE_BYTES).read_to_end(&mut bytes).map_err(|e| cannot(&e))?;
    Ok(bytes)
}

fn missing(path: &Path) -> Diagnostic {
    let error = Diagnostic::error("file::missing", "no such file").in_file(path.display().to_string());
    let folder = match path.parent() {
        Some(folder) if folder.as_os_str().is_empty() => Path::new("."),
        Some(folder) => folder,
        None => return error,
    };
    if !folder.is_dir() {
        return error.help(format!("the folder {} does not exist", folder.display()));
    }
    let near = names_near(path);
    if near.is_empty() { error } else { error.help(format!("near names in that folder: {}", near.join(", "))) }
}

/// Up to five files beside `path` whose names are most like its own, the nearest first.
pub fn names_near(path: &Path) -> Vec<String> {
    let folder = path.parent().filter(|f| !f.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Some(wanted) = path.file_name().map(|n| n.to_string_lossy().into_owned()) else { return Vec::new() };
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let mut names: Vec<String> =
        entries.take(10_000).filter_map(|e| Some(e.ok()?.file_name().to_string_lossy().into_owned())).collect();
    names.sort_unstable();
    let mut near = Vec::new();
    while near.len() < 5 {
        let Some(index) =
            nearest(&wanted, names.iter().map(String::as_str)).and_then(|name| names.iter().position(|n| n == name))
        else {
            break;
        };
        near.push(names.remove(index));
    }
    near
}
