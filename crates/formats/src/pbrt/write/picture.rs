//! The camera, the film, and how to render.

use super::Writer;
use super::text::{float, matrix, numbers, param, string};
use crate::load::{CameraSettings, Projection};
use glam::{Affine3A, Mat3, Vec2, Vec3};
use std::fmt::Write;
use sunfleck::camera::Unrolling;
use sunfleck::film::{Curve, Filter};

impl Writer<'_> {
    pub(super) fn picture(&mut self) {
        let scene = self.scene;
        match scene.camera_to {
            None => self.view(scene.camera),
            Some(to) => {
                self.line("ActiveTransform StartTime");
                self.view(scene.camera);
                self.line("ActiveTransform EndTime");
                self.view(to);
                self.line("ActiveTransform All");
            }
        }
        let camera = camera(scene.camera, scene.size);
        self.line(&camera);
        let [width, height] = scene.size;
        let film = param("integer", "xresolution", &width.to_string())
            + &param("integer", "yresolution", &height.to_string())
            + &string("filename", "sunfleck.exr");
        self.line(&format!("Film \"rgb\"{film}"));
        let filter = filter(scene.hints.filter.unwrap_or_default());
        self.line(&filter);
        if let Some(passes) = scene.hints.passes {
            self.line(&format!("Sampler \"halton\"{}", param("integer", "pixelsamples", &passes.to_string())));
        }
        let depth = scene.hints.scatterings.unwrap_or(64);
        self.line(&format!("Integrator \"volpath\"{}", param("integer", "maxdepth", &depth.to_string())));
    }

    /// The transformation before the camera.
    fn view(&mut self, c: &CameraSettings) {
        let v = c.view;
        if let Projection::Spherical(Unrolling::Equirectangular) = c.projection {
            let line = format!("Transform {}", matrix(&longitudes(c).inverse()));
            return self.line(&line);
        }
        // Looking along z with y up, pbrt has x at its right, and a camera of ours at its left.
        let mut line = String::from(if c.is_mirrored { "" } else { "Scale -1 1 1 " });
        let all = [v.position, v.look_at, upright(c)].map(|p| numbers(p.to_array()));
        let _ = write!(line, "LookAt {}", all.join("  "));
        self.line(&line);
    }
}

/// What points up, never along the line of sight.
fn upright(c: &CameraSettings) -> Vec3 {
    let forward = (c.view.look_at - c.view.position).normalize_or(Vec3::Z);
    // As the camera itself has it: right = forward × up.
    let right = forward.cross(c.view.up).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
    if forward.cross(c.view.up).length_squared() > 1e-12 { c.view.up } else { right.cross(forward) }
}

/// World from camera of a spherical one: pbrt's longitudes run from x over z, so the middle of the picture is at −x.
fn longitudes(c: &CameraSettings) -> Affine3A {
    let x = -(c.view.look_at - c.view.position).normalize_or(Vec3::Z);
    let up = upright(c);
    let y = (up - x * x.dot(up)).normalize_or(Vec3::Y);
    let z = x.cross(y) * if c.is_mirrored { -1.0 } else { 1.0 };
    Affine3A::from_mat3_translation(Mat3::from_cols(x, y, z), c.view.position)
}

/// Filters without a curve are no file's.
fn filter(filter: Filter) -> String {
    let (curve, radius) = filter.shape().unwrap_or((Curve::Box, Vec2::splat(0.5)));
    let (name, settings) = match curve {
        Curve::Box => ("box", String::new()),
        Curve::Tent => ("triangle", String::new()),
        Curve::Gaussian { sigma } => ("gaussian", float("sigma", sigma)),
        Curve::Cubic { b, c } => ("mitchell", float("B", b) + &float("C", c)),
        Curve::Lanczos { tau } => ("sinc", float("tau", tau)),
    };
    format!("PixelFilter \"{name}\"{}{}{settings}", float("xradius", radius.x), float("yradius", radius.y))
}

fn camera(c: &CameraSettings, size: [u32; 2]) -> String {
    let square = size[0] as f32 / size[1] as f32;
    let aspect = c.aspect.unwrap_or(1.0);
    let lens = if c.aperture > 0.0 {
        float("lensradius", 0.5 * c.aperture) + &float("focaldistance", c.focus_distance)
    } else {
        String::new()
    };
    // In heights of the picture: the window, to the right and up.
    let window = |height: f32| {
        let [x, y] = c.shift.map(|s| s * height);
        let (w, h) = (0.5 * height * aspect, 0.5 * height);
        param("float", "screenwindow", &numbers([x - w, x + w, y - h, y + h]))
    };
    match c.projection {
        Projection::Perspective if c.shift == [0.0; 2] && (aspect / square - 1.0).abs() < 1e-6 => {
            let half = (0.5 * c.fov.to_radians()).tan() * aspect.min(1.0);
            format!("Camera \"perspective\"{}{lens}", float("fov", 2.0 * half.atan().to_degrees()))
        }
        Projection::Perspective => {
            let height = 2.0 * (0.5 * c.fov.to_radians()).tan();
            format!("Camera \"perspective\"{}{}{lens}", float("fov", 90.0), window(height))
        }
        Projection::Orthographic(height) => format!("Camera \"orthographic\"{}{lens}", window(height)),
        Projection::Spherical(Unrolling::Equirectangular) => {
            format!("Camera \"spherical\"{}", string("mapping", "equirectangular"))
        }
        Projection::Spherical(Unrolling::EqualArea) => {
            format!("Camera \"spherical\"{}", string("mapping", "equalarea"))
        }
    }
}
