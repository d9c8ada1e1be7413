//! `sunfleck convert`: a scene of any format as one of pbrt.
use crate::{
    args::ConvertArgs,
    console,
    failure::Failure,
    load::{self},
    words::things,
};
use formats::diagnostic::Diagnostic;
use formats::pbrt::write::{Written, write};
use std::path::Path;

pub(crate) fn run(args: &ConvertArgs) -> Result<(), Failure> {
    let target = &args.output;
    check(target)?;
    let opened = load::open(&args.scene, &args.camera, args.compat, false)?;
    let camera = opened.eye.settings();
    let to = opened.eye_to.map(|eye| eye.settings());
    let scene = Written {
        parts: opened.builder.parts(),
        camera: &camera,
        camera_to: to.as_ref(),
        size: [opened.defaults.width, opened.defaults.height],
        hints: &opened.hints,
        names: &opened.names,
    };
    opened.say_warnings();
    let report = write(target, &scene).map_err(|e| Failure::Work(e.into()))?;
    for note in &report.notes {
        console::say(format_args!("note: {note}"));
    }
    let files = things(report.files as u64, "file", "files");
    console::say(format_args!("wrote {} and {files} beside it", target.display()));
    Ok(())
}

/// That the name is that of a pbrt scene.
fn check(path: &Path) -> Result<(), Failure> {
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("pbrt")) {
        return Ok(());
    }
    let error = Diagnostic::error("convert::extension", "scenes are written as pbrt text");
    let error = error.in_file(path.display().to_string()).expected("a name that ends in `.pbrt`");
    Err(formats::Error::from(error).into())
}
