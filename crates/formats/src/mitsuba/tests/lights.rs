//! What shines, and how much.

use super::*;

/// What the first light sends to the origin.
fn first_light(inner: &str) -> Vec3 {
    let scene = scene(inner);
    let li = scene.lights()[0].sample_li(Vec3::ZERO, Vec2::splat(0.5), &AROUND).unwrap().li;
    Vec3::from_slice(&li.lanes()[..3])
}

#[test]
fn colours_come_in_all_their_forms() {
    let light = |value: &str| {
        let value = value.replace('@', "name='intensity'");
        first_light(&format!("<emitter type='point'><point name='position' x='0' y='0' z='1'/>{value}</emitter>"))
    };
    for (value, want) in [
        ("<rgb @ value='1, 2 3'/>", Vec3::new(1.0, 2.0, 3.0)),
        ("<rgb @ value='0.5'/>", Vec3::splat(0.5)),
        ("<srgb @ value='#ff0000'/>", Vec3::X),
        ("<srgb @ value='0.5'/>", Vec3::splat(0.214_04)),
        ("<spectrum @ value='7'/>", Vec3::splat(7.0)),
        ("<spectrum @ value='1 2 3'/>", Vec3::new(1.0, 2.0, 3.0)),
        ("<float @ value='4'/>", Vec3::splat(4.0)),
        ("<spectrum @ type='d65'><float name='scale' value='2'/></spectrum>", Vec3::splat(2.0)),
        ("<spectrum @ type='uniform'><float name='value' value='3'/></spectrum>", Vec3::splat(3.0)),
        // What Mitsuba 3 makes of this in its RGB variants.
        ("<spectrum @ value='400:0, 500:8, 600:15.6, 700:18.4'/>", Vec3::new(20.711, 10.855, 2.771)),
    ] {
        let got = light(value);
        assert!((got - want).abs().max_element() < 2e-3 * want.max_element(), "{value}: {got}");
    }
    let black_body = light("<blackbody @ temperature='6500K'/>");
    assert!(black_body.x > 1000.0 && (black_body.z / black_body.x - 1.0).abs() < 0.1, "{black_body}");
}

#[test]
fn an_envmap_is_turned_as_mitsubas() {
    // Longitude is atan2(x, -z): u = 0.25 is where x is, 0.5 where z is.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.pfm");
    let mut image = RgbImage32::filled(64, 32, [0.0; 3]);
    for y in 0..32 {
        for x in 0..64 {
            image.data[y * 64 + x] = match (x, y) {
                (_, 0..8) => [0.0, 1.0, 0.0],
                (12..20, _) => [1.0, 0.0, 0.0],
                (28..36, _) => [0.0, 0.0, 1.0],
                _ => [0.0; 3],
            };
        }
    }
    write_image(&path, &image.into(), Tone::Srgb).unwrap();
    let sky = std::fs::read(&path).unwrap();
    let seen = |transform: &str, d: Vec3| {
        let main = wrapped(&format!(
            "<emitter type='envmap'><string name='filename' value='sky.pfm'/>
            <transform name='to_world'>{transform}</transform></emitter>"
        ));
        let file = load_files(&[("main.xml", main.as_bytes()), ("sky.pfm", &sky)], &[]).1.unwrap();
        let scene = file.builder.build().unwrap();
        Vec3::from_slice(&scene.lights()[0].le_escaped(d, Wavelengths::Rgb).lanes()[..3])
    };
    for (transform, [red, green, blue]) in
        [("", [Vec3::X, Vec3::Y, Vec3::Z]), ("<rotate x='1' angle='90'/>", [Vec3::X, Vec3::Z, Vec3::NEG_Y])]
    {
        assert_eq!(seen(transform, red), Vec3::X);
        assert_eq!(seen(transform, green), Vec3::Y);
        assert_eq!(seen(transform, blue), Vec3::Z);
        assert_eq!(seen(transform, -red), Vec3::ZERO);
    }
}

#[test]
fn lights_have_mitsubas_measures() {
    let spot = scene(
        "<emitter type='spot'><rgb name='intensity' value='2'/><float name='cutoff_angle' value='40'/>
        <float name='beam_width' value='20'/></emitter>",
    );
    for (degrees, want) in [(0.0_f32, 2.0), (19.0, 2.0), (30.0, 1.0), (35.0, 0.5), (41.0, 0.0)] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let li =
            spot.lights()[0].sample_li(Vec3::new(sin, 0.0, cos), Vec2::ZERO, &AROUND).map_or(0.0, |s| s.li.lanes()[0]);
        assert!((li - want).abs() < 1e-3, "{degrees}: {li}");
    }
    assert_eq!(
        first_light(
            "<emitter type='directional'><vector name='direction' value='0,0,-1'/>
        <rgb name='irradiance' value='3'/></emitter>"
        ),
        Vec3::splat(3.0)
    );
    let lights = scene("<emitter type='sunsky'><vector name='sun_direction' x='0' y='1' z='1'/></emitter>");
    assert!(matches!(lights.lights(), [Light::Environment(_), Light::Sun(_)]));
    let to_sun = lights.lights()[1].sample_li(Vec3::ZERO, Vec2::ZERO, &AROUND).unwrap().wi;
    assert!((to_sun - Vec3::new(0.0, 1.0, 1.0).normalize()).length() < 1e-5, "{to_sun}");
}

#[test]
fn pictures_are_projected_as_mitsuba_has_them() {
    // Red above, green below; dark at the right.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.pfm");
    let mut image = RgbImage32::filled(2, 2, [0.0; 3]);
    (image.data[0], image.data[2]) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    write_image(&path, &image.into(), Tone::Srgb).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    let seen = |emitter: &str, to: Vec3| {
        let (kind, name) = emitter.split_once(' ').unwrap();
        let main = wrapped(&format!(
            "<emitter type='{kind}'><texture name='{name}' type='bitmap'>
            <string name='filename' value='a.pfm'/></texture><float name='fov' value='90'/>
            <float name='cutoff_angle' value='45'/><float name='beam_width' value='45'/></emitter>"
        ));
        let file = load_files(&[("main.xml", main.as_bytes()), ("a.pfm", &bytes)], &[]).1.unwrap();
        let scene = file.builder.build().unwrap();
        scene.lights()[0]
            .sample_li(to, Vec2::ZERO, &AROUND)
            .map_or(Vec3::ZERO, |s| Vec3::from_slice(&s.li.lanes()[..3]))
    };
    // A camera there has x at its left and y up; a plane at distance 1 gets π times the picture.
    let p = Vec3::new(0.4, 0.4, 1.0);
    let cos = p.z / p.length();
    let red = seen("projector irradiance", p) * cos;
    assert!((red - std::f32::consts::PI * Vec3::X).length() < 0.05, "{red}");
    assert!((seen("projector irradiance", p * Vec3::new(1.0, -1.0, 1.0)).y) > 1.0);
    assert_eq!(seen("projector irradiance", p * Vec3::new(-1.0, 1.0, 1.0)), Vec3::ZERO);
    // A spot's picture begins where x and y are negative.
    assert!(seen("spot texture", p * Vec3::new(-1.0, -1.0, 1.0)).x > 0.3);
    assert!(seen("spot texture", p * Vec3::new(-1.0, 1.0, 1.0)).y > 0.3);
    assert_eq!(seen("spot texture", p), Vec3::ZERO);
}
