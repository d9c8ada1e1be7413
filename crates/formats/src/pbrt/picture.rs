//! `Camera`, `Film`, `PixelFilter`, `Sampler` and `Integrator`: what the file says about the picture.

use super::directives::{Importer, unknown, warning};
use super::filters;
use super::params::{Found, Params};
use super::sensor::white_balance;
use crate::lines::shortened;
use crate::load::Hints;
use glam::{DAffine3, DVec2, Mat3, Vec3};
use std::ops::RangeInclusive;

const FILMS: [&str; 4] = ["gbuffer", "image", "rgb", "spectral"];

/// pbrt's `maxdepth` of every integrator.
const DEFAULT_DEPTH: u32 = 5;

/// Sides of a picture in pixels.
const SIDES: RangeInclusive<i64> = 1..=1 << 20;

/// What was said so far; of directives given twice, the last one counts.
pub(super) struct Picture {
    pub(super) camera: Option<(String, Params, [DAffine3; 2])>,
    pub(super) sampler: Option<Params>,
    pub(super) filter: Option<(String, Params)>,
    pub(super) integrator: Option<(String, Params)>,
    /// Whether the file is of version 3, which has other units of light.
    pub(super) is_version_3: bool,
    pub(super) film: Film,
}

/// Size and sensitivity.
#[derive(Clone, Copy)]
pub(super) struct Film {
    /// Pixels of the whole picture, cropped or not.
    pub(super) size: [u32; 2],
    /// The part that is rendered: first and last pixel of each axis.
    crop: [[u32; 2]; 2],
    /// What pixel values are multiplied by.
    scale: f32,
    /// Millimetres from corner to corner.
    pub(super) diagonal: f64,
    /// What takes the colours of light to those that the sensor's white balance makes of them.
    balance: Option<Mat3>,
}

impl Default for Picture {
    fn default() -> Self {
        let film = Film { size: [1280, 720], crop: [[0, 1280], [0, 720]], scale: 1.0, diagonal: 35.0, balance: None };
        Self { camera: None, sampler: None, filter: None, integrator: None, is_version_3: false, film }
    }
}

impl Picture {
    /// What all light is multiplied by so that pixel values are those of pbrt's film.
    pub(super) fn exposure(&self) -> f32 {
        let shutter = |(_, params, _): &(String, Params, [DAffine3; 2])| {
            let open = params.number("shutteropen", 0.0).ok()?;
            let close = params.number("shutterclose", 1.0).ok()?;
            (close > open).then_some((close - open) as f32)
        };
        let time = if self.is_version_3 { None } else { self.camera.as_ref().and_then(shutter) };
        self.film.scale * time.unwrap_or(1.0)
    }
}

impl Film {
    /// A colour of light as the film sees it.
    pub(super) fn balanced(&self, light: Vec3) -> Option<Vec3> {
        self.balance.map(|m| (m * light).max(Vec3::ZERO))
    }
}

impl Importer<'_> {
    pub(super) fn film(&mut self, name: &str, params: &Params) -> Found<()> {
        if !FILMS.contains(&name) {
            return Err(unknown(&params.at, "film", name, FILMS));
        }
        self.picture.is_version_3 = name == "image";
        let default = if name == "image" { [640, 480] } else { [1280, 720] };
        let side =
            |name, default: u32| -> Found<u32> { Ok(params.integer(name, SIDES)?.map_or(default, |n| n as u32)) };
        let size = [side("xresolution", default[0])?, side("yresolution", default[1])?];
        let crop = crop(params, size)?;
        let scale = params.number("scale", 1.0)? * params.number("iso", 100.0)? / 100.0;
        let scale = scale * params.number("exposuretime", 1.0)?;
        if scale <= 0.0 {
            return Err(params.bad("pbrt::value", "the film's `scale` and `iso` must be greater than 0"));
        }
        let balance = self.balance(params)?;
        let diagonal = params.number("diagonal", 35.0)?;
        self.picture.film = Film { size, crop, scale: scale as f32, diagonal, balance };
        params.ignore(&["filename", "savefp16", "maxcomponentvalue", "maxsampleluminance", "coordinatesystem"]);
        params.ignore(&["nbuckets", "lambdamin", "lambdamax"]);
        self.tell_unused(params);
        Ok(())
    }

    /// The white balance of the sensor: what it takes for white becomes white. As in pbrt, the standard observer does none
    /// unless it is asked to, and cameras are balanced for 6500 K.
    fn balance(&mut self, params: &Params) -> Found<Option<Mat3>> {
        let sensor = params.string("sensor")?.unwrap_or("cie1931").to_owned();
        let asked = params.number("whitebalance", 0.0)?;
        if sensor != "cie1931" {
            let message = format!("the sensor `{}` is taken as one that sees as people do", shortened(&sensor));
            self.warn_once("pbrt::sensor", "", || params.at.tell(warning("pbrt::sensor", message), ""));
        }
        let kelvin = if sensor != "cie1931" && asked == 0.0 { 6500.0 } else { asked };
        Ok((kelvin > 0.0).then(|| white_balance(kelvin)))
    }

    /// Hands everything to the target.
    pub(super) fn finish_picture(&mut self) -> Found<()> {
        let Film { crop, .. } = self.picture.film;
        let [width, height] = crop.map(|[from, to]| to - from);
        let camera = self.picture.camera.take();
        let hints = self.hints(width, height)?;
        self.target.hints = Some(hints);
        let Some((name, params, camera_from_world)) = camera else {
            let window = [DVec2::splat(-1.0), DVec2::splat(1.0)];
            self.target.camera = Some(self.picture.film.look(DAffine3::IDENTITY, window, Some(90.0)));
            return Ok(());
        };
        let [open, close] = camera_from_world;
        let settings = self.camera_settings(&name, &params, open)?;
        self.target.camera = Some(settings);
        if open != close {
            self.target.camera_to = Some(self.camera_settings(&name, &params, close)?);
        }
        params.ignore(&["shutteropen", "shutterclose", "lensfile", "aperturediameter", "filmdiag", "mapping"]);
        self.tell_unused(&params);
        Ok(())
    }

    /// How the file wants to be rendered.
    fn hints(&mut self, width: u32, height: u32) -> Found<Hints> {
        let mut hints = Hints { width: Some(width), height: Some(height), ..Hints::default() };
        hints.filter = Some(match self.picture.filter.take() {
            Some((name, params)) => self.filter(&name, &params)?,
            None => filters::unsaid(self.picture.is_version_3),
        });
        if let Some(params) = self.picture.sampler.take() {
            hints.passes = params.integer("pixelsamples", 1..=1_000_000_000)?.map(|n| n as u64);
            if let (Some(x), Some(y)) =
                (params.integer("xsamples", 1..=10_000)?, params.integer("ysamples", 1..=10_000)?)
            {
                hints.passes = Some((x * y) as u64);
            }
        }
        // What pbrt does when the file says nothing.
        hints.scatterings = Some(DEFAULT_DEPTH);
        if let Some((name, params)) = self.picture.integrator.take() {
            let depth = params.integer("maxdepth", 0..=10_000_000)?.map_or(DEFAULT_DEPTH, |n| n.min(5_000) as u32);
            // Photons and camera paths are counted on their own there.
            hints.scatterings = Some(if name == "sppm" { 2 * depth } else { depth });
            hints.photons = params.integer("photonsperiteration", -1..=1 << 40)?.filter(|n| *n > 0).map(|n| n as u64);
            if let Some(n) = params.integer("numiterations", 1..=1_000_000_000)? {
                hints.passes = Some(n as u64);
            }
            hints.radius = params.maybe_number("radius")?.filter(|r| *r > 0.0);
            hints.integrator = Some(name);
        }
        Ok(hints)
    }
}

impl Film {
    /// The part of a window that is rendered. Rows run downwards, the window's y upwards.
    pub(super) fn cropped(&self, window: [DVec2; 2]) -> [DVec2; 2] {
        let part = |axis: usize, pixel: u32| f64::from(pixel) / f64::from(self.size[axis]);
        let [[x0, x1], [y0, y1]] = self.crop;
        let span = window[1] - window[0];
        let low = window[0] + span * DVec2::new(part(0, x0), 1.0 - part(1, y1));
        let high = window[0] + span * DVec2::new(part(0, x1), 1.0 - part(1, y0));
        [low, high]
    }
}

/// The part of the picture that is rendered, in pixels.
fn crop(params: &Params, size: [u32; 2]) -> Found<[[u32; 2]; 2]> {
    let whole = [[0, size[0]], [0, size[1]]];
    let (pixels, share) = (params.numbers("pixelbounds", 4)?, params.numbers("cropwindow", 4)?);
    let part = match (pixels, share) {
        (Some(p), _) => [[p[0], p[1]], [p[2], p[3]]],
        (None, Some(c)) => {
            // In the precision of pbrt, whose roundings decide which pixel is the first.
            let pixel = |share: f64, axis: usize| f64::from((share as f32 * size[axis] as f32).ceil());
            [[pixel(c[0], 0), pixel(c[1], 0)], [pixel(c[2], 1), pixel(c[3], 1)]]
        }
        (None, None) => return Ok(whole),
    };
    let mut crop = whole;
    for axis in 0..2 {
        let [from, to] = part[axis].map(|p| p.clamp(0.0, f64::from(size[axis])) as u32);
        if from >= to {
            return Err(params.bad("pbrt::value", "the part of the picture to render is empty"));
        }
        crop[axis] = [from, to];
    }
    Ok(crop)
}
