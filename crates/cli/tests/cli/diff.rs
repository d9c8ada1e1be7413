use crate::workplace::Workplace;

const GREY: [f32; 3] = [0.5; 3];

/// A reference, the same 1 % brighter, and one with a broken pixel.
fn place() -> Workplace {
    let place = Workplace::new();
    place.paint("r.exr", GREY, &[]);
    place.paint("a.exr", [0.505; 3], &[]);
    place.paint("nan.exr", GREY, &[(7, [f32::NAN; 3])]);
    place
}

#[test]
fn figures_are_those_of_the_formulas() {
    let report = place().run("diff a.exr r.exr --json").json().remove(0);
    let near = |name: &str, want: f64| {
        let have = report[name].as_f64().unwrap();
        assert!((have - want).abs() < 1e-6 * want, "{name} {have}");
    };
    near("rmse", f64::from(0.505_f32) - 0.5);
    near("relmse", (f64::from(0.505_f32) - 0.5).powi(2) / 0.26);
    near("worst_mean_error", f64::from(0.505_f32) / 0.5 - 1.0);
    assert_eq!((report["blocks"]["within"].as_f64(), report["blocks"]["count"].as_u64()), (Some(1.0), Some(4)));
}

#[test]
fn limits_decide_the_exit_code_and_say_which_was_exceeded() {
    let place = place();
    let cases = [
        ("--max-mean-error 2%", None),
        ("--max-mean-error 0.5%", Some("mean")),
        ("--max-rmse 0.01", None),
        ("--max-rmse 0.001", Some("RMSE is")),
        ("--max-relmse 1e-3", None),
        ("--max-relmse 1e-6", Some("relMSE is")),
        ("--min-blocks-within 100%", None),
        ("--min-blocks-within 50% --block-tolerance 0.5%", Some("of the blocks")),
    ];
    for (limit, exceeded) in cases {
        let ran = place.run(&format!("diff a.exr r.exr {limit}"));
        assert_eq!(ran.code, Some(i32::from(exceeded.is_some())), "{limit}: {}", ran.err);
        assert!(exceeded.is_none_or(|e| ran.err.contains(e)), "{limit}: {}", ran.err);
        assert!(ran.out.contains("relMSE trimmed"), "{limit}");
    }
}

#[test]
fn a_broken_pixel_exceeds_any_limit_but_is_no_error_without() {
    let place = place();
    assert_eq!(place.run("diff nan.exr r.exr").code, Some(0));
    let ran = place.run("diff nan.exr r.exr --max-rmse 1000");
    assert_eq!((ran.code, ran.err.contains("not finite")), (Some(1), true));
}

#[test]
fn masks_leave_pixels_out() {
    let place = place();
    let lamp = [(500, [100.0; 3])];
    place.paint("lamp.exr", GREY, &lamp);
    place.paint("dim.exr", GREY, &[(500, [50.0; 3])]);
    place.paint("mask.png", [0.0; 3], &[(500, [1.0; 3])]);
    let rmse = |args: &str| place.run(&format!("diff dim.exr lamp.exr --json {args}")).json()[0]["rmse"].as_f64();
    assert!(rmse("").is_some_and(|e| e > 1.0));
    assert_eq!((rmse("--mask-lights"), rmse("--mask mask.png")), (Some(0.0), Some(0.0)));
    let masked = place.run("diff dim.exr lamp.exr --json --mask-lights").json()[0]["pixels_masked"].as_u64();
    assert_eq!(masked, Some(25), "the lamp and two pixels around");
}

#[test]
fn pictures_that_cannot_be_compared_are_bad_input() {
    let place = place();
    let mut small = place.image("r.exr");
    small.image = formats::image::RgbImage32::filled(16, 64, GREY);
    formats::image::write_image(&place.path("other.pfm"), &small, formats::image::Tone::Srgb).unwrap();
    for args in ["a.exr other.pfm", "a.exr missing.exr", "a.exr ball.scn", "a.exr r.exr --mask other.pfm"] {
        let ran = place.run(&format!("diff {args}"));
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{args}: {}", ran.err);
    }
    assert_eq!(place.run("diff a.exr r.exr --heatmap map.doc").code, Some(2));
}

#[test]
fn a_heat_map_is_dark_where_pictures_agree() {
    let place = place();
    place.paint("spot.pfm", GREY, &[(100, [5.0; 3])]);
    let ran = place.run("diff spot.pfm r.exr --heatmap map.exr");
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    let map = place.image("map.exr").image;
    assert!(map.data[0].iter().all(|v| v.abs() < 1e-3) && map.data[100][0] > 0.5, "{:?}", map.data[100]);
}

#[test]
fn a_z_test_accepts_what_the_noise_of_the_samples_explains() {
    // A sample varies by 0.01, so the mean of 100 has a standard deviation of 0.01; of 3072 values one in a hundred pictures
    // is 4.66 of these away.
    let place = place();
    place.paint("variance.exr", [1e-2; 3], &[]);
    place.paint("near.exr", [0.54; 3], &[(3, [0.56, 0.5, 0.5])]);
    let accepted = |args: &str| {
        let report = place.run(&format!("diff near.exr r.exr --variance variance.exr --json {args}")).json().remove(0);
        (report["z_test"]["accepted"].as_f64().unwrap(), report["z_test"]["limit"].as_f64().unwrap())
    };
    let (share, limit) = accepted("--samples 100");
    assert!((share - 3071.0 / 3072.0).abs() < 1e-9 && (limit - 4.66).abs() < 0.02, "{share} {limit}");
    assert_eq!(accepted("--samples 100 --reference-samples 100").0, 1.0);
    assert!(accepted("--samples 1000").0 < 0.01);
    let limits = [("--samples 100 --min-accepted 99%", 0), ("--samples 1000 --min-accepted 99%", 1), ("", 2)];
    for (args, code) in limits {
        let ran = place.run(&format!("diff near.exr r.exr --variance variance.exr {args}"));
        assert_eq!(ran.code, Some(code), "{args}: {}", ran.err);
        assert!(code != 1 || ran.err.contains("z-test accepts"), "{}", ran.err);
    }
}

#[test]
fn a_picture_of_ours_tells_its_samples() {
    let place = place();
    assert_eq!(place.run("render ball.scn --width 8 --height 8 --spp 4 -q -o p.exr").code, Some(0));
    let ran = place.run("diff p.exr p.exr --variance p.exr --min-accepted 100%");
    assert_eq!((ran.code, ran.out.contains("100.000% of 192 values accepted")), (Some(0), true), "{}", ran.err);
}
