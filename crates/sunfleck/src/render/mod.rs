//! One render: passes until a rule says stop.
use crate::{
    film::{Counts, Film, FilmSpec, PassImage},
    integrator::{Integrator, Pass},
    scene::Scene,
    spectrum::ColorMode,
};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// When to stop; the first rule that applies wins, and without any a render goes on until its observer stops it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Budget {
    /// Passes to render.
    pub passes: Option<u64>,
    /// Wall-clock time, preparation included. No pass is begun that would not end in time, going by the longest so
    /// far; one pass is always rendered.
    pub time: Option<Duration>,
}

/// What a render needs besides scene and algorithm.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Picture.
    pub spec: FilmSpec,
    /// Seed of all randomness.
    pub seed: u64,
    /// Whether colours are carried as RGB or by wavelength.
    pub color: ColorMode,
    /// When to stop.
    pub budget: Budget,
}

/// How far a render is, after each pass.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Passes done.
    pub passes: u64,
    /// Since the start.
    pub elapsed: Duration,
    /// The last pass alone.
    pub pass_time: Duration,
    /// Work of all passes.
    pub counts: Counts,
    /// Expected time to the end, if a rule tells.
    pub remaining: Option<Duration>,
}

/// Renders passes 0, 1, 2, … of `scene` until the budget is spent or `observe`, called after each, breaks.
pub fn render(
    scene: &Scene,
    integrator: &dyn Integrator,
    settings: &Settings,
    mut observe: impl FnMut(&Progress, &Film) -> ControlFlow<()>,
) -> Film {
    let start = Instant::now();
    let prepared = integrator.prepare(scene, settings.spec, settings.seed);
    let mut film = Film::new(settings.spec);
    let mut image = PassImage::new(settings.spec);
    let mut counts = Counts::default();
    let mut longest = Duration::ZERO;
    while !settings.budget.spent(film.passes(), start.elapsed(), longest) {
        let pass_start = Instant::now();
        image.clear();
        let pass = Pass::new(settings.seed, film.passes()).colored(settings.color);
        prepared.render_pass(&pass, &mut image);
        film.add(&image);
        counts += image.counts;
        let (elapsed, pass_time) = (start.elapsed(), pass_start.elapsed());
        longest = longest.max(pass_time);
        let remaining = settings.budget.remaining(film.passes(), elapsed);
        let progress = Progress { passes: film.passes(), elapsed, pass_time, counts, remaining };
        if observe(&progress, &film).is_break() {
            break;
        }
    }
    film
}

impl Budget {
    fn spent(&self, passes: u64, elapsed: Duration, longest: Duration) -> bool {
        let out_of_passes = self.passes.is_some_and(|n| passes >= n);
        let out_of_time = passes > 0 && self.time.is_some_and(|t| elapsed + longest > t);
        out_of_passes || out_of_time
    }
    fn remaining(&self, passes: u64, elapsed: Duration) -> Option<Duration> {
        let by_passes = self.passes.map(|n| elapsed.mul_f64(n.saturating_sub(passes) as f64 / passes.max(1) as f64));
        let by_time = self.time.map(|t| t.saturating_sub(elapsed));
        match (by_passes, by_time) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_rule_wins_and_one_pass_is_always_rendered() {
        let s = Duration::from_secs;
        let b = Budget { passes: Some(10), time: Some(s(60)) };
        assert!(!b.spent(9, s(50), s(5)) && b.spent(10, s(1), s(0)) && b.spent(9, s(56), s(5)));
        assert!(!b.spent(0, s(100), s(0)));
        assert_eq!(b.remaining(5, s(20)), Some(s(20)));
        assert_eq!(b.remaining(5, s(50)), Some(s(10)));
        assert_eq!(Budget::default().remaining(5, s(50)), None);
    }
}
