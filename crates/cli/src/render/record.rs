//! What programs read: JSON on standard output, and metadata inside EXR files.
use super::{Done, Job, explain::Explanation, outputs::Written};
use crate::load::{Eye, SceneRecord, Warning};
use glam::DVec3;
use serde::Serialize;
use std::collections::BTreeMap;
use sunfleck::{
    film::Film,
    render::{Budget, Progress},
};

/// Which rule ended a render.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum StoppedBy {
    Passes,
    Time,
    Interrupt,
}

impl StoppedBy {
    pub(super) fn new(interrupted: bool, budget: &Budget, passes: u64) -> Self {
        match (interrupted, budget.passes) {
            (true, _) => Self::Interrupt,
            (false, Some(n)) if passes >= n => Self::Passes,
            (false, _) => Self::Time,
        }
    }
}

/// The whole render.
#[derive(Debug, Serialize)]
pub(super) struct Record<'a> {
    event: &'static str,
    version: &'static str,
    files: Vec<String>,
    scene: SceneRecord,
    camera: Eye,
    integrator: &'static str,
    settings: &'a BTreeMap<String, String>,
    seed: u64,
    width: u32,
    height: u32,
    /// `rgb` or `spectral`.
    color: &'static str,
    #[serde(flatten)]
    work: Work,
    stopped_by: StoppedBy,
    /// Mean radiance by channel.
    mean: [f64; 3],
    outputs: &'a [Written],
    warnings: Vec<Warning>,
    /// With `--explain`.
    #[serde(skip_serializing_if = "Option::is_none")]
    explain: Option<&'a Explanation>,
}

/// What was done in which time.
#[derive(Debug, Serialize)]
struct Work {
    passes: u64,
    seconds: f64,
    rays: u64,
    photons_emitted: u64,
    photons_stored: u64,
    rays_per_s: f64,
}

/// One pass, for `--json=lines`.
#[derive(Debug, Serialize)]
pub(super) struct PassRecord {
    event: &'static str,
    pass_seconds: f64,
    remaining_seconds: Option<f64>,
    #[serde(flatten)]
    work: Work,
}

impl Work {
    fn new(p: &Progress) -> Self {
        let seconds = p.elapsed.as_secs_f64();
        Self {
            passes: p.passes,
            seconds,
            rays: p.counts.rays,
            photons_emitted: p.counts.emitted,
            photons_stored: p.counts.stored,
            rays_per_s: p.counts.rays as f64 / seconds.max(1e-9),
        }
    }
}

pub(super) fn pass(p: &Progress) -> PassRecord {
    PassRecord {
        event: "pass",
        pass_seconds: p.pass_time.as_secs_f64(),
        remaining_seconds: p.remaining.map(|t| t.as_secs_f64()),
        work: Work::new(p),
    }
}

impl<'a> Record<'a> {
    pub(super) fn new(job: &'a Job, done: &Done, outputs: &'a [Written], explain: Option<&'a Explanation>) -> Self {
        let spec = job.settings.spec;
        Self {
            event: "done",
            version: env!("CARGO_PKG_VERSION"),
            files: job.args.scene.files.iter().map(|f| f.display().to_string()).collect(),
            scene: job.loaded.record(),
            camera: job.loaded.eye,
            integrator: job.algorithm.name(),
            settings: job.algorithm.settings(),
            seed: job.settings.seed,
            width: spec.width,
            height: spec.height,
            color: job.settings.color.name(),
            work: Work::new(&done.progress),
            stopped_by: done.stopped_by,
            mean: mean(&done.film),
            outputs,
            warnings: job.loaded.warnings().collect(),
            explain,
        }
    }
}

/// Mean radiance of the picture by channel.
fn mean(film: &Film) -> [f64; 3] {
    let pixels = film.mean();
    let sum = pixels.iter().fold(DVec3::ZERO, |s, p| s + p.as_dvec3());
    (sum / pixels.len().max(1) as f64).to_array()
}

/// Names and values stored in EXR files: what is needed to make the picture again.
pub(super) fn metadata(job: &Job, film: &Film) -> Vec<(String, String)> {
    let said: Vec<String> = job.algorithm.settings().iter().map(|(k, v)| format!("{k}={v}")).collect();
    let pairs = [
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("scene-hash", job.loaded.hash.clone()),
        ("camera", job.loaded.eye.words()),
        ("integrator", job.algorithm.name().to_owned()),
        ("settings", said.join(" ")),
        ("color", job.settings.color.name().to_owned()),
        ("seed", job.settings.seed.to_string()),
        ("passes", film.passes().to_string()),
    ];
    pairs.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}
