//! The table in the book is that of the registry and of the scenes.
use crate::{estimators, scenes::SCENES};

/// A row for each scene, a column for each algorithm.
fn table() -> String {
    let row = |first: &str, cells: Vec<String>| format!("| {first} | {} |\n", cells.join(" | "));
    let mut table = row("scene", estimators().map(|e| format!("`{}`", e.name)).collect());
    table += &row("---", estimators().map(|_| ":-:".to_owned()).collect());
    for s in SCENES {
        let mark = |seen| if seen { "✓" } else { "—" }.to_owned();
        let marks = estimators().map(|e| mark(s.is_seen_by(e))).collect();
        table += &row(&format!("`{}`: {}", s.name, s.about), marks);
    }
    table
}

#[test]
fn the_book_has_the_table_of_algorithms_and_scenes() {
    let table = table();
    let page = include_str!("../../../../book/src/agreement.md").replace("\r\n", "\n");
    assert!(page.contains(&table), "book/src/agreement.md should have this table:\n\n{table}");
}

#[test]
fn blind_algorithms_exist() {
    for name in SCENES.iter().flat_map(|s| s.blind) {
        assert!(estimators().any(|e| e.name == *name), "no algorithm {name}");
    }
}
