//! Process of the load generator: it reads commands line by line and answers with one JSON object a line.

use std::{
    io::{BufRead, BufReader, Write},
    process::{Child, ChildStdin, Command, Stdio},
    sync::mpsc::{Receiver, channel},
    time::Duration,
};

use anyhow::Context;
use serde_json::Value;

/// An answer that takes longer means that the process is broken.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(240);

/// A process of this binary that ends when this one does.
pub(super) struct Helper {
    name: String,
    child: Child,
    input: Option<ChildStdin>,
    lines: Receiver<String>,
}

impl Helper {
    /// Starts `treadmill bench` with these arguments.
    pub(super) fn start(args: &[String]) -> anyhow::Result<Self> {
        let program = std::env::current_exe().context("this program's own path is unknown")?;
        let name = args.first().cloned().unwrap_or_default();
        let mut child = Command::new(program)
            .arg("bench")
            .args(args)
            // It ends when this closes, which it does by itself when this process is gone.
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .with_context(|| format!("{name} cannot be started"))?;
        let (input, output) = (child.stdin.take(), child.stdout.take().context("standard output is piped")?);
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    return;
                }
            }
        });
        Ok(Self { name, child, input, lines })
    }

    /// Sends a command.
    pub(super) fn send(&mut self, line: &str) -> anyhow::Result<()> {
        let input = self.input.as_mut().context("standard input is piped")?;
        writeln!(input, "{line}").and_then(|()| input.flush()).with_context(|| format!("{} is gone", self.name))
    }

    /// Next answer.
    pub(super) fn receive(&mut self) -> anyhow::Result<Value> {
        let line = self.lines.recv_timeout(ANSWER_TIMEOUT).with_context(|| format!("{} says nothing", self.name))?;
        serde_json::from_str(&line).with_context(|| format!("{} said `{line}`", self.name))
    }

    /// Sends a command and returns the answer.
    pub(super) fn ask(&mut self, line: &str) -> anyhow::Result<Value> {
        self.send(line)?;
        self.receive()
    }
}

impl Drop for Helper {
    fn drop(&mut self) {
        drop(self.input.take());
        let begun = std::time::Instant::now();
        while begun.elapsed() < Duration::from_secs(5) {
            if matches!(self.child.try_wait(), Ok(Some(_)) | Err(_)) {
                return;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A number in what a helper said.
pub(super) fn number(said: &Value, field: &str) -> anyhow::Result<f64> {
    said[field].as_f64().with_context(|| format!("`{field}` is missing in {said}"))
}
