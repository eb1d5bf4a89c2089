//! What the viewer's tests share: its real binary, and a real browser.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod browser;
pub mod picture;

use std::{
    io::{BufRead, BufReader},
    path::{Path, PathBuf},
    process::{Child, Command, ExitStatus, Stdio},
    sync::mpsc::{Receiver, channel},
    time::{Duration, Instant},
};

/// Nothing in these tests takes this long unless it is broken; a browser without a GPU takes a while for its first picture.
pub const PATIENCE: Duration = Duration::from_secs(300);

/// The root of the repository.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The policy that comes along.
pub fn policy() -> PathBuf {
    root().join("docs/results/policy.safetensors")
}

/// The viewer.
pub fn viewer(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_treadmill-watch"));
    command.current_dir(folder).env_remove("TREADMILL_LOG").stdin(Stdio::null());
    command
}

/// The trainer's binary of the same build, which these tests do not build.
pub fn treadmill(folder: &Path) -> Option<Command> {
    let program = Path::new(env!("CARGO_BIN_EXE_treadmill-watch")).with_file_name("treadmill");
    if !program.is_file() {
        skip("build the trainer first: cargo build --release");
        return None;
    }
    let mut command = Command::new(program);
    command.current_dir(folder).env_remove("TREADMILL_LOG").stdin(Stdio::null());
    Some(command)
}

/// Says loudly that a test was left out; with TREADMILL_STRICT=yes none may be.
#[allow(clippy::print_stderr, reason = "a test that was left out must say so")]
pub fn skip(why: &str) {
    assert!(std::env::var("TREADMILL_STRICT").as_deref() != Ok("yes"), "{why}");
    eprintln!("SKIPPED: {why}");
}

/// A process that is killed when the test is over, however it ends.
pub struct Running {
    child: Child,
    lines: Receiver<String>,
}

impl Running {
    /// Starts and follows what it says.
    pub fn start(mut command: Command) -> Self {
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the binary starts");
        let (sender, lines) = channel();
        let out = child.stdout.take().expect("piped");
        let err = child.stderr.take().expect("piped");
        let streams: [Box<dyn std::io::Read + Send>; 2] = [Box::new(out), Box::new(err)];
        for stream in streams {
            let sender = sender.clone();
            std::thread::spawn(move || {
                let lines = BufReader::new(stream).lines().map_while(Result::ok);
                lines.take_while(|line| sender.send(line.clone()).is_ok()).for_each(drop);
            });
        }
        Self { child, lines }
    }

    /// Waits for a line that contains `part`.
    pub fn wait_for(&self, part: &str) -> String {
        let until = Instant::now() + PATIENCE;
        let mut seen = Vec::new();
        loop {
            match self.lines.recv_timeout(until.saturating_duration_since(Instant::now())) {
                Ok(line) if line.contains(part) => return line,
                Ok(line) => seen.push(line),
                Err(why) => panic!("no line with `{part}` ({why}); seen: {seen:#?}"),
            }
        }
    }

    /// Sends a signal.
    pub fn signal(&self, signal: i32) {
        // SAFETY: kill takes two numbers and touches no memory of ours.
        let sent = unsafe { libc::kill(self.child.id() as i32, signal) };
        assert_eq!(sent, 0, "it can be signalled");
    }

    /// Waits for the end.
    pub fn wait(mut self) -> ExitStatus {
        await_that("the process ends", || self.child.try_wait().expect("it can be waited for"))
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Looks until `look` finds something.
pub fn await_that<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let until = Instant::now() + PATIENCE;
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(Instant::now() < until, "waited in vain: {what}");
        std::thread::sleep(Duration::from_millis(20));
    }
}
