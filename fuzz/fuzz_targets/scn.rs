//! Any bytes as an `.scn` file: a tree or errors with a place, never a panic.
#![no_main]

use formats::diagnostic::{Sink, SourceFile};
use formats::scn::{Comma, parse};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let source = SourceFile::from_bytes("fuzz.scn", data);
    for comma in [Comma::Separates, Comma::EndsNumbers] {
        let mut sink = Sink::default();
        let tree = parse(&source, comma, &mut sink);
        match sink.finish(()) {
            Ok(()) => {
                let shapes = tree.models.iter().flat_map(|m| &m.shapes);
                assert!(shapes.into_iter().all(|s| s.material < tree.materials.len()));
            }
            Err(error) => assert!(error.errors.iter().all(|e| e.place.is_some() && !e.render(false).is_empty())),
        }
        sink.take_warnings().iter().for_each(|w| assert!(!w.render(false).is_empty()));
    }
});
