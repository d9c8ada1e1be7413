//! `sunfleck list`: what the registries hold.
use crate::{
    args::{ListArgs, Listing},
    console,
    failure::Failure,
    table::aligned,
};
use formats::{SCENE_FORMATS, image::FORMATS};
use serde::Serialize;
use serde_json::{Value, json};
use sunfleck::{
    bsdf::{COVERINGS, MATERIALS, MaterialEntry},
    integrator::{Entry, ParamInfo, REGISTRY},
};

pub(crate) fn run(args: &ListArgs) -> Result<(), Failure> {
    match (args.what, args.json) {
        (Listing::Integrators, false) => console::print(&integrators()),
        (Listing::Integrators, true) => {
            console::print_json(&REGISTRY.iter().map(integrator_record).collect::<Vec<_>>())
        }
        (Listing::Materials, false) => {
            console::print(&aligned(&materials().map(|m| [m.name, m.about].map(str::to_owned)).collect::<Vec<_>>()))
        }
        (Listing::Materials, true) => {
            let record = |m: &MaterialEntry| json!({ "name": m.name, "about": m.about });
            console::print_json(&materials().map(record).collect::<Vec<_>>())
        }
        (Listing::Formats, false) => console::print(&aligned(&formats().map(|f| format_row(&f)).collect::<Vec<_>>())),
        (Listing::Formats, true) => console::print_json(&formats().collect::<Vec<_>>()),
    }
}

/// Models of scattering, then what is laid over others.
fn materials() -> impl Iterator<Item = &'static MaterialEntry> {
    MATERIALS.iter().chain(COVERINGS)
}

/// Settings are indented below their algorithm.
fn integrators() -> String {
    let setting = |p: &ParamInfo| [format!("  {}", p.name), p.about.to_owned()];
    let mut rows = Vec::new();
    for e in REGISTRY {
        rows.push([e.name, e.about].map(str::to_owned));
        rows.extend(e.settings().map(setting));
    }
    aligned(&rows)
}

fn integrator_record(e: &Entry) -> Value {
    let setting = |p: &ParamInfo| json!({ "name": p.name, "about": p.about });
    let settings: Vec<Value> = e.settings().map(setting).collect();
    json!({ "name": e.name, "about": e.about, "mergeable": e.mergeable, "settings": settings })
}

/// A kind of file, whichever list it is from.
#[derive(Serialize)]
struct Format {
    kind: &'static str,
    name: &'static str,
    extensions: &'static [&'static str],
    about: &'static str,
    reads: bool,
    writes: bool,
}

fn formats() -> impl Iterator<Item = Format> {
    let scenes = SCENE_FORMATS.iter().map(|f| Format {
        kind: "scene",
        name: f.name,
        extensions: f.extensions,
        about: f.about,
        reads: true,
        writes: false,
    });
    scenes.chain(FORMATS.iter().map(|f| Format {
        kind: "picture",
        name: f.name,
        extensions: f.extensions,
        about: f.about,
        reads: f.read.is_some(),
        writes: f.write.is_some(),
    }))
}

fn format_row(f: &Format) -> [String; 4] {
    let extensions = f.extensions.iter().map(|e| format!(".{e}")).collect::<Vec<_>>().join(" ");
    let ways = [(f.reads, "read"), (f.writes, "write")];
    let ways = ways.iter().filter(|(can, _)| *can).map(|(_, way)| *way).collect::<Vec<_>>().join("/");
    [f.kind.to_owned(), extensions, ways, f.about.to_owned()]
}
