//! From scene files and the flags that change them to a scene that can be rendered.
mod change;
mod eye;
mod inventory;
mod record;

pub(crate) use change::{projection, replacement};
pub(crate) use eye::Eye;
pub(crate) use inventory::Inventory;
pub(crate) use record::{SceneRecord, Warning};

use crate::{
    args::{CameraArgs, Compat, SceneArgs},
    console,
    failure::Failure,
};
use formats::diagnostic::Diagnostic;
use formats::image::read_image;
use formats::load::{Hints, LoadOptions, RenderDefaults, is_missing};
use formats::scn::ScnOptions;
use glam::{Mat3, Vec3};
use std::path::Path;
use sunfleck::{
    light::{EnvironmentLight, Sides},
    scene::{MaterialId, Scene, SceneBuilder},
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
    /// What it is made of.
    pub(crate) inventory: Inventory,
    warnings: Vec<Diagnostic>,
}

/// The same before it is built.
pub(crate) struct Opened {
    pub(crate) builder: SceneBuilder,
    pub(crate) eye: Eye,
    /// Where the eye goes while the shutter is open, if it moves.
    pub(crate) eye_to: Option<Eye>,
    pub(crate) defaults: RenderDefaults,
    pub(crate) hints: Hints,
    pub(crate) hash: String,
    /// What files call the materials.
    pub(crate) names: Vec<(String, MaterialId)>,
    warnings: Vec<Diagnostic>,
}

/// Reads the files into one scene, adds the surroundings and what else was asked for, and opens the eye.
///
/// With `stage`, a mesh alone gets a floor, a sky and an eye, unless the flags light it.
pub(crate) fn open(
    args: &SceneArgs,
    camera: &CameraArgs,
    compat: Option<Compat>,
    stage: bool,
) -> Result<Opened, Failure> {
    let scn = ScnOptions {
        compat: compat == Some(Compat::Nrenderer),
        area_light_sides: args.area_lights.map(Sides::from),
        comma: None,
    };
    let stage = stage && compat.is_none() && args.env.is_none() && args.ambient.is_none() && args.lights.is_empty();
    let options = LoadOptions {
        scn,
        allow_outside: args.allow_outside,
        strict: args.strict,
        defines: args.defines.clone(),
        stage,
    };
    let mut read = formats::load(&args.files, &options)?;
    let surroundings = surroundings(args)?;
    let lit = surroundings.is_some() || !args.lights.is_empty();
    if let Some(light) = surroundings {
        read.builder.light(light);
    }
    change::apply(&mut read, &args.materials, &args.lights)?;
    let eye = Eye::new(camera, &read.camera, compat);
    let eye_to = read.camera_to.filter(|_| !camera.is_placed()).map(|to| Eye::new(camera, &to, compat));
    // The files know nothing of the flags that light the scene.
    let outdated = |w: &Diagnostic| lit && w.code == "load::no-light";
    Ok(Opened {
        builder: read.builder,
        eye,
        eye_to,
        defaults: read.defaults,
        hints: read.hints,
        hash: read.hash,
        names: read.materials,
        warnings: read.warnings.into_iter().filter(|w| !outdated(w)).collect(),
    })
}

/// [`open`], ready to be rendered.
pub(crate) fn scene(
    args: &SceneArgs,
    camera: &CameraArgs,
    compat: Option<Compat>,
    stage: bool,
) -> Result<Loaded, Failure> {
    let Opened { mut builder, eye, eye_to, defaults, hints, hash, names, warnings } =
        open(args, camera, compat, stage)?;
    match eye_to {
        Some(to) => builder.camera_moving(eye.open()?, to.open()?),
        None => builder.camera(eye.open()?),
    }
    let inventory = Inventory::new(&builder.parts(), &names);
    let scene = builder.build().map_err(|e| Failure::BadInput(e.into()))?;
    Ok(Loaded { scene, eye, defaults, hints, hash, inventory, warnings })
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
    /// What is missing: textures, meshes and other files for which something else stands.
    pub(crate) fn missing(&self) -> impl Iterator<Item = &str> {
        self.warnings.iter().filter(|w| is_missing(w.code)).map(|w| w.message.as_str())
    }
    /// Tells a person what was odd.
    pub(crate) fn say_warnings(&self) {
        say(&self.warnings);
    }
}

impl Opened {
    /// Tells a person what was odd.
    pub(crate) fn say_warnings(&self) {
        say(&self.warnings);
    }
}

fn say(warnings: &[Diagnostic]) {
    let colour = console::has_colour();
    warnings.iter().for_each(|w| console::say(format_args!("{}\n", w.render(colour))));
}
