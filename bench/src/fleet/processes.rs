//! Learner and routers as child processes, and their use of the machine.

use std::{
    collections::HashMap,
    fs::{self, File},
    io::{BufRead, BufReader},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};

use anyhow::Context;

use crate::helper::treadmill;

/// Longest wait until a learner listens.
const START_TIMEOUT: Duration = Duration::from_secs(60);
/// Longest wait until a process has ended.
const STOP_TIMEOUT: Duration = Duration::from_secs(30);
const POLL: Duration = Duration::from_millis(20);
/// Nice value of routers and played actors, so that the learner has the machine as if they ran elsewhere.
pub const NICE: i32 = 19;
/// Name of the learner's thread that collects, updates and saves.
const TRAINING_THREAD: &str = "training";

/// Child process of this binary, which ends with this one.
pub struct Process {
    child: Child,
    /// Endpoint that it listens on.
    pub endpoint: String,
    /// What it is, for errors.
    name: &'static str,
    /// File that it writes to, if it does.
    log: Option<PathBuf>,
}

impl Process {
    /// Starts a learner whose run folder is `run`; it writes to `log`.
    pub fn learner(args: &[String], run: &Path, log: PathBuf) -> anyhow::Result<Self> {
        let log_file = File::create(&log).with_context(|| format!("cannot create `{}`", log.display()))?;
        let output = log_file.try_clone().context("the log cannot be shared")?;
        let mut command = treadmill(args, 0)?;
        command.stdin(Stdio::null()).stdout(output).stderr(log_file);
        let child = command.spawn().context("the learner cannot be started")?;
        let mut learner = Self { child, endpoint: String::new(), name: "the learner", log: Some(log) };
        let (file, begun) = (run.join("endpoint.txt"), Instant::now());
        loop {
            match fs::read_to_string(&file) {
                Ok(text) if text.ends_with('\n') => learner.endpoint = text.trim().to_string(),
                _ => std::thread::sleep(POLL),
            }
            learner.check_runs()?;
            if !learner.endpoint.is_empty() {
                return Ok(learner);
            }
            anyhow::ensure!(begun.elapsed() < START_TIMEOUT, "the learner does not listen");
        }
    }

    /// Fails if the process has ended, with the last line that it wrote.
    pub fn check_runs(&mut self) -> anyhow::Result<()> {
        let Some(status) = self.child.try_wait()? else { return Ok(()) };
        let text = self.log.as_ref().and_then(|log| fs::read_to_string(log).ok()).unwrap_or_default();
        anyhow::bail!("{} ended with {status}: {}", self.name, text.trim_end().lines().last().unwrap_or_default())
    }

    /// Starts a router that dials the learner at `to`.
    pub fn router(listen: &str, to: &str, network: &[String]) -> anyhow::Result<Self> {
        let args = ["router", "--listen", listen, "--connect", to].map(str::to_string);
        let mut child = treadmill(&[&args, network].concat(), NICE)?
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .context("a router cannot be started")?;
        let mut lines = BufReader::new(child.stdout.take().context("standard output is piped")?).lines();
        let listening = lines.next().transpose().ok().flatten().unwrap_or_default();
        let endpoint = listening.strip_prefix("listening ").context("a router does not listen")?.trim().to_string();
        // Its other lines are read, so that it never waits for space in the pipe.
        std::thread::spawn(move || lines.for_each(drop));
        Ok(Self { child, endpoint, name: "a router", log: None })
    }

    /// Asks the process to stop and waits for its end.
    pub fn stop(&mut self) -> anyhow::Result<()> {
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

    fn file(&self, name: &str) -> String {
        fs::read_to_string(PathBuf::from(format!("/proc/{}/{name}", self.child.id()))).unwrap_or_default()
    }

    /// Returns the processor time of all threads in seconds.
    pub fn cpu_s(&self) -> f64 {
        let stat = self.file("stat");
        // The name, in brackets, may contain spaces. User and system time are fields 14 and 15 of the line.
        let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
        let ticks = |field: usize| fields.get(field - 3).and_then(|ticks| ticks.parse::<f64>().ok()).unwrap_or(0.0);
        // SAFETY: sysconf takes a number and accesses no memory.
        let per_s = unsafe { libc::sysconf(libc::_SC_CLK_TCK) } as f64;
        (ticks(14) + ticks(15)) / per_s.max(1.0)
    }

    /// Returns the peak of resident memory in MB.
    pub fn resident_max_mb(&self) -> f64 {
        let status = self.file("status");
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or_default();
        let kib: Option<f64> = line.trim().trim_end_matches("kB").trim().parse().ok();
        kib.unwrap_or(0.0) * 1024.0 / 1e6
    }

    /// Returns the processor time of the learner's training thread in seconds. `None` if the kernel does not count it.
    pub fn training_thread_s(&self) -> Option<f64> {
        let tasks = fs::read_dir(format!("/proc/{}/task", self.child.id())).ok()?;
        let is_training =
            |task: &PathBuf| fs::read_to_string(task.join("comm")).is_ok_and(|name| name.trim() == TRAINING_THREAD);
        let task = tasks.flatten().map(|task| task.path()).find(is_training)?;
        let counts = fs::read_to_string(task.join("schedstat")).ok()?;
        let ran_ns: f64 = counts.split_whitespace().next()?.parse().ok()?;
        Some(ran_ns / 1e9)
    }

    /// Returns the bytes that the process has sent over each connection to its endpoint, by the other end's address.
    /// `None` if this machine has no program `ss`.
    pub fn sent_bytes(&self) -> Option<HashMap<String, u64>> {
        let port = self.endpoint.rsplit(':').next()?;
        let output = Command::new("ss").args(["-tinH", "sport", "=", &format!(":{port}")]).output().ok()?;
        output.status.success().then(|| sent_by_peer(&String::from_utf8_lossy(&output.stdout)))
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sent_bytes_are_read_for_each_connection() {
        let output = "ESTAB 0      0      127.0.0.1:47725 127.0.0.1:34142\n\t bbr wscale:10,10 rto:204 bytes_sent:100000 \
                      bytes_acked:99000 send 3bps\nESTAB 0 3 127.0.0.1:47725 127.0.0.1:34144 \n\t cubic rto:204 rtt:0.1/0.2\n";
        let expected = [("127.0.0.1:34142".to_string(), 100_000), ("127.0.0.1:34144".to_string(), 0)];
        assert_eq!(sent_by_peer(output), HashMap::from(expected));
        assert!(sent_by_peer("").is_empty());
    }
}
