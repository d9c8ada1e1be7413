//! A render by this repository's `sunfleck`.
use super::child::{self, Cost};
use anyhow::Context;
use serde::Deserialize;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// What to render.
pub(crate) struct Job<'a> {
    pub(crate) scene: &'a Path,
    pub(crate) integrator: &'a str,
    pub(crate) settings: &'a [String],
    /// Width and height.
    pub(crate) size: (u32, u32),
    pub(crate) until: Until,
    pub(crate) threads: usize,
    pub(crate) seed: u64,
    pub(crate) out: &'a Path,
}

/// When it ends.
#[derive(Clone, Copy)]
pub(crate) enum Until {
    Passes(u64),
    Time(Duration),
}

/// What came of it.
pub(crate) struct Render {
    pub(crate) cost: Cost,
    /// From the start of the process to that of the first pass.
    pub(crate) first_pass: Duration,
    /// Time in passes.
    pub(crate) in_passes: f64,
    pub(crate) passes: u64,
    pub(crate) rays: u64,
    /// Light paths.
    pub(crate) emitted: u64,
    /// Photons.
    pub(crate) stored: u64,
}

/// What `--json=lines` says after each pass.
#[derive(Deserialize)]
struct PassLine {
    pass_seconds: f64,
    passes: u64,
    rays: u64,
    photons_emitted: u64,
    photons_stored: u64,
}

impl Job<'_> {
    pub(crate) fn run(&self) -> anyhow::Result<Render> {
        let mut command = Command::new(env!("CARGO_BIN_EXE_sunfleck"));
        command.arg("render").arg(self.scene).args(["--integrator", self.integrator, "--quiet", "--json=lines"]);
        command.args(["--width", &self.size.0.to_string(), "--height", &self.size.1.to_string()]);
        command.args(["--threads", &self.threads.to_string(), "--seed", &self.seed.to_string()]);
        match self.until {
            Until::Passes(n) => command.args(["--passes", &n.to_string()]),
            Until::Time(t) => command.args(["--time", &format!("{}ms", t.as_millis())]),
        };
        for setting in self.settings {
            command.args(["--set", setting]);
        }
        let ran = child::run(command.arg("-o").arg(self.out))?;
        let lines = ran.lines.iter().filter(|(_, l)| l.starts_with(r#"{"event":"pass""#));
        let passes: Vec<(Duration, PassLine)> =
            lines.map(|(at, l)| Ok((*at, serde_json::from_str(l)?))).collect::<serde_json::Result<_>>()?;
        let (Some((at, first)), Some((_, last))) = (passes.first(), passes.last()) else {
            anyhow::bail!("sunfleck told of no pass");
        };
        let first_pass = at.saturating_sub(Duration::try_from_secs_f64(first.pass_seconds).context("no time")?);
        let in_passes = passes.iter().map(|(_, p)| p.pass_seconds).sum();
        let (emitted, stored) = (last.photons_emitted, last.photons_stored);
        Ok(Render { cost: ran.cost, first_pass, in_passes, passes: last.passes, rays: last.rays, emitted, stored })
    }
}

impl Render {
    /// Seconds of a pass, on average.
    pub(crate) fn pass(&self) -> f64 {
        self.in_passes / self.passes as f64
    }
    /// Processors busy on average.
    pub(crate) fn cores(&self) -> f64 {
        self.cost.cpu.as_secs_f64() / self.cost.wall.as_secs_f64()
    }
}
