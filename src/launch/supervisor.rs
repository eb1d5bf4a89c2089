//! Actor and evaluator processes of `train`: starts them beside the learner, restarts those that die, ends them with it.

use std::{
    path::PathBuf,
    process::Stdio,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

use anyhow::Context;
use tokio::{
    process::{Child, ChildStdin, Command},
    task::JoinSet,
};
use treadmill_runtime::shutdown::Shutdown;

/// A process that ends sooner than this counts as a failed start.
const FAILED_START: Duration = Duration::from_secs(5);
/// Failed starts in a row after which a process is given up.
const FAILED_STARTS_MAX: u32 = 8;
/// Nice value of actors on the learner's machine.
const ACTOR_NICE: &str = "10";
const BACKOFF_MAX: Duration = Duration::from_secs(5);
/// Time from closing an actor's standard input to killing it.
const STOP_TIMEOUT: Duration = Duration::from_secs(3);

/// Options of a run's processes.
#[derive(Clone, Debug)]
pub struct FleetOptions {
    /// Endpoint of the learner.
    pub endpoint: String,
    /// Folder of certificates, if links are encrypted.
    pub tls: Option<PathBuf>,
    /// Whether fragments may pass through shared memory.
    pub shared_memory: bool,
    /// The run's name.
    pub run: String,
    /// Number of actor processes.
    pub actors: u32,
    /// Total number of environments.
    pub envs: u32,
    /// Whether policies are evaluated during training.
    pub evaluates: bool,
    /// Earlier starts of the learner; they select the random streams of this start.
    pub starts_before: u64,
}

/// Runs actor and evaluator processes.
pub struct Supervisor {
    tasks: JoinSet<anyhow::Result<()>>,
    stopping: Shutdown,
}

impl Supervisor {
    /// Starts all processes. Counts restarts of actors in `restarts`. Requests `shutdown` when an actor is given up.
    pub fn start(fleet: &FleetOptions, restarts: Arc<AtomicU64>, shutdown: Shutdown) -> Self {
        let stopping = Shutdown::default();
        let mut tasks = JoinSet::new();
        for index in 0..fleet.actors {
            let (fleet, restarts, shutdown, stopping) =
                (fleet.clone(), restarts.clone(), shutdown.clone(), stopping.clone());
            tasks.spawn(async move {
                let ended = keep_alive(&fleet, Role::Actor { index }, &restarts, &stopping).await;
                if ended.is_err() {
                    shutdown.ask();
                }
                ended
            });
        }
        if fleet.evaluates {
            let (fleet, stopping) = (fleet.clone(), stopping.clone());
            tasks.spawn(async move {
                // Training continues without evaluation, so a failure is only reported.
                if let Err(why) = keep_alive(&fleet, Role::Evaluator, &AtomicU64::new(0), &stopping).await {
                    tracing::warn!("policies are no longer evaluated: {why:#}");
                }
                Ok(())
            });
        }
        Self { tasks, stopping }
    }

    /// Ends all processes. Returns the first error of an actor that was given up.
    pub async fn stop(mut self) -> anyhow::Result<()> {
        self.stopping.ask();
        let mut outcome = Ok(());
        while let Some(ended) = self.tasks.join_next().await {
            let ended = ended.context("an actor's supervisor failed").and_then(|ended| ended);
            outcome = outcome.and(ended);
        }
        outcome
    }
}

/// Purpose of a process.
#[derive(Clone, Copy, Debug)]
enum Role {
    Actor { index: u32 },
    Evaluator,
}

impl std::fmt::Display for Role {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Actor { index } => write!(f, "actor-{index}"),
            Self::Evaluator => write!(f, "evaluator"),
        }
    }
}

async fn keep_alive(fleet: &FleetOptions, role: Role, restarts: &AtomicU64, stopping: &Shutdown) -> anyhow::Result<()> {
    let mut failed_starts = 0;
    for restart in 0u64.. {
        let begun = Instant::now();
        let ended = match spawn(fleet, role, restart) {
            Ok(mut child) => {
                // Taken out, because waiting for a child closes its standard input.
                let stdin = child.stdin.take();
                tokio::select! {
                    status = child.wait() => format!("ended with {}", status.context("an actor cannot be waited for")?),
                    () = stopping.wait() => return end(child, stdin).await,
                }
            }
            // The system may be short of memory or processes for a moment.
            Err(why) => format!("cannot be started: {why:#}"),
        };
        failed_starts = if begun.elapsed() < FAILED_START { failed_starts + 1 } else { 0 };
        if failed_starts >= FAILED_STARTS_MAX {
            anyhow::bail!(
                "{role} failed {failed_starts} times in a row right after its start; the last time it {ended}"
            );
        }
        restarts.fetch_add(1, Ordering::Relaxed);
        tracing::warn!("{role} {ended}; starting it again");
        let pause = (Duration::from_millis(100) * 2u32.saturating_pow(failed_starts)).min(BACKOFF_MAX);
        tokio::select! {
            () = tokio::time::sleep(pause) => {}
            () = stopping.wait() => return Ok(()),
        }
    }
    Ok(())
}

fn spawn(fleet: &FleetOptions, role: Role, restart: u64) -> anyhow::Result<Child> {
    let mut command = Command::new(own_program()?);
    match role {
        Role::Actor { index } => {
            // The first actors take the remainder.
            let envs = fleet.envs / fleet.actors + u32::from(index < fleet.envs % fleet.actors);
            let start = (fleet.starts_before << 32) + restart;
            command.args(["actor", "--envs", &envs.to_string(), "--start-number", &start.to_string()]);
            // The learner goes first: the sooner it publishes a policy, the fresher the experience.
            command.args(["--nice", ACTOR_NICE]);
        }
        Role::Evaluator => drop(command.arg("evaluator")),
    }
    if let Some(folder) = &fleet.tls {
        command.arg("--tls").arg(folder);
    }
    if fleet.shared_memory {
        command.arg("--shared-memory");
    }
    command
        .args(["--connect", &fleet.endpoint, "--name", &role.to_string()])
        // The name may begin with a hyphen.
        .arg(format!("--run={}", fleet.run))
        .args(["--until-stdin-closes", "--insecure"])
        // Only this process holds it open, so it closes when this process ends for any reason.
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        // A process group of its own, so that Ctrl-C reaches only the learner, which then ends its actors in order.
        .process_group(0)
        .kill_on_drop(true)
        .spawn()
        .map_err(Into::into)
}

/// Returns the path of this program, also if its file was replaced after the start, as by an upgrade.
pub fn own_program() -> anyhow::Result<PathBuf> {
    let path = std::env::current_exe().context("this program's own path is unknown")?;
    // Linux names a file that is gone as `PATH (deleted)`, and still has its content.
    Ok(if path.exists() { path } else { PathBuf::from("/proc/self/exe") })
}

async fn end(mut child: Child, stdin: Option<ChildStdin>) -> anyhow::Result<()> {
    drop(stdin);
    if tokio::time::timeout(STOP_TIMEOUT, child.wait()).await.is_err() {
        child.kill().await.context("an actor cannot be killed")?;
    }
    Ok(())
}
