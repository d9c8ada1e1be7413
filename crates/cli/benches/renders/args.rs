//! What can be said.
use anyhow::{Context, anyhow, ensure};
use clap::{Args as Group, Parser, Subcommand};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Where pictures and generated scenes go.
pub(crate) const SCRATCH: &str = "target/renders";

/// Scenes measured unless others are named.
const OWN: [&str; 4] = ["scenes/cornell.scn", "scenes/cornell-glass.scn", "scenes/sds.scn", "scenes/far-glass.scn"];

#[derive(Parser)]
#[command(about = "Measures whole renders and prints a table")]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
    /// Append the table to this file, such as benches/runs/renders.md
    #[arg(long, value_name = "FILE", global = true)]
    pub(crate) record: Option<PathBuf>,
    /// A line of text above the table
    #[arg(long, global = true)]
    pub(crate) note: Option<String>,
    /// Said by `cargo bench`
    #[arg(long, hide = true, global = true)]
    bench: bool,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Integrators, and other renderers, at equal times
    Compare(Compare),
    /// The same render on more and more threads
    Threads(Threads),
    /// More and more light paths in one pass
    Photons(Photons),
    /// Larger and larger meshes
    Triangles(Triangles),
    /// Larger and larger pictures
    Pixels(Pixels),
    /// From the start of the process to that of the first pass
    Start(Start),
}

#[derive(Group)]
pub(crate) struct Picture {
    /// Width of the picture
    #[arg(long, value_name = "N", default_value_t = 256)]
    pub(crate) width: u32,
    /// Height of the picture [default: the width]
    #[arg(long, value_name = "N")]
    height: Option<u32>,
    /// A setting of the integrator, as for `sunfleck render`
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) settings: Vec<String>,
}

impl Picture {
    pub(crate) fn size(&self) -> (u32, u32) {
        (self.width, self.height.unwrap_or(self.width))
    }
}

#[derive(Group)]
pub(crate) struct Compare {
    /// Scenes, each perhaps with `=` and its reference [default: four of scenes/]
    #[arg(value_name = "SCENE[=REFERENCE]")]
    scenes: Vec<String>,
    /// Integrators
    #[arg(long, value_delimiter = ',', default_value = "unified,vcm,ppm,path")]
    pub(crate) integrators: Vec<String>,
    /// Times to render for
    #[arg(long, value_delimiter = ',', default_value = "2s,8s", value_parser = humantime::parse_duration)]
    pub(crate) times: Vec<Duration>,
    /// Threads
    #[arg(long, value_delimiter = ',', default_value = "2")]
    pub(crate) threads: Vec<usize>,
    #[command(flatten)]
    pub(crate) picture: Picture,
    /// Render a reference for this long where none is named and none is left from before
    #[arg(long, value_name = "TIME", value_parser = humantime::parse_duration)]
    pub(crate) reference_time: Option<Duration>,
    /// Integrator for that
    #[arg(long, value_name = "NAME", default_value = "vcm")]
    pub(crate) reference_integrator: String,
    /// Another renderer: its name, `=`, and its command line with {scene}, {stem} (scene without extension), {out} or
    /// {out.EXT}, {seconds}, {threads}, {width}, {height}; may be repeated
    #[arg(long = "other", value_name = "NAME=COMMAND")]
    pub(crate) others: Vec<String>,
}

impl Compare {
    /// Scenes and their references.
    pub(crate) fn scenes(&self) -> Vec<(PathBuf, Option<PathBuf>)> {
        if self.scenes.is_empty() {
            return OWN.into_iter().map(|s| (s.into(), None)).collect();
        }
        let one = |s: &String| match s.split_once('=') {
            Some((scene, reference)) => (scene.into(), Some(reference.into())),
            None => (s.into(), None),
        };
        self.scenes.iter().map(one).collect()
    }
}

#[derive(Group)]
pub(crate) struct Threads {
    /// Scene
    #[arg(default_value = "scenes/cornell-glass.scn")]
    pub(crate) scene: PathBuf,
    /// Integrators
    #[arg(long, value_delimiter = ',', default_value = "path,ppm,sppm,vcm,unified,photonmap")]
    pub(crate) integrators: Vec<String>,
    /// Threads; the first is what others are held against. More than the machine has show what contention costs
    #[arg(long = "threads", value_name = "THREADS", value_delimiter = ',', default_value = "1,2,16")]
    pub(crate) counts: Vec<usize>,
    /// Passes of each render
    #[arg(long, default_value_t = 8)]
    pub(crate) passes: u64,
    /// Rounds; the fastest of each counts
    #[arg(long, default_value_t = 2)]
    pub(crate) rounds: u32,
    #[command(flatten)]
    pub(crate) picture: Picture,
}

#[derive(Group)]
pub(crate) struct Photons {
    /// Scene
    #[arg(default_value = "scenes/cornell-glass.scn")]
    pub(crate) scene: PathBuf,
    /// Integrators
    #[arg(long, value_delimiter = ',', default_value = "ppm")]
    pub(crate) integrators: Vec<String>,
    /// Light paths a pass
    #[arg(long, value_delimiter = ',', default_value = "1e3,1e4,1e5,1e6,1e7", value_parser = count)]
    pub(crate) counts: Vec<u64>,
    #[command(flatten)]
    pub(crate) picture: Picture,
}

#[derive(Group)]
pub(crate) struct Triangles {
    /// Triangles, about
    #[arg(long, value_delimiter = ',', default_value = "1e3,1e4,1e5,1e6,1e7", value_parser = count)]
    pub(crate) counts: Vec<u64>,
    /// Kind of mesh file: ply or obj
    #[arg(long, default_value = "ply")]
    pub(crate) mesh: String,
    #[command(flatten)]
    pub(crate) picture: Picture,
}

#[derive(Group)]
pub(crate) struct Pixels {
    /// Scene
    #[arg(default_value = "scenes/cornell-glass.scn")]
    pub(crate) scene: PathBuf,
    /// Integrators
    #[arg(long, value_delimiter = ',', default_value = "path,ppm,unified")]
    pub(crate) integrators: Vec<String>,
    /// Sizes
    #[arg(long, value_delimiter = ',', default_value = "256x256,512x512,1024x1024,2048x2048,3840x2160,7680x4320",
        value_parser = size)]
    pub(crate) sizes: Vec<(u32, u32)>,
    /// A setting of the integrator, as for `sunfleck render`
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) settings: Vec<String>,
}

#[derive(Group)]
pub(crate) struct Start {
    /// Scenes [default: four of scenes/]
    #[arg(value_name = "SCENE", default_values = OWN)]
    pub(crate) scenes: Vec<PathBuf>,
    /// Integrators
    #[arg(long, value_delimiter = ',', default_value = "raycast,path,light,bdpt,photonmap,ppm,sppm,vcm,unified")]
    pub(crate) integrators: Vec<String>,
    /// Starts, of which the median counts
    #[arg(long, default_value_t = 7)]
    pub(crate) rounds: usize,
    #[command(flatten)]
    pub(crate) picture: Picture,
}

/// `1e6` or `1000000`.
fn count(text: &str) -> anyhow::Result<u64> {
    let n: f64 = text.parse().context("not a number")?;
    ensure!((1.0..=1e12).contains(&n), "not a number from 1 to 1e12");
    Ok(n as u64)
}

/// `WIDTHxHEIGHT`.
fn size(text: &str) -> anyhow::Result<(u32, u32)> {
    let (w, h) = text.split_once('x').ok_or_else(|| anyhow!("not WIDTHxHEIGHT"))?;
    Ok((w.parse()?, h.parse()?))
}

/// The name of a file without folder and extension.
pub(crate) fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}
