//! The front door: from paths to a scene that can be built, whatever the formats.
//!
//! Several files become one scene, as when they are imported into NRenderer one after the other. To add a format, write
//! its reader, and add one line to [`SCENE_FORMATS`].

mod camera;
mod hash;
mod stage;
mod target;
#[cfg(test)]
mod tests;

pub use camera::{CameraSettings, Hints, Projection, RenderDefaults};
pub use target::Target;

use crate::diagnostic::{Diagnostic, Error, Severity};
use crate::image::Tone;
use crate::scn::ScnOptions;
use hash::InputHash;
use std::path::{Path, PathBuf};
use sunfleck::film::Filter;
use sunfleck::scene::{MaterialId, SceneBuilder};

/// How scene files are read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// For NRenderer's scenes.
    pub scn: ScnOptions,
    /// Whether a file may include others from outside of its folder.
    pub allow_outside: bool,
    /// Whether missing files, and what breaks the rules of a format, are errors even where a picture can be made.
    pub strict: bool,
    /// Values for the names that a scene leaves open, as (name, value).
    pub defines: Vec<(String, String)>,
    /// Whether a mesh that comes without light or an eye gets them, and a floor if it has neither.
    pub stage: bool,
}

/// A scene that was read, and what its files say or imply about the picture.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// What the files say about how to render them.
    pub hints: Hints,
    /// The scene, without a camera.
    pub builder: SceneBuilder,
    /// The camera of the files, or the default of their format.
    pub camera: CameraSettings,
    /// Where the camera goes while the shutter is open, if it moves.
    pub camera_to: Option<CameraSettings>,
    /// What the files call their materials; a name may stand for several.
    pub materials: Vec<(String, MaterialId)>,
    /// Picture size and the like.
    pub defaults: RenderDefaults,
    /// What was odd.
    pub warnings: Vec<Diagnostic>,
    /// A hash of the bytes of all files read and of the options: equal hashes mean equal scenes. 32 hexadecimal digits.
    pub hash: String,
    /// Number of surfaces added.
    pub surfaces: usize,
    /// Number of lights added, emitting surfaces included.
    pub lights: usize,
}

/// Adds the content of one file to a scene. Errors go to the target's sink.
pub type LoadFn = fn(&Path, &LoadOptions, &mut Target) -> Result<(), Error>;

/// A format of scene files.
#[derive(Clone, Copy, Debug)]
pub struct SceneFormat {
    /// Its usual name.
    pub name: &'static str,
    /// Ends of file names behind a dot, in lower case.
    pub extensions: &'static [&'static str],
    /// One line for lists.
    pub about: &'static str,
    /// Whether it is for things only, which usually have neither light nor camera.
    pub is_mesh: bool,
    /// Reads it.
    pub load: LoadFn,
}

/// All formats of scene files.
pub const SCENE_FORMATS: &[SceneFormat] = &[
    crate::scn::FORMAT,
    crate::obj::FORMAT,
    crate::ply::FORMAT,
    crate::pbrt::FORMAT,
    crate::mitsuba::FORMAT,
    crate::gltf::FORMAT,
];

/// Reads one or several files into one scene.
///
/// # Errors
/// All errors of all files: missing files (with near names), formats that are not known (with those that are), and
/// mistakes inside of them with their places.
pub fn load(paths: &[PathBuf], options: &LoadOptions) -> Result<Loaded, Error> {
    let mut target = Target::new();
    let mut failed: Option<Error> = None;
    for path in paths {
        let result = format_of(path).and_then(|format| (format.load)(path, options, &mut target));
        let (result, warnings) = (result.and_then(|()| target.sink.finish(())), target.sink.take_warnings());
        target.warnings.extend(warnings);
        if let Err(error) = result {
            let all = failed.get_or_insert(Error { errors: Vec::new(), warnings: Vec::new() });
            all.errors.extend(error.errors);
            target.warnings.extend(error.warnings);
        }
    }
    if paths.is_empty() {
        failed = Some(Diagnostic::error("load::nothing", "no scene file is given").into());
    }
    if options.strict {
        let (missing, other) = target.warnings.into_iter().partition::<Vec<_>, _>(|w| is_missing(w.code));
        target.warnings = other;
        if !missing.is_empty() {
            let all = failed.get_or_insert(Error { errors: Vec::new(), warnings: Vec::new() });
            all.errors.extend(missing.into_iter().map(|w| Diagnostic { severity: Severity::Error, ..w }));
        }
    }
    if let Some(error) = failed {
        return Err(Error { warnings: target.warnings, ..error });
    }
    let things_only = paths.iter().all(|path| format_of(path).is_ok_and(|f| f.is_mesh));
    if options.stage && things_only {
        stage::set(&mut target);
    }
    warn_of_darkness(&mut target);
    let compat = options.scn.compat;
    let ours = RenderDefaults::default();
    let hints = target.hints.unwrap_or_default();
    Ok(Loaded {
        builder: target.builder,
        camera: target.camera.unwrap_or_default(),
        camera_to: target.camera_to,
        materials: target.names,
        defaults: RenderDefaults {
            filter: if compat { Filter::NRenderer } else { hints.filter.unwrap_or_default() },
            tone: if compat { Tone::SquareRoot } else { Tone::Srgb },
            width: hints.width.unwrap_or(ours.width),
            height: hints.height.unwrap_or(ours.height),
        },
        hints,
        warnings: target.warnings,
        hash: target.hash.finish(options),
        surfaces: target.surfaces,
        lights: target.lights,
    })
}

/// Whether a warning is about a file that is missing or cannot be read, and for which something else stands.
pub fn is_missing(code: &str) -> bool {
    const WHAT: [&str; 5] = ["missing-picture", "missing-texture", "missing-mesh", "missing-library", "missing-file"];
    matches!(code, "mtl::texture" | "gltf::picture") || code.split("::").nth(1).is_some_and(|what| WHAT.contains(&what))
}

fn format_of(path: &Path) -> Result<&'static SceneFormat, Error> {
    let name = path.file_name().map(|n| n.to_string_lossy().to_lowercase()).unwrap_or_default();
    let ends_in = |e: &&str| name.strip_suffix(*e).is_some_and(|stem| stem.ends_with('.'));
    if let Some(format) = SCENE_FORMATS.iter().find(|f| f.extensions.iter().any(&ends_in)) {
        return Ok(format);
    }
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    let message = match extension.as_str() {
        "" => "a file name without an extension does not tell the format".to_owned(),
        _ => format!("scene files of the format `{extension}` are not supported"),
    };
    let known = SCENE_FORMATS.iter().flat_map(|f| f.extensions.iter().copied());
    let error = Diagnostic::error("load::unknown-format", message).in_file(path.display().to_string());
    Err(error.one_of(&extension, known).into())
}

/// A scene may be loaded for other reasons than to see it, so this is no error.
fn warn_of_darkness(target: &mut Target) {
    if target.surfaces == 0 {
        let warning = Diagnostic::warning("load::no-surface", "there is no surface in this scene");
        target.warnings.push(warning.help("the picture will be empty"));
    }
    if target.lights == 0 {
        let warning = Diagnostic::warning("load::no-light", "there is no light in this scene");
        target.warnings.push(warning.help("the picture will be black"));
    }
}
