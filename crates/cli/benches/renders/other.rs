//! Any other renderer, by its command line.
use super::child::{self, Cost};
use anyhow::ensure;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// A name and a template.
pub(crate) struct Other {
    pub(crate) name: String,
    words: Vec<String>,
}

/// What stands for the placeholders.
pub(crate) struct Job<'a> {
    pub(crate) scene: &'a Path,
    pub(crate) size: (u32, u32),
    pub(crate) time: Duration,
    pub(crate) threads: usize,
    /// Where its picture goes, without extension.
    pub(crate) out: &'a Path,
}

impl Other {
    /// `NAME=COMMAND`; words of the command are parted by spaces, and there is no quoting: what needs more is a script.
    pub(crate) fn parse(text: &str) -> anyhow::Result<Self> {
        let (name, command) = text.split_once('=').unwrap_or(("", text));
        let words: Vec<String> = command.split_whitespace().map(str::to_owned).collect();
        ensure!(!name.is_empty() && !words.is_empty(), "`--other {text}` is not NAME=COMMAND");
        ensure!(command.contains("{out"), "the command of {name} has no {{out}} for its picture");
        Ok(Self { name: name.to_owned(), words })
    }

    /// Runs it; returns its cost, and its picture.
    pub(crate) fn run(&self, job: &Job) -> anyhow::Result<(Cost, PathBuf)> {
        let mut picture = job.out.with_extension("exr");
        let words: Vec<String> = self.words.iter().map(|w| job.fill(w, &mut picture)).collect();
        let cost = child::run(Command::new(&words[0]).args(&words[1..]))?.cost;
        ensure!(picture.is_file(), "{} wrote no {}", self.name, picture.display());
        Ok((cost, picture))
    }
}

impl Job<'_> {
    /// The word with values for placeholders; `picture` takes the extension that it asks for.
    fn fill(&self, word: &str, picture: &mut PathBuf) -> String {
        let mut word = word.to_owned();
        if let Some((before, rest)) = word.clone().split_once("{out")
            && let Some((extension, after)) = rest.split_once('}')
        {
            if let Some(extension) = extension.strip_prefix('.') {
                picture.set_extension(extension);
            }
            word = format!("{before}{}{after}", picture.display());
        }
        let stem = self.scene.with_extension("");
        let values = [
            ("{scene}", self.scene.display().to_string()),
            ("{stem}", stem.display().to_string()),
            ("{seconds}", self.time.as_secs_f64().to_string()),
            ("{threads}", self.threads.to_string()),
            ("{width}", self.size.0.to_string()),
            ("{height}", self.size.1.to_string()),
        ];
        values.iter().fold(word, |word, (name, value)| word.replace(name, value))
    }
}
