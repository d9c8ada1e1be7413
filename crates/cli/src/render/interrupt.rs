//! Ctrl-C, SIGTERM and the like: the first ends the render after the running pass, the second ends the program.
use crate::console;
use anyhow::Context;
use std::process::exit;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether the user has had enough.
pub(super) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens from now on. Before, a signal ends the program: there is nothing to keep yet.
    pub(super) fn listen() -> anyhow::Result<Self> {
        let requested = Arc::new(AtomicBool::new(false));
        let shared = Arc::clone(&requested);
        ctrlc::set_handler(move || {
            if shared.swap(true, Ordering::SeqCst) {
                exit(130);
            }
            console::say("\nstopping after this pass, then writing the picture; again to end at once");
        })
        .context("cannot listen to Ctrl-C")?;
        Ok(Self(requested))
    }
    pub(super) fn requested(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}
