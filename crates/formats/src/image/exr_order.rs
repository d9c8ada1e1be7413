//! The order of attributes in an OpenEXR header, which the format leaves free and the library leaves to chance.

/// Sorts the attributes of the first header by name, so that equal pictures are equal files. A file that is not understood
/// is left as it is.
pub(super) fn sort_attributes(file: &mut [u8]) {
    /// Magic number and version.
    const START: usize = 8;
    if let Some((mut attributes, end)) = attributes(file, START) {
        attributes.sort();
        let sorted = attributes.concat();
        file[START..end].copy_from_slice(&sorted);
    }
}

/// The attributes from `at` to the zero byte that ends their list, whole and as stored, and where that byte is.
fn attributes(file: &[u8], mut at: usize) -> Option<(Vec<Vec<u8>>, usize)> {
    let mut all = Vec::new();
    while *file.get(at)? != 0 {
        // Name and type end with a zero each; then the size of the value, and the value.
        let size_at = after_zero(file, after_zero(file, at)?)?;
        let size = i32::from_le_bytes(file.get(size_at..size_at + 4)?.try_into().ok()?);
        let end = (size_at + 4).checked_add(usize::try_from(size).ok()?)?;
        all.push(file.get(at..end)?.to_vec());
        at = end;
    }
    Some((all, at))
}

fn after_zero(file: &[u8], from: usize) -> Option<usize> {
    file.get(from..)?.iter().position(|b| *b == 0).map(|n| from + n + 1)
}
