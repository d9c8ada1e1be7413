//! Where files that other people made are, if they are at hand.
use std::path::{Path, PathBuf};

/// A file or folder of them, or `None` (with a note) if there is none.
pub(crate) fn shared(name: &str) -> Option<PathBuf> {
    let root = std::env::var_os("SUNFLECK_SHARED")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"), PathBuf::from);
    let path = root.join(name);
    if !path.exists() {
        eprintln!("skipped: {} is not there (set SUNFLECK_SHARED)", path.display());
        return None;
    }
    Some(path)
}
