//! Child processes, which end with this one, and their use of the machine.

use std::{
    collections::HashMap,
    fs::{self, File},
    io::{BufRead, BufReader, Write},
    path::{Path, PathBuf},
    process::{Child, ChildStdin, Command, Stdio},
    sync::mpsc::{Receiver, channel},
    time::{Duration, Instant},
};

use anyhow::Context;
use serde_json::Value;
use treadmill_rl::launch::child;

/// Longest wait for an answer; a process that takes longer is broken.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(240);
/// Longest wait until a process has ended.
const STOP_TIMEOUT: Duration = Duration::from_secs(30);
const POLL: Duration = Duration::from_millis(20);

/// Child process.
pub struct Process {
    name: &'static str,
    child: Child,
    /// Its end is a request to stop.
    input: Option<ChildStdin>,
    lines: Receiver<String>,
    /// File that it writes its log to.
    log: Option<PathBuf>,
}

impl Process {
    /// Starts this program's command `name`, at this nice value.
    pub fn of_bench(name: &'static str, args: &[String], nice: i32) -> anyhow::Result<Self> {
        let mut command = child::command(&own_path()?, nice);
        command.arg(name).args(args);
        Self::start(name, command, None)
    }

    /// Starts the command `name` of the program `treadmill`, at this nice value. Its log goes to `log`.
    pub fn of_treadmill(name: &'static str, args: &[String], nice: i32, log: Option<PathBuf>) -> anyhow::Result<Self> {
        let mut command = treadmill(nice)?;
        command.arg(name).args(args);
        Self::start(name, command, log)
    }

    fn start(name: &'static str, mut command: Command, log: Option<PathBuf>) -> anyhow::Result<Self> {
        if let Some(log) = &log {
            command.stderr(File::create(log).with_context(|| format!("cannot create `{}`", log.display()))?);
        }
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().with_context(|| format!("{name} cannot be started"))?;
        let (input, output) = (child.stdin.take(), child.stdout.take().context("standard output is piped")?);
        let (sender, lines) = channel();
        // Reads on, so that the process never waits for space in the pipe.
        std::thread::spawn(move || {
            BufReader::new(output).lines().map_while(Result::ok).for_each(|line| drop(sender.send(line)));
        });
        Ok(Self { name, child, input, lines, log })
    }

    /// Returns the next line.
    pub fn line(&mut self) -> anyhow::Result<String> {
        self.lines.recv_timeout(ANSWER_TIMEOUT).with_context(|| format!("{} does not answer", self.name))
    }

    /// Sends a command.
    pub fn send(&mut self, line: &str) -> anyhow::Result<()> {
        let input = self.input.as_mut().context("standard input is piped")?;
        writeln!(input, "{line}").and_then(|()| input.flush()).with_context(|| format!("{} is gone", self.name))
    }

    /// Returns the next answer.
    pub fn receive(&mut self) -> anyhow::Result<Value> {
        let line = self.line()?;
        serde_json::from_str(&line).with_context(|| format!("{} answered `{line}`", self.name))
    }

    /// Sends a command and returns the answer.
    pub fn ask(&mut self, line: &str) -> anyhow::Result<Value> {
        self.send(line)?;
        self.receive()
    }

    /// Fails if the process has ended, with the last line of its log.
    pub fn check_runs(&mut self) -> anyhow::Result<()> {
        let Some(status) = self.child.try_wait()? else { return Ok(()) };
        let text = self.log.as_ref().and_then(|log| fs::read_to_string(log).ok()).unwrap_or_default();
        anyhow::bail!("{} ended with {status}: {}", self.name, text.trim_end().lines().last().unwrap_or_default())
    }

    /// Asks the process to stop and waits for its end.
    pub fn stop(mut self) -> anyhow::Result<()> {
        // SAFETY: kill takes two numbers and accesses no memory. The child was not waited for, so its number is its own.
        unsafe { libc::kill(self.child.id() as i32, libc::SIGTERM) };
        let begun = Instant::now();
        while begun.elapsed() < STOP_TIMEOUT {
            if let Some(status) = self.child.try_wait()? {
                anyhow::ensure!(status.success(), "{} ended with {status}", self.name);
                return Ok(());
            }
            std::thread::sleep(POLL);
        }
        anyhow::bail!("{} does not stop", self.name)
    }

    /// Returns the processor time of all threads in seconds.
    pub fn cpu_s(&self) -> f64 {
        cpu_s(self.child.id())
    }

    /// Returns the peak of resident memory in MB.
    pub fn resident_max_mb(&self) -> f64 {
        self.memory_mb("VmHWM:")
    }

    /// Returns the resident shared memory in MB.
    pub fn shared_mb(&self) -> f64 {
        self.memory_mb("RssShmem:")
    }

    fn memory_mb(&self, entry: &str) -> f64 {
        let status = proc_file(self.child.id(), "status");
        let line = status.lines().find_map(|line| line.strip_prefix(entry)).unwrap_or_default();
        let kib: Option<f64> = line.trim().trim_end_matches("kB").trim().parse().ok();
        kib.unwrap_or(0.0) * 1024.0 / 1e6
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        drop(self.input.take());
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn proc_file(process: u32, name: &str) -> String {
    fs::read_to_string(format!("/proc/{process}/{name}")).unwrap_or_default()
}

/// Returns the processor time of all threads of a process in seconds.
pub fn cpu_s(process: u32) -> f64 {
    let stat = proc_file(process, "stat");
    // The name, in brackets, may contain spaces. User and system time are fields 14 and 15 of the line.
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |field: usize| fields.get(field - 3).and_then(|ticks| ticks.parse::<f64>().ok()).unwrap_or(0.0);
    // SAFETY: sysconf takes a number and accesses no memory.
    let per_s = unsafe { libc::sysconf(libc::_SC_CLK_TCK) } as f64;
    (ticks(14) + ticks(15)) / per_s.max(1.0)
}

/// Returns the bytes sent over each connection to a listening endpoint, by the other end's address. `None` if this machine
/// has no program `ss`.
pub fn sent_bytes(endpoint: &str) -> Option<HashMap<String, u64>> {
    let port = endpoint.rsplit(':').next()?;
    let output = Command::new("ss").args(["-tinH", "sport", "=", &format!(":{port}")]).output().ok()?;
    output.status.success().then(|| sent_by_peer(&String::from_utf8_lossy(&output.stdout)))
}

/// Reads the output of `ss -tinH`: a line for each connection, and an indented one with its counters.
fn sent_by_peer(output: &str) -> HashMap<String, u64> {
    let (mut sent, mut peer) = (HashMap::new(), "");
    for line in output.lines() {
        match line.starts_with(char::is_whitespace) {
            false => peer = line.split_whitespace().nth(4).unwrap_or_default(),
            true => {
                let bytes = line.split_whitespace().find_map(|field| field.strip_prefix("bytes_sent:")?.parse().ok());
                sent.insert(peer.to_string(), bytes.unwrap_or(0));
            }
        }
    }
    sent
}

/// Returns the command of the program `treadmill` beside this one, at this nice value.
fn treadmill(nice: i32) -> anyhow::Result<Command> {
    let program = own_path()?.with_file_name("treadmill");
    anyhow::ensure!(program.exists(), "{} does not exist; run: cargo build --release", program.display());
    Ok(child::command(&program, nice))
}

fn own_path() -> anyhow::Result<PathBuf> {
    std::env::current_exe().context("this program's own path is unknown")
}

/// Makes certificates for this machine in `folder`, and returns the flags that use them.
pub fn certify(folder: &Path) -> anyhow::Result<[String; 2]> {
    let folder = folder.display().to_string();
    let mut command = treadmill(0)?;
    command.args(["certs", &folder, "--host", "localhost", "--host", "127.0.0.1", "--days", "1"]);
    let made = command.stdout(Stdio::null()).status().context("certificates cannot be made")?;
    anyhow::ensure!(made.success(), "making certificates ended with {made}");
    Ok(["--tls".to_string(), folder])
}

/// Returns a number of an answer.
pub fn number(answer: &Value, field: &str) -> anyhow::Result<f64> {
    answer[field].as_f64().with_context(|| format!("`{field}` is missing in {answer}"))
}

/// Returns flags with their values.
pub fn flags(pairs: &[(&str, String)]) -> Vec<String> {
    pairs.iter().flat_map(|(flag, value)| [(*flag).to_string(), value.clone()]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sent_bytes_are_read_for_each_connection() {
        let output = "ESTAB 0      0      127.0.0.1:47725 127.0.0.1:34142\n\t bbr wscale:10,10 rto:204 \
                      bytes_sent:100000 bytes_acked:99000 send 3bps\nESTAB 0 3 127.0.0.1:47725 127.0.0.1:34144 \n\t \
                      cubic rto:204 rtt:0.1/0.2\n";
        let expected = [("127.0.0.1:34142".to_string(), 100_000), ("127.0.0.1:34144".to_string(), 0)];
        assert_eq!(sent_by_peer(output), HashMap::from(expected));
        assert!(sent_by_peer("").is_empty());
    }
}
