use crate::workplace::{SCENE, Workplace};

/// Standard error of a run that must refuse its input without writing anything.
fn refused(place: &Workplace, args: &str) -> String {
    let before = place.files();
    let ran = place.run(args);
    assert_eq!(ran.code, Some(2), "{args}: {}", ran.err);
    assert_eq!(ran.out, "", "{args}");
    assert_eq!(place.files(), before, "{args}");
    ran.err
}

#[test]
fn a_mistake_in_a_scene_is_shown_with_its_place_and_a_caret() {
    let place = Workplace::new();
    place.write("bad.scn", SCENE.replace("Ball Glass", "Ball Glas"));
    let said = refused(&place, "render bad.scn -q");
    assert!(said.contains("bad.scn:14:13") && said.contains('^') && said.contains("Glass"), "{said}");
    insta::assert_snapshot!("bad_scene", said);
}

#[test]
fn unknown_names_are_answered_with_the_known_ones() {
    let place = Workplace::new();
    let said = refused(&place, "render ball.scn --integrator pmm");
    for entry in sunfleck::integrator::REGISTRY {
        assert!(said.contains(entry.name), "{said}");
    }
    let said = refused(&place, "render ball.scn -q --integrator path --set photons=5");
    insta::assert_snapshot!(said, @"error: `photons` is not a setting of `path`; it knows scatterings, roulette-after, texture-filter");
    insta::assert_snapshot!("unknown_extension", refused(&place, "render ball.scn -o a.pgn"));
    insta::assert_snapshot!("unknown_scene_format", refused(&place, "render ball.blend -q"));
    insta::assert_snapshot!("missing_scene", refused(&place, "info bal.scn"));
}

#[test]
fn a_setting_said_twice_is_refused() {
    let place = Workplace::new();
    let said = refused(&place, "render ball.scn --integrator ppm --photons 5 --set photons=6");
    insta::assert_snapshot!(said, @"error: the setting `photons` is given twice");
    let said = refused(&place, "render ball.scn --depth 3 --set scatterings=6");
    insta::assert_snapshot!(said, @"error: --depth and --set scatterings=6 say the same thing twice");
}

#[test]
fn places_that_cannot_be_written_are_found_before_rendering() {
    let place = Workplace::new();
    insta::assert_snapshot!(refused(&place, "render ball.scn -o a.png -o nowhere/b.exr"),
        @"error: cannot write nowhere/b.exr: the folder nowhere does not exist");
    insta::assert_snapshot!(refused(&place, "render ball.scn -o a.png -o a.png"),
        @"error: a.png would be written twice");
    std::fs::create_dir(place.path("taken.png")).unwrap();
    insta::assert_snapshot!(refused(&place, "render ball.scn -o taken.png"),
        @"error: cannot write taken.png: it is a folder");
}

#[test]
fn values_out_of_range_are_answered_with_the_range() {
    let place = Workplace::new();
    let cases = [
        ("--fov nan", "more than 0 and less than 180"),
        ("--fov 180", "more than 0 and less than 180"),
        ("--width -5", "a whole number from 1 to"),
        ("--height 0", "a whole number from 1 to"),
        ("--width 1e3", "a whole number from 1 to"),
        ("--width 100000 --height 100000", "more than 268435456"),
        ("--camera-position 1,2", "three finite numbers"),
        ("--up 0,inf,0", "three finite numbers"),
        ("--ambient -1,0,0", "three numbers of 0 or more"),
        ("--aperture -1", "a number of 0 or more"),
        ("--focus 0", "a number greater than 0"),
        ("--passes 0", "a whole number from 1 to"),
        ("--passes 3 --spp 3", "cannot be used with"),
        ("--time 30", "such as 30s"),
        ("--threads 0", "a whole number from 1 to 1024"),
        ("--exposure 99", "from -32 to 32"),
        ("--set photons", "KEY=VALUE"),
        ("--memory 5 --passes 1", "memory=5 is not a whole number"),
        ("--aim perhaps", "one of off, on"),
        ("--memory 2XB", "such as 512MiB"),
        ("--seed -1", "a whole number from 0 to"),
        ("--compat nrenderer --depth 0", "1 or more"),
        ("--camera-position 0,0,0", "cannot look at"),
        ("--env nowhere.hdr", "no such file"),
        ("--env ball.scn", "no picture of a known format"),
    ];
    for (args, expected) in cases {
        let said = refused(&place, &format!("render ball.scn {args}"));
        assert!(said.contains(expected), "{args}: {said}");
    }
}
