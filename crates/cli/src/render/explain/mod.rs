//! `--explain`: which sampler brings which part of the picture, and what becomes of the light of each lamp.
mod advice;
mod books;
mod samplers;

use super::{Done, Job, interrupt::Interrupt};
use books::Books;
use formats::image::RgbImage32;
use samplers::Shown;
use serde::Serialize;

/// What is told, to people and to programs.
#[derive(Debug, Serialize)]
pub(super) struct Explanation {
    /// Passes in which each sampler was shown.
    passes: u64,
    /// Samplers of the algorithm; none if it cannot show them apart.
    samplers: Vec<Shown>,
    /// Books of the light; none if no light path was sent.
    books: Option<Books>,
    /// What could be better.
    advice: Vec<String>,
    #[serde(skip)]
    integrator: &'static str,
}

/// Pictures that go with it: their sum, and each sampler by its name.
pub(super) struct Pictures {
    pub(super) sum: RgbImage32,
    pub(super) layers: Vec<(String, RgbImage32)>,
}

/// Passes in which samplers are shown, at most.
const PASSES: u64 = 8;

/// Renders what is to be told; `None` if the user has had enough.
pub(super) fn explain(job: &Job, done: &Done, interrupt: &Interrupt) -> Option<(Explanation, Option<Pictures>)> {
    let scene = &job.loaded.scene;
    let settings = &job.settings;
    let renderer = job.algorithm.integrator().prepare(scene, settings.spec, settings.seed);
    let passes = done.film.passes().min(PASSES);
    let (samplers, pictures) = samplers::show(&*renderer, settings, passes, interrupt)?;
    let books = books::keep(&*renderer, job, done.progress.counts.emitted);
    let advice = books.as_ref().map(|b| advice::give(b, &job.algorithm)).unwrap_or_default();
    let pictures = (!samplers.is_empty()).then_some(pictures);
    Some((Explanation { passes, samplers, books, advice, integrator: job.algorithm.name() }, pictures))
}

impl Explanation {
    /// Tables and advice for people.
    pub(super) fn text(&self) -> String {
        let name = self.integrator;
        let samplers = match &self.samplers[..] {
            [] => format!("`{name}` has no samplers that could be shown apart\n"),
            all => samplers::table(all),
        };
        let books = self.books.as_ref().map_or_else(|| format!("`{name}` sent no light paths here\n"), Books::table);
        let advice = self.advice.iter().map(|a| format!("\nnote: {a}\n"));
        format!("\n{samplers}\n{books}{}", advice.collect::<String>())
    }
}
