//! Text in aligned columns.

/// Rows of cells; every column but the last is as wide as its widest cell, two spaces between columns. Each row ends with
/// a newline.
pub(crate) fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |column: usize| rows.iter().map(|r| r[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..N).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}"));
        text += cells.collect::<Vec<_>>().join("  ").trim_end();
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::aligned;

    #[test]
    fn columns_are_as_wide_as_their_widest_cell_in_characters() {
        let rows = [["a", "é", "x"], ["bbb", "", "y"]].map(|r| r.map(str::to_owned));
        assert_eq!(aligned(&rows), "a    é  x\nbbb     y\n");
    }
}
