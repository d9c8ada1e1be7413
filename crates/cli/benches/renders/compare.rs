//! Pictures at equal times, held against references.
use super::args::{Compare, SCRATCH, stem};
use super::child::Cost;
use super::other::{self, Other};
use super::ours::{Job, Render, Until};
use super::table::{Table, figures, mib};
use formats::compare::{CompareOptions, compare};
use formats::image::read_image;
use std::path::{Path, PathBuf};
use std::time::Duration;

const COLUMNS: [&str; 14] = [
    "scene",
    "renderer",
    "threads",
    "asked, s",
    "wall, s",
    "first pass after, s",
    "passes/s",
    "Mrays/s",
    "Mphotons/s",
    "cores busy",
    "peak, MiB",
    "relMSE",
    "trimmed",
    "mean",
];

/// The seed of references, which no render here shares.
const REFERENCE_SEED: u64 = 0x5EED;

pub(crate) fn run(what: &Compare) -> anyhow::Result<Table> {
    let (w, h) = what.picture.size();
    let mut table = Table::new(format!("Renders at equal times, {w}×{h}"), &COLUMNS);
    let others = what.others.iter().map(|o| Other::parse(o)).collect::<anyhow::Result<Vec<_>>>()?;
    for (scene, reference) in what.scenes() {
        let reference = reference.map_or_else(|| own_reference(what, &scene), |r| Ok(Some(r)))?;
        for (&time, &threads) in what.times.iter().flat_map(|t| what.threads.iter().map(move |n| (t, n))) {
            let run = Run { what, scene: &scene, reference: reference.as_deref(), time, threads };
            for integrator in &what.integrators {
                table.row(run.ours(integrator)?);
            }
            for other in &others {
                table.row(run.other(other)?);
            }
        }
    }
    Ok(table)
}

/// A reference left from before, or rendered now if that was asked for.
fn own_reference(what: &Compare, scene: &Path) -> anyhow::Result<Option<PathBuf>> {
    let (width, height) = what.picture.size();
    let path = Path::new(SCRATCH).join(format!("{}-{width}x{height}-reference.exr", stem(scene)));
    if path.is_file() {
        return Ok(Some(path));
    }
    let Some(time) = what.reference_time else { return Ok(None) };
    let job = Job {
        scene,
        integrator: &what.reference_integrator,
        settings: &[],
        size: (width, height),
        until: Until::Time(time),
        threads: std::thread::available_parallelism()?.get(),
        seed: REFERENCE_SEED,
        out: &path,
    };
    job.run()?;
    Ok(Some(path))
}

/// One scene, time and number of threads.
struct Run<'a> {
    what: &'a Compare,
    scene: &'a Path,
    reference: Option<&'a Path>,
    time: Duration,
    threads: usize,
}

impl Run<'_> {
    fn ours(&self, integrator: &str) -> anyhow::Result<Vec<String>> {
        let out = self.out(integrator).with_extension("exr");
        let job = Job {
            scene: self.scene,
            integrator,
            settings: &self.what.picture.settings,
            size: self.what.picture.size(),
            until: Until::Time(self.time),
            threads: self.threads,
            seed: 0,
            out: &out,
        };
        let render = job.run()?;
        let Render { first_pass, in_passes, passes, rays, emitted, .. } = render;
        let rate = |n: u64| figures(n as f64 / in_passes);
        let mega = |n: u64| figures(n as f64 / in_passes / 1e6);
        let work = [figures(first_pass.as_secs_f64()), rate(passes), mega(rays), mega(emitted)];
        self.row(integrator, &render.cost, work, &out)
    }

    fn other(&self, other: &Other) -> anyhow::Result<Vec<String>> {
        let out = self.out(&other.name);
        let (scene, size, time, threads) = (self.scene, self.what.picture.size(), self.time, self.threads);
        let (cost, picture) = other.run(&other::Job { scene, size, time, threads, out: &out })?;
        self.row(&other.name, &cost, [(); 4].map(|()| "-".to_owned()), &picture)
    }

    /// Where a picture goes.
    fn out(&self, renderer: &str) -> PathBuf {
        let name = format!("{}-{renderer}-{}ms-{}", stem(self.scene), self.time.as_millis(), self.threads);
        Path::new(SCRATCH).join(name)
    }

    fn row(&self, renderer: &str, cost: &Cost, work: [String; 4], picture: &Path) -> anyhow::Result<Vec<String>> {
        let wall = cost.wall.as_secs_f64();
        let start = [stem(self.scene), renderer.to_owned(), self.threads.to_string()];
        let times = [figures(self.time.as_secs_f64()), figures(wall)];
        let machine = [figures(cost.cpu.as_secs_f64() / wall), mib(cost.peak)];
        let errors = self.errors(picture)?;
        Ok(start.into_iter().chain(times).chain(work).chain(machine).chain(errors).collect())
    }

    /// Relative squared error, the same without the worst pixels, and the mean over that of the reference; lamps are left
    /// out.
    fn errors(&self, picture: &Path) -> anyhow::Result<[String; 3]> {
        let Some(reference) = self.reference else { return Ok([(); 3].map(|()| "-".to_owned())) };
        let (picture, reference) = (read_image(picture)?.image, read_image(reference)?.image);
        let c = compare(&picture, &reference, &CompareOptions::default())?;
        Ok([figures(c.rel_mse), figures(c.rel_mse_trimmed), format!("{:.4}", c.means.ratio_grey)])
    }
}
