//! A program run to its end, and what it cost.
use anyhow::{Context, bail};
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant};

/// What a program cost. Processor time and memory are Linux's, and zero elsewhere.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cost {
    /// From start to end.
    pub(crate) wall: Duration,
    /// Processor time of all its threads, to 10 ms.
    pub(crate) cpu: Duration,
    /// The most memory it held at once, bytes.
    pub(crate) peak: u64,
}

/// A program that ended well.
pub(crate) struct Ran {
    pub(crate) cost: Cost,
    /// Lines of its standard output, and when they came.
    pub(crate) lines: Vec<(Duration, String)>,
}

/// Programs that take longer are ended.
const LIMIT: Duration = Duration::from_secs(3600);
/// Linux counts the time of children in hundredths of a second (`proc_pid_stat(5)`, `USER_HZ`).
const TICK: Duration = Duration::from_millis(10);

/// Runs it. One at a time: the time of all children that ended meanwhile counts as its own.
pub(crate) fn run(command: &mut Command) -> anyhow::Result<Ran> {
    let name = command.get_program().to_string_lossy().into_owned();
    let before = children_cpu();
    let start = Instant::now();
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let child = child.as_mut().map_err(|e| anyhow::anyhow!("cannot start {name}: {e}"))?;
    let (out, err) = (child.stdout.take().expect("piped"), child.stderr.take().expect("piped"));
    let (id, ended) = (child.id(), AtomicBool::new(false));
    let (status, wall, lines, complaint, peak) = thread::scope(|s| {
        let lines = s.spawn(|| {
            let lines = BufReader::new(out).split(b'\n').map_while(Result::ok);
            lines.map(|l| (start.elapsed(), String::from_utf8_lossy(&l).into_owned())).collect::<Vec<_>>()
        });
        let complaint = s.spawn(|| {
            let mut bytes = Vec::new();
            BufReader::new(err).read_to_end(&mut bytes).map(|_| String::from_utf8_lossy(&bytes).into_owned())
        });
        let peak = s.spawn(|| watch(id, start, &ended));
        let status = wait(child, start);
        let wall = start.elapsed();
        ended.store(true, Relaxed);
        let join = "a reader does not panic";
        (status, wall, lines.join().expect(join), complaint.join().expect(join), peak.join().expect(join))
    });
    let status = status.with_context(|| format!("cannot wait for {name}"))?;
    if !status.success() {
        bail!("{name} failed ({status}): {}", complaint.unwrap_or_default());
    }
    let cpu = children_cpu().saturating_sub(before);
    Ok(Ran { cost: Cost { wall, cpu, peak }, lines })
}

/// Waits for the end, which comes no later than the limit.
fn wait(child: &mut Child, start: Instant) -> std::io::Result<std::process::ExitStatus> {
    let mut pause = Duration::from_micros(200);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(status);
        }
        if start.elapsed() > LIMIT {
            child.kill()?;
            return child.wait();
        }
        thread::sleep(pause);
        // No more than one part in a hundred of the time is waited too long.
        pause = (start.elapsed() / 100).clamp(pause, Duration::from_millis(20));
    }
}

/// The most memory that the process held, looked at now and then until it ends: what it takes in the last moments may be
/// missed.
fn watch(id: u32, start: Instant, ended: &AtomicBool) -> u64 {
    let path = format!("/proc/{id}/status");
    let mut peak = 0;
    while !ended.load(Relaxed) {
        let text = fs::read_to_string(&path).unwrap_or_default();
        let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
        let kib = line.and_then(|l| l.trim().strip_suffix("kB")?.trim().parse::<u64>().ok());
        peak = kib.map_or(peak, |k| peak.max(1024 * k));
        thread::sleep((start.elapsed() / 50).clamp(Duration::from_millis(1), Duration::from_millis(20)));
    }
    peak
}

/// Processor time of the children that ended (`proc_pid_stat(5)`: fields 16 and 17, counted after the name).
fn children_cpu() -> Duration {
    let text = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = text.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |i: usize| fields.get(i).and_then(|f| f.parse::<u32>().ok()).unwrap_or(0);
    TICK * (ticks(13) + ticks(14))
}
