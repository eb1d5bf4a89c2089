//! Child process of the load generator. It reads commands line by line and answers each with a JSON object on one line.

use std::{
    io::{BufRead, BufReader, Write},
    path::{Path, PathBuf},
    process::{Child, ChildStdin, Command, Stdio},
    sync::mpsc::{Receiver, channel},
    time::Duration,
};

use anyhow::Context;
use serde_json::Value;
use treadmill_rl::launch::child;

/// Longest wait for an answer; a process that takes longer is broken.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(240);

/// Child process of this binary, which ends with this one.
pub struct Helper {
    name: String,
    child: Child,
    input: Option<ChildStdin>,
    lines: Receiver<String>,
}

impl Helper {
    /// Starts this program with `args`, at this nice value.
    pub fn start(args: &[String], nice: i32) -> anyhow::Result<Self> {
        let name = args.first().cloned().unwrap_or_default();
        let mut child = child::command(&own_path()?, nice)
            .args(args)
            // The child ends when this closes.
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
    pub fn send(&mut self, line: &str) -> anyhow::Result<()> {
        let input = self.input.as_mut().context("standard input is piped")?;
        writeln!(input, "{line}").and_then(|()| input.flush()).with_context(|| format!("{} is gone", self.name))
    }

    /// Returns the next answer.
    pub fn receive(&mut self) -> anyhow::Result<Value> {
        let line = self.lines.recv_timeout(ANSWER_TIMEOUT).with_context(|| format!("{} does not answer", self.name))?;
        serde_json::from_str(&line).with_context(|| format!("{} answered `{line}`", self.name))
    }

    /// Sends a command and returns the answer.
    pub fn ask(&mut self, line: &str) -> anyhow::Result<Value> {
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

/// Returns the command of the program `treadmill` beside this one with `args`, at this nice value.
pub fn treadmill(args: &[String], nice: i32) -> anyhow::Result<Command> {
    let program = own_path()?.with_file_name("treadmill");
    anyhow::ensure!(program.exists(), "{} does not exist; run: cargo build --release", program.display());
    let mut command = child::command(&program, nice);
    command.args(args);
    Ok(command)
}

/// Makes certificates for this machine in `folder`, and returns the flags that use them.
pub fn certify(folder: &Path) -> anyhow::Result<[String; 2]> {
    let folder = folder.display().to_string();
    let args = ["certs", &folder, "--host", "localhost", "--host", "127.0.0.1", "--days", "1"].map(str::to_string);
    let made = treadmill(&args, 0)?.stdout(Stdio::null()).status().context("certificates cannot be made")?;
    anyhow::ensure!(made.success(), "making certificates ended with {made}");
    Ok(["--tls".to_string(), folder])
}

fn own_path() -> anyhow::Result<PathBuf> {
    std::env::current_exe().context("this program's own path is unknown")
}

/// Returns a number of an answer.
pub fn number(answer: &Value, field: &str) -> anyhow::Result<f64> {
    answer[field].as_f64().with_context(|| format!("`{field}` is missing in {answer}"))
}

/// Returns the numbers of a list.
pub fn numbers(list: &Value) -> impl Iterator<Item = f64> + '_ {
    list.as_array().into_iter().flatten().filter_map(Value::as_f64)
}
