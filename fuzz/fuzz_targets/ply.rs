//! Any bytes as a `.ply` file: a mesh with valid indices or errors with a place, never a panic.
#![no_main]

use formats::diagnostic::{Sink, SourceFile};
use formats::ply::parse;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut sink = Sink::default();
    let mesh = parse(&SourceFile::from_bytes("fuzz.ply", data), &mut sink);
    assert!(mesh.triangles.iter().flatten().all(|i| (*i as usize) < mesh.positions.len()));
    if let Err(error) = sink.finish(()) {
        assert!(error.errors.iter().all(|e| e.place.is_some() && !e.render(false).is_empty()));
    }
});
