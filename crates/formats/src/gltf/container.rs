//! The two shapes of a file: JSON text, or a binary container with JSON and data in chunks (glTF 2.0, section 4).

use super::findings::Findings;
use crate::diagnostic::{Diagnostic, Sink};

/// What a file is made of.
pub(super) struct Container {
    /// The text that describes the scene.
    pub(super) json: Vec<u8>,
    /// The data of the first buffer, in a binary file that has any.
    pub(super) data: Option<Vec<u8>>,
    /// Whether the text stands in a binary container.
    pub(super) is_binary: bool,
}

const MAGIC: &[u8] = b"glTF";
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const DATA: u32 = u32::from_le_bytes(*b"BIN\0");

/// Takes a file apart. `None` after an error, which is in the sink.
pub(super) fn open(bytes: Vec<u8>, is_named_binary: bool, told: &Findings, sink: &mut Sink) -> Option<Container> {
    if bytes.starts_with(MAGIC) {
        let found = chunks(&bytes, told, sink);
        return found.map_err(|error| sink.error(*error)).ok();
    }
    if bytes.starts_with(b"version https://git-lfs") {
        let error = told.file_error("gltf::git-lfs", "this is a placeholder of Git LFS, not the file itself");
        sink.error(error.help("fetch the file: git lfs pull"));
        return None;
    }
    let looks_like_text = bytes.trim_ascii_start().starts_with(b"{");
    if is_named_binary && !looks_like_text {
        let message = match bytes.len() {
            0 => "the file is empty",
            1..=3 => "the file ends within its header",
            _ => "this is no binary glTF",
        };
        sink.error(told.file_error("gltf::not-binary", message).expected("`glTF` as the first four bytes"));
        return None;
    }
    Some(Container { json: bytes, data: None, is_binary: false })
}

type Found<T> = Result<T, Box<Diagnostic>>;

fn chunks(bytes: &[u8], told: &Findings, sink: &mut Sink) -> Found<Container> {
    let bad = |message: String| Box::new(told.file_error("gltf::container", message));
    let word = |at: usize| bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let cut = || bad("the file ends within its header".to_owned());
    let (version, length) = (word(4).ok_or_else(cut)?, word(8).ok_or_else(cut)? as usize);
    if version != 2 {
        return Err(bad(format!("the container is of version {version}")).expected("version 2").into());
    }
    if length < HEADER + CHUNK_HEADER {
        return Err(bad(format!("the header says that the file has {length} bytes, too few to hold anything")));
    }
    if length > bytes.len() {
        return Err(bad(format!("the header says that the file has {length} bytes, but it has {}", bytes.len())));
    }
    if length < bytes.len() {
        sink.warn("gltf::container", || {
            let message = format!("{} bytes lie behind the end that the header gives", bytes.len() - length);
            Diagnostic { severity: crate::Severity::Warning, ..told.file_error("gltf::container", message) }
        });
    }
    let (mut at, mut json, mut data, mut index) = (HEADER, None, None, 0);
    while at < length {
        let name = |kind: u32| format!("chunk {index} ({})", kind_name(kind));
        let within = |from: usize, size: usize| from.checked_add(size).is_some_and(|end| end <= length);
        if !within(at, CHUNK_HEADER) {
            return Err(bad(format!("the file ends within the header of chunk {index}")));
        }
        let (size, kind) = (word(at).unwrap_or(0) as usize, word(at + 4).unwrap_or(0));
        if size % 4 != 0 {
            return Err(bad(format!("{} has {size} bytes, not a multiple of 4", name(kind))));
        }
        let start = at + CHUNK_HEADER;
        if !within(start, size) {
            let message = format!("{} is said to have {size} bytes, but only {} follow", name(kind), length - start);
            return Err(bad(message));
        }
        let content = &bytes[start..start + size];
        match (kind, index) {
            (JSON, 0) if size == 0 => return Err(bad("the chunk of JSON is empty".to_owned())),
            (JSON, 0) => json = Some(content.to_vec()),
            (_, 0) => return Err(bad(format!("{} comes first", name(kind))).expected("JSON").into()),
            (DATA, 1) => data = Some(content.to_vec()),
            (JSON | DATA, _) if kind == JSON || data.is_some() => {
                return Err(bad(format!("{} comes a second time", name(kind))));
            }
            (DATA, _) => return Err(bad(format!("{} must be the second one", name(kind)))),
            _ => sink.warn("gltf::chunk", || {
                let message = format!("{} is of no known kind", name(kind));
                let warning = told.file_error("gltf::chunk", message).help("it is passed over");
                Diagnostic { severity: crate::Severity::Warning, ..warning }
            }),
        }
        at = start + size;
        index += 1;
    }
    let json = json.ok_or_else(|| bad("there is no JSON in this file".to_owned()))?;
    Ok(Container { json, data, is_binary: true })
}

fn kind_name(kind: u32) -> String {
    match kind {
        JSON => "JSON".to_owned(),
        DATA => "BIN".to_owned(),
        _ => format!("{kind:#010x}"),
    }
}
