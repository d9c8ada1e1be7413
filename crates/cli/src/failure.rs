//! How a command ends when it does not end well.
use crate::console;
use formats::diagnostic::Error as SceneError;
use std::process::ExitCode;

/// Why a command did not do what was asked. Bad input is the user's to fix, failed work is not.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Something the user said or gave cannot be used.
    BadInput(anyhow::Error),
    /// The work itself failed, or a limit of `diff` was exceeded.
    Work(anyhow::Error),
    /// Ctrl-C; what was done so far is kept and told already.
    Interrupted,
}

impl Failure {
    /// Bad input, told in one line.
    pub(crate) fn input(message: impl Into<String>) -> Self {
        Self::BadInput(anyhow::Error::msg(message.into()))
    }

    /// Tells the user, and gives the exit code: 2, 1 or 130.
    pub(crate) fn report(self) -> ExitCode {
        let (code, error) = match self {
            Self::BadInput(error) => (2, error),
            Self::Work(error) => (1, error),
            Self::Interrupted => return ExitCode::from(130),
        };
        match error.downcast_ref::<SceneError>() {
            Some(found) => say_all(found),
            None => console::say(format_args!("{} {error:#}", console::error_word())),
        }
        ExitCode::from(code)
    }
}

fn say_all(found: &SceneError) {
    let colour = console::has_colour();
    found.warnings.iter().for_each(|w| console::say(format_args!("{}\n", w.render(colour))));
    console::say(found.render(colour));
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::BadInput(error.into())
    }
}
