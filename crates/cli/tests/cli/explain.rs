//! `--explain`: the picture taken apart, and the books of its light.
use crate::workplace::{SCENE, Workplace};
use serde_json::Value;

const SMALL: &str = "--width 24 --height 16 --aspect 1.5 --passes 2";

/// Numbers by channel.
fn channels(v: &Value) -> [f64; 3] {
    [0, 1, 2].map(|c| v[c].as_f64().unwrap())
}

#[test]
fn samplers_become_layers_that_add_up_to_the_picture_and_to_the_whole() {
    let place = Workplace::new();
    let record = place
        .run(&format!("render ball.scn {SMALL} -o a.exr -o a.png --integrator vcm --explain --json"))
        .json()
        .remove(0);
    assert_eq!(place.files(), ["a.explain.exr", "a.exr", "a.png", "ball.scn"]);
    let (picture, apart) = (place.image("a.exr"), place.image("a.explain.exr"));
    let layers: Vec<&str> = apart.layers.iter().map(|(name, _)| name.as_str()).collect();
    for name in ["hit", "nee", "light-image", "connect", "merge"] {
        assert!(layers.contains(&name) && layers.contains(&format!("{name}-unweighted").as_str()), "{layers:?}");
    }
    let weighted = apart.layers.iter().filter(|(name, _)| !name.ends_with("-unweighted"));
    let mut sum = vec![[0.0f32; 3]; 24 * 16];
    weighted.for_each(|(_, l)| sum.iter_mut().flatten().zip(l.data.iter().flatten()).for_each(|(s, v)| *s += v));
    for ((a, b), c) in
        sum.iter().flatten().zip(picture.image.data.iter().flatten()).zip(apart.image.data.iter().flatten())
    {
        assert!((a - b).abs() < 1e-4 * (1.0 + b) && (a - c).abs() < 1e-4 * (1.0 + c), "{a} {b} {c}");
    }
    let explain = &record["explain"];
    assert_eq!(explain["passes"], 2);
    let samplers = explain["samplers"].as_array().unwrap();
    let shares: Vec<f64> = samplers.iter().map(|s| s["share"].as_f64().unwrap()).collect();
    assert!(shares.len() == 5 && (shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{shares:?}");
    for channel in 0..3 {
        let parts: f64 = samplers.iter().map(|s| channels(&s["mean"])[channel]).sum();
        assert!((parts / channels(&record["mean"])[channel] - 1.0).abs() < 1e-4);
    }
    assert!(record["outputs"].as_array().unwrap().iter().any(|o| o["path"] == "a.explain.exr"));
}

#[test]
fn without_layers_samplers_are_pictures_of_the_same_kind() {
    let place = Workplace::new();
    let ran = place.run(&format!("render ball.scn {SMALL} -o a.png --integrator bdpt --explain"));
    assert_eq!(ran.code, Some(0), "{}", ran.err);
    for name in ["hit", "nee", "light-image", "connect"] {
        for file in [format!("a.explain-{name}.png"), format!("a.explain-{name}-unweighted.png")] {
            assert_eq!(place.image(&file).image.width, 24, "{file}");
        }
        assert!(ran.err.contains(name), "{}", ran.err);
    }
    assert!(ran.err.contains("area 1") && ran.err.contains("of the picture"), "{}", ran.err);
}

#[test]
fn books_balance_and_are_the_same_on_any_number_of_threads() {
    let place = Workplace::new();
    let books = |threads: u32| {
        let args =
            format!("render ball.scn {SMALL} -q -o a.png --integrator bdpt --explain --json --threads {threads}");
        place.run(&args).json().remove(0)["explain"].clone()
    };
    let explain = books(1);
    assert_eq!(explain, books(3));
    let [light] = &explain["books"]["lights"].as_array().unwrap()[..] else { panic!("one light") };
    assert_eq!((light["name"].as_str(), light["kind"].as_str()), (Some("area 1"), Some("area")));
    let watts = |part: &str| channels(&light[part]["watts"]);
    let count = |part: &str| light[part]["count"].as_u64().unwrap();
    for channel in 0..3 {
        // One side of one square metre: π·A·L.
        let emitted = watts("emitted")[channel];
        let power = [10.0, 9.0, 8.0][channel] * std::f64::consts::PI;
        assert!((emitted / power - 1.0).abs() < 0.05, "{emitted} {power}");
        let spent = ["absorbed", "escaped", "cut"].map(|part| watts(part)[channel]).iter().sum::<f64>();
        let roulette = channels(&light["roulette_watts"])[channel];
        assert!(((spent + roulette) / emitted - 1.0).abs() < 1e-5 && (roulette / emitted).abs() < 0.02);
    }
    assert_eq!(count("emitted"), count("absorbed") + count("escaped") + count("cut"));
    assert!(count("gathered") > 0 && count("gathered") < count("stored"));
}

#[test]
fn algorithms_without_samplers_or_photons_say_so() {
    let place = Workplace::new();
    let ran = place.run(&format!("render ball.scn {SMALL} -o a.png --integrator path --explain"));
    assert!(ran.code == Some(0) && ran.err.contains("`path` has no samplers"), "{}", ran.err);
    assert!(ran.err.contains("`path` sent no light paths"), "{}", ran.err);
    assert_eq!(place.files(), ["a.png", "ball.scn"]);
    let args = format!("render ball.scn {SMALL} -o a.png --integrator photonmap --photons 1e3 --explain --json -q");
    let explain = &place.run(&args).json().remove(0)["explain"];
    assert!(explain["samplers"].as_array().unwrap().is_empty() && explain["books"]["lights"][0]["kind"] == "area");
}

#[test]
fn a_lamp_that_nothing_in_view_needs_is_named() {
    let place = Workplace::new();
    let far = "\
Begin Model
Model Elsewhere
Plane Floor White
N 0 1 0
P 98 -1 -1
U 0 0 4
V 4 0 0
End
Begin Light
Area Lamp
IRV 10 9 8
P 99.5 2 0.5
U 1 0 0
V 0 0 1
End
";
    place.write("two.scn", format!("{SCENE}{far}"));
    let ran = place.run(&format!("render two.scn {SMALL} -o a.png --integrator bdpt --explain"));
    assert!(ran.err.contains("100.0 % of the photons of light `area 2` never reach a visible kernel"), "{}", ran.err);
    assert!(!ran.err.contains("of light `area 1` never"), "{}", ran.err);
    let ran = place.run(&format!("render two.scn {SMALL} -o a.png --integrator ppm --aim off --explain"));
    assert!(ran.err.contains("of light `area 2` ") && ran.err.contains("`--aim on`"), "{}", ran.err);
    let ran = place.run(&format!("render ball.scn {SMALL} -o a.png --integrator ppm --depth 2 --explain"));
    assert!(ran.err.contains("of the light of `area 1` is cut off") && ran.err.contains("--depth"), "{}", ran.err);
}
