//! `Camera`: perspective, parallel or all around; lenses made of glass are told by their focal length.

use super::directives::{Importer, bad, unknown, warning};
use super::lens::Barrel;
use super::params::{Found, Params};
use super::picture::Film;
use crate::load::{CameraSettings, Projection};
use glam::{DAffine3, DVec2, DVec3};
use sunfleck::camera::{Unrolling, View};

const CAMERAS: [&str; 5] = ["environment", "orthographic", "perspective", "realistic", "spherical"];

impl Importer<'_> {
    /// The camera of a `Camera` directive that stood where `camera_from_world` is the transformation.
    pub(super) fn camera_settings(
        &mut self,
        name: &str,
        params: &Params,
        camera_from_world: DAffine3,
    ) -> Found<CameraSettings> {
        let world_from_camera = camera_from_world.inverse();
        if !world_from_camera.is_finite() || world_from_camera.matrix3.determinant() == 0.0 {
            return Err(bad(&params.at, "pbrt::transform", "the camera is squeezed flat by its transformation"));
        }
        let film = self.picture.film;
        let settings = match name {
            "perspective" => film.look(world_from_camera, screen(params, film.size)?, Some(fov(params)?)),
            "orthographic" => film.look(world_from_camera, screen(params, film.size)?, None),
            "spherical" | "environment" => {
                let square = name == "spherical"
                    && params.word("mapping", "equalarea", &["equalarea", "equirectangular"])? == "equalarea";
                return Ok(all_around(world_from_camera, square));
            }
            "realistic" => {
                let barrel = self.barrel(params)?;
                return barrel.settings(params, &film, world_from_camera);
            }
            _ => return Err(unknown(&params.at, "camera", name, CAMERAS)),
        };
        let scale = world_from_camera.transform_vector3(DVec3::Z).length() as f32;
        let focus = params.number("focaldistance", 1e6)? as f32 * scale;
        let radius = params.number("lensradius", 0.0)? as f32 * scale;
        if radius < 0.0 || focus <= 0.0 {
            return Err(params.bad("pbrt::value", "the lens needs a radius of 0 or more and a focal distance above 0"));
        }
        Ok(focused(settings, 2.0 * radius, focus))
    }

    /// The lens file of a realistic camera.
    fn barrel(&mut self, params: &Params) -> Found<Barrel> {
        let message = "a camera with a barrel of lenses is shown as one thin lens of the same focal length";
        self.warn_once("pbrt::camera", "", || params.at.tell(warning("pbrt::camera", message), ""));
        let Some(param) = params.get("lensfile").cloned() else { return Ok(Barrel::default()) };
        let [name] = param.strings().unwrap_or_default() else { return Err(param.expected("one file name")) };
        let path = self.files.find(name, param.at.source.name());
        let text = self.files.read(&path).ok().map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        let barrel = text.as_deref().and_then(Barrel::read);
        if barrel.is_none() {
            let message = format!("the lenses of {} cannot be read: 50 mm are taken", path.display());
            self.warn_once("pbrt::lens", name, || param.at.tell(warning("pbrt::lens", message), ""));
        }
        Ok(barrel.unwrap_or_default())
    }
}

/// Gives a camera its lens. What is in focus is what it looks at, if there is such a thing.
pub(super) fn focused(settings: CameraSettings, aperture: f32, focus: f32) -> CameraSettings {
    let look_at = settings.view.position + (settings.view.look_at - settings.view.position) * focus.min(1e6);
    let view = if aperture > 0.0 && focus < 1e6 { View { look_at, ..settings.view } } else { settings.view };
    CameraSettings { aperture, focus_distance: focus, view, ..settings }
}

/// The angle that the shorter side of the picture spans, degrees.
fn fov(params: &Params) -> Found<f64> {
    let half = params.maybe_number("halffov")?.filter(|h| *h > 0.0);
    let fov = params.number("fov", 90.0)?;
    let fov = half.map_or(fov, |h| 2.0 * h);
    if fov > 0.0 && fov < 180.0 {
        return Ok(fov);
    }
    Err(params.bad("pbrt::value", "the field of view must be more than 0 and less than 180 degrees"))
}

/// The window of the picture: its shorter side spans -1 to 1. In perspective, at unit distance over tan(fov/2).
fn screen(params: &Params, size: [u32; 2]) -> Found<[DVec2; 2]> {
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let aspect = params.maybe_number("frameaspectratio")?.filter(|a| *a > 0.0).unwrap_or(aspect);
    if let Some(w) = params.numbers("screenwindow", 4)? {
        if w[0] < w[1] && w[2] < w[3] {
            return Ok([DVec2::new(w[0], w[2]), DVec2::new(w[1], w[3])]);
        }
        return Err(params.bad("pbrt::value", "`screenwindow` is empty"));
    }
    let corner = if aspect > 1.0 { DVec2::new(aspect, 1.0) } else { DVec2::new(1.0, 1.0 / aspect) };
    Ok([-corner, corner])
}

/// pbrt's longitudes run from its x axis over z; so the middle of the picture looks along -x, with z at its left.
fn all_around(world_from_camera: DAffine3, square: bool) -> CameraSettings {
    let m = world_from_camera.matrix3;
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(DVec3::normalize_or_zero);
    let position = world_from_camera.translation;
    let is_mirrored = x.dot(z.cross(y)) < 0.0;
    let (forward, unrolling, is_mirrored) =
        if square { (z, Unrolling::EqualArea, is_mirrored) } else { (-x, Unrolling::Equirectangular, !is_mirrored) };
    let view = View {
        position: position.as_vec3(),
        look_at: (position + forward).as_vec3(),
        up: y.normalize_or(DVec3::Y).as_vec3(),
    };
    let projection = Projection::Spherical(unrolling);
    CameraSettings {
        projection,
        view,
        is_mirrored,
        aspect: Some(1.0),
        focus_distance: 1.0,
        ..CameraSettings::default()
    }
}

impl Film {
    /// The camera that sees the window, or the part of it that is rendered: in perspective, over tan(fov/2) (degrees).
    pub(super) fn look(&self, world_from_camera: DAffine3, window: [DVec2; 2], fov: Option<f64>) -> CameraSettings {
        let [low, high] = self.cropped(window);
        let m = world_from_camera.matrix3;
        let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
        let position = world_from_camera.translation;
        let sizes = DVec2::new(x.length(), y.length());
        // Uneven scaling stretches the picture.
        let stretch = fov.map_or(sizes, |fov| sizes / z.length() * (fov.to_radians() * 0.5).tan());
        let (size, centre) = (((high - low) * stretch).as_vec2(), (0.5 * (high + low) * stretch).as_vec2());
        CameraSettings {
            projection: if fov.is_some() { Projection::Perspective } else { Projection::Orthographic(size.y) },
            view: View {
                position: position.as_vec3(),
                look_at: (position + z.normalize_or(DVec3::Z)).as_vec3(),
                up: y.normalize_or(DVec3::Y).as_vec3(),
            },
            fov: 2.0 * (0.5 * size.y).atan().to_degrees(),
            aspect: Some(size.x / size.y),
            shift: (centre / size.y).to_array(),
            // Looking along z with y up, a camera of ours has -x at its right.
            is_mirrored: x.dot(z.cross(y)) < 0.0,
            aperture: 0.0,
            focus_distance: 1.0,
        }
    }
}
