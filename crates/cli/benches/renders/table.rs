//! A table in Markdown, and where it came from.
use std::fmt::Write as _;
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::Path;
use std::process::Command;
use std::time::SystemTime;

/// Rows under headings.
pub(crate) struct Table {
    title: String,
    columns: Vec<&'static str>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// Without rows yet.
    pub(crate) fn new(title: impl Into<String>, columns: &[&'static str]) -> Self {
        Self { title: title.into(), columns: columns.to_vec(), rows: Vec::new() }
    }

    /// Adds a row, and says it at once to who waits.
    pub(crate) fn row(&mut self, cells: Vec<String>) {
        assert_eq!(cells.len(), self.columns.len(), "a cell for each column");
        eprintln!("{}", cells.join("  "));
        self.rows.push(cells);
    }

    /// Prints it, and appends it to the file `record`.
    pub(crate) fn tell(&self, note: Option<&str>, record: Option<&Path>) -> anyhow::Result<()> {
        let text = self.text(note);
        print!("{text}");
        if let Some(path) = record {
            OpenOptions::new().create(true).append(true).open(path)?.write_all(text.as_bytes())?;
        }
        Ok(())
    }

    fn text(&self, note: Option<&str>) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let headings: Vec<String> = self.columns.iter().map(|&c| c.to_owned()).collect();
        let mut text = format!("\n## {}\n\n{}\n", self.title, origin());
        if let Some(note) = note {
            let _ = writeln!(text, "{note}");
        }
        let _ = write!(text, "\n    {}\n\n{}{}\n", said(), line(&headings), "|---".repeat(headings.len()) + "|");
        self.rows.iter().for_each(|r| text += &line(r));
        text
    }
}

/// The command that gave it.
fn said() -> String {
    let words = std::env::args().skip(1).filter(|a| a != "--bench");
    let quoted = words.map(|w| if w.contains(char::is_whitespace) { format!("\"{w}\"") } else { w });
    format!("cargo bench -p sunfleck-cli --bench renders -- {}", quoted.collect::<Vec<_>>().join(" "))
}

/// Date, commit and machine.
fn origin() -> String {
    let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
    let git = |args: &[&str]| {
        let output = Command::new("git").args(args).output().ok().filter(|o| o.status.success());
        output.map(|o| String::from_utf8_lossy(&o.stdout).trim().to_owned())
    };
    let commit = git(&["rev-parse", "--short", "HEAD"]).unwrap_or_else(|| "unknown".to_owned());
    let changed = git(&["status", "--porcelain", "--untracked-files=no"]).is_some_and(|s| !s.is_empty());
    let more = if changed { " and what was not committed" } else { "" };
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let load = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load = load.split(' ').next().filter(|l| !l.is_empty()).unwrap_or("unknown");
    format!("{}, commit {commit}{more}, {}, {cores} threads, load at the end {load}.", &now[..10], processor())
}

fn processor() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = text.lines().find_map(|l| l.strip_prefix("model name")?.split_once(": "));
    name.map_or_else(|| std::env::consts::ARCH.to_owned(), |(_, name)| name.to_owned())
}

/// Three figures.
pub(crate) fn figures(x: f64) -> String {
    match x.abs() {
        a if !a.is_finite() || a == 0.0 => "-".to_owned(),
        a if a >= 100.0 => format!("{x:.0}"),
        a if a >= 10.0 => format!("{x:.1}"),
        a if a >= 1.0 => format!("{x:.2}"),
        a if a >= 0.001 => format!("{x:.*}", (2 - a.log10().floor() as i32) as usize),
        _ => format!("{x:.2e}"),
    }
}

/// Bytes as MiB.
pub(crate) fn mib(bytes: u64) -> String {
    figures(bytes as f64 / f64::from(1 << 20))
}
