//! A panic is a bug of ours: said in one line, without a trace.
use crate::console;
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook, take_hook};

/// What the process returns after a panic.
pub(crate) const EXIT_CODE: u8 = 1;

/// Runs `work`; a panic in it, on whatever thread, is told to the user and gives `None`.
pub(crate) fn caught<T>(work: impl FnOnce() -> T) -> Option<T> {
    set_hook(Box::new(|info| console::say(message(info))));
    // Nothing is used after a panic but the exit code.
    let result = catch_unwind(AssertUnwindSafe(work)).ok();
    drop(take_hook());
    result
}

fn message(info: &PanicHookInfo) -> String {
    let payload = info.payload();
    let text = payload.downcast_ref::<String>().map(String::as_str);
    let what = text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("no message");
    let place = info.location().map(|l| format!(" ({}:{})", l.file(), l.line())).unwrap_or_default();
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "{} this is a bug in sunfleck {version}: {what}{place}\nPlease report it with the command line and the scene.",
        console::error_word()
    )
}

#[cfg(test)]
mod tests {
    use super::caught;

    #[test]
    fn a_panic_on_any_thread_of_the_pool_is_caught() {
        assert_eq!(caught(|| 1), Some(1));
        let broken = || rayon::join(|| (), || panic!("as the test wants"));
        assert!(caught(broken).is_none());
    }
}
