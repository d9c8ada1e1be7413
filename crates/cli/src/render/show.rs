//! How a render goes, for the person who waits: a bar where a line can be redrawn, else a line now and then.
use crate::{
    console,
    words::{count, time},
};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::{Duration, Instant};
use sunfleck::render::{Budget, Progress};

/// Steps of the bar; it moves by whichever limit is nearest.
const STEPS: u64 = 1000;

/// Between two lines, at least.
const BETWEEN_LINES: Duration = Duration::from_secs(10);

/// Tells of passes.
pub(super) struct Show {
    budget: Budget,
    how: How,
}

enum How {
    Silent,
    Bar(ProgressBar),
    Lines { said: Option<Instant> },
}

impl Show {
    pub(super) fn new(quiet: bool, budget: Budget) -> Self {
        let how = match (quiet, console::is_watched()) {
            (true, _) => How::Silent,
            (false, true) => How::Bar(bar()),
            (false, false) => How::Lines { said: None },
        };
        Self { budget, how }
    }

    /// Tells of a pass done.
    pub(super) fn pass(&mut self, progress: &Progress) {
        match &mut self.how {
            How::Bar(bar) => {
                bar.set_position((STEPS as f64 * done(&self.budget, progress)) as u64);
                bar.set_message(words(&self.budget, progress));
            }
            How::Lines { said } if said.is_none_or(|at| at.elapsed() >= BETWEEN_LINES) => {
                console::say(format_args!("{}, {} elapsed", words(&self.budget, progress), time(progress.elapsed)));
                *said = Some(Instant::now());
            }
            How::Silent | How::Lines { .. } => {}
        }
    }

    /// Clears the bar.
    pub(super) fn end(&self) {
        if let How::Bar(bar) = &self.how {
            bar.finish_and_clear();
        }
    }
}

fn bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:16} {elapsed_precise} {wide_msg}")
        .expect("the template is a constant")
        .progress_chars("━╸ ");
    let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr()).with_style(style);
    bar.set_message("preparing");
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// Part of the budget that is spent, 0 to 1.
fn done(budget: &Budget, p: &Progress) -> f64 {
    let passes = budget.passes.map_or(0.0, |n| p.passes as f64 / n.max(1) as f64);
    let time = budget.time.map_or(0.0, |t| p.elapsed.as_secs_f64() / t.as_secs_f64());
    passes.max(time).min(1.0)
}

fn words(budget: &Budget, p: &Progress) -> String {
    let of = budget.passes.map(|n| format!("/{n}")).unwrap_or_default();
    let seconds = p.elapsed.as_secs_f64().max(1e-9);
    let rate = |n: u64, what: &str| (n > 0).then(|| format!(", {} {what}/s", count(n as f64 / seconds)));
    let rays = rate(p.counts.rays, "rays").unwrap_or_default();
    let photons = rate(p.counts.emitted, "photons").unwrap_or_default();
    let left = p.remaining.map(|t| format!(", {} left", time(t))).unwrap_or_default();
    format!("pass {}{of}{left}{rays}{photons}", p.passes)
}
