//! A name for the content of a scene.

use super::LoadOptions;
use sha2::{Digest, Sha256};

/// Collects all bytes that a scene is made of.
pub(crate) struct InputHash(Sha256);

impl InputHash {
    pub(super) fn new() -> Self {
        Self(Sha256::new())
    }

    /// Adds a file. Its length goes in first, so that moving bytes between files changes the hash.
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        self.0.update((bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
    }

    /// The first 128 bits of the hash, as hexadecimal digits.
    pub(super) fn finish(mut self, options: &LoadOptions) -> String {
        let scn = &options.scn;
        for part in options.defines.iter().flat_map(|(name, value)| [name, value]) {
            self.add(part.as_bytes());
        }
        self.0.update([u8::from(scn.compat), scn.sides() as u8, scn.comma() as u8]);
        self.0.finalize()[..16].iter().map(|b| format!("{b:02x}")).collect::<Vec<_>>().concat()
    }
}
