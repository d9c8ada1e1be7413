//! What a person reads before and after the passes.
use super::{Done, Job, Outputs, StoppedBy, outputs::Written};
use crate::{
    table::aligned,
    words::{count, things, time},
};
use sunfleck::spectrum::ColorMode;

/// Scene, eye, algorithm and picture.
pub(super) fn before(job: &Job, outputs: &Outputs) -> String {
    let Job { args, loaded, algorithm, settings } = job;
    let files = args.scene.files.iter().map(|f| f.display().to_string()).collect::<Vec<_>>().join(", ");
    let spec = settings.spec;
    let passes = settings.budget.passes.map(|n| things(n, "pass", "passes"));
    let until = passes.into_iter().chain(settings.budget.time.map(time)).collect::<Vec<_>>().join(" or ");
    let color = if settings.color == ColorMode::Spectral { "spectral, " } else { "" };
    let mut rows = vec![("scene", files), ("", loaded.words()), ("camera", loaded.eye.words())];
    if let Some(name) = &loaded.hints.integrator {
        rows.push(("", format!("asks for `{name}`; what renders here is said by --integrator only")));
    }
    rows.extend([
        ("integrator", format!("{}, seed {}", algorithm.words(), settings.seed)),
        ("picture", format!("{}×{}, {color}{until} → {}", spec.width, spec.height, outputs.names())),
    ]);
    let rows: Vec<[String; 2]> = rows.into_iter().map(|(name, value)| [name.to_owned(), value]).collect();
    let text = aligned(&rows);
    text + &loaded.eye.stretch(&spec).unwrap_or_default()
}

/// Passes, time and files. Files that failed are told of as errors, not here.
pub(super) fn after(done: &Done, written: &[Written]) -> String {
    let Done { progress, stopped_by, .. } = done;
    let rays = count(progress.counts.rays as f64 / progress.elapsed.as_secs_f64().max(1e-9));
    let why = if *stopped_by == StoppedBy::Interrupt { ", interrupted" } else { "" };
    let passes = things(progress.passes, "pass", "passes");
    let first = format!("{passes} in {}, {rays} rays/s{why}", time(progress.elapsed));
    let files = written.iter().filter(|w| w.error.is_none()).map(|w| format!("wrote {}", w.path));
    std::iter::once(first).chain(files).collect::<Vec<_>>().join("\n")
}
