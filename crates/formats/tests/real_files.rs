//! Files that other people made: each gives a scene or picture, or a clear error. Skipped where they are not at hand.

mod shared;

use formats::image::read_image;
use formats::pbrt::write::{Written, write};
use formats::scn::ScnOptions;
use formats::{Diagnostic, Error, LoadOptions, Loaded, load};
use shared::shared;
use std::path::{Path, PathBuf};
use sunfleck::film::{FilmSpec, Filter, PassImage};
use sunfleck::integrator::{Params, Pass, find};

/// All files below a folder, in order.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files.extend(files_below(&path));
        } else {
            files.push(path);
        }
    }
    files
}

fn has_extension(path: &Path, extensions: &[&str]) -> bool {
    path.extension().is_some_and(|e| extensions.contains(&e.to_string_lossy().to_lowercase().as_str()))
}

fn load_one(path: &Path, compat: bool) -> Result<Loaded, Error> {
    load(
        &[path.to_owned()],
        &LoadOptions {
            scn: ScnOptions { compat, ..ScnOptions::default() },
            allow_outside: true,
            ..LoadOptions::default()
        },
    )
}

fn print(path: &Path, warnings: &[Diagnostic]) {
    println!("{}", path.display());
    for warning in warnings {
        println!("    {}: {}", warning.code, warning.message);
    }
}

#[test]
fn every_nrenderer_scene_loads_and_builds() {
    let Some(folder) = shared("scenes/nrenderer") else { return };
    let scenes: Vec<PathBuf> = files_below(&folder).into_iter().filter(|p| has_extension(p, &["scn", "obj"])).collect();
    assert!(scenes.len() >= 22, "{} scenes", scenes.len());
    for path in scenes {
        for compat in [false, true] {
            let loaded = load_one(&path, compat).unwrap_or_else(|e| panic!("{}:\n{e}", path.display()));
            if !compat {
                print(&path, &loaded.warnings);
            }
            loaded.builder.build().unwrap_or_else(|e| panic!("{}:\n{e}", path.display()));
        }
    }
}

#[test]
fn the_stock_cornell_box_holds_what_its_file_says() {
    let Some(folder) = shared("scenes/nrenderer") else { return };
    let loaded = load_one(&folder.join("stock/path_tracing_cornel.scn"), false).unwrap();
    let codes: Vec<&str> = loaded.warnings.iter().map(|w| w.code).collect();
    assert_eq!(codes, ["scn::comma"]);
    let counts = loaded.builder.build().unwrap().counts();
    // 5 walls, a sphere, 6 planes of the box, the pyramid, the light.
    assert_eq!((counts.surfaces, counts.spheres, counts.lights, counts.materials), (14, 1, 1, 4));
}

#[test]
fn odd_meshes_give_a_scene_or_a_clear_error() {
    let Some(folder) = shared("scenes/odd-obj-ply") else { return };
    for path in files_below(&folder) {
        match load_one(&path, false) {
            Ok(loaded) => {
                print(&path, &loaded.warnings);
                // A glTF file may be empty.
                assert!(loaded.surfaces > 0 || !has_extension(&path, &["obj", "ply"]));
                loaded.builder.build().unwrap();
            }
            Err(error) => {
                println!("{}\n{error}", path.display());
                let place = error.errors[0].place.as_ref().unwrap();
                assert!(place.file.contains(&*path.file_stem().unwrap().to_string_lossy()));
                let is_mesh = has_extension(&path, &["obj", "ply"]);
                assert!(is_mesh || error.to_string().contains("known: scn, obj"), "{error}");
            }
        }
    }
}

#[test]
fn every_pbrt_scene_loads_and_builds() {
    let Some(folder) = shared("scenes") else { return };
    let scenes = files_below(&folder).into_iter().filter(|p| has_extension(p, &["pbrt"]));
    // Parts of other scenes are none by themselves.
    let whole = scenes.filter(|p| !p.ends_with("geometry.pbrt"));
    for path in whole {
        let loaded = load_one(&path, false).unwrap_or_else(|e| panic!("{}:\n{e}", path.display()));
        print(&path, &loaded.warnings);
        loaded.builder.build().unwrap_or_else(|e| panic!("{}:\n{e}", path.display()));
    }
}

#[test]
fn meshes_beside_other_scenes_load_too() {
    let Some(folder) = shared("scenes") else { return };
    let is_odd = |p: &Path| p.components().any(|c| c.as_os_str() == "odd-obj-ply");
    let files = files_below(&folder).into_iter().filter(|p| !is_odd(p));
    for path in files.filter(|p| has_extension(p, &["obj", "ply"])) {
        if let Err(error) = load_one(&path, false) {
            assert!(error.errors[0].place.is_some(), "{}:\n{error}", path.display());
            println!("{error}");
        }
    }
}

#[test]
fn pictures_of_other_programs_can_be_read() {
    let Some(folder) = shared("references") else { return };
    let folders = [folder, shared("scenes").unwrap()];
    let pictures = folders.iter().flat_map(|f| files_below(f));
    for path in pictures.filter(|p| has_extension(p, &["exr", "hdr", "pfm"])) {
        match read_image(&path) {
            Ok(file) => {
                let (sum, count) = file
                    .image
                    .data
                    .iter()
                    .flatten()
                    .filter(|x| x.is_finite())
                    .fold((0.0, 0_usize), |(sum, count), x| (sum + f64::from(*x), count + 1));
                let layers: Vec<&str> = file.layers.iter().map(|(name, _)| name.as_str()).collect();
                let size = (file.image.width, file.image.height);
                println!("{} {size:?} mean {:.4} {layers:?}", path.display(), sum / count as f64);
            }
            Err(error) => println!("{error}"),
        }
    }
}

#[test]
fn the_reference_of_the_cornell_box_has_its_known_mean() {
    let Some(folder) = shared("references/nrenderer") else { return };
    let file = read_image(&folder.join("path_tracing_cornel_inf_box.exr")).unwrap();
    let image = &file.image;
    assert_eq!((image.width, image.height), (500, 500));
    let pixels = image.data.len() as f64;
    let mean = [0, 1, 2].map(|c| image.data.iter().map(|p| f64::from(p[c])).sum::<f64>() / pixels);
    for (mean, known) in mean.into_iter().zip([0.7344, 0.5312, 0.3647]) {
        assert!((mean - known).abs() < 2e-4, "{mean} {known}");
    }
    // The back wall is bright, the lamp is near the upper edge: rows run downwards.
    assert!(image.data[..500 * 60].iter().any(|p| p[0] > 40.0));
}

/// What is written as pbrt text is read back as it was: the same counts, and for scenes of moderate size the same picture.
#[test]
fn every_scene_can_be_written_as_pbrt_and_read_back() {
    let Some(folder) = shared("scenes") else { return };
    let is_scene =
        |p: &PathBuf| has_extension(p, &["pbrt", "scn", "xml", "gltf", "glb"]) && !p.ends_with("geometry.pbrt");
    let small =
        |p: &PathBuf| !["fractal", "machines", "luxcore", "odd-"].iter().any(|big| p.to_string_lossy().contains(big));
    for path in files_below(&folder).into_iter().filter(is_scene).filter(small) {
        // Parts of other scenes are none by themselves.
        let Ok(first) = load_one(&path, false) else { continue };
        let place = tempfile::tempdir().unwrap();
        let to = place.path().join("written.pbrt");
        let report = write(&to, &Written::from(&first)).unwrap();
        let second = load_one(&to, false).unwrap_or_else(|e| panic!("{}:\n{e}", path.display()));
        println!("{}: {report:?}", path.display());
        assert_eq!((first.surfaces, first.lights), (second.surfaces, second.lights), "{}", path.display());
        for (i, [x, difference, error]) in compared(&passes(first), &passes(second)).into_iter().enumerate() {
            let allowed = 5e-3 * x.max(1e-4) + 3.0 * error;
            assert!(difference.abs() <= allowed, "{}, quarter {i}: {x}, off by {difference}", path.display());
        }
    }
}

/// For each quarter the mean over the passes, by how much the other differs, and the standard error of that.
fn compared(a: &[[f32; 4]], b: &[[f32; 4]]) -> [[f32; 3]; 4] {
    let n = a.len() as f32;
    [0, 1, 2, 3].map(|q| {
        let differences: Vec<f32> = a.iter().zip(b).map(|(a, b)| b[q] - a[q]).collect();
        let mean = differences.iter().sum::<f32>() / n;
        let variance = differences.iter().map(|d| (d - mean).powi(2)).sum::<f32>() / (n - 1.0);
        [a.iter().map(|a| a[q]).sum::<f32>() / n, mean, (variance / n).sqrt()]
    })
}

/// Sums over the quarters of a small picture, pass by pass.
fn passes(loaded: Loaded) -> Vec<[f32; 4]> {
    const SIDE: u32 = 24;
    let mut builder = loaded.builder;
    builder.camera(loaded.camera.build(loaded.camera.aspect.unwrap_or(1.0)).unwrap());
    let scene = builder.build().unwrap();
    let spec = FilmSpec { width: SIDE, height: SIDE, filter: Filter::Box };
    let integrator = find("path").unwrap().build(Params::default()).unwrap();
    let prepared = integrator.prepare(&scene, spec, 7);
    let mut image = PassImage::new(spec);
    let one = |index| {
        image.clear();
        prepared.render_pass(&Pass::new(7, index), &mut image);
        let mut sums = [0.0; 4];
        for (i, p) in (0..).zip(image.pixels()) {
            sums[((i / SIDE * 2 / SIDE) * 2 + i % SIDE * 2 / SIDE) as usize] += p.element_sum();
        }
        sums
    };
    (0..8).map(one).collect()
}
