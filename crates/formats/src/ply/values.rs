//! Numbers of the body, one after the other.

use super::header::{Encoding, Scalar};

/// Walks over the values of a file.
pub(super) struct Values<'s> {
    bytes: &'s [u8],
    at: usize,
    encoding: Encoding,
}

/// Why there is no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trouble {
    /// The file ends.
    End,
    /// In a text, a word from here to there that is no number.
    NoNumber(usize, usize),
}

impl<'s> Values<'s> {
    /// Starts at byte `at`.
    pub(super) fn new(bytes: &'s [u8], at: usize, encoding: Encoding) -> Self {
        Self { bytes, at: at.min(bytes.len()), encoding }
    }

    /// Bytes that are left.
    pub(super) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The next number, exact for every type.
    #[inline]
    pub(super) fn next(&mut self, kind: Scalar) -> Result<f64, Trouble> {
        match self.encoding {
            Encoding::Text => self.word(),
            Encoding::LittleEndian => self.binary(kind, false),
            Encoding::BigEndian => self.binary(kind, true),
        }
    }

    /// Passes over `count` values.
    pub(super) fn skip(&mut self, kind: Scalar, count: u64) -> Result<(), Trouble> {
        if self.encoding == Encoding::Text {
            return (0..count).try_for_each(|_| self.next(kind).map(drop));
        }
        let bytes = count.saturating_mul(kind.bytes() as u64);
        if bytes > self.left() as u64 {
            return Err(Trouble::End);
        }
        self.at += bytes as usize;
        Ok(())
    }

    fn word(&mut self) -> Result<f64, Trouble> {
        let rest = &self.bytes[self.at..];
        let blanks = rest.iter().position(|b| !b.is_ascii_whitespace()).ok_or(Trouble::End)?;
        let start = self.at + blanks;
        let length = self.bytes[start..].iter().position(u8::is_ascii_whitespace);
        let end = length.map_or(self.bytes.len(), |l| start + l);
        self.at = end;
        let text = std::str::from_utf8(&self.bytes[start..end]).ok();
        text.and_then(|t| t.parse().ok()).ok_or(Trouble::NoNumber(start, end))
    }

    #[inline]
    fn binary(&mut self, kind: Scalar, big: bool) -> Result<f64, Trouble> {
        let size = kind.bytes();
        let stored = self.bytes.get(self.at..self.at + size).ok_or(Trouble::End)?;
        self.at += size;
        let mut b = [0; 8];
        // To little-endian, with zeros above.
        for (i, byte) in stored.iter().enumerate() {
            b[if big { size - 1 - i } else { i }] = *byte;
        }
        let [b0, b1, b2, b3, ..] = b;
        Ok(match kind {
            Scalar::I8 => f64::from(b0 as i8),
            Scalar::U8 => f64::from(b0),
            Scalar::I16 => f64::from(i16::from_le_bytes([b0, b1])),
            Scalar::U16 => f64::from(u16::from_le_bytes([b0, b1])),
            Scalar::I32 => f64::from(i32::from_le_bytes([b0, b1, b2, b3])),
            Scalar::U32 => f64::from(u32::from_le_bytes([b0, b1, b2, b3])),
            Scalar::F32 => f64::from(f32::from_le_bytes([b0, b1, b2, b3])),
            Scalar::F64 => f64::from_le_bytes(b),
        })
    }
}
