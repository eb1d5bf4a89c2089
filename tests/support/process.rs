//! Processes under test, waiting for conditions, and skipped tests. The viewer's tests use this file too.

use std::{
    io::{BufRead, BufReader},
    process::{Child, Command, ExitStatus},
    sync::mpsc::{Receiver, RecvTimeoutError, channel},
    time::{Duration, Instant},
};

use super::TIMEOUT;

/// Process that is killed when it is dropped.
pub struct Running {
    child: Child,
    lines: Receiver<String>,
}

impl Running {
    /// Starts a process and reads its standard output and standard error, which share a pipe: lines come in the order in
    /// which they were written.
    pub fn start(mut command: Command) -> Self {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        let both = writer.try_clone().expect("a pipe");
        let child = command.stdout(both).stderr(writer).spawn().expect("the binary starts");
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(reader).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    return;
                }
            }
        });
        Self { child, lines }
    }

    /// Returns the process ID.
    pub fn pid(&self) -> u32 {
        self.child.id()
    }

    /// Waits for a line that contains `part`, and returns it.
    pub fn wait_for(&self, part: &str) -> String {
        let until = Instant::now() + TIMEOUT;
        let mut seen = Vec::new();
        loop {
            match self.lines.recv_timeout(until.saturating_duration_since(Instant::now())) {
                Ok(line) if line.contains(part) => return line,
                Ok(line) => seen.push(line),
                Err(RecvTimeoutError::Timeout) => panic!("no line with `{part}`; seen: {seen:#?}"),
                Err(RecvTimeoutError::Disconnected) => panic!("the process ended without `{part}`; seen: {seen:#?}"),
            }
        }
    }

    /// Sends a signal.
    pub fn signal(&self, signal: i32) {
        send_signal(self.pid(), signal);
    }

    /// Waits for the end. Returns the status and all lines not read before.
    pub fn wait(mut self) -> (ExitStatus, Vec<String>) {
        let status = await_that("the end of the process", || self.child.try_wait().expect("a child"));
        // The streams stay open until the children of a killed process are gone.
        let mut lines = Vec::new();
        while let Ok(line) = self.lines.recv_timeout(Duration::from_secs(5)) {
            lines.push(line);
        }
        (status, lines)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Sends a signal to any process.
pub fn send_signal(pid: u32, signal: i32) {
    // SAFETY: kill takes two numbers and accesses no memory.
    let sent = unsafe { libc::kill(pid as i32, signal) };
    assert_eq!(sent, 0, "process {pid} cannot be signalled");
}

/// Polls until `poll` returns something. `what` describes it.
pub fn await_that<T>(what: &str, mut poll: impl FnMut() -> Option<T>) -> T {
    let until = Instant::now() + TIMEOUT;
    loop {
        if let Some(found) = poll() {
            return found;
        }
        assert!(Instant::now() < until, "timed out waiting for {what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Reports a skipped test; panics with TREADMILL_STRICT=yes.
#[allow(clippy::print_stderr, reason = "reports a skipped test")]
pub fn skip(why: &str) {
    assert!(std::env::var("TREADMILL_STRICT").as_deref() != Ok("yes"), "{why}");
    eprintln!("SKIPPED: {why}");
}

/// Returns whether a command succeeds.
pub fn works(program: &str, args: &[&str]) -> bool {
    Command::new(program).args(args).output().is_ok_and(|tried| tried.status.success())
}
