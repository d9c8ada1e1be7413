use crate::workplace::Workplace;

#[test]
fn a_scene_of_nrenderer_becomes_one_of_pbrt() {
    let place = Workplace::new();
    let ran = place.run("convert ball.scn out.pbrt --camera-position 0,1,-5");
    assert_eq!((ran.code, ran.out.as_str()), (Some(0), ""), "{}", ran.err);
    let info = place.run("info out.pbrt --json").json().remove(0);
    assert_eq!(info["scene"]["triangles"], 4);
    assert_eq!(info["camera"]["position"], serde_json::json!([0.0, 1.0, -5.0]));
    let text = std::fs::read_to_string(place.path("out.pbrt")).unwrap();
    assert!(text.contains("MakeNamedMaterial \"Glass\" \"string type\" [ \"dielectric\" ]"), "{text}");
    insta::assert_snapshot!("converted", text);
}

#[test]
fn only_pbrt_is_written_and_only_whole() {
    let place = Workplace::new();
    let before = place.files();
    let ran = place.run("convert ball.scn out.gltf");
    assert_eq!(ran.code, Some(2));
    assert!(ran.err.contains("a name that ends in `.pbrt`"), "{}", ran.err);
    assert_eq!(place.run("convert ball.scn nowhere/out.pbrt").code, Some(1));
    assert_eq!(place.files(), before);
}

#[test]
fn materials_are_replaced_by_name_and_lights_added() {
    let place = Workplace::new();
    let flags = "--material White=metal:gold:roughness=0.2 --material #1=glass:bk7 --add-light sun:irradiance=2 \
                 --add-light ball:at=0,1,1:radius=0.05";
    let info = place.run(&format!("info ball.scn --json {flags}")).json().remove(0);
    let materials = &info["inventory"]["materials"];
    assert_eq!(materials[0]["model"], "roughconductor");
    assert_eq!((&materials[1]["name"], &materials[1]["model"]), (&"Glass".into(), &"dielectric".into()));
    assert_eq!((info["lights"].as_array().unwrap().len(), info["dispersive"].clone()), (3, true.into()));
    let seen = place.run("info ball.scn --json --camera orthographic:3").json().remove(0);
    assert_eq!(seen["camera"]["projection"], "orthographic:3");
}

#[test]
fn what_the_flags_do_not_know_is_told_with_what_they_do() {
    let place = Workplace::new();
    let said = |flags: &str| {
        let ran = place.run(&format!("info ball.scn {flags}"));
        assert_eq!(ran.code, Some(2), "{flags}");
        ran.err
    };
    let flags = [
        "--material Glas=glass",
        "--material Glass=glas",
        "--material Glass=glass:bk8",
        "--material Glass=metal:golden",
        "--material Glass=glass:ior=-1",
        "--material Glass=glass:iro=1",
        "--material Glass=diffuse:color=1,2",
        "--add-light lamp",
        "--add-light spot:angle=200",
    ];
    insta::assert_snapshot!("flags", flags.map(|f| format!("{f}\n{}", said(f))).join("\n"));
    assert!(said("--camera fisheye").contains("orthographic:HEIGHT"));
}
