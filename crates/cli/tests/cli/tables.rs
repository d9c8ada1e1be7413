use crate::workplace::Workplace;
use sunfleck::{
    bsdf::{COVERINGS, MATERIALS},
    integrator::REGISTRY,
};

#[test]
fn lists_hold_the_whole_registries() {
    let place = Workplace::new();
    let names = |what: &str| -> Vec<String> {
        let records = place.run(&format!("list {what} --json")).json().remove(0);
        records.as_array().unwrap().iter().map(|r| r["name"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(names("integrators"), REGISTRY.iter().map(|e| e.name).collect::<Vec<_>>());
    assert_eq!(names("materials"), MATERIALS.iter().chain(COVERINGS).map(|m| m.name).collect::<Vec<_>>());
    let known = formats::SCENE_FORMATS.iter().map(|f| f.name).chain(formats::image::FORMATS.iter().map(|f| f.name));
    assert_eq!(names("formats"), known.collect::<Vec<_>>());
    for what in ["integrators", "materials", "formats"] {
        let text = place.run(&format!("list {what}")).out;
        assert!(text.lines().all(|line| line == line.trim_end()) && text.lines().count() >= names(what).len());
    }
}

#[test]
fn info_counts_what_the_scene_holds() {
    let place = Workplace::new();
    let info = place.run("info ball.scn --json --camera-position 0,1,-5").json().remove(0);
    let scene = &info["scene"];
    // The floor and the lamp are two triangles each.
    assert_eq!((scene["triangles"].as_u64(), scene["spheres"].as_u64()), (Some(4), Some(1)));
    assert_eq!(info["materials"]["dielectric"], 1);
    assert_eq!(info["camera"]["position"], serde_json::json!([0.0, 1.0, -5.0]));
    // One side of one square metre: π·A·L.
    let power = info["lights"][0]["power"][0].as_f64().unwrap();
    assert!((power - 10.0 * std::f64::consts::PI).abs() < 1e-4, "{power}");
    let both = place.run("info ball.scn --json --area-lights two").json().remove(0);
    assert!((both["lights"][0]["power"][0].as_f64().unwrap() / power - 2.0).abs() < 1e-6);
    insta::assert_snapshot!("info", place.run("info ball.scn --ambient 1,1,1").out);
}
