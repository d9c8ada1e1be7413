//! A place for things that come alone: a mesh without lights is put under a sky, one without a camera before an eye, and one
//! with neither on a floor, too.

use super::{CameraSettings, Target};
use crate::diagnostic::Diagnostic;
use glam::{Mat3, Vec3};
use sunfleck::bsdf::DiffuseMaterial;
use sunfleck::camera::View;
use sunfleck::light::{DirectionalLight, EnvironmentLight};
use sunfleck::shape::{Parallelogram, Shape};
use sunfleck::texture::{ImageTexture, Wrap};

/// From the thing to the eye: from the front, a little from the right and from above. y is up, as in most meshes.
const TO_EYE: Vec3 = Vec3::new(0.5, 0.4, 1.0);
/// Vertical field of view in degrees.
const FOV: f32 = 30.0;
/// Side of the floor over the size of the thing.
const FLOOR: f32 = 60.0;
/// Where the sun's light goes.
const SUN: Vec3 = Vec3::new(0.55, -1.0, -0.35);

/// Adds what is missing around what is there: an eye; sky and sun; and a floor, if there was neither.
pub(super) fn set(target: &mut Target) {
    let (is_lit, is_seen) = (target.lights > target.glowing, target.camera.is_some());
    let Some((low, high)) = target.bounds() else { return };
    let what = match (is_lit, is_seen) {
        (true, true) => return,
        (true, false) => "the file has no camera: one that fits is added",
        (false, true) => "the file has no light: a sky and a sun are added",
        (false, false) => "the file has a mesh and nothing else: a floor, a sky and an eye are added",
    };
    if !is_lit && !is_seen {
        floor(target, low, high);
    }
    if !is_lit {
        if let Some(sun) = DirectionalLight::new(SUN, Vec3::new(2.2, 2.0, 1.7)) {
            target.light(sun);
        }
        if let Some(sky) = sky() {
            target.light(sky);
        }
    }
    if !is_seen {
        target.camera = Some(eye(low, high));
    }
    let note = Diagnostic::warning("load::alone", what);
    let help = "--env or --ambient light it otherwise, and then nothing is added";
    target.warnings.push(if is_lit { note } else { note.help(help) });
}

fn floor(target: &mut Target, low: Vec3, high: Vec3) {
    let (centre, size) = (0.5 * (low + high), (high - low).length());
    let side = FLOOR * size;
    // A little below, so that flat things do not share its plane.
    let corner = Vec3::new(centre.x - 0.5 * side, low.y - 1e-4 * size, centre.z - 0.5 * side);
    let reflectance = target.builder().constant(Vec3::splat(0.5));
    let matt = target.builder().material(DiffuseMaterial { reflectance });
    target.surface(Shape::Parallelogram(Parallelogram::new(corner, side * Vec3::Z, side * Vec3::X)), matt, None);
}

fn eye(low: Vec3, high: Vec3) -> CameraSettings {
    let (centre, size) = (0.5 * (low + high), (high - low).length());
    let distance = 0.55 * size / (0.5 * FOV).to_radians().sin();
    let view = View { position: centre + distance * TO_EYE.normalize(), look_at: centre, up: Vec3::Y };
    CameraSettings { view, fov: FOV, focus_distance: distance, ..CameraSettings::default() }
}

/// Blue above, white at the horizon, dim below.
fn sky() -> Option<EnvironmentLight> {
    const ROWS: usize = 64;
    let colour = |row: usize| {
        // 1 straight up, -1 straight down.
        let height = (std::f32::consts::PI * (row as f32 + 0.5) / ROWS as f32).cos();
        let (zenith, horizon, ground) =
            (Vec3::new(0.25, 0.42, 0.85), Vec3::new(0.9, 0.95, 1.0), Vec3::new(0.25, 0.24, 0.23));
        if height > 0.0 { horizon.lerp(zenith, height.powf(0.5)) } else { ground }
    };
    let pixels = (0..ROWS).flat_map(|row| [colour(row); 2]).collect();
    let image = ImageTexture::new(2, ROWS, pixels, Wrap::Clamp)?;
    EnvironmentLight::panorama(image, Vec3::splat(0.8), Mat3::IDENTITY).ok()
}

#[cfg(test)]
mod tests {
    use crate::load::{LoadOptions, load};

    #[test]
    fn a_mesh_alone_is_lit_stands_on_a_floor_and_fills_the_picture() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        std::fs::write(&path, "v 10 20 30\nv 12 20 30\nv 11 22 30\nf 1 2 3\n").unwrap();
        let options = LoadOptions { stage: true, ..LoadOptions::default() };
        let loaded = load(std::slice::from_ref(&path), &options).unwrap();
        assert_eq!((loaded.surfaces, loaded.lights), (2, 2));
        let (view, fov) = (loaded.camera.view, loaded.camera.fov);
        assert_eq!(view.look_at, glam::Vec3::new(11.0, 21.0, 30.0));
        // The ball around the thing fits into the picture's height, and takes most of it.
        let radius = 0.5 * 8.0_f32.sqrt();
        let seen = (radius / view.position.distance(view.look_at)).asin().to_degrees() * 2.0;
        assert!(seen < fov && seen > 0.8 * fov, "{seen} of {fov}");
        // A mesh that shines is no thing alone.
        std::fs::write(folder.path().join("m.mtl"), "newmtl l\nKe 1 1 1\n").unwrap();
        std::fs::write(&path, "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl l\nf 1 2 3\n").unwrap();
        let loaded = load(&[path], &options).unwrap();
        assert_eq!((loaded.surfaces, loaded.lights), (1, 1));
    }
}
