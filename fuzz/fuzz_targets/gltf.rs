//! Any bytes as a glTF file, text or binary, without others beside it: a scene or errors with a place, never a panic.
#![no_main]

use formats::gltf::check;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    for strict in [false, true] {
        match check("fuzz.gltf", data.to_vec(), strict) {
            Ok((builder, warnings)) => {
                warnings.iter().for_each(|w| assert!(!w.render(false).is_empty()));
                let _ = builder.build();
            }
            Err(error) => assert!(error.errors.iter().all(|e| e.place.is_some() && !e.render(false).is_empty())),
        }
    }
});
