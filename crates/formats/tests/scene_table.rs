//! Every scene that other people made, loaded and rendered small: a table, pictures, and sheets of them to look at. It judges
//! nothing, takes minutes, and runs when it is asked for:
//!
//! ```text
//! cargo test -p formats --test scene_table -- --ignored --nocapture
//! ```
//!
//! Pictures are in `target/tmp/scenes`. A reference of the same scene is shrunk to the size of the picture and stands below it.
mod shared;

use formats::compare::{CompareOptions, compare};
use formats::image::{ImageFile, RgbImage32, Tone, read_image, write_image};
use formats::{LoadOptions, Loaded, load};
use glam::Vec3;
use shared::shared;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use sunfleck::film::{FilmSpec, Filter};
use sunfleck::integrator::{Params, find};
use sunfleck::render::{Budget, Settings, render};
use sunfleck::spectrum::ColorMode;

/// Columns of a picture.
const WIDTH: u32 = 160;
/// What a picture may take.
const TIME: Duration = Duration::from_secs(6);
/// Pictures on a sheet, across and down.
const SHEET: [usize; 2] = [6, 5];

/// Which pictures are of the same scene: ends of paths, and the picture beside them or under the shared folder.
const REFERENCES: [(&str, &str); 19] = [
    ("pbrt-caustic-glass/v3/f16-11a.pbrt", "scenes/pbrt-caustic-glass/reference/f16-11a.exr"),
    ("pbrt-caustic-glass/v3/f16-9c.pbrt", "scenes/pbrt-caustic-glass/reference/f16-9c.exr"),
    ("pbrt-caustic-glass/v4/f16-11a-upgraded.pbrt", "scenes/pbrt-caustic-glass/reference/f16-11a.exr"),
    ("pbrt-caustic-glass/v4/f16-9c-upgraded.pbrt", "scenes/pbrt-caustic-glass/reference/f16-9c.exr"),
    ("pbrt4-veach-ajar/veach-ajar.pbrt", "scenes/pbrt4-veach-ajar/TungstenRender.exr"),
    ("pbrt4-volumetric-caustic/volumetric-caustic.pbrt", "scenes/pbrt4-volumetric-caustic/TungstenRender.exr"),
    ("pbrt3-buddha-fractal/buddha-fractal.pbrt", "scenes/pbrt3-buddha-fractal/buddha-fractal.exr"),
    ("veach-bidir/mitsuba/scene.xml", "scenes/veach-bidir/mitsuba/TungstenRender.exr"),
    ("mitsuba-water-caustic/scene_mi3.xml", "scenes/mitsuba-water-caustic/TungstenRender.exr"),
    ("mitsuba-water-caustic/scene_v05.xml", "scenes/mitsuba-water-caustic/TungstenRender.exr"),
    ("nrenderer/stock/path_tracing_cornel.scn", "references/nrenderer/path_tracing_cornel_inf_box.exr"),
    ("nrenderer/stock/pt_glass.scn", "references/nrenderer/pt_glass_inf_box.exr"),
    ("peers/a.pbrt", "references/peers/a.exr"),
    ("peers/a.xml", "references/peers/a.exr"),
    ("peers/b.pbrt", "references/peers/b.exr"),
    ("peers/b.xml", "references/peers/b.exr"),
    ("peers/c.pbrt", "references/peers/c_provisional.exr"),
    ("peers/c.xml", "references/peers/c_provisional.exr"),
    ("medium_homogeneous_sss.xml", "scenes/mitsuba3-doc-scenes/docs/reference/medium_homogeneous_sss.jpg"),
];

/// Parts of other scenes, files made to be odd, and a format that is not ours.
const LEFT_OUT: [&str; 7] =
    ["odd-", "luxcore", "/fragments/", "/include/", "geometry.pbrt", "glass-upgraded.pbrt", "v3/glass.pbrt"];

fn scenes_below(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    let is_scene = |p: &Path| {
        let known = ["pbrt", "xml", "scn", "gltf", "glb"];
        let object = p.extension().is_some_and(|e| e == "obj") && p.to_string_lossy().contains("obj-lumen");
        object || p.extension().is_some_and(|e| known.contains(&&*e.to_string_lossy()))
    };
    let mut found = Vec::new();
    for path in entries {
        if path.is_dir() {
            found.extend(scenes_below(&path));
        } else if is_scene(&path) && LEFT_OUT.iter().all(|part| !path.to_string_lossy().contains(part)) {
            found.push(path);
        }
    }
    found
}

/// The reference of a scene: Mitsuba's lie beside it.
fn reference_of(scene: &Path) -> Option<RgbImage32> {
    let name = scene.to_string_lossy().into_owned();
    let listed = REFERENCES.iter().find(|(end, _)| name.ends_with(end)).and_then(|(_, picture)| shared(picture));
    let stem = scene.file_stem()?.to_string_lossy().into_owned();
    let test =
        ["_path", "_volpathmis", "_volpath", "_direct", "_ptracer"].iter().find_map(|end| stem.strip_suffix(end));
    let beside = test.map(|t| scene.with_file_name("refs").join(format!("{t}_ref_rgb.exr")));
    let documented = scene.parent()?.with_file_name("reference").join(format!("{stem}.jpg"));
    let all = listed.into_iter().chain(beside).chain([documented]);
    read_image(&all.into_iter().find(|p| p.exists())?).ok().map(|f| f.image)
}

/// The means of the pixels that each new pixel covers.
fn shrunk(image: &RgbImage32, width: u32, height: u32) -> RgbImage32 {
    let part = |i: u32, of: u32, all: u32| {
        let (a, b) = (f64::from(i * all) / f64::from(of), f64::from((i + 1) * all) / f64::from(of));
        (a.floor() as u32..b.ceil() as u32)
            .map(move |k| (k.min(all - 1), (f64::from(k + 1).min(b) - f64::from(k).max(a)) as f32))
    };
    let pixel = |i: u32| {
        let (mut sum, mut weight) = (Vec3::ZERO, 0.0);
        for (y, wy) in part(i / width, height, image.height) {
            for (x, wx) in part(i % width, width, image.width) {
                sum += Vec3::from(image.data[(y * image.width + x) as usize]) * (wx * wy);
                weight += wx * wy;
            }
        }
        (sum / weight).to_array()
    };
    RgbImage32 { width, height, data: (0..width * height).map(pixel).collect() }
}

struct Seen {
    picture: RgbImage32,
    /// Columns of the table behind the name.
    row: String,
}

fn see(path: &Path, width: u32) -> Result<Seen, String> {
    let start = Instant::now();
    let options = LoadOptions { stage: true, allow_outside: true, ..LoadOptions::default() };
    let loaded = load(&[path.to_owned()], &options).map_err(|e| e.to_string())?;
    let Loaded { mut builder, camera, defaults, hints, warnings, .. } = loaded;
    let aspect = camera.aspect.unwrap_or(defaults.width as f32 / defaults.height as f32);
    builder.camera(camera.build(aspect).map_err(|e| e.to_string())?);
    let scene = builder.build().map_err(|e| e.to_string())?;
    let (load_time, counts) = (start.elapsed().as_secs_f32(), scene.counts());
    let spec = FilmSpec { width, height: (width as f32 / aspect).round() as u32, filter: Filter::Box };
    let mut params = Params::default();
    hints.scatterings.iter().for_each(|n| params.set("scatterings", n.to_string()));
    let integrator = find("unified").unwrap().build(params).map_err(|e| e.to_string())?;
    let color = if scene.is_dispersive() { ColorMode::Spectral } else { ColorMode::Rgb };
    let settings = Settings { spec, seed: 1, color, budget: Budget { passes: None, time: Some(TIME) } };
    let film = render(&scene, &*integrator, &settings, |_, _| ControlFlow::Continue(()));
    let data: Vec<[f32; 3]> = film.mean().iter().map(Vec3::to_array).collect();
    let picture = RgbImage32 { width: spec.width, height: spec.height, data };
    let kinds: std::collections::BTreeSet<&str> = warnings.iter().map(|w| w.code).collect();
    let remarks = kinds.into_iter().collect::<Vec<_>>().join(", ");
    let (triangles, instances) = (counts.triangles, counts.instances);
    let row = format!("{load_time:.2} | {triangles} | {instances} | {} | {} | {remarks}", counts.lights, film.passes());
    Ok(Seen { picture, row })
}

/// Ratio of the means, and the relative squared error without the worst thousandth; both without lamps. A reference of eight
/// bits ends at 1.
fn judged(picture: &RgbImage32, reference: &RgbImage32) -> String {
    let mut picture = picture.clone();
    if reference.data.iter().flatten().all(|v| *v <= 1.0) {
        picture.data.iter_mut().flatten().for_each(|v| *v = v.min(1.0));
    }
    match compare(&picture, reference, &CompareOptions::default()) {
        Ok(c) => format!("{:.4} | {:.4}", c.means.ratio_grey, c.rel_mse_trimmed),
        Err(e) => format!("{e} | "),
    }
}

/// A picture as bright as suits it, on a square of grey.
fn tile(sheet: &mut RgbImage32, at: usize, picture: &RgbImage32, level: f32) {
    let (x0, y0) = ((at % SHEET[0]) as u32 * (WIDTH + 4), (at / SHEET[0]) as u32 * (WIDTH + 4));
    for (i, p) in (0..).zip(&picture.data) {
        let (x, y) = (x0 + i % picture.width, y0 + i / picture.width);
        if y < y0 + WIDTH && x < sheet.width && y < sheet.height {
            sheet.data[(y * sheet.width + x) as usize] = p.map(|v| v * level);
        }
    }
}

/// What brings three quarters of the pixels below 0.6.
fn level_of(picture: &RgbImage32) -> f32 {
    let mut grey: Vec<f32> = picture.data.iter().map(|p| p.iter().sum::<f32>() / 3.0).collect();
    grey.sort_by(f32::total_cmp);
    0.6 / grey[grey.len() * 3 / 4].max(1e-6)
}

#[test]
#[ignore = "takes minutes, and judges nothing"]
fn every_scene_loads_and_is_seen() {
    let Some(folder) = shared("scenes") else { return };
    let to = Path::new(env!("CARGO_TARGET_TMPDIR")).join("scenes");
    std::fs::create_dir_all(&to).unwrap();
    let blank = || RgbImage32::filled((WIDTH + 4) * SHEET[0] as u32, (WIDTH + 4) * SHEET[1] as u32, [0.2; 3]);
    let save = |name: &str, image: &RgbImage32| {
        write_image(&to.join(name), &ImageFile::from(image.clone()), Tone::Srgb).unwrap();
    };
    println!(
        "| number | scene | load, s | triangles | instances | lights | passes | kinds of warnings | mean ratio | relMSE |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let (mut sheet, mut at, mut sheets) = (blank(), 0, 0);
    for (number, path) in scenes_below(&folder).into_iter().enumerate() {
        let name = path.strip_prefix(&folder).unwrap().display();
        let reference = reference_of(&path);
        match see(&path, reference.as_ref().map_or(WIDTH, |r| r.width.min(WIDTH))) {
            Ok(Seen { picture, row }) => {
                let level = level_of(reference.as_ref().unwrap_or(&picture));
                let reference = reference.map(|r| shrunk(&r, picture.width, picture.height));
                let judged = reference.as_ref().map_or("| ".into(), |r| judged(&picture, r));
                println!("| {number} | {name} | {row} | {judged} |");
                save(&format!("{number:03}.exr"), &picture);
                for picture in [Some(picture), reference].iter().flatten() {
                    tile(&mut sheet, at, picture, level);
                    at += 1;
                }
            }
            Err(error) => println!("| {number} | {name} | {} |", error.lines().next().unwrap_or_default()),
        }
        if at + 2 > SHEET[0] * SHEET[1] {
            save(&format!("sheet-{sheets}.png"), &sheet);
            (sheet, at, sheets) = (blank(), 0, sheets + 1);
        }
    }
    save(&format!("sheet-{sheets}.png"), &sheet);
}
