//! `sunfleck`: the command line of the renderer.
//!
//! [`args`] says what can be said; each command has a room of its own ([`render`], [`info`], [`convert`], [`list`], [`diff`],
//! [`completions`]) that ends in `Ok` or a [`failure::Failure`], which knows its exit code. Results go to standard output,
//! everything else to standard error.
#![forbid(unsafe_code)]

mod args;
mod bug;
mod compat;
mod completions;
mod console;
mod convert;
mod destination;
mod diff;
mod failure;
mod info;
mod list;
mod load;
mod machine;
mod render;
mod table;
mod words;

use args::{Cli, Command};
use clap::Parser;
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    let command = Cli::parse().command;
    match bug::caught(|| run(&command)) {
        Some(Ok(())) => ExitCode::SUCCESS,
        Some(Err(failure)) => failure.report(),
        None => ExitCode::from(bug::EXIT_CODE),
    }
}

fn run(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Render(args) => render::run(args),
        Command::Info(args) => info::run(args),
        Command::Convert(args) => convert::run(args),
        Command::List(args) => list::run(args),
        Command::Diff(args) => diff::run(args),
        Command::Completions(args) => completions::run(args),
    }
}
