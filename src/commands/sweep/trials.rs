//! Runs trials as child processes: `treadmill train`, some at a time.

use std::{
    collections::{BTreeMap, VecDeque},
    fs::{self, File},
    io::{Read, Seek, SeekFrom},
    os::unix::process::{CommandExt, ExitStatusExt},
    path::Path,
    process::{ExitStatus, Stdio},
    time::Duration,
};

use anyhow::Context;
use tokio::{process::Command, task::JoinSet, time::MissedTickBehavior};
use treadmill_runtime::{machine::cores, run_folder::RunFolder, run_lock, shutdown::Shutdown};

use super::{
    plan::{Plan, SweepFolder, Trial},
    study::Study,
};
use crate::launch::{child, exit_code::Usage, supervisor::own_program};

/// Free room (bytes) below which no further trial begins.
const ROOM_MIN_BYTES: u64 = 64 << 20;
/// Times that a trial which was killed goes on before that is its result.
const KILLS_MAX: u32 = 8;
/// Wait for a process that is about to leave a trial's folder.
const LOCK_TIMEOUT: Duration = Duration::from_secs(10);
/// Time between looks at what trials report to a study.
const FOLLOW_EVERY: Duration = Duration::from_millis(200);
/// Most bytes of a log's end that are searched for an error.
const LOG_END_BYTES: i64 = 8 << 10;

/// Trials that are to run.
pub(crate) struct TrialRunner<'a> {
    pub(crate) folder: &'a SweepFolder,
    pub(crate) shutdown: &'a Shutdown,
    /// Trials at once.
    pub(crate) parallel: usize,
    /// Environment steps at which all of them pause, if not at their end.
    pub(crate) pause_at: Option<u64>,
}

/// Why the remaining trials did not begin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Ended {
    /// All have begun.
    All,
    /// A stop was requested.
    Stopped,
    /// The disk is full.
    NoRoom,
}

impl TrialRunner<'_> {
    /// Runs trials of a plan, then those that a study proposes. Calls `ended` with each that has ended and its exit code,
    /// but not with one that stops because the sweep was asked to.
    ///
    /// # Errors
    /// If a process cannot be started, another process has a trial's folder, or `study` or `ended` fails.
    pub(crate) async fn run(
        &self,
        plan: &mut Plan,
        indices: &[usize],
        mut study: Option<&mut Study<'_>>,
        mut ended: impl FnMut(&mut Plan, usize, i32) -> anyhow::Result<()>,
    ) -> anyhow::Result<Ended> {
        let mut queue: VecDeque<(usize, u32)> = indices.iter().map(|index| (*index, 0)).collect();
        let mut running = JoinSet::new();
        let mut hopeless: BTreeMap<usize, Shutdown> = BTreeMap::new();
        let mut looks = tokio::time::interval(FOLLOW_EVERY);
        looks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        // Trials of the last round have the cores among themselves.
        let count = indices.len() + study.as_ref().map_or(0, |study| study.left(plan));
        let last_round = count - count % self.parallel;
        let (mut begun, mut outcome) = (0, Ended::All);
        loop {
            while running.len() < self.parallel && outcome == Ended::All {
                let has_next = |study: &&mut Study<'_>| study.has_next(plan, running.len());
                let next = study.as_mut().filter(|study| queue.is_empty() && has_next(study));
                if queue.is_empty() && next.is_none() {
                    break;
                } else if self.shutdown.asked() {
                    outcome = Ended::Stopped;
                } else if !self.has_room() {
                    outcome = Ended::NoRoom;
                } else if let Some(study) = next {
                    queue.extend(study.ask(plan)?.map(|index| (index, 0)));
                } else if let Some((index, kills)) = queue.pop_front() {
                    let round = if begun < last_round { self.parallel } else { count - last_round };
                    self.await_lock(index).await?;
                    // A hopeless one that was to go on after a kill ends as it is.
                    let child = (!plan.trials[index].is_pruned)
                        .then(|| self.start(plan, index, (cores() / round.max(1)).max(1)))
                        .transpose()?;
                    begun += 1;
                    let (shutdown, is_hopeless) = (self.shutdown.clone(), hopeless.entry(index).or_default().clone());
                    running.spawn(async move {
                        let Some(mut child) = child else { return (index, kills, Ok(ExitStatus::default())) };
                        let status = tokio::select! {
                            status = child.wait() => return (index, kills, status),
                            () = shutdown.wait() => child.id(),
                            () = is_hopeless.wait() => child.id(),
                        };
                        status.into_iter().for_each(interrupt);
                        (index, kills, child.wait().await)
                    });
                }
            }
            let done = tokio::select! {
                done = running.join_next() => Some(done),
                _ = looks.tick(), if study.is_some() => None,
            };
            if let Some(study) = &mut study {
                let ended = done.as_ref().and_then(|done| Some(done.as_ref()?.as_ref().ok()?.0));
                study.follow(plan, ended)?.iter().filter_map(|index| hopeless.get(index)).for_each(Shutdown::ask);
            }
            let Some(done) = done else { continue };
            let Some(done) = done else { break };
            let (index, kills, status) = done.context("a trial's task failed")?;
            let status = status.context("a trial cannot be waited for")?;
            let is_pruned = plan.trials[index].is_pruned;
            if self.shutdown.asked() && !is_pruned && !self.has_all_steps(plan, index) {
                outcome = Ended::Stopped;
            } else if !is_pruned && self.is_unfinished(plan, index, status.code()) && kills < KILLS_MAX {
                tracing::warn!(trial = index + 1, %status, "a trial was killed or stopped; it goes on from its checkpoint");
                queue.push_front((index, kills + 1));
            } else {
                ended(plan, index, code(status))?;
                study.as_mut().map_or(Ok(()), |study| study.end(plan, plan.trials[index].setting - 1))?;
            }
        }
        Ok(outcome)
    }

    /// Returns whether a trial ended before its steps without a failure: by a signal, or because it was asked to stop.
    fn is_unfinished(&self, plan: &Plan, index: usize, code: Option<i32>) -> bool {
        code.is_none() || code == Some(0) && !self.has_all_steps(plan, index)
    }

    /// Returns whether a trial that ended has all its steps.
    fn has_all_steps(&self, plan: &Plan, index: usize) -> bool {
        reached(&self.folder.trial(index)) >= self.pause_at.unwrap_or(plan.steps)
    }

    fn has_room(&self) -> bool {
        // A file system that does not say is tried.
        rustix::fs::statvfs(self.folder.root())
            .map_or(true, |space| space.f_bavail.saturating_mul(space.f_frsize) >= ROOM_MIN_BYTES)
    }

    /// Waits for a process that still has the folder of a trial, such as a killed one.
    async fn await_lock(&self, index: usize) -> anyhow::Result<()> {
        let root = self.folder.trial(index);
        let Ok(folder) = RunFolder::open(&root.display().to_string()) else { return Ok(()) };
        let path = folder.lock();
        let Ok(file) = File::open(&path) else { return Ok(()) };
        let free = tokio::task::spawn_blocking(move || file.lock_shared());
        match tokio::time::timeout(LOCK_TIMEOUT, free).await {
            Ok(free) => free?.with_context(|| format!("`{}` cannot be locked", path.display())),
            Err(_) => {
                let holder = run_lock::holder(&folder).map_or("another process".to_string(), |by| by.to_string());
                let why = format!("`{}` is in use by {holder}; stop that process", root.display());
                Err(Usage(why + ", then go on with `treadmill sweep --resume`").into())
            }
        }
    }

    fn start(&self, plan: &Plan, index: usize, actors: usize) -> anyhow::Result<tokio::process::Child> {
        let path = self.folder.log(index);
        let log = File::options().create(true).append(true).open(&path);
        let log = log.with_context(|| format!("`{}` cannot be written", path.display()))?;
        let mut command = child::command(&own_program()?, 0);
        command
            .args(self.arguments(plan, index, actors))
            .current_dir(&plan.started_in)
            .stdin(Stdio::null())
            .stdout(log.try_clone()?)
            .stderr(log)
            // Ctrl-C reaches only the sweep, which then stops its trials.
            .process_group(0);
        Command::from(command).spawn().context("a trial cannot be started")
    }

    /// Returns the command line of a trial, which is the same at each of its starts, but for the number of its actors.
    fn arguments(&self, plan: &Plan, index: usize, actors: usize) -> Vec<String> {
        let Trial { seed, keys, parent, .. } = &plan.trials[index];
        let command = if plan.connect.is_empty() { "train" } else { "learner" };
        let mut words: Vec<String> =
            [command, "--resume-or-start", "--no-progress", "--no-page"].map(String::from).into();
        words.extend(plan.connect.iter().map(|endpoint| format!("--connect={endpoint}")));
        if !plan.connect.is_empty() {
            let is_encrypted = plan.flags.iter().any(|flag| flag.starts_with("--tls"));
            words.push(format!("--listen={}/127.0.0.1:0", if is_encrypted { "tls" } else { "tcp" }));
            words.push(format!("--run={}-trial-{}", plan.bus_name, index + 1));
        }
        words.extend(flags(plan, parent.is_some(), self.pause_at.is_some()));
        words.extend(keys.iter().map(|(key, value)| format!("--set={key}={value}")));
        words.push(format!("--run-dir={}", self.folder.trial(index).display()));
        words.push(format!("--seed={seed}"));
        words.extend(self.pause_at.map(|steps| format!("--steps={steps}")));
        words.extend(parent.map(|_| format!("--fork={}", forked(self.folder, index).display())));
        // Also where a trial has all cores: one that measured them could begin with other environments than the rest.
        let has_own = plan.connect.is_empty() && !plan.deterministic;
        if has_own && !words.iter().any(|word| word.starts_with("--actors")) {
            words.push(format!("--actors={actors}"));
        }
        words
    }
}

/// Returns the flags of the sweep's command line that a trial has. The configuration of a fork is that of its parent.
pub(crate) fn flags(plan: &Plan, is_fork: bool, has_own_steps: bool) -> impl Iterator<Item = String> + '_ {
    let is_replaced = move |flag: &&String| match flag.split('=').next().unwrap_or_default() {
        "--preset" | "--init-from" | "--fork" | "--checkpoint" => is_fork,
        "--steps" => has_own_steps,
        _ => false,
    };
    plan.flags.iter().filter(move |flag| !is_replaced(flag)).cloned()
}

/// Returns the folder of the state that a trial forks.
pub(crate) fn forked(folder: &SweepFolder, index: usize) -> std::path::PathBuf {
    folder.root().join(format!(".forked-{}", index + 1))
}

/// Returns the environment steps that a run has learnt from.
pub(crate) fn reached(run: &Path) -> u64 {
    crate::commands::runs::record::Record::read(run).map_or(0, |record| record.env_steps)
}

/// Requests a process to stop.
fn interrupt(pid: u32) {
    // SAFETY: kill takes two numbers and accesses no memory.
    let _ = unsafe { libc::kill(pid as i32, libc::SIGINT) };
}

/// Returns the exit code as shells have it: 128 and the signal for a killed process.
fn code(status: ExitStatus) -> i32 {
    status.code().unwrap_or_else(|| 128 + status.signal().unwrap_or_default())
}

/// Returns the last error in a trial's output.
pub(crate) fn last_error(log: &Path) -> Option<String> {
    let mut file = File::open(log).ok()?;
    let length = fs::metadata(log).ok()?.len() as i64;
    file.seek(SeekFrom::End(-length.min(LOG_END_BYTES))).ok()?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).ok()?;
    let text = String::from_utf8_lossy(&bytes);
    text.lines().rev().find_map(|line| line.strip_prefix("error: ").map(str::to_string))
}
