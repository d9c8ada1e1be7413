use crate::workplace::Workplace;
use std::io::{BufRead, BufReader, Lines};
use std::process::{Child, ChildStderr, ChildStdout, Command};

/// A render that runs until it is stopped.
struct Running {
    child: Child,
    out: Lines<BufReader<ChildStdout>>,
    err: Lines<BufReader<ChildStderr>>,
}

impl Running {
    fn start(place: &Workplace, args: &str) -> Self {
        let mut child = place.command(args).spawn().unwrap();
        let out = BufReader::new(child.stdout.take().unwrap()).lines();
        let err = BufReader::new(child.stderr.take().unwrap()).lines();
        Self { child, out, err }
    }
    fn signal(&self, name: &str) {
        let sent = Command::new("kill").args(["-s", name, &self.child.id().to_string()]).status().unwrap();
        assert!(sent.success());
    }
    /// Reads standard error up to a line with `text`.
    fn wait_for(&mut self, text: &str) {
        assert!(self.err.by_ref().any(|line| line.unwrap().contains(text)), "`{text}` was never said");
    }
    /// Its exit code and the rest of what it said.
    fn end(&mut self) -> (Option<i32>, String) {
        let rest: Vec<String> = self.err.by_ref().map(Result::unwrap).collect();
        (self.child.wait().unwrap().code(), rest.join("\n"))
    }
}

impl Drop for Running {
    /// A test that fails must not leave a program behind.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_signal_stops_the_render_and_the_picture_is_written() {
    for signal in ["INT", "TERM"] {
        let place = Workplace::new();
        let args = "render ball.scn --width 32 --height 32 --passes 1000000 -o a.png -o a.exr --json=lines";
        let mut running = Running::start(&place, args);
        running.out.next().unwrap().unwrap();
        running.signal(signal);
        let done = running.out.by_ref().map(Result::unwrap).last().unwrap();
        let (code, said) = running.end();
        assert_eq!(code, Some(130), "{signal}: {said}");
        assert!(done.contains(r#""stopped_by":"interrupt""#), "{done}");
        let passes: serde_json::Value = serde_json::from_str(&done).unwrap();
        let metadata = place.image("a.exr").metadata;
        assert!(metadata.contains(&("passes".to_owned(), passes["passes"].to_string())), "{metadata:?}");
        assert_eq!(place.image("a.png").image.width, 32);
    }
}

#[test]
fn a_second_signal_ends_the_program_at_once() {
    let place = Workplace::new();
    // One pass takes minutes.
    let args = "render ball.scn --width 200 --height 200 --integrator photonmap --set samples=100000 -o a.png";
    let mut running = Running::start(&place, args);
    running.wait_for("integrator");
    running.signal("INT");
    running.wait_for("stopping after this pass");
    running.signal("INT");
    assert_eq!(running.end().0, Some(130));
    assert_eq!(place.files(), ["ball.scn"]);
}

#[test]
fn a_file_that_cannot_be_written_is_named_and_the_others_are_written() {
    let place = Workplace::new();
    std::fs::create_dir(place.path("gone")).unwrap();
    let args = "render ball.scn --width 16 --height 16 --passes 1000000 -o gone/a.exr -o b.exr --json=lines";
    let mut running = Running::start(&place, args);
    running.out.next().unwrap().unwrap();
    std::fs::remove_dir(place.path("gone")).unwrap();
    running.signal("INT");
    let mut rest = String::new();
    running.out.by_ref().for_each(|line| rest = line.unwrap());
    let (code, said) = running.end();
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("error: gone/a.exr: cannot write the file"), "{said}");
    assert!(rest.contains("cannot write the file"), "{rest}");
    assert_eq!(place.image("b.exr").image.width, 16);
}
