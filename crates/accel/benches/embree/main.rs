//! Rays per second of CPU time against Embree 4, measured side by side in one process.
//!
//! ```text
//! pip install embreex
//! cargo bench -p accel --bench embree -- [--embree FILE] [--scene ball|clutter] [--reps N] [--quality high] [--level N]
//!     [--side N] [--only-builds]
//! ```
//!
//! Without `--embree` the folder of the Python package `embreex` is searched, and if there is no Embree the program
//! says so and ends well.

mod ffi;
#[path = "../scenes/mod.rs"]
mod scenes;

use accel::{Bvh, Geometry, Quality, Ray};
use scenes::Mesh;
use std::{
    path::PathBuf,
    process::Command,
    sync::atomic::{AtomicUsize, Ordering::Relaxed},
    time::Instant,
};

struct Options {
    embree: Option<PathBuf>,
    scene: Option<String>,
    reps: usize,
    quality: Quality,
    level: u32,
    side: u32,
    only_builds: bool,
}

fn options() -> Options {
    let mut options = Options {
        embree: None,
        scene: None,
        reps: 3,
        quality: Quality::Default,
        level: 8,
        side: 1024,
        only_builds: false,
    };
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        let mut value = || args.next().unwrap_or_else(|| panic!("{arg} wants a value"));
        match arg.as_str() {
            "--bench" => {}
            "--only-builds" => options.only_builds = true,
            "--embree" => options.embree = Some(value().into()),
            "--scene" => options.scene = Some(value()),
            "--reps" => options.reps = value().parse().expect("--reps wants a number"),
            "--level" => options.level = value().parse().expect("--level wants a number"),
            "--side" => options.side = value().parse().expect("--side wants a number"),
            "--quality" => {
                options.quality = if value() == "high" { Quality::High } else { Quality::Default };
            }
            other => panic!("unknown argument {other}"),
        }
    }
    options
}

fn main() {
    let options = options();
    let Some(library) = options.embree.clone().or_else(find_embree) else {
        println!("Embree 4 was not found; install it with `pip install embreex` or name it with --embree");
        return;
    };
    for (name, make) in [
        ("ball", Box::new(|| scenes::ball(options.level)) as Box<dyn Fn() -> Mesh>),
        ("clutter", Box::new(scenes::clutter)),
    ] {
        if options.scene.as_deref().is_none_or(|wanted| wanted == name) {
            compare(name, &make(), &library, &options);
        }
    }
}

/// The shared library inside the wheel `embreex`, whose name carries a hash.
fn find_embree() -> Option<PathBuf> {
    let script = "import importlib.util, os; s = importlib.util.find_spec('embreex'); print(os.path.dirname(s.origin))";
    let output = Command::new("python3").args(["-c", script]).output().ok()?;
    let package = PathBuf::from(String::from_utf8(output.stdout).ok()?.trim());
    let folder = package.with_file_name("embreex.libs");
    std::fs::read_dir(folder)
        .ok()?
        .filter_map(Result::ok)
        .map(|entry| entry.path())
        .find(|path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("libembree4")))
}

fn compare(name: &str, mesh: &Mesh, library: &std::path::Path, options: &Options) {
    println!("\n## Scene {name}: {} triangles", mesh.indices.len());
    let positions: Vec<[f32; 3]> = mesh.positions.iter().map(glam::Vec3::to_array).collect();
    let geometry = Geometry::Triangles { positions: &mesh.positions, indices: &mesh.indices };
    let quality = if options.quality == Quality::High { 2 } else { 1 };
    let mut kept = None;
    println!("\n| build | threads | seconds | CPU seconds | MiB |\n|---|---|---|---|---|");
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
        for _ in 0..options.reps {
            let (embree, time) =
                timed(|| ffi::Scene::build(library, &positions, &mesh.indices, quality, threads).expect("Embree"));
            println!("| Embree | {threads} | {time} | {:.1} |", embree.bytes as f64 / 1_048_576.0);
            let (own, time) = timed(|| pool.install(|| Bvh::build(&[geometry], &[], &[], options.quality)));
            println!("| own | {threads} | {time} | {:.1} |", own.memory_bytes() as f64 / 1_048_576.0);
            kept = Some((embree, own));
        }
    }
    let (embree, own) = kept.expect("at least one repetition");
    if options.only_builds {
        return;
    }
    let sets = scenes::ray_sets(|hit| mesh.normal(hit), &own, options.side);
    for threads in [1, 2] {
        table(&embree, &own, &sets, threads, options.reps);
    }
}

/// One row per ray set: Mrays per CPU second of both and their ratio, medians over `reps` interleaved runs.
fn table(embree: &ffi::Scene, own: &Bvh, sets: &[scenes::RaySet], threads: usize, reps: usize) {
    println!(
        "\n| {threads} thread(s) | rays | Embree Mrays/CPU-s | own Mrays/CPU-s | ratio | Embree hits | own hits |"
    );
    println!("|---|---|---|---|---|---|---|");
    let mut log_sum = 0.0;
    for scenes::RaySet { name, rays, any } in sets {
        let mut rates = [Vec::new(), Vec::new(), Vec::new()];
        let mut hits = [0, 0];
        for _ in 0..reps {
            let (a, b) = if *any {
                (run(rays, threads, |ray| embree.occluded(ray)), run(rays, threads, |ray| own.occluded(ray)))
            } else {
                let embree = run(rays, threads, |ray| embree.closest(ray).is_some());
                (embree, run(rays, threads, |ray| own.closest(ray).is_some()))
            };
            rates[0].push(rays.len() as f64 / a.0 / 1e6);
            rates[1].push(rays.len() as f64 / b.0 / 1e6);
            rates[2].push(a.0 / b.0);
            hits = [a.1, b.1];
        }
        let [a, b, ratio] = rates.map(median);
        log_sum += ratio.ln();
        println!("| {name} | {} | {a:.3} | {b:.3} | {ratio:.3} | {} | {} |", rays.len(), hits[0], hits[1]);
    }
    println!("| **geometric mean** | | | | **{:.3}** | | |", (log_sum / sets.len() as f64).exp());
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// CPU seconds of all threads together, and the number of rays for which `query` holds.
fn run(rays: &[Ray], threads: usize, query: impl Fn(&Ray) -> bool + Sync) -> (f64, usize) {
    const CHUNK: usize = 2048;
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        let worker = || {
            let start = seconds(libc::CLOCK_THREAD_CPUTIME_ID);
            let mut hits = 0;
            while let Some(chunk) = rays.chunks(CHUNK).nth(next.fetch_add(1, Relaxed)) {
                hits += chunk.iter().filter(|ray| query(ray)).count();
            }
            (seconds(libc::CLOCK_THREAD_CPUTIME_ID) - start, hits)
        };
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().map(|w| w.join().expect("a worker")).fold((0.0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
    })
}

/// What `work` gives, and its wall-clock and CPU seconds as two cells of a table.
fn timed<T>(work: impl FnOnce() -> T) -> (T, String) {
    let (start, cpu) = (Instant::now(), seconds(libc::CLOCK_PROCESS_CPUTIME_ID));
    let result = work();
    let cpu = seconds(libc::CLOCK_PROCESS_CPUTIME_ID) - cpu;
    (result, format!("{:.2} | {cpu:.2}", start.elapsed().as_secs_f64()))
}

/// Seconds on one of the system's clocks.
fn seconds(clock: libc::clockid_t) -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the call only writes to `time`.
    unsafe { libc::clock_gettime(clock, &raw mut time) };
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}
