//! A folder with a small scene in it, and the program run there.
use formats::image::{ImageFile, RgbImage32, Tone, read_image, write_image};
use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A glass ball over a floor, under a lamp.
pub(crate) const SCENE: &str = "\
Begin Material
Material White
Prop diffuseColor RGB 0.7 0.6 0.5
Material Glass 2
Prop ior Float 1.5
End
Begin Model
Model Room
Plane Floor White
N 0 1 0
P -2 -1 -1
U 0 0 4
V 4 0 0
Sphere Ball Glass
P 0 0 1
R 0.5
End
Begin Light
Area Lamp
IRV 10 9 8
P -0.5 2 0.5
U 1 0 0
V 0 0 1
End
";

/// The folder; gone when dropped.
pub(crate) struct Workplace(TempDir);

impl Workplace {
    /// With `ball.scn` in it.
    pub(crate) fn new() -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        place.write("ball.scn", SCENE);
        place
    }
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
    pub(crate) fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), text).unwrap();
    }
    /// The program, ready to run in the folder; `args` are separated by blanks.
    pub(crate) fn command(&self, args: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sunfleck"));
        command.current_dir(self.0.path()).args(args.split_whitespace()).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }
    pub(crate) fn run(&self, args: &str) -> Ran {
        self.command(args).output().unwrap().into()
    }
    pub(crate) fn image(&self, name: &str) -> ImageFile {
        read_image(&self.path(name)).unwrap()
    }
    /// Writes a picture of one colour, with some pixels of another.
    pub(crate) fn paint(&self, name: &str, colour: [f32; 3], others: &[(usize, [f32; 3])]) {
        let mut image = RgbImage32::filled(32, 32, colour);
        others.iter().for_each(|&(at, c)| image.data[at] = c);
        write_image(&self.path(name), &image.into(), Tone::Srgb).unwrap();
    }
    pub(crate) fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

/// What a run left behind.
pub(crate) struct Ran {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl From<Output> for Ran {
    fn from(o: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Self { code: o.status.code(), out: text(o.stdout), err: text(o.stderr) }
    }
}

impl Ran {
    /// Its standard output as JSON, one value a line; fails unless the run succeeded.
    pub(crate) fn json(&self) -> Vec<Value> {
        assert_eq!(self.code, Some(0), "{}", self.err);
        self.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }
}
