//! Scenes to pbrt 4: text, with meshes as PLY and pictures as EXR in a folder beside it.
//!
//! What pbrt has no words for is written twice: as pbrt's nearest, and behind `#sunfleck`, a comment to pbrt, as what it is;
//! our own reader takes the latter. So others open the file, and we read back the same scene.
//!
//! `text` forms numbers and parameters, `files` keeps what lies beside the text until all is written; textures,
//! materials, lights, shapes and the picture have a file each.

mod files;
mod lights;
mod materials;
mod media;
mod mitsubas;
mod picture;
mod ply;
mod shapes;
#[cfg(test)]
mod tests;
mod text;
mod textures;

use crate::Error;
use crate::load::{CameraSettings, Hints, Loaded};
use files::Files;
use std::collections::{BTreeSet, HashMap};
use std::fmt::Write;
use std::path::Path;
use sunfleck::scene::{MaterialId, Parts, TextureId};

/// A scene to be written.
#[derive(Clone, Copy, Debug)]
pub struct Written<'s> {
    /// Geometry, materials, lights.
    pub parts: Parts<'s>,
    /// The eye.
    pub camera: &'s CameraSettings,
    /// Where it goes while the shutter is open, if it moves.
    pub camera_to: Option<&'s CameraSettings>,
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// How the scene wants to be rendered.
    pub hints: &'s Hints,
    /// What files call the materials.
    pub names: &'s [(String, MaterialId)],
}

impl<'s> From<&'s Loaded> for Written<'s> {
    fn from(loaded: &'s Loaded) -> Self {
        Self {
            parts: loaded.builder.parts(),
            camera: &loaded.camera,
            camera_to: loaded.camera_to.as_ref(),
            size: [loaded.defaults.width, loaded.defaults.height],
            hints: &loaded.hints,
            names: &loaded.materials,
        }
    }
}

/// What became of a scene.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Files beside the text.
    pub files: usize,
    /// What neither pbrt nor we read back as it was, in one line each.
    pub notes: Vec<String>,
}

/// Writes `scene` to the file `path`, and meshes and pictures to a folder beside it: everything or nothing.
///
/// # Errors
/// A file that cannot be written.
pub fn write(path: &Path, scene: &Written) -> Result<Report, Error> {
    let mut writer = Writer::new(path, scene)?;
    writer.all()?;
    let Writer { text, files, notes, .. } = writer;
    let count = files.commit(&text)?;
    Ok(Report { files: count, notes: notes.into_iter().collect() })
}

/// A texture as colours or as numbers, and where it is looked up.
type TextureKey = (TextureId, bool, ([u32; 6], bool));

/// The text in the making.
struct Writer<'s> {
    scene: &'s Written<'s>,
    text: String,
    files: Files,
    notes: BTreeSet<String>,
    textures: HashMap<TextureKey, String>,
    /// By material; what is nothing has none.
    materials: HashMap<MaterialId, String>,
}

impl<'s> Writer<'s> {
    fn new(path: &Path, scene: &'s Written<'s>) -> Result<Self, Error> {
        Ok(Self {
            scene,
            text: String::new(),
            files: Files::beside(path)?,
            notes: BTreeSet::new(),
            textures: HashMap::new(),
            materials: HashMap::new(),
        })
    }

    fn all(&mut self) -> Result<(), Error> {
        self.line("# Written by sunfleck; lines behind #sunfleck say what pbrt has no words for.");
        self.picture();
        self.line("\nWorldBegin\n");
        self.lights()?;
        self.materials()?;
        self.media();
        self.shapes()
    }

    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Notes something that is lost.
    fn note(&mut self, what: &str) {
        self.notes.insert(what.to_owned());
    }

    /// A fresh name for a texture.
    fn texture_name(&mut self) -> String {
        let mut name = String::from("t");
        let _ = write!(name, "{}", self.textures.len());
        name
    }
}
