use crate::workplace::{SCENE, Workplace};
use formats::image::Tone;

const SMALL: &str = "--width 24 --height 16 --aspect 1.5 --passes 2";

#[test]
fn a_picture_has_its_size_and_an_exr_tells_where_it_comes_from() {
    let place = Workplace::new();
    let ran = place.run(&format!("render ball.scn {SMALL} -o a.png -o a.exr -o a.hdr -o a.pfm --seed 7 --alpha 0.5"));
    assert_eq!((ran.code, ran.out.as_str()), (Some(0), ""), "{}", ran.err);
    for name in ["a.png", "a.exr", "a.hdr", "a.pfm"] {
        let image = place.image(name).image;
        assert_eq!((image.width, image.height), (24, 16), "{name}");
        assert!(image.data.iter().flatten().sum::<f32>() > 1.0, "{name} is black");
    }
    let metadata = place.image("a.exr").metadata;
    let value = |key: &str| metadata.iter().find(|(k, _)| k == key).map(|(_, v)| v.as_str());
    assert_eq!((value("integrator"), value("settings")), (Some("unified"), Some("alpha=0.5")));
    assert_eq!((value("seed"), value("passes")), (Some("7"), Some("2")));
    assert_eq!(value("version"), Some(env!("CARGO_PKG_VERSION")));
    assert_eq!(value("scene-hash").map(str::len), Some(32));
}

#[test]
fn without_an_output_the_picture_is_named_after_the_scene() {
    let place = Workplace::new();
    let ran = place.run(&format!("render ball.scn {SMALL}"));
    assert!(ran.code == Some(0) && ran.err.contains("ball.png"), "{}", ran.err);
    assert_eq!(place.files(), ["ball.png", "ball.scn"]);
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_any_number_of_threads() {
    let place = Workplace::new();
    let bytes = |name: &str| std::fs::read(place.path(name)).unwrap();
    for integrator in sunfleck::integrator::REGISTRY.iter().map(|e| e.name) {
        for threads in [1, 2, 7] {
            let outputs = ["exr", "png", "pfm"].map(|kind| format!("-o {threads}.{kind}")).join(" ");
            let args = format!("render ball.scn {SMALL} {outputs} --integrator {integrator} --threads {threads}");
            assert_eq!(place.run(&args).code, Some(0));
        }
        for other in [2, 7] {
            assert!(bytes("1.png") == bytes(&format!("{other}.png")), "{integrator}, {other} threads");
            assert!(bytes("1.pfm") == bytes(&format!("{other}.pfm")), "{integrator}, {other} threads");
            // The order of attributes in an EXR file is not defined; what it holds is.
            assert!(bytes("1.exr") == bytes(&format!("{other}.exr")), "{integrator}, {other} threads");
        }
    }
    assert_eq!(place.run(&format!("render ball.scn {SMALL} -o other.pfm --integrator light --seed 1")).code, Some(0));
    assert!(bytes("other.pfm") != bytes("1.pfm"), "another seed gives the same picture");
}

#[test]
fn json_is_one_object_and_its_means_are_those_of_the_picture() {
    let place = Workplace::new();
    let ran = place.run(&format!("render ball.scn {SMALL} -o a.exr --integrator ppm --photons 384 --json --quiet"));
    assert_eq!(ran.err, "");
    let records = ran.json();
    let [record] = &records[..] else { panic!("{} lines", records.len()) };
    assert_eq!((record["event"].as_str(), record["stopped_by"].as_str()), (Some("done"), Some("passes")));
    assert_eq!((record["passes"].as_u64(), record["photons_emitted"].as_u64()), (Some(2), Some(2 * 24 * 16)));
    assert_eq!((record["scene"]["lights"].as_u64(), record["outputs"][0]["path"].as_str()), (Some(1), Some("a.exr")));
    let image = place.image("a.exr").image;
    for channel in 0..3 {
        let mean = image.data.iter().map(|p| f64::from(p[channel])).sum::<f64>() / 384.0;
        assert!((record["mean"][channel].as_f64().unwrap() - mean).abs() < 1e-9);
    }
}

#[test]
fn json_lines_tell_of_each_pass_and_then_of_the_whole() {
    let place = Workplace::new();
    let records = place.run("render ball.scn --width 8 --height 8 --passes 3 --json=lines -o a.png").json();
    let events: Vec<&str> = records.iter().map(|r| r["event"].as_str().unwrap()).collect();
    assert_eq!(events, ["pass", "pass", "pass", "done"]);
    assert!(records.iter().zip(1..4).take(3).all(|(r, n)| r["passes"].as_u64() == Some(n)));
}

#[test]
fn a_time_budget_is_kept_within_a_pass() {
    let place = Workplace::new();
    let records = place.run("render ball.scn --width 16 --height 16 --time 1s --json=lines -o a.png").json();
    let (done, passes) = records.split_last().unwrap();
    let longest = passes.iter().map(|p| p["pass_seconds"].as_f64().unwrap()).fold(0.0, f64::max);
    let seconds = done["seconds"].as_f64().unwrap();
    assert!(seconds <= 1.0 + longest, "{seconds} s with passes of {longest} s");
    assert_eq!(done["stopped_by"].as_str(), Some("time"));
    assert!(passes.len() > 1);
}

#[test]
fn samples_are_spread_over_passes() {
    let place = Workplace::new();
    let passes = |args: &str| {
        let args = format!("render ball.scn --width 4 --height 4 --json -q -o a.png {args}");
        place.run(&args).json()[0]["passes"].as_u64()
    };
    assert_eq!(passes("--spp 6"), Some(6));
    assert_eq!(passes("--integrator photonmap --photons 100 --set samples=4 --spp 6"), Some(2));
    assert_eq!(passes(""), Some(64));
    assert_eq!(passes("--compat nrenderer"), Some(16));
}

#[test]
fn compatibility_with_nrenderer_changes_depth_filter_light_and_curve() {
    let place = Workplace::new();
    let common = "--width 16 --height 16 --passes 64 --integrator path -q";
    let render = |args: &str| assert_eq!(place.run(&format!("render ball.scn {common} {args}")).code, Some(0));
    // Depth 2 is direct light. The lamp shines down on the floor only, so its other side changes nothing here.
    render("--compat nrenderer --depth 2 -o theirs.exr -o theirs.png");
    render("--depth 1 -o ours.exr -o ours.png --tone nrenderer");
    let mean = |name: &str| place.image(name).image.data.iter().map(|p| f64::from(p[0])).sum::<f64>();
    let (theirs, ours) = (mean("theirs.exr"), mean("ours.exr"));
    assert!((theirs / ours - 1.0).abs() < 0.1 && theirs != ours, "{theirs} {ours}");
    let png = std::fs::read(place.path("theirs.png")).unwrap();
    let linear = place.image("theirs.exr");
    formats::image::write_image(&place.path("again.png"), &linear, Tone::SquareRoot).unwrap();
    assert!(png == std::fs::read(place.path("again.png")).unwrap());
}

#[test]
fn exposure_brightens_png_only() {
    let place = Workplace::new();
    let render = |args: &str| assert_eq!(place.run(&format!("render ball.scn {SMALL} -q {args}")).code, Some(0));
    render("-o a.png -o a.pfm");
    render("--exposure -2 -o b.png -o b.pfm");
    assert_eq!(place.image("a.pfm"), place.image("b.pfm"));
    let sum = |name: &str| place.image(name).image.data.iter().flatten().sum::<f32>();
    assert!(sum("b.png") < 0.5 * sum("a.png"));
}

#[test]
fn surroundings_light_a_scene_without_lamps() {
    let place = Workplace::new();
    let dark = SCENE.split("Begin Light").next().unwrap();
    place.write("dark.scn", dark);
    place.paint("sky.pfm", [2.0, 2.0, 2.0], &[]);
    let mean = |args: &str| {
        let args =
            format!("render dark.scn --width 8 --height 8 --passes 16 --integrator path -q -o a.exr --json {args}");
        place.run(&args).json()[0]["mean"][0].as_f64().unwrap()
    };
    assert_eq!(mean(""), 0.0);
    let (constant, panorama) = (mean("--ambient 2,2,2"), mean("--env sky.pfm"));
    assert!(constant > 0.5 && (panorama / constant - 1.0).abs() < 0.05, "{constant} {panorama}");
    let warned = place.run(&format!("render dark.scn {SMALL} -o a.png"));
    assert!(warned.err.contains("no light"), "{}", warned.err);
    let lit = place.run(&format!("render dark.scn {SMALL} -o a.png --ambient 1,1,1"));
    assert!(!lit.err.contains("no light"), "{}", lit.err);
}

#[test]
fn several_files_make_one_scene() {
    let place = Workplace::new();
    let (shapes, lamp) = SCENE.split_at(SCENE.find("Begin Light").unwrap());
    place.write("shapes.scn", shapes);
    place.write("lamp.scn", lamp);
    let means: Vec<_> = ["ball.scn", "shapes.scn lamp.scn"]
        .map(|files| place.run(&format!("render {files} {SMALL} -o a.png --json -q")).json()[0]["mean"].clone())
        .into();
    assert_eq!(means[0], means[1]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_picture_is_written_even_if_nobody_can_be_told() {
    let place = Workplace::new();
    let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
    let mut command = place.command(&format!("render ball.scn {SMALL} -o a.png --json=lines"));
    let ran = crate::workplace::Ran::from(command.stdout(full).output().unwrap());
    assert!(ran.code == Some(1) && ran.err.contains("standard output"), "{}", ran.err);
    assert_eq!(place.image("a.png").image.width, 24);
}
