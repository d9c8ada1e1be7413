//! `sensor`, `film`, `rfilter`, `sampler` and `integrator`: what the file says about the picture.

use super::document::Found;
use super::filters::gaussian;
use super::props::Props;
use super::scene::Importer;
use crate::load::{CameraSettings, Hints, Projection};
use glam::{DVec2, DVec3};
use sunfleck::camera::View;
use sunfleck::film::Filter;

const SENSORS: [&str; 14] = [
    "batch",
    "distant",
    "fluencemeter",
    "irradiancemeter",
    "orthographic",
    "perspective",
    "perspective_rdist",
    "radiancemeter",
    "spherical",
    "telecentric",
    "thinlens",
    "vorthographic",
    "vperspective",
    "pinhole",
];
const FILMS: [&str; 7] = ["exrfilm", "hdrfilm", "ldrfilm", "mfilm", "pngfilm", "specfilm", "tiledhdrfilm"];

/// Sides of a picture in pixels.
const MAX_SIDE: i64 = 1 << 20;

/// Size, and the part of it that is rendered.
#[derive(Clone, Copy, Debug)]
struct Film {
    size: [u32; 2],
    /// First pixel of each axis, and how many.
    crop: [[u32; 2]; 2],
    filter: Filter,
}

impl Default for Film {
    fn default() -> Self {
        let filter = gaussian(0.5).unwrap_or_default();
        Self { size: [768, 576], crop: [[0, 768], [0, 576]], filter }
    }
}

impl<'d> Importer<'d, '_> {
    /// Hands the first sensor and the integrator to the target.
    pub(super) fn picture(&mut self) -> Found<()> {
        let mut hints = Hints::default();
        let first = |tag: &str| self.document.top.iter().copied().find(|n| self.document.elements[*n].tag == tag);
        let (sensor, integrator) = (first("sensor"), first("integrator"));
        if let Some(number) = sensor {
            let sensors = self.document.top.iter().filter(|n| self.document.elements[**n].tag == "sensor").count();
            let props = self.props(number);
            if sensors > 1 {
                self.warn_once("mitsuba::sensors", "", &props, "the scene has several sensors: this one is taken");
            }
            self.sensor(&props, &mut hints)?;
            self.tell_unused(&props);
        }
        if let Some(number) = integrator {
            self.integrator(number, &mut hints, 0)?;
        }
        self.target.hints = Some(hints);
        Ok(())
    }

    fn sensor(&mut self, props: &Props<'d>, hints: &mut Hints) -> Found<()> {
        let (name, at) = props.element.plugin()?;
        if !SENSORS.contains(&name) {
            return Err(at.unknown("sensor", name, SENSORS));
        }
        let film = match props.object("film")? {
            Some(number) => self.film(number)?,
            None => Film::default(),
        };
        let [width, height] = film.crop.map(|[_, count]| count);
        (hints.width, hints.height) = (Some(width), Some(height));
        hints.filter = Some(film.filter);
        if let Some(number) = props.object("sampler")? {
            let sampler = self.props(number);
            hints.passes = sampler.integer("sample_count", 1..=1_000_000_000)?.map(|n| n as u64);
        }
        props.ignore(&["near_clip", "far_clip", "shutter_open", "shutter_close", "srf", "name", "kc", "medium"]);
        drop(props.objects("medium")?);
        let kind = match name {
            "thinlens" => Kind::Lens,
            "orthographic" | "vorthographic" => Kind::Parallel,
            _ => Kind::Pinhole,
        };
        if kind == Kind::Pinhole && !matches!(name, "perspective" | "pinhole") {
            self.near(name, props, "a camera in perspective");
        }
        let settings = camera(props, &film, kind)?;
        self.target.camera = Some(settings);
        Ok(())
    }

    fn film(&mut self, number: usize) -> Found<Film> {
        let props = self.props(number);
        let (name, at) = props.element.plugin()?;
        if !FILMS.contains(&name) {
            return Err(at.unknown("film", name, FILMS));
        }
        let whole = Film::default().size;
        let side =
            |name, default: u32| -> Found<u32> { Ok(props.integer(name, 1..=MAX_SIDE)?.map_or(default, |n| n as u32)) };
        let size = [side("width", whole[0])?, side("height", whole[1])?];
        let mut crop = [[0, size[0]], [0, size[1]]];
        for (axis, names) in [["crop_offset_x", "crop_width"], ["crop_offset_y", "crop_height"]].into_iter().enumerate()
        {
            let from = props.integer(names[0], 0..=MAX_SIDE)?.map_or(0, |n| n as u32).min(size[axis] - 1);
            let count = side(names[1], size[axis] - from)?.min(size[axis] - from);
            crop[axis] = [from, count];
        }
        let filter = match props.object("rfilter")? {
            Some(number) => self.filter(number)?,
            None => gaussian(0.5).unwrap_or_default(),
        };
        // How the picture is stored is for the command line to say.
        props.ignore(&["filename", "file_format", "pixel_format", "component_format", "banner", "gamma", "exposure"]);
        props.ignore(&["attach_log", "high_quality_edges", "sample_border", "compensate", "tonemap_method", "key"]);
        props.ignore(&["burn", "digits", "variable", "crop_scale", "label", "size", "channel_names", "burst"]);
        self.tell_unused(&props);
        Ok(Film { size, crop, filter })
    }

    /// What the file wants to be rendered with: told of, and limits taken.
    fn integrator(&mut self, number: usize, hints: &mut Hints, depth: usize) -> Found<()> {
        let props = self.props(number);
        let (name, _) = props.element.plugin()?;
        if matches!(name, "moment" | "aov" | "adaptive" | "irrcache" | "multichannel" | "depth_aov")
            && depth < 8
            && let Some(inner) = props.object("integrator")?
        {
            return self.integrator(inner, hints, depth + 1);
        }
        hints.integrator = Some(name.to_owned());
        // Mitsuba counts the ways between surfaces, and the one to the eye.
        let limit = props.integer("max_depth", -1..=1_000_000_000)?.filter(|n| *n > 0);
        hints.scatterings = limit.map(|n| (n - 1).min(10_000) as u32);
        if name.starts_with("direct") {
            hints.scatterings = Some(1);
        }
        hints.photons = props.integer("photon_count", 1..=1 << 40)?.map(|n| n as u64);
        hints.radius = props.maybe_float("initial_radius")?.filter(|r| *r > 0.0);
        if props.boolean("hide_emitters", false)? {
            self.warn_once("mitsuba::hide", "", &props, "lights that this hides from the camera are shown");
        }
        Ok(())
    }
}

/// How a camera makes a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Pinhole,
    Lens,
    Parallel,
}

/// The camera. Mitsuba's looks along z with y up and x to the left, as ours does.
fn camera(props: &Props, film: &Film, kind: Kind) -> Found<CameraSettings> {
    let world_from_camera = props.transform("to_world")?;
    let m = world_from_camera.matrix3;
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis];
    if m.determinant() == 0.0 {
        return Err(props.bad("the camera is squeezed flat by its transformation"));
    }
    let aspect = f64::from(film.size[0]) / f64::from(film.size[1]);
    // Parallel rays leave a window from -1 to 1, whatever its distance.
    let width = if kind == Kind::Parallel { 2.0 } else { 2.0 * half_tangent(props, aspect)? };
    let whole = DVec2::new(width, width / aspect);
    let offset =
        DVec2::new(props.float("principal_point_offset_x", 0.0)?, props.float("principal_point_offset_y", 0.0)?);
    // The middle of the part that is rendered. Rows run downwards.
    let size = DVec2::new(f64::from(film.size[0]), f64::from(film.size[1]));
    let [from, count] = [0, 1].map(|i| DVec2::new(f64::from(film.crop[0][i]), f64::from(film.crop[1][i])));
    let middle = (from + 0.5 * count) / size - 0.5;
    // Uneven scaling stretches the picture.
    let unit = if kind == Kind::Parallel { 1.0 } else { z.length() };
    let stretch = DVec2::new(x.length(), y.length()) / unit;
    let centre = (middle * DVec2::new(1.0, -1.0) + offset) * whole * stretch;
    let part = whole * stretch * count / size;
    let position = world_from_camera.translation;
    let focus = props.float("focus_distance", 0.0)? * z.length();
    let has_lens = kind == Kind::Lens;
    let aperture = if has_lens { props.float("aperture_radius", 0.0)? * x.length() } else { 0.0 };
    if has_lens && (aperture < 0.0 || focus <= 0.0) {
        return Err(props.bad("a lens needs an `aperture_radius` of 0 or more and a `focus_distance` above 0"));
    }
    let ahead = if has_lens && aperture > 0.0 { focus } else { 1.0 };
    let height = part.y as f32;
    Ok(CameraSettings {
        projection: if kind == Kind::Parallel { Projection::Orthographic(height) } else { Projection::Perspective },
        view: View {
            position: position.as_vec3(),
            look_at: (position + ahead * z.normalize_or(DVec3::Z)).as_vec3(),
            up: y.normalize_or(DVec3::Y).as_vec3(),
        },
        fov: (2.0 * (0.5 * part.y).atan().to_degrees()) as f32,
        aspect: Some((part.x / part.y) as f32),
        shift: (centre / part.y).as_vec2().to_array(),
        is_mirrored: x.dot(z.cross(y)) > 0.0,
        aperture: 2.0 * aperture as f32,
        focus_distance: ahead as f32,
    })
}

/// Half of the picture's width at distance 1, by `fov` along `fov_axis`, or by `focal_length` of a lens for film of
/// 36 by 24 mm, whose diagonal it means.
pub(super) fn half_tangent(props: &Props, aspect: f64) -> Found<f64> {
    let per_diagonal = aspect / aspect.hypot(1.0);
    let axes = ["x", "y", "diagonal", "smaller", "larger"];
    let axis = props.word("fov_axis", "x", &axes)?;
    let length = props.string("focal_length")?;
    let Some(fov) = props.maybe_float("fov")? else {
        let text = length.map_or("50mm", |l| l.value.trim());
        let mm = text.trim_end_matches("mm").trim().parse::<f64>().ok().filter(|mm| *mm > 0.0);
        let wrong = || length.map_or(props.at(), |l| &l.at).bad("mitsuba::value", "a focal length is given as `50mm`");
        let mm = mm.ok_or_else(wrong)?;
        return Ok(0.5 * 36.0_f64.hypot(24.0) / mm * per_diagonal);
    };
    if fov <= 0.0 || fov >= 180.0 {
        return Err(props.bad("the field of view must be more than 0 and less than 180 degrees"));
    }
    let tangent = (0.5 * fov).to_radians().tan();
    Ok(match axis {
        "y" => tangent * aspect,
        "diagonal" => tangent * per_diagonal,
        "smaller" if aspect > 1.0 => tangent * aspect,
        "larger" if aspect < 1.0 => tangent * aspect,
        _ => tangent,
    })
}
