//! Pictures to write: checked before the work, written after it.
use super::explain::Pictures;
use crate::{args::OutputArgs, console, destination, failure::Failure};
use formats::diagnostic::Error as SceneError;
use formats::image::{ImageFile, ImageFormat, RgbImage32, Tone, write_image};
use glam::Vec3;
use serde::Serialize;
use std::path::PathBuf;
use sunfleck::film::Film;

/// Files to write, all of a kind that can be written into folders that can.
#[derive(Debug)]
pub(super) struct Outputs {
    files: Vec<(PathBuf, &'static ImageFormat)>,
    /// Curve for PNG values, if said.
    tone: Option<Tone>,
    /// What PNG values are multiplied by.
    scale: f32,
}

/// What became of a file.
#[derive(Debug, Serialize)]
pub(super) struct Written {
    pub(super) path: String,
    pub(super) format: &'static str,
    /// Why it was not written.
    pub(super) error: Option<String>,
}

impl Outputs {
    /// Finds what would go wrong later.
    pub(super) fn check(args: &OutputArgs, scenes: &[PathBuf]) -> Result<Self, Failure> {
        let paths = if args.outputs.is_empty() { vec![default_name(scenes)] } else { args.outputs.clone() };
        for (i, path) in paths.iter().enumerate() {
            if paths[..i].contains(path) {
                return Err(Failure::input(format!("{} would be written twice", path.display())));
            }
        }
        let with_format = |path: PathBuf| destination::check(&path).map(|format| (path, format));
        let files = paths.into_iter().map(with_format).collect::<Result<_, _>>()?;
        let outputs = Self { files, tone: args.tone.map(Tone::from), scale: args.exposure.exp2() };
        if !args.quiet {
            outputs.say_notes(args);
        }
        Ok(outputs)
    }

    fn say_notes(&self, args: &OutputArgs) {
        if args.outputs.is_empty() {
            console::say(format_args!("no -o given: the picture will be {}", self.names()));
        }
        let has_png = self.files.iter().any(|(_, format)| is_png(format));
        if !has_png && (args.exposure != 0.0 || args.tone.is_some()) {
            console::say("note: --exposure and --tone change PNG pictures only, and none will be written");
        }
    }

    /// All names in one line.
    pub(super) fn names(&self) -> String {
        self.files.iter().map(|(path, _)| path.display().to_string()).collect::<Vec<_>>().join(", ")
    }

    /// Writes every file, whatever becomes of the others; `tone` is the curve when none was said.
    pub(super) fn write(&self, film: &Film, tone: Tone, metadata: &[(String, String)]) -> Vec<Written> {
        let spec = film.spec();
        let data: Vec<[f32; 3]> = film.mean().iter().map(Vec3::to_array).collect();
        let linear = RgbImage32 { width: spec.width, height: spec.height, data };
        let file = ImageFile { image: linear, metadata: metadata.to_vec(), ..ImageFile::default() };
        self.files.iter().map(|output| self.write_one(output, &file, self.tone.unwrap_or(tone))).collect()
    }

    /// Writes each sampler beside the first file: as layers where a file can have them, else as files of its kind.
    pub(super) fn write_apart(&self, apart: &Pictures, tone: Tone, metadata: &[(String, String)]) -> Vec<Written> {
        let Some((path, format)) = self.files.first() else { return Vec::new() };
        let tone = self.tone.unwrap_or(tone);
        let beside = |name: &str| {
            let extension = path.extension().map(|e| e.to_string_lossy().into_owned()).unwrap_or_default();
            (path.with_extension(format!("{name}.{extension}")), *format)
        };
        if format.extensions.contains(&"exr") {
            let (image, layers) = (apart.sum.clone(), apart.layers.clone());
            let file = ImageFile { image, layers, metadata: metadata.to_vec(), ..ImageFile::default() };
            return vec![self.write_one(&beside("explain"), &file, tone)];
        }
        let one = |(name, image): &(String, RgbImage32)| {
            self.write_one(&beside(&format!("explain-{name}")), &image.clone().into(), tone)
        };
        apart.layers.iter().map(one).collect()
    }

    fn write_one(&self, (path, format): &(PathBuf, &'static ImageFormat), linear: &ImageFile, tone: Tone) -> Written {
        let error = if is_png(format) && self.scale != 1.0 {
            let mut file = linear.clone();
            file.image.data.iter_mut().flatten().for_each(|v| *v *= self.scale);
            write_image(path, &file, tone).err()
        } else {
            write_image(path, linear, tone).err()
        };
        let reason = |e: SceneError| e.errors.iter().map(|d| d.message.as_str()).collect::<Vec<_>>().join("; ");
        Written { path: path.display().to_string(), format: format.name, error: error.map(reason) }
    }
}

/// Fails if a file was not written, and names each.
pub(super) fn failures(written: Vec<Written>) -> Result<(), Failure> {
    let told = |w: Written| w.error.map(|e| format!("{}: {e}", w.path));
    let failures: Vec<String> = written.into_iter().filter_map(told).collect();
    if failures.is_empty() { Ok(()) } else { Err(Failure::Work(anyhow::Error::msg(failures.join("\n")))) }
}

/// PNG is the only format that is toned.
fn is_png(format: &ImageFormat) -> bool {
    format.extensions.contains(&"png")
}

fn default_name(scenes: &[PathBuf]) -> PathBuf {
    let stem = scenes.first().and_then(|s| s.file_stem()).unwrap_or("picture".as_ref());
    let mut name = stem.to_owned();
    name.push(".png");
    name.into()
}
