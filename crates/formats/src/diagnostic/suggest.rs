//! "Did you mean": the valid name nearest to what was written.

/// Longer words and longer lists are not compared: the work grows with their product.
const MAX_LETTERS: usize = 64;
pub(super) const MAX_NAMES: usize = 10_000;

/// The name most like `found`, or `None` when none is near: a difference in case only is always near, else at most
/// one edit per three letters (insert, delete, replace, swap neighbours).
pub fn nearest<'n>(found: &str, names: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    if found.len() > MAX_LETTERS {
        return None;
    }
    let lower = found.to_lowercase();
    let limit = (lower.chars().count() / 3).max(1);
    names
        .into_iter()
        .take(MAX_NAMES)
        .filter(|name| *name != found && name.len() <= MAX_LETTERS)
        .map(|name| (strsim::damerau_levenshtein(&lower, &name.to_lowercase()), name))
        .filter(|(edits, name)| *edits <= limit && *edits < name.chars().count())
        .min_by_key(|(edits, _)| *edits)
        .map(|(_, name)| name)
}
