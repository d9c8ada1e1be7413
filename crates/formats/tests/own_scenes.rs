//! The scenes of this project.

use formats::scn::ScnOptions;
use formats::{LoadOptions, load};
use std::path::Path;

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
            assert!(loaded.warnings.is_empty(), "{}: {:?}", path.display(), loaded.warnings);
            loaded.builder.build().unwrap();
        }
    }
    assert!(count > 0, "no scene found");
}
