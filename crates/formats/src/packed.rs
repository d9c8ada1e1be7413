//! Files that may be packed by gzip, as `.ply.gz` and `.pbrt.gz` are.

use crate::diagnostic::{Diagnostic, Error, MAX_FILE_BYTES, read_bytes};
use flate2::read::MultiGzDecoder;
use std::io::Read;
use std::path::Path;

/// A packed file may unpack to this much whatever its size,
const SMALL: u64 = 1 << 26;
/// and beyond that to so many times its own.
const MAX_RATIO: u64 = 100;

/// Reads a whole file and unpacks it if it begins as gzip does.
///
/// # Errors
/// As [`read_bytes`]; damaged; or it unpacks to more than its size can mean.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    let bytes = read_bytes(path)?;
    if !bytes.starts_with(&[0x1F, 0x8B]) {
        return Ok(bytes);
    }
    unpack(&bytes)
        .map_err(|(code, message)| Diagnostic::error(code, message).in_file(path.display().to_string()).into())
}

fn unpack(packed: &[u8]) -> Result<Vec<u8>, (&'static str, String)> {
    let limit = (packed.len() as u64 * MAX_RATIO).clamp(SMALL, MAX_FILE_BYTES);
    let mut bytes = Vec::new();
    MultiGzDecoder::new(packed)
        .take(limit + 1)
        .read_to_end(&mut bytes)
        .map_err(|e| ("file::gzip", format!("cannot unpack the file: {e}")))?;
    if bytes.len() as u64 > limit {
        return Err(("file::too-large", format!("the file unpacks to more than {} MiB", limit >> 20)));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::{Compression, write::GzEncoder};
    use std::io::Write;

    fn pack(bytes: &[u8]) -> Vec<u8> {
        let mut packer = GzEncoder::new(Vec::new(), Compression::best());
        packer.write_all(bytes).unwrap();
        packer.finish().unwrap()
    }

    #[test]
    fn what_was_packed_comes_out_again() {
        let bytes: Vec<u8> = (0..100_000_u32).map(|i| (i.wrapping_mul(i) >> 7) as u8).collect();
        assert_eq!(unpack(&pack(&bytes)).unwrap(), bytes);
    }

    #[test]
    fn damage_and_bombs_are_refused() {
        let packed = pack(&[7; 1000]);
        assert_eq!(unpack(&packed[..packed.len() / 2]).unwrap_err().0, "file::gzip");
        let bomb = pack(&vec![0; (SMALL + 1) as usize]);
        assert!(bomb.len() < 100_000);
        assert_eq!(unpack(&bomb).unwrap_err().0, "file::too-large");
    }
}
