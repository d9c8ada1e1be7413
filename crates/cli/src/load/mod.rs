//! From scene files and the flags that change them to a scene that can be rendered.
mod eye;
mod record;

pub(crate) use eye::Eye;
pub(crate) use record::{SceneRecord, Warning};

use crate::{
    args::{CameraArgs, Compat, SceneArgs},
    console,
    failure::Failure,
};
use formats::diagnostic::Diagnostic;
use formats::image::read_image;
use formats::load::{Hints, LoadOptions, RenderDefaults};
use formats::scn::ScnOptions;
use glam::{Mat3, Vec3};
use std::path::Path;
use sunfleck::{
    light::{EnvironmentLight, Sides},
    scene::Scene,
    texture::{ImageTexture, Wrap},
};

/// A scene and all that came with it.
pub(crate) struct Loaded {
    pub(crate) scene: Scene,
    pub(crate) eye: Eye,
    /// What the files, or their format, say about the picture.
    pub(crate) defaults: RenderDefaults,
    /// What the files say about how to render them.
    pub(crate) hints: Hints,
    /// Names the content of all files.
    pub(crate) hash: String,
    warnings: Vec<Diagnostic>,
}

/// Reads the files into one scene, adds the surroundings, and opens the eye.
///
/// With `stage`, a mesh alone gets a floor, a sky and an eye, unless the flags light it.
pub(crate) fn scene(
    args: &SceneArgs,
    camera: &CameraArgs,
    compat: Option<Compat>,
    stage: bool,
) -> Result<Loaded, Failure> {
    let scn = ScnOptions {
        compat: compat == Some(Compat::Nrenderer),
        area_light_sides: args.area_lights.map(Sides::from),
        comma: None,
    };
    let stage = stage && compat.is_none() && args.env.is_none() && args.ambient.is_none();
    let read = formats::load(&args.files, &LoadOptions { scn, allow_outside: args.allow_outside, stage })?;
    let mut builder = read.builder;
    let surroundings = surroundings(args)?;
    let lit = surroundings.is_some();
    if let Some(light) = surroundings {
        builder.light(light);
    }
    let eye = Eye::new(camera, &read.camera, compat);
    builder.camera(eye.open()?);
    let scene = builder.build().map_err(|e| Failure::BadInput(e.into()))?;
    // The files know nothing of the flags that light the scene.
    let outdated = |w: &Diagnostic| lit && w.code == "load::no-light";
    let warnings = read.warnings.into_iter().filter(|w| !outdated(w)).collect();
    Ok(Loaded { scene, eye, defaults: read.defaults, hints: read.hints, hash: read.hash, warnings })
}

fn surroundings(args: &SceneArgs) -> Result<Option<EnvironmentLight>, Failure> {
    match (&args.env, args.ambient) {
        (Some(path), _) => panorama(path).map(Some),
        (None, Some(radiance)) if radiance != Vec3::ZERO => Ok(Some(EnvironmentLight::constant(radiance))),
        (None, _) => Ok(None),
    }
}

fn panorama(path: &Path) -> Result<EnvironmentLight, Failure> {
    let image = read_image(path)?.image;
    let pixels = image.data.into_iter().map(Vec3::from_array).collect();
    let bad = |why: &str| Failure::input(format!("{} cannot surround the scene: {why}", path.display()));
    let texture = ImageTexture::new(image.width as usize, image.height as usize, pixels, Wrap::Repeat);
    let texture = texture.ok_or_else(|| bad("it is empty"))?;
    EnvironmentLight::panorama(texture, Vec3::ONE, Mat3::IDENTITY).map_err(|e| bad(&e.to_string()))
}

impl Loaded {
    /// What was odd about the files.
    pub(crate) fn warnings(&self) -> impl Iterator<Item = Warning> + '_ {
        self.warnings.iter().map(Warning::from)
    }
    /// Tells a person what was odd.
    pub(crate) fn say_warnings(&self) {
        let colour = console::has_colour();
        self.warnings.iter().for_each(|w| console::say(format_args!("{}\n", w.render(colour))));
    }
}
