//! Standard error for people, standard output for results. A stream that was closed never stops the work.
use crate::failure::Failure;
use anstream::{AutoStream, ColorChoice};
use anyhow::Context;
use serde::Serialize;
use std::fmt::Display;
use std::io::{ErrorKind, IsTerminal, Write, stderr, stdout};

/// Says a line to the person at the terminal.
pub(crate) fn say(line: impl Display) {
    // Nobody is there to be told that nobody listens.
    let _ = writeln!(stderr().lock(), "{line}");
}

/// Whether a person watches standard error, so that a line may be redrawn.
pub(crate) fn is_watched() -> bool {
    stderr().is_terminal()
}

/// Whether standard error shows colours.
pub(crate) fn has_colour() -> bool {
    AutoStream::choice(&stderr()) != ColorChoice::Never
}

/// The word that begins every error.
pub(crate) fn error_word() -> &'static str {
    if has_colour() { "\u{1b}[1;31merror:\u{1b}[0m" } else { "error:" }
}

/// Writes a result. A reader that has left, such as `head`, has had enough: that is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(e).context("cannot write to standard output").map_err(Failure::Work)
        }
        _ => Ok(()),
    }
}

/// Writes a result as one line of JSON.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(value).context("cannot write JSON").map_err(Failure::Work)?;
    print(&format!("{text}\n"))
}
