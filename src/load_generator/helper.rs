//! Child process of the load generator. It reads commands line by line and answers each with a JSON object on one line.

use std::{
    io::{BufRead, BufReader, Write},
    os::unix::process::CommandExt,
    process::{Child, ChildStdin, Command, Stdio},
    sync::mpsc::{Receiver, channel},
    time::Duration,
};

use anyhow::Context;
use serde_json::Value;

/// Longest wait for an answer; a process that takes longer is broken.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(240);

/// Child process of this binary, which ends with this one.
pub(super) struct Helper {
    name: String,
    child: Child,
    input: Option<ChildStdin>,
    lines: Receiver<String>,
}

impl Helper {
    /// Starts `treadmill bench` with `args`, at this nice value.
    pub(super) fn start(args: &[String], nice: i32) -> anyhow::Result<Self> {
        let name = args.first().cloned().unwrap_or_default();
        let mut child = command(&[&["bench".to_string()], args].concat(), nice)?
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
    pub(super) fn send(&mut self, line: &str) -> anyhow::Result<()> {
        let input = self.input.as_mut().context("standard input is piped")?;
        writeln!(input, "{line}").and_then(|()| input.flush()).with_context(|| format!("{} is gone", self.name))
    }

    /// Returns the next answer.
    pub(super) fn receive(&mut self) -> anyhow::Result<Value> {
        let line = self.lines.recv_timeout(ANSWER_TIMEOUT).with_context(|| format!("{} does not answer", self.name))?;
        serde_json::from_str(&line).with_context(|| format!("{} answered `{line}`", self.name))
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

/// Returns the command of this binary with `args`, at this nice value; the process is killed when this one ends.
pub(crate) fn command(args: &[String], nice: i32) -> anyhow::Result<Command> {
    let program = std::env::current_exe().context("this program's own path is unknown")?;
    let mut command = Command::new(program);
    command.args(args);
    // SAFETY: between fork and exec, nice and prctl are allowed, and they access no memory here.
    unsafe {
        command.pre_exec(move || {
            // Fails only for negative values.
            libc::nice(nice);
            match libc::prctl(libc::PR_SET_PDEATHSIG, libc::SIGKILL) {
                0 => Ok(()),
                _ => Err(std::io::Error::last_os_error()),
            }
        });
    }
    Ok(command)
}

/// Returns a number of an answer.
pub(super) fn number(answer: &Value, field: &str) -> anyhow::Result<f64> {
    answer[field].as_f64().with_context(|| format!("`{field}` is missing in {answer}"))
}

/// Returns the numbers of a list.
pub(super) fn numbers(list: &Value) -> impl Iterator<Item = f64> + '_ {
    list.as_array().into_iter().flatten().filter_map(Value::as_f64)
}
