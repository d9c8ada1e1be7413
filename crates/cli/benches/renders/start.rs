//! From the start of the process to that of the first pass.
use super::args::{SCRATCH, Start, stem};
use super::ours::{Job, Until};
use super::table::{Table, figures};
use std::path::Path;
use std::thread::available_parallelism;
use std::time::Duration;

pub(crate) fn run(what: &Start) -> anyhow::Result<Table> {
    let columns = ["scene", "integrator", "first pass after, ms", "least", "most"];
    let (w, h) = what.picture.size();
    let mut table = Table::new(format!("Start, {w}×{h}, median of {}", what.rounds), &columns);
    let out = Path::new(SCRATCH).join("start.exr");
    let threads = available_parallelism()?.get();
    for (scene, integrator) in what.scenes.iter().flat_map(|s| what.integrators.iter().map(move |i| (s, i))) {
        let (settings, size, until) = (&what.picture.settings[..], what.picture.size(), Until::Passes(1));
        let job = Job { scene, integrator, settings, size, until, threads, seed: 0, out: &out };
        let mut times = (0..what.rounds.max(1))
            .map(|_| job.run().map(|r| r.first_pass))
            .collect::<anyhow::Result<Vec<Duration>>>()?;
        times.sort();
        let ms = |t: Duration| figures(1e3 * t.as_secs_f64());
        let (median, least, most) = (times[times.len() / 2], times[0], times[times.len() - 1]);
        table.row(vec![stem(scene), integrator.clone(), ms(median), ms(least), ms(most)]);
    }
    Ok(table)
}
