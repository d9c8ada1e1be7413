//! Kinds of numbers (glTF 2.0, section 3.6.2.2).

/// The type of one component of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in super::super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    /// By the code in the file.
    pub(in super::super) fn of(code: usize) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    /// Bytes of one.
    pub(in super::super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The whole number that means 1 where it is normalized.
    pub(in super::super) fn largest(self) -> Option<f32> {
        Some(match self {
            Self::I8 => 127.0,
            Self::U8 => 255.0,
            Self::I16 => 32_767.0,
            Self::U16 => 65_535.0,
            Self::U32 => u32::MAX as f32,
            Self::F32 => return None,
        })
    }

    /// Whether it holds whole numbers of 0 or more.
    pub(in super::super) fn is_unsigned(self) -> bool {
        matches!(self, Self::U8 | Self::U16 | Self::U32)
    }

    /// The number in the first bytes of `b`; `normalized` ones are fractions of the largest (section 3.6.2.2).
    pub(super) fn float(self, b: &[u8], normalized: bool) -> f32 {
        let value = match (self, b) {
            (Self::I8, [a, ..]) => f32::from(*a as i8),
            (Self::U8, [a, ..]) => f32::from(*a),
            (Self::I16, [a, b, ..]) => f32::from(i16::from_le_bytes([*a, *b])),
            (Self::U16, [a, b, ..]) => f32::from(u16::from_le_bytes([*a, *b])),
            (Self::U32, [a, b, c, d, ..]) => u32::from_le_bytes([*a, *b, *c, *d]) as f32,
            (Self::F32, [a, b, c, d, ..]) => f32::from_le_bytes([*a, *b, *c, *d]),
            _ => 0.0,
        };
        match self.largest() {
            Some(largest) if normalized => (value / largest).max(-1.0),
            _ => value,
        }
    }

    /// The whole number in the first bytes of `b`; 0 for other kinds.
    pub(super) fn whole(self, b: &[u8]) -> u32 {
        match (self, b) {
            (Self::U8, [a, ..]) => u32::from(*a),
            (Self::U16, [a, b, ..]) => u32::from(u16::from_le_bytes([*a, *b])),
            (Self::U32, [a, b, c, d, ..]) => u32::from_le_bytes([*a, *b, *c, *d]),
            _ => 0,
        }
    }
}

/// Components of an element of that type: columns and rows.
fn shape_of(kind: &str) -> Option<(usize, usize)> {
    Some(match kind {
        "SCALAR" => (1, 1),
        "VEC2" => (1, 2),
        "VEC3" => (1, 3),
        "VEC4" => (1, 4),
        "MAT2" => (2, 2),
        "MAT3" => (3, 3),
        "MAT4" => (4, 4),
        _ => return None,
    })
}

/// Components of an element.
pub(in super::super) fn width_of(kind: &str) -> Option<usize> {
    shape_of(kind).map(|(columns, rows)| columns * rows)
}

/// Bytes from one element to the next, and bytes of an element: columns of a matrix begin at multiples of 4, and behind the
/// last one no padding need follow (section 3.6.2.4).
pub(in super::super) fn element_bytes(kind: &str, component: Component) -> Option<(usize, usize)> {
    let (columns, rows) = shape_of(kind)?;
    let column = rows * component.bytes();
    let padded = if columns > 1 { column.next_multiple_of(4) } else { column };
    Some((columns * padded, (columns - 1) * padded + column))
}
