use super::{Diagnostic, Sink, SourceFile, Span, WARNINGS_PER_CODE, names_near, nearest};

fn source(bytes: &[u8]) -> SourceFile {
    SourceFile::from_bytes("a.scn", bytes)
}

#[test]
fn a_place_counts_lines_and_columns_from_one() {
    let text = source(b"one\r\ntwo\rthree\n\xE5\xB1\xB1 four");
    let place = |start, end| text.place(Span::new(start, end), "").at.unwrap();
    let one = place(0, 3);
    assert_eq!((one.line, one.column, one.excerpt.text.as_str(), one.excerpt.mark), (1, 1, "one", 0..3));
    let three = place(9, 14);
    assert_eq!((three.line, three.column, three.excerpt.text.as_str()), (3, 1, "three"));
    let four = place(19, 23);
    assert_eq!((four.line, four.column, four.excerpt.mark), (4, 3, 4..8));
}

#[test]
fn a_place_outside_of_the_file_is_its_end() {
    let at = source(b"ab\n").place(Span::new(90, 95), "").at.unwrap();
    assert_eq!((at.line, at.column, at.excerpt.text.as_str()), (2, 1, ""));
}

#[test]
fn a_very_long_line_is_shown_in_part_with_its_true_column() {
    let mut bytes = vec![b'x'; 100_000];
    bytes[50_000] = b'!';
    let at = source(&bytes).place(Span::new(50_000, 99_000), "").at.unwrap();
    assert_eq!((at.line, at.column), (1, 50_001));
    assert!(at.excerpt.text.len() <= 700 && at.excerpt.text[at.excerpt.mark].starts_with('!'));
}

#[test]
fn a_late_excerpt_shows_its_true_column() {
    let mut bytes = vec![b'x'; 1000];
    bytes[500] = b'!';
    let shown = Diagnostic::error("test::kind", "oh").at(&source(&bytes), Span::new(500, 501), "here").to_string();
    assert!(shown.contains("a.scn:1:501"), "{shown}");
    assert!(shown.contains("^ here"), "{shown}");
}

#[test]
fn names_that_are_not_utf8_stay_different() {
    let text = source(b"\xB2\xE3 \xB2\xE4");
    assert_eq!(text.text(Span::new(0, 2)), "\\xB2\\xE3");
    assert_ne!(text.text(Span::new(0, 2)), text.text(Span::new(3, 5)));
}

#[test]
fn the_nearest_name_is_offered_only_when_near() {
    let names = ["Material", "Model", "Light"];
    assert_eq!(nearest("material", names), Some("Material"));
    assert_eq!(nearest("Modle", names), Some("Model"));
    assert_eq!(nearest("Camera", names), None);
    assert_eq!(nearest("", names), None);
    assert_eq!(nearest(&"M".repeat(1_000_000), names), None);
}

#[test]
fn a_diagnostic_shows_all_it_knows() {
    let text = source(b"Begin Model\n\tSphere ball whit\nEnd\n");
    let shown = Diagnostic::error("test::kind", "no material is named `whit`")
        .at(&text, Span::new(25, 29), "here")
        .see(&text, Span::new(0, 11), "in this section")
        .expected("a material")
        .one_of("whit", ["White", "Red"])
        .help("define it above");
    insta::assert_snapshot!("everything", shown.to_string());
    assert!(shown.render(true).contains("\u{1b}["));
    let bare = Diagnostic::warning("test::kind", "no light in the scene").in_file("b.scn");
    insta::assert_snapshot!("file_only", bare.to_string());
}

#[test]
fn the_end_of_a_line_can_be_marked() {
    let text = source(b"R\nEnd");
    insta::assert_snapshot!(
        "line_end",
        Diagnostic::error("test::kind", "oh").at(&text, Span::new(1, 1), "").to_string()
    );
}

#[test]
fn a_sink_keeps_three_warnings_of_a_kind() {
    let mut sink = Sink::default();
    for _ in 0..10 {
        sink.warn("test::a", || Diagnostic::warning("test::a", "a"));
    }
    sink.warn("test::b", || Diagnostic::warning("test::b", "b"));
    let warnings = sink.take_warnings();
    assert_eq!(warnings.len(), WARNINGS_PER_CODE + 1);
    assert_eq!(warnings[2].help, ["7 more of this kind in this file"]);
    assert!(warnings[3].help.is_empty());
}

#[test]
fn files_that_cannot_be_read_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("cornell_box.scn"), "Begin").unwrap();
    std::fs::write(path("utf16.scn"), b"B\0e\0g\0i\0n\0 \0M\0o\0d\0e\0l\0").unwrap();
    std::fs::write(path("utf16be.scn"), b"\xFE\xFF\0B\0e\0g\0i\0n").unwrap();
    let told = |name: &str| {
        let text = SourceFile::read(&path(name)).unwrap_err().to_string();
        text.replace(&folder.path().display().to_string(), "FOLDER")
    };
    assert_eq!(names_near(&path("cornel_box.scn")), ["cornell_box.scn"]);
    insta::assert_snapshot!("missing_file", told("cornel_box.scn"));
    insta::assert_snapshot!("missing_folder", told("nowhere/cornell_box.scn"));
    insta::assert_snapshot!("utf16_without_mark", told("utf16.scn"));
    insta::assert_snapshot!("utf16_with_mark", told("utf16be.scn"));
    std::fs::write(path("binary.scn"), b"Begin\0\0\0\x01").unwrap();
    insta::assert_snapshot!("binary", told("binary.scn"));
    insta::assert_snapshot!("folder", told("."));
    std::fs::File::create(path("huge.scn")).unwrap().set_len((1 << 30) + 1).unwrap();
    insta::assert_snapshot!("huge_file", told("huge.scn"));
}
