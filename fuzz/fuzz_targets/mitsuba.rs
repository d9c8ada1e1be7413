//! Any bytes as a Mitsuba `.xml` file without others beside it: a scene or errors with a place, never a panic.
#![no_main]

use formats::mitsuba::check;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    match check("fuzz.xml", data.to_vec()) {
        Ok((_, warnings)) => warnings.iter().for_each(|w| assert!(!w.render(false).is_empty())),
        Err(error) => assert!(error.errors.iter().all(|e| e.place.is_some() && !e.render(false).is_empty())),
    }
});
