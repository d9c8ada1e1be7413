//! Any bytes as an `.obj` file: meshes with valid indices or errors with a place, never a panic.
#![no_main]

use formats::diagnostic::{Sink, SourceFile};
use formats::obj::parse;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let source = SourceFile::from_bytes("fuzz.obj", data);
    let mut sink = Sink::default();
    let tree = parse(&source, &mut sink);
    match sink.finish(()) {
        Ok(()) => {
            for corner in tree.meshes.iter().flat_map(|m| &m.triangles).flatten() {
                assert!((corner.position as usize) < tree.positions.len());
                assert!(corner.uv().is_none_or(|i| (i as usize) < tree.uvs.len()));
                assert!(corner.normal().is_none_or(|i| (i as usize) < tree.normals.len()));
            }
        }
        Err(error) => assert!(error.errors.iter().all(|e| e.place.is_some() && !e.render(false).is_empty())),
    }
});
