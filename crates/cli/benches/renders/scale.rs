//! How time and memory grow.
use super::args::{Photons, Pixels, SCRATCH, Threads, Triangles};
use super::ours::{Job, Render, Until};
use super::table::{Table, figures, mib};
use super::triangles::write_scene;
use std::path::{Path, PathBuf};
use std::thread::available_parallelism;

fn out() -> PathBuf {
    Path::new(SCRATCH).join("scale.exr")
}

/// One render of each kind per round; the fastest counts, since nothing makes a render too fast.
pub(crate) fn threads(what: &Threads) -> anyhow::Result<Table> {
    let columns =
        ["integrator", "threads", "pass, s", "faster", "CPU, s", "more CPU", "cores busy", "whole, s", "faster"];
    let (w, h) = what.picture.size();
    let title = format!("Threads: {}, {w}×{h}, {} passes", what.scene.display(), what.passes);
    let mut table = Table::new(title, &columns);
    for integrator in &what.integrators {
        let mut best: Vec<Option<Render>> = what.counts.iter().map(|_| None).collect();
        for _ in 0..what.rounds {
            for (best, &threads) in best.iter_mut().zip(&what.counts) {
                let (settings, until) = (&what.picture.settings[..], Until::Passes(what.passes));
                let size = what.picture.size();
                let job = Job { scene: &what.scene, integrator, settings, size, until, threads, seed: 0, out: &out() };
                let render = job.run()?;
                if best.as_ref().is_none_or(|b| render.in_passes < b.in_passes) {
                    *best = Some(render);
                }
            }
        }
        let best: Vec<Render> = best.into_iter().flatten().collect();
        let Some(first) = best.first() else { continue };
        for (render, threads) in best.iter().zip(&what.counts) {
            let (cpu, base) = (render.cost.cpu.as_secs_f64(), first.cost.cpu.as_secs_f64());
            let (wall, first_wall) = (render.cost.wall.as_secs_f64(), first.cost.wall.as_secs_f64());
            table.row(vec![
                integrator.clone(),
                threads.to_string(),
                figures(render.pass()),
                figures(first.pass() / render.pass()),
                figures(cpu),
                figures(cpu / base),
                figures(render.cores()),
                figures(wall),
                figures(first_wall / wall),
            ]);
        }
    }
    Ok(table)
}

/// One pass of each size.
pub(crate) fn photons(what: &Photons) -> anyhow::Result<Table> {
    let columns =
        ["integrator", "light paths", "photons", "pass, s", "µs a path", "whole, s", "peak, MiB", "bytes a photon"];
    let (w, h) = what.picture.size();
    let mut table = Table::new(format!("Photons: {}, {w}×{h}, one pass", what.scene.display()), &columns);
    for integrator in &what.integrators {
        for &count in &what.counts {
            let mut settings = what.picture.settings.clone();
            settings.push(format!("photons={count}"));
            let render = one_pass(&what.scene, integrator, &settings, what.picture.size())?;
            table.row(vec![
                integrator.clone(),
                format!("{:.0e}", count as f64),
                format!("{:.2e}", render.stored as f64),
                figures(render.in_passes),
                figures(1e6 * render.in_passes / render.emitted as f64),
                figures(render.cost.wall.as_secs_f64()),
                mib(render.cost.peak),
                figures(render.cost.peak as f64 / render.stored as f64),
            ]);
        }
    }
    Ok(table)
}

/// Loading, building and one pass of `path` for each size.
pub(crate) fn triangles(what: &Triangles) -> anyhow::Result<Table> {
    let columns =
        ["triangles", "file, MiB", "first pass after, s", "ns a triangle", "pass, s", "peak, MiB", "bytes a triangle"];
    let (w, h) = what.picture.size();
    let mut table = Table::new(format!("Triangles: a bumpy ball (.{}), {w}×{h}, `path`", what.mesh), &columns);
    for &count in &what.counts {
        let (scene, count, bytes) = write_scene(count, &what.mesh)?;
        let render = one_pass(&scene, "path", &what.picture.settings, what.picture.size())?;
        table.row(vec![
            count.to_string(),
            mib(bytes),
            figures(render.first_pass.as_secs_f64()),
            figures(render.first_pass.as_nanos() as f64 / count as f64),
            figures(render.in_passes),
            mib(render.cost.peak),
            figures(render.cost.peak as f64 / count as f64),
        ]);
    }
    Ok(table)
}

/// One pass of each size.
pub(crate) fn pixels(what: &Pixels) -> anyhow::Result<Table> {
    let columns = [
        "integrator",
        "picture",
        "first pass after, s",
        "pass, s",
        "µs a pixel",
        "whole, s",
        "peak, MiB",
        "bytes a pixel",
    ];
    let mut table = Table::new(format!("Pixels: {}, one pass", what.scene.display()), &columns);
    for integrator in &what.integrators {
        for &(w, h) in &what.sizes {
            let render = one_pass(&what.scene, integrator, &what.settings, (w, h))?;
            let pixels = f64::from(w) * f64::from(h);
            table.row(vec![
                integrator.clone(),
                format!("{w}×{h}"),
                figures(render.first_pass.as_secs_f64()),
                figures(render.in_passes),
                figures(1e6 * render.in_passes / pixels),
                figures(render.cost.wall.as_secs_f64()),
                mib(render.cost.peak),
                figures(render.cost.peak as f64 / pixels),
            ]);
        }
    }
    Ok(table)
}

fn one_pass(scene: &Path, integrator: &str, settings: &[String], size: (u32, u32)) -> anyhow::Result<Render> {
    let (until, threads) = (Until::Passes(1), available_parallelism()?.get());
    Job { scene, integrator, settings, size, until, threads, seed: 0, out: &out() }.run()
}
