//! Buffers, loaded once, and views into them.

use super::super::document::Fields;
use super::super::findings::Findings;
use super::meshopt;
use super::uri::{Reference, reference};
use crate::diagnostic::Diagnostic;
use crate::files::Files;
use crate::load::Target;
use serde_json::Value;
use std::collections::HashMap;
use std::rc::Rc;

/// Kinds of `data:` that buffers may have (glTF 2.0, section 3.6.1.1).
const BUFFER_MIME: [&str; 2] = ["application/octet-stream", "application/gltf-buffer"];

/// All bytes of a file.
pub(in super::super) struct Buffers {
    /// By buffer; `None` for those whose data only an extension provides.
    all: Vec<Option<Rc<[u8]>>>,
    /// By view: what it holds once unpacked.
    unpacked: HashMap<usize, Vec<u8>>,
    /// Bytes in all buffers.
    total: usize,
}

impl Buffers {
    /// Loads all buffers and unpacks the views that are packed. What cannot be had is an error.
    pub(in super::super) fn load(
        root: &Value,
        mut data: Option<Vec<u8>>,
        is_binary: bool,
        files: &Files,
        told: &Findings,
        target: &mut Target,
    ) -> Self {
        let mut by_name: HashMap<String, Rc<[u8]>> = HashMap::new();
        let mut buffers = Vec::new();
        for (i, buffer) in root.items("buffers").iter().enumerate() {
            let chunk = if i == 0 && is_binary { data.take() } else { None };
            let found = load_one(buffer, chunk, &mut by_name, files, target);
            let path = format!("buffers[{i}]");
            match found {
                Ok(Some((bytes, mime))) => {
                    check_one(buffer, &bytes, mime.as_deref(), &path, told, target);
                    buffers.push(Some(bytes));
                }
                Ok(None) => {
                    if buffer.get("uri").is_some() {
                        let message = "it lies neither beside the scene nor in it, and is not fetched";
                        told.warn(&mut target.sink, "gltf::remote", path, message);
                    } else if i == 0 && is_binary && meshopt::extension(buffer).is_none() {
                        told.error(&mut target.sink, "gltf::buffer", path, "the file has no chunk of data for it");
                    }
                    buffers.push(None);
                }
                Err(reason) => {
                    told.error(&mut target.sink, "gltf::buffer", path, reason);
                    buffers.push(None);
                }
            }
        }
        let total = by_name.values().chain(buffers.iter().flatten()).map(|b| b.len()).sum();
        let mut all = Self { all: buffers, unpacked: HashMap::new(), total };
        all.unpack(root, told, target);
        all
    }

    /// Bytes in all buffers.
    pub(in super::super) fn total(&self) -> usize {
        self.total
    }

    fn unpack(&mut self, root: &Value, told: &Findings, target: &mut Target) {
        for (i, view) in root.items("bufferViews").iter().enumerate() {
            let Some(packed) = meshopt::extension(view) else { continue };
            let result = match self.range(packed) {
                Some(stream) => meshopt::unpack(packed, stream),
                None => Err("the packed data lie beyond the end of their buffer".to_owned()),
            };
            match result {
                Ok(bytes) => {
                    self.unpacked.insert(i, bytes);
                }
                Err(reason) => told.error(
                    &mut target.sink,
                    "gltf::meshopt",
                    format_args!("bufferViews[{i}].extensions.EXT_meshopt_compression"),
                    reason,
                ),
            }
        }
    }

    /// The bytes that `buffer`, `byteOffset` and `byteLength` of an object mean.
    fn range(&self, object: &Value) -> Option<&[u8]> {
        let buffer = self.all.get(object.index("buffer")?)?.as_deref()?;
        let start = object.index("byteOffset").unwrap_or(0);
        buffer.get(start..start.checked_add(object.index("byteLength")?)?)
    }

    /// Whether a view is one into a buffer that the file does not provide.
    pub(in super::super) fn is_absent(&self, root: &Value, view: usize) -> bool {
        let buffer = root.items("bufferViews").get(view).and_then(|v| v.index("buffer"));
        !self.unpacked.contains_key(&view) && buffer.is_some_and(|b| matches!(self.all.get(b), Some(None)))
    }

    /// The bytes of a view; `None` if it lies outside of its buffer, or that has none.
    pub(in super::super) fn view(&self, root: &Value, index: usize) -> Option<&[u8]> {
        match self.unpacked.get(&index) {
            Some(bytes) => Some(bytes),
            None => self.range(root.items("bufferViews").get(index)?),
        }
    }
}

type Loaded = Option<(Rc<[u8]>, Option<String>)>;

/// The bytes of a buffer, and their kind if the file says it.
fn load_one(
    buffer: &Value,
    chunk: Option<Vec<u8>>,
    by_name: &mut HashMap<String, Rc<[u8]>>,
    files: &Files,
    target: &mut Target,
) -> Result<Loaded, String> {
    let Some(uri) = buffer.text("uri") else { return Ok(chunk.map(|c| (c.into(), None))) };
    match reference(uri)? {
        Reference::Remote => Ok(None),
        Reference::Data { mime, bytes } => Ok(Some((bytes.into(), Some(mime)))),
        Reference::File(name) => {
            if let Some(bytes) = by_name.get(&name) {
                return Ok(Some((bytes.clone(), None)));
            }
            let path = files.find(&name, "");
            let source = files.include(&path, target).map_err(|e| reason(&name, &e))?;
            let bytes: Rc<[u8]> = source.bytes().into();
            by_name.insert(name, bytes.clone());
            Ok(Some((bytes, None)))
        }
    }
}

/// Why another file cannot be read, with advice if there is any.
pub(in super::super) fn reason(name: &str, error: &Diagnostic) -> String {
    let mut text = error.message.clone();
    for help in &error.help {
        text += "; ";
        text += help;
    }
    if text.contains(name) { text } else { format!("{name}: {text}") }
}

fn check_one(buffer: &Value, bytes: &[u8], mime: Option<&str>, path: &str, told: &Findings, target: &mut Target) {
    let sink = &mut target.sink;
    let declared = buffer.index("byteLength").unwrap_or(0);
    if bytes.len() < declared {
        let message = format!("`byteLength` is {declared}, but there are {} bytes", bytes.len());
        told.error(sink, "gltf::buffer", path, message);
    }
    if let Some(mime) = mime
        && !BUFFER_MIME.contains(&mime)
    {
        let message = format!("the data are of the kind `{mime}`, not {}", BUFFER_MIME.join(" or "));
        told.lapse(sink, "gltf::mime", path, message);
    }
}
