//! Any bytes as an image file: a picture of the size it says, or an error, never a panic.
#![no_main]

use formats::image::read_image_bytes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    if let Ok(file) = read_image_bytes("fuzz", data) {
        assert_eq!(file.image.data.len(), file.image.width as usize * file.image.height as usize);
    }
});
