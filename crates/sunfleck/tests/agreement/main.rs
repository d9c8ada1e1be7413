//! Do the algorithms agree? Each pair that applies to a tiny scene is compared block by block.
//!
//! A claim here is statistical: block means of two algorithms differ by less than [`LEVEL`] standard errors (of the spread
//! of passes) plus the small bias that density estimation is allowed, and the picture's mean by less than 0.3 %.
mod estimate;
mod scenes;
mod table;

use estimate::{Estimate, estimate};
use scenes::{SCENES, TinyScene};
use sunfleck::integrator::{Entry, REGISTRY};

/// Standard errors that a block may differ by. With about 5,000 comparisons, 5.5 is passed by chance once in several
/// thousand runs; seeds are fixed, so a run that passes always passes.
const LEVEL: f64 = 5.5;
/// Relative bias of a block that a shrinking kernel may still have, at edges and in corners.
const KERNEL_BIAS: f64 = 0.02;
/// Relative difference of the means of whole pictures, beyond their standard error.
const MEAN: f64 = 0.003;

/// Every algorithm of the registry that estimates light: a new one is tested in every scene.
fn estimators() -> impl Iterator<Item = &'static Entry> {
    // Ray casting is a formula.
    REGISTRY.iter().filter(|e| e.name != "raycast")
}

impl TinyScene {
    /// Whether `entry` finds all light of the scene.
    fn is_seen_by(&self, entry: &Entry) -> bool {
        !self.blind.contains(&entry.name)
    }
    /// Passes enough for `entry`: paths that meet lights by chance are cheap and noisy where light comes through glass.
    fn passes(&self, entry: &Entry) -> u64 {
        match entry.name {
            "path" | "bdpt" if !self.blind.is_empty() => 1600,
            "path" | "bdpt" | "light" => 400,
            _ if !entry.mergeable => 256,
            _ => 160,
        }
    }
}

/// How much of a difference an algorithm may have by itself: nothing if it merges nothing.
fn bias(name: &str) -> f64 {
    if matches!(name, "path" | "light" | "bdpt") { 0.0 } else { KERNEL_BIAS }
}

fn check(scene: &TinyScene, a: &Estimate, b: &Estimate) -> Result<(), String> {
    let allowed = bias(a.name).max(bias(b.name));
    let pair = format!("{}: {} against {}", scene.name, a.name, b.name);
    for (i, (x, y)) in a.blocks.iter().zip(&b.blocks).enumerate() {
        let error = (x.variance + y.variance).sqrt();
        let difference = (x.mean - y.mean).abs();
        if difference > LEVEL * error + allowed * y.mean.abs() {
            return Err(format!(
                "{pair}: block {i}: {} and {} differ by {:.1} standard errors",
                x.mean,
                y.mean,
                difference / error
            ));
        }
    }
    let (x, y) = (a.picture(), b.picture());
    let error = (x.variance + y.variance).sqrt();
    if (x.mean - y.mean).abs() > 3.0 * error + MEAN * y.mean {
        return Err(format!("{pair}: means {} and {}, {:.2} %", x.mean, y.mean, 100.0 * (x.mean / y.mean - 1.0)));
    }
    Ok(())
}

fn agree(scene: &TinyScene) {
    let world = (scene.build)();
    let seeing = estimators().filter(|e| scene.is_seen_by(e));
    let estimates: Vec<Estimate> = seeing.map(|e| estimate(&world, e, scene.passes(e))).collect();
    assert!(estimates[0].picture().mean > 0.0, "{}: a black picture proves nothing", scene.name);
    let mut failures = Vec::new();
    for (i, a) in estimates.iter().enumerate() {
        failures.extend(estimates[..i].iter().filter_map(|b| check(scene, a, b).err()));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// One test a scene, so that they run in parallel and are named in the report.
macro_rules! agreement {
    ($($test:ident),* $(,)?) => {
        $(#[test]
        fn $test() {
            agree(SCENES.iter().find(|s| s.name == stringify!($test)).expect("a scene of that name"));
        })*
        #[test]
        fn every_scene_has_its_test() {
            let tested = [$(stringify!($test)),*];
            for s in SCENES {
                assert!(tested.contains(&s.name), "{} is not tested", s.name);
            }
        }
    };
}

agreement![
    diffuse_room,
    bumped_normals,
    point_light,
    two_sided_light,
    caustic_of_a_glass_ball,
    point_light_through_glass,
    nested_glass,
    mirror_room,
    instance,
    thin_lens,
    parallel_rays,
    all_around,
    mesh_light,
    sphere_light,
    spot_light,
    directional_light,
    environment_light,
    rough_glass,
    rough_metal,
    haze,
    glossy_paint,
    textures,
    unlike_lights,
    an_eye_in_glass,
    moving_instance,
    moving_light,
    moving_camera,
    moving_thin_lens,
    dispersive_ball,
    dispersive_caustic,
    dispersive_rough_glass,
    coverings,
    mixed_mirror,
    layers,
    absorbing_ball,
    overlapping_balls,
    under_water,
    frosted_wine,
    filled_holes,
];
