//! Runs the built program as a user would.
mod convert;
mod diff;
mod errors;
mod explain;
mod help;
mod render;
#[cfg(unix)]
mod signals;
mod tables;
mod workplace;
