//! The header: which elements, how many, made of what.

use crate::diagnostic::{Diagnostic, Sink, SourceFile, Span, is_line_end};

/// More elements or properties of one are refused: no real file has them.
const MAX_DECLARATIONS: usize = 1024;

/// How values are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

const SCALARS: [(&str, Scalar); 16] = [
    ("char", Scalar::I8),
    ("uchar", Scalar::U8),
    ("short", Scalar::I16),
    ("ushort", Scalar::U16),
    ("int", Scalar::I32),
    ("uint", Scalar::U32),
    ("float", Scalar::F32),
    ("double", Scalar::F64),
    ("int8", Scalar::I8),
    ("uint8", Scalar::U8),
    ("int16", Scalar::I16),
    ("uint16", Scalar::U16),
    ("int32", Scalar::I32),
    ("uint32", Scalar::U32),
    ("float32", Scalar::F32),
    ("float64", Scalar::F64),
];

impl Scalar {
    /// Bytes in a binary file.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

/// One value of an element, or a list of them.
#[derive(Clone, Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) value: Scalar,
    /// The type of the length, if this is a list.
    pub(super) length: Option<Scalar>,
}

/// A kind of thing that the file holds several of.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// The fewest bytes that one of them can take.
    pub(super) fn min_bytes(&self, encoding: Encoding) -> usize {
        match encoding {
            // A digit and what separates it from the next.
            Encoding::Text => 2 * self.properties.len(),
            _ => self.properties.iter().map(|p| p.length.unwrap_or(p.value).bytes()).sum(),
        }
    }
}

/// What the file declares.
#[derive(Clone, Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the values begin.
    pub(super) body: usize,
}

/// Reads the header. `None` after an error, which is in the sink.
pub(super) fn parse(source: &SourceFile, sink: &mut Sink) -> Option<Header> {
    let mut reader = Reader { source, at: 0, encoding: None, elements: Vec::new() };
    match reader.run(sink) {
        Ok(header) => Some(header),
        Err(error) => {
            sink.error(*error);
            None
        }
    }
}

type Found<T> = Result<T, Box<Diagnostic>>;

struct Reader<'s> {
    source: &'s SourceFile,
    at: usize,
    encoding: Option<Encoding>,
    elements: Vec<Element>,
}

impl Reader<'_> {
    fn run(&mut self, sink: &mut Sink) -> Found<Header> {
        let is_ply = self.line().is_some_and(|words| words.len() == 1 && self.source.slice(words[0]) == b"ply");
        if !is_ply {
            let error = Diagnostic::error("ply::not-ply", "this is no PLY file").in_file(self.source.name());
            return Err(Box::new(error.expected("`ply` in the first line")));
        }
        loop {
            let Some(words) = self.line() else {
                let error = Diagnostic::error("ply::header", "the header does not end").in_file(self.source.name());
                return Err(Box::new(error.expected("`end_header` in a line of its own")));
            };
            let Some(&word) = words.first() else { continue };
            match self.source.slice(word) {
                b"end_header" => break,
                b"format" => self.format(&words)?,
                b"element" => self.element(&words)?,
                b"property" => self.property(&words)?,
                b"comment" | b"obj_info" => {}
                _ => sink.warn("ply::header-line", || {
                    let message = format!("`{}` begins no line of a header", self.source.text(word));
                    Diagnostic::warning("ply::header-line", message).at(self.source, word, "ignored")
                }),
            }
        }
        let Some(encoding) = self.encoding else {
            let error = Diagnostic::error("ply::header", "the header has no `format`").in_file(self.source.name());
            return Err(Box::new(error));
        };
        Ok(Header { encoding, elements: std::mem::take(&mut self.elements), body: self.at })
    }

    /// The words of the next line; `None` at the end of the file. `\r\n` ends one line, not two.
    fn line(&mut self) -> Option<Vec<Span>> {
        let bytes = self.source.bytes();
        let rest = bytes.get(self.at..).filter(|r| !r.is_empty())?;
        let length = rest.iter().position(|b| is_line_end(*b)).unwrap_or(rest.len());
        let (start, line) = (self.at, &rest[..length]);
        self.at += length + if rest[length..].starts_with(b"\r\n") { 2 } else { 1 };
        let mut words = Vec::new();
        let mut at = 0;
        for word in line.split(u8::is_ascii_whitespace).take(MAX_DECLARATIONS) {
            if !word.is_empty() {
                words.push(Span::new(start + at, start + at + word.len()));
            }
            at += word.len() + 1;
        }
        Some(words)
    }

    fn bad(&self, message: &str, span: Span) -> Box<Diagnostic> {
        Box::new(Diagnostic::error("ply::header", message).at(self.source, span, ""))
    }

    fn format(&mut self, words: &[Span]) -> Found<()> {
        const NAMES: [(&str, Encoding); 3] = [
            ("ascii", Encoding::Text),
            ("binary_little_endian", Encoding::LittleEndian),
            ("binary_big_endian", Encoding::BigEndian),
        ];
        let Some(&word) = words.get(1) else { return Err(self.bad("which format?", words[0])) };
        let name = self.source.text(word);
        let Some((_, encoding)) = NAMES.iter().find(|(n, _)| *n == name) else {
            return Err(Box::new(self.bad("an unknown format", word).one_of(&name, NAMES.map(|(n, _)| n))));
        };
        self.encoding = Some(*encoding);
        Ok(())
    }

    fn element(&mut self, words: &[Span]) -> Found<()> {
        let &[_, name, count] = words else {
            return Err(Box::new(self.bad("not an element", words[0]).expected("`element <name> <count>`")));
        };
        let Some(number) = self.source.text(count).parse::<u64>().ok() else {
            return Err(Box::new(self.bad("this is no count", count).expected("a whole number of 0 or more")));
        };
        if self.elements.len() >= MAX_DECLARATIONS {
            return Err(self.bad("too many kinds of elements", name));
        }
        self.elements.push(Element { name: self.source.text(name), count: number, properties: Vec::new() });
        Ok(())
    }

    fn property(&mut self, words: &[Span]) -> Found<()> {
        let (value, length, name) = match *words {
            [_, list, length, value, name] if self.source.slice(list) == b"list" => (value, Some(length), name),
            [_, value, name] => (value, None, name),
            _ => {
                let error = self.bad("not a property", words[0]);
                return Err(Box::new(
                    error.expected("`property <type> <name>` or `property list <type> <type> <name>`"),
                ));
            }
        };
        let property = Property {
            name: self.source.text(name),
            value: self.scalar(value)?,
            length: length.map(|l| self.scalar(l)).transpose()?,
        };
        let no_element = self.bad("a property before any element", words[0]);
        let Some(element) = self.elements.last_mut() else { return Err(no_element) };
        if element.properties.len() >= MAX_DECLARATIONS {
            return Err(self.bad("too many properties", name));
        }
        element.properties.push(property);
        Ok(())
    }

    fn scalar(&self, word: Span) -> Found<Scalar> {
        let name = self.source.text(word);
        let found = SCALARS.iter().find(|(n, _)| *n == name).map(|(_, s)| *s);
        let names = SCALARS.iter().map(|(n, _)| *n);
        found.ok_or_else(|| Box::new(self.bad("an unknown type", word).one_of(&name, names)))
    }
}
