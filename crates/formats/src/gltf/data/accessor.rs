//! Accessors: lists of numbers within views, some of them sparse.

use super::super::document::Fields;
use super::{Buffers, Component, element_bytes, width_of};
use serde_json::Value;

/// An accessor without data of its own is zeros, and may have at most this many elements: nothing in the file vouches for
/// them.
const MAX_UNBACKED: usize = 1 << 20;

/// A list of elements, each of `width` numbers.
pub(in super::super) struct Accessor<'b> {
    /// Elements.
    pub(in super::super) count: usize,
    /// Numbers of an element.
    pub(in super::super) width: usize,
    /// Their kind.
    pub(in super::super) component: Component,
    /// Whether whole numbers mean fractions.
    pub(in super::super) normalized: bool,
    /// From the first element on; `None` means zeros.
    bytes: Option<&'b [u8]>,
    stride: usize,
    sparse: Option<Sparse<'b>>,
}

/// Elements that differ.
struct Sparse<'b> {
    count: usize,
    places: &'b [u8],
    place: Component,
    values: &'b [u8],
    stride: usize,
}

impl<'b> Accessor<'b> {
    /// The accessor of that index.
    ///
    /// # Errors
    /// Why it cannot be read, in words that begin with its place.
    pub(in super::super) fn open(root: &Value, buffers: &'b Buffers, index: usize) -> Result<Self, String> {
        Self::try_open(root, buffers, index).map_err(|reason| format!("accessors[{index}]: {reason}"))
    }

    fn try_open(root: &Value, buffers: &'b Buffers, index: usize) -> Result<Self, String> {
        let json = root.items("accessors").get(index).ok_or("it does not exist")?;
        let code = json.index("componentType").unwrap_or(0);
        let component = Component::of(code).ok_or_else(|| format!("numbers of the kind {code} are not known"))?;
        let kind = json.text("type").unwrap_or("");
        let unknown = || format!("elements of the type `{kind}` are not known");
        let width = width_of(kind).ok_or_else(unknown)?;
        let (mut stride, size) = element_bytes(kind, component).ok_or_else(unknown)?;
        let (tight, count, mut bytes) = (stride, json.index("count").unwrap_or(0), None);
        if let Some(view) = json.index("bufferView") {
            let all = buffers.view(root, view).ok_or_else(|| format!("bufferViews[{view}] has no data"))?;
            let start = json.index("byteOffset").unwrap_or(0);
            stride = root.items("bufferViews").get(view).and_then(|v| v.index("byteStride")).unwrap_or(tight);
            bytes = Some(slice(all, start, stride, count, size).ok_or("it reaches beyond the end of its view")?);
        } else if count > MAX_UNBACKED {
            return Err(format!("{count} elements without data are too many; at most {MAX_UNBACKED}"));
        }
        let sparse = json.get("sparse").map(|s| Sparse::open(root, buffers, s, [tight, size], count)).transpose()?;
        Ok(Self { count, width, component, normalized: json.flag("normalized"), bytes, stride, sparse })
    }

    /// The elements as numbers; an accessor of another width is cut, or filled up with zeros.
    pub(in super::super) fn floats<const N: usize>(&self) -> Vec<[f32; N]> {
        self.numbers(self.normalized)
    }

    /// The elements as the file holds them, normalized or not.
    pub(in super::super) fn raw<const N: usize>(&self) -> Vec<[f32; N]> {
        self.numbers(false)
    }

    fn numbers<const N: usize>(&self, normalized: bool) -> Vec<[f32; N]> {
        let columns = self.column_starts();
        let read = |b: &[u8]| -> [f32; N] {
            std::array::from_fn(|i| {
                let part = columns.get(i).and_then(|at| b.get(*at..)).unwrap_or_default();
                self.component.float(part, normalized)
            })
        };
        self.all([0.0; N], read)
    }

    /// The elements as whole numbers of 0 or more.
    pub(in super::super) fn wholes<const N: usize>(&self) -> Vec<[u32; N]> {
        let size = self.component.bytes();
        let read = |b: &[u8]| -> [u32; N] {
            std::array::from_fn(|i| {
                let part = if i < self.width { b.get(i * size..).unwrap_or_default() } else { &[] };
                self.component.whole(part)
            })
        };
        self.all([0; N], read)
    }

    /// Where each number of an element begins.
    fn column_starts(&self) -> Vec<usize> {
        let size = self.component.bytes();
        let rows = match self.width {
            9 => 3,
            16 => 4,
            width => width,
        };
        let column = if rows == self.width { rows * size } else { (rows * size).next_multiple_of(4) };
        (0..self.width).map(|i| i / rows * column + i % rows * size).collect()
    }

    fn all<T: Clone>(&self, zero: T, read: impl Fn(&[u8]) -> T) -> Vec<T> {
        let mut all = match self.bytes {
            None => vec![zero; self.count],
            Some(bytes) => (0..self.count).map(|i| read(bytes.get(i * self.stride..).unwrap_or_default())).collect(),
        };
        if let Some(sparse) = &self.sparse {
            for i in 0..sparse.count {
                let value = sparse.values.get(i * sparse.stride..).unwrap_or_default();
                if let Some(element) = all.get_mut(sparse.place(i)) {
                    *element = read(value);
                }
            }
        }
        all
    }
}

impl<'b> Sparse<'b> {
    fn open(
        root: &Value,
        buffers: &'b Buffers,
        json: &Value,
        [tight, size]: [usize; 2],
        all: usize,
    ) -> Result<Self, String> {
        let count = json.index("count").unwrap_or(0);
        if count > all {
            return Err(format!("{count} of {all} elements are said to differ"));
        }
        let (indices, values) = (json.field("indices"), json.field("values"));
        let place = indices.index("componentType").and_then(Component::of).filter(|c| c.is_unsigned());
        let place = place.ok_or("the places of its differing elements are no whole numbers")?;
        let part = |object: &Value, stride: usize, size: usize| {
            let view = buffers.view(root, object.index("bufferView")?)?;
            slice(view, object.index("byteOffset").unwrap_or(0), stride, count, size)
        };
        let short = "its differing elements reach beyond the end of their view";
        let places = part(indices, place.bytes(), place.bytes()).ok_or(short)?;
        let sparse = Self { count, places, place, values: part(values, tight, size).ok_or(short)?, stride: tight };
        if (0..count).any(|i| sparse.place(i) >= all) {
            return Err("an element that differs does not exist".to_owned());
        }
        Ok(sparse)
    }

    fn place(&self, i: usize) -> usize {
        self.place.whole(self.places.get(i * self.place.bytes()..).unwrap_or_default()) as usize
    }
}

/// The bytes of `count` elements of `size` at `stride` from `start`.
fn slice(bytes: &[u8], start: usize, stride: usize, count: usize, size: usize) -> Option<&[u8]> {
    let length = match count {
        0 => 0,
        _ => (count - 1).checked_mul(stride)?.checked_add(size)?,
    };
    bytes.get(start..start.checked_add(length)?)
}
