//! The command line of sunfleck.
#![forbid(unsafe_code)]
fn main() {}
