//! Whole renders, measured from outside: each is a program of its own, ours and others alike, so that time, processor time
//! and peak memory mean the same for all.
//!
//! ```text
//! cargo bench -p sunfleck-cli --bench renders -- compare --times 2s,10s --reference-time 60s
//! cargo bench -p sunfleck-cli --bench renders -- compare a.pbrt=a.exr --other "peer=peer {stem}.xml -o {out} -t {seconds}"
//! cargo bench -p sunfleck-cli --bench renders -- threads|photons|triangles|pixels|start
//! ```
//!
//! Each command prints a table in Markdown; `--record FILE` appends it to a file, with commit and processor. Paths are
//! relative to the root of the repository. `--help` tells the rest.

mod args;
mod child;
mod compare;
mod other;
mod ours;
mod scale;
mod start;
mod table;
mod triangles;

use args::{Args, Command};
use clap::Parser;
use std::path::Path;

fn main() -> anyhow::Result<()> {
    let args = Args::parse();
    std::env::set_current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))?;
    std::fs::create_dir_all(args::SCRATCH)?;
    let table = match &args.command {
        Command::Compare(what) => compare::run(what)?,
        Command::Threads(what) => scale::threads(what)?,
        Command::Photons(what) => scale::photons(what)?,
        Command::Triangles(what) => scale::triangles(what)?,
        Command::Pixels(what) => scale::pixels(what)?,
        Command::Start(what) => start::run(what)?,
    };
    table.tell(args.note.as_deref(), args.record.as_deref())
}
