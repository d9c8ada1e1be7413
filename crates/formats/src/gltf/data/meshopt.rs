//! Buffer views packed by `EXT_meshopt_compression` (Khronos glTF registry; its codecs are those of meshoptimizer).

use super::super::document::Fields;
use meshoptimizer_rs::codec::{BufferView, Filter, Mode};
use meshoptimizer_rs::{Limits, Workspace};
use serde_json::Value;

/// The names under which the extension goes.
const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// No stream of these codecs packs more than this many bytes into one: sixteen equal values take two bits.
const MAX_RATIO: usize = 64;

/// A view may unpack to this much whatever the size of its stream,
const SMALL: usize = 1 << 16;

/// The extension of a buffer view, or of a buffer.
pub(super) fn extension(object: &Value) -> Option<&Value> {
    NAMES.iter().find_map(|name| object.extension(name))
}

/// Unpacks the view that `packed` describes from its stream.
///
/// # Errors
/// What is wrong with it, in words.
pub(super) fn unpack(packed: &Value, stream: &[u8]) -> Result<Vec<u8>, String> {
    let word = |key: &str, default| packed.text(key).unwrap_or(default);
    let (mode, filter) = (word("mode", ""), word("filter", "NONE"));
    let unknown = |what: &str, name: &str| format!("the {what} `{name}` is not supported");
    let mode = Mode::parse(mode).map_err(|_| unknown("mode", mode))?;
    let filter = Filter::parse(filter).map_err(|_| unknown("filter", filter))?;
    let (count, stride) = (packed.index("count").unwrap_or(0), packed.index("byteStride").unwrap_or(0));
    let view = BufferView::new(mode, filter, count, stride).map_err(|e| format!("count, stride and mode: {e}"))?;
    if view.byte_length() > stream.len().saturating_mul(MAX_RATIO).max(SMALL) {
        let (size, packed) = (view.byte_length(), stream.len());
        return Err(format!("{packed} bytes are said to unpack to {size}, which no such stream does"));
    }
    let limits = Limits { max_bytes: view.byte_length() + (1 << 24), ..Limits::default() };
    view.decode(stream, &mut Workspace::new(limits)).map_err(|e| format!("the packed data are damaged: {e}"))
}
