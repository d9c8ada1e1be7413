//! `sunfleck completions`.
use crate::{
    args::{Cli, CompletionsArgs},
    console,
    failure::Failure,
};
use clap::CommandFactory;

pub(crate) fn run(args: &CompletionsArgs) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "sunfleck", &mut script);
    console::print(&String::from_utf8_lossy(&script))
}
