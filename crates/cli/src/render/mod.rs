//! `sunfleck render`: check everything that can be checked, load, render, write, tell.
//!
//! [`algorithm`] builds the integrator, [`outputs`] checks and writes files, [`interrupt`] listens to Ctrl-C, [`show`] and
//! [`record`] tell people and programs how it goes, [`explain`] takes the picture apart.
mod algorithm;
mod explain;
mod interrupt;
mod outputs;
mod record;
mod show;
mod summary;

use crate::{
    args::{BudgetArgs, JsonStyle, PictureArgs, RenderArgs},
    compat::Habits,
    console,
    failure::Failure,
    load::{self, Loaded},
};
use algorithm::Algorithm;
use anyhow::Context;
use formats::{image::MAX_PIXELS, load::Hints};
use interrupt::Interrupt;
use outputs::Outputs;
use record::{Record, StoppedBy};
use show::Show;
use std::ops::ControlFlow;
use sunfleck::{
    film::{Film, FilmSpec},
    render::{Budget, Progress, Settings, render},
};

pub(crate) fn run(args: &RenderArgs) -> Result<(), Failure> {
    let habits = Habits::of(args.compat);
    // What was said is checked before a scene is read, which may take long.
    Algorithm::new(&args.algorithm, &habits, &Hints::default())?;
    let outputs = Outputs::check(&args.output, &args.scene.files)?;
    use_threads(args.budget.threads)?;
    let loaded = load::scene(&args.scene, &args.camera, args.compat, true)?;
    let algorithm = Algorithm::new(&args.algorithm, &habits, &loaded.hints)?;
    let settings = Settings {
        spec: film_spec(&args.picture, &loaded)?,
        seed: args.budget.seed,
        color: args.picture.color.of(&loaded.scene),
        budget: budget(&args.budget, loaded.hints.passes.unwrap_or(habits.passes), algorithm.samples_per_pass()),
    };
    let interrupt = Interrupt::listen().map_err(Failure::Work)?;
    let job = Job { args, loaded, algorithm, settings };
    if !args.output.quiet {
        job.loaded.say_warnings();
        console::say(summary::before(&job, &outputs));
    }
    finish(&job, &outputs, job.passes(&interrupt), &interrupt)
}

/// Writes, then tells: a picture is worth more than a message that did not arrive.
fn finish(job: &Job, outputs: &Outputs, done: Done, interrupt: &Interrupt) -> Result<(), Failure> {
    let (tone, metadata) = (job.loaded.defaults.tone, record::metadata(job, &done.film));
    let mut written = outputs.write(&done.film, tone, &metadata);
    let output = &job.args.output;
    let explained = if output.explain { explain::explain(job, &done, interrupt) } else { None };
    if let Some((_, Some(pictures))) = &explained {
        written.extend(outputs.write_apart(pictures, tone, &metadata));
    }
    let explanation = explained.as_ref().map(|(words, _)| words);
    let wants_json = output.json.is_some() && done.told.is_ok();
    let told = if wants_json { console::print_json(&Record::new(job, &done, &written, explanation)) } else { Ok(()) };
    if !output.quiet {
        console::say(summary::after(&done, &written));
        if job.loaded.scene.was_crowded() {
            console::say(
                "warning: somewhere more media lie in each other than can be kept apart (8): some were ignored",
            );
        }
        match explanation {
            Some(e) => console::say(e.text().trim_end()),
            None if output.explain => console::say("interrupted: the picture is not explained"),
            None => {}
        }
    }
    outputs::failures(written)?;
    done.told.and(told)?;
    if done.stopped_by == StoppedBy::Interrupt { Err(Failure::Interrupted) } else { Ok(()) }
}

/// All that a render needs.
struct Job<'a> {
    args: &'a RenderArgs,
    loaded: Loaded,
    algorithm: Algorithm,
    settings: Settings,
}

/// What it gave.
struct Done {
    film: Film,
    progress: Progress,
    stopped_by: StoppedBy,
    /// Whether standard output took every line.
    told: Result<(), Failure>,
}

impl Job<'_> {
    /// Renders until the budget is spent or the user has had enough.
    fn passes(&self, interrupt: &Interrupt) -> Done {
        let output = &self.args.output;
        let budget = self.settings.budget;
        let mut show = Show::new(output.quiet, budget);
        let mut last = None;
        let mut told = Ok(());
        let film = render(&self.loaded.scene, self.algorithm.integrator(), &self.settings, |progress, _| {
            show.pass(progress);
            last = Some(*progress);
            if output.json == Some(JsonStyle::Lines) && told.is_ok() {
                told = console::print_json(&record::pass(progress));
            }
            if interrupt.requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        show.end();
        let progress = last.expect("a render has at least one pass");
        let stopped_by = StoppedBy::new(interrupt.requested(), &budget, progress.passes);
        Done { film, progress, stopped_by, told }
    }
}

fn film_spec(picture: &PictureArgs, loaded: &Loaded) -> Result<FilmSpec, Failure> {
    let defaults = &loaded.defaults;
    // Where a file gives the size of its picture, one side changed changes the other too.
    let across = |side: Option<u32>, factor: f32| {
        side.filter(|_| loaded.hints.width.is_some()).map(|n| (n as f32 * factor).round().clamp(1.0, 1e6) as u32)
    };
    let aspect = loaded.eye.aspect();
    let width = picture.width.or(across(picture.height, aspect)).unwrap_or(defaults.width);
    let height = picture.height.or(across(picture.width, 1.0 / aspect)).unwrap_or(defaults.height);
    let pixels = u64::from(width) * u64::from(height);
    if pixels > MAX_PIXELS {
        let message = format!("a picture of {width}×{height} has {pixels} pixels, more than {MAX_PIXELS}");
        return Err(Failure::input(message));
    }
    let filter = picture.filter.unwrap_or(defaults.filter);
    Ok(FilmSpec { width, height, filter })
}

/// With a time and no passes, only the time counts.
fn budget(args: &BudgetArgs, default_passes: u64, samples_per_pass: u64) -> Budget {
    let said = args.passes.or(args.spp.map(|n| n.div_ceil(samples_per_pass)));
    let passes = if args.time.is_some() { said } else { said.or(Some(default_passes)) };
    Budget { passes, time: args.time }
}

fn use_threads(threads: Option<usize>) -> Result<(), Failure> {
    let builder = rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0));
    builder.build_global().context("cannot start the threads").map_err(Failure::Work)
}
