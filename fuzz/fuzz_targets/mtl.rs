//! Any bytes as an `.mtl` file: materials or errors with a place, never a panic.
#![no_main]

use formats::diagnostic::{Sink, SourceFile};
use formats::obj::parse_mtl;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut sink = Sink::default();
    parse_mtl(&SourceFile::from_bytes("fuzz.mtl", data), &mut sink);
    if let Err(error) = sink.finish(()) {
        assert!(error.errors.iter().all(|e| e.place.is_some() && !e.render(false).is_empty()));
    }
});
