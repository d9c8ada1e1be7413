//! The scenes of this project.

use formats::scn::ScnOptions;
use formats::{LoadOptions, load};
use std::path::Path;

/// Scenes that a sky given by a flag lights; the format has no word for it, and the card says so.
const LIT_BY_A_FLAG: [&str; 1] = ["far-glass"];

#[test]
fn every_scene_of_ours_loads_without_a_word() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "scn" && e != "obj" && e != "pbrt") {
            continue;
        }
        count += 1;
        for compat in [false, true] {
            let options = LoadOptions { scn: ScnOptions { compat, ..ScnOptions::default() }, ..LoadOptions::default() };
            let loaded = load(std::slice::from_ref(&path), &options).unwrap_or_else(|e| panic!("{e}"));
            let lit_by_a_flag = path.file_stem().is_some_and(|s| LIT_BY_A_FLAG.iter().any(|name| s == *name));
            let expected: &[&str] = if lit_by_a_flag { &["load::no-light"] } else { &[] };
            let codes: Vec<&str> = loaded.warnings.iter().map(|w| w.code).collect();
            assert_eq!(codes, expected, "{}: {:?}", path.display(), loaded.warnings);
            loaded.builder.build().unwrap();
        }
    }
    assert!(count > 0, "no scene found");
}
