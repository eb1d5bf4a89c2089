//! Flags that locate a learner, and a session with it: for `status`, `control`, `check` and the viewer.

use std::{fs, path::PathBuf, time::Duration};

use anyhow::Context;
use clap::Args;
use treadmill_bus::{Bus, BusError, BusOptions, Role};
use treadmill_proto::{ControlReply, RunStatus};
use treadmill_runtime::{holder::Holder, run_folder::RunFolder, run_lock::holder, words::quoted};

use crate::{
    diagnosis::Silence,
    launch::{async_runtime, exit_code::Usage, resume_line, slow_step::SlowStepNotice},
    shared::{
        network_args::{DEFAULT_PORT, NetworkArgs, check_run},
        saved_run,
    },
};

/// Time without an answer after which the way to the endpoints is examined, and further time for an answer if it is free.
const DIAGNOSE_AFTER: Duration = Duration::from_secs(1);
const DIAL_TIMEOUT: Duration = Duration::from_secs(4);
/// Longest wait for an answer of a learner.
pub const ANSWER_TIMEOUT: Duration = Duration::from_secs(5);
/// Time after joining during which a router may not know the learner yet.
const ROUTES_SETTLE_TIMEOUT: Duration = Duration::from_secs(2);
const RETRY: Duration = Duration::from_millis(100);

/// Flags that locate a learner.
#[derive(Args, Clone, Debug)]
pub struct ReachArgs {
    /// Folder of a run on this machine, or its name below runs/; the folder holds the learner's endpoint.
    #[arg(value_name = "RUN", conflicts_with = "connect")]
    pub folder: Option<String>,
    /// Endpoint of the learner or of a router; may be repeated. By default that of the run that is trained below runs/, else
    /// port 7447 on loopback, as tls/ with --tls and else tcp/; `check` then asks no learner.
    #[arg(long, value_name = "ENDPOINT")]
    pub connect: Vec<String>,
    /// Name of the run on the bus; may be left out if there is only one.
    #[arg(long, value_name = "NAME")]
    pub run: Option<String>,
    /// Flags of the network.
    #[command(flatten)]
    pub network: NetworkArgs,
}

impl ReachArgs {
    /// Returns the metrics file of the run whose folder was given.
    #[must_use]
    pub fn metrics_file(&self) -> Option<PathBuf> {
        RunFolder::open(self.folder.as_ref()?).ok().map(|folder| folder.metrics())
    }

    /// Returns the folder of the run that was given, if one was and it is no store.
    ///
    /// # Errors
    /// If it is missing or cannot be read.
    pub fn run_folder(&self) -> anyhow::Result<Option<RunFolder>> {
        let given = self.folder.as_ref().filter(|run| !run.contains("://"));
        Ok(given.map(|run| RunFolder::open(run)).transpose()?)
    }

    /// Returns the store that was given, or that of the run whose folder was given.
    #[must_use]
    pub fn store_url(&self) -> Option<String> {
        saved_run::store_url(self.folder.as_ref()?)
    }

    /// Returns the folder of the run that was given, if no process trains it now.
    #[must_use]
    pub fn idle_folder(&self) -> Option<RunFolder> {
        let folder = RunFolder::open(self.folder.as_ref()?).ok()?;
        holder(&folder).is_none().then_some(folder)
    }

    /// Returns that no process trains the run whose folder was given, and the remedy.
    #[must_use]
    pub fn idleness(&self) -> Option<[String; 2]> {
        let folder = self.idle_folder()?;
        let root = quoted(&folder.root().display().to_string());
        Some([format!("no process trains `{root}` now"), format!("go on with: {}", resume_line::of_folder(&folder))])
    }

    /// Returns the process that trains the run whose folder was given.
    #[must_use]
    pub fn holder(&self) -> Option<Holder> {
        holder(&RunFolder::open(self.folder.as_ref()?).ok()?)
    }

    /// Returns the folders below `runs/` of runs that are trained now, unless the flags name a run or a learner.
    #[must_use]
    pub fn live_folders(&self) -> Vec<String> {
        if self.folder.is_some() || self.run.is_some() || !self.connect.is_empty() || self.network.discover {
            return Vec::new();
        }
        let entries = fs::read_dir("runs").into_iter().flatten().flatten();
        let mut folders: Vec<String> = entries.map(|entry| entry.path().display().to_string()).collect();
        folders.sort();
        folders.retain(|folder| RunFolder::open(folder).is_ok_and(|folder| holder(&folder).is_some()));
        folders
    }

    /// Returns the endpoints given, or the one that the run's folder holds now: a restarted learner may listen elsewhere.
    ///
    /// # Errors
    /// If the run's folder or its endpoint file is missing.
    pub fn named_endpoints(&self) -> anyhow::Result<Vec<String>> {
        let mut connect = self.connect.clone();
        if let Some(folder) = &self.folder {
            let folder = RunFolder::open(folder)?;
            let file = folder.endpoint();
            let text = std::fs::read_to_string(&file)
                .with_context(|| format!("cannot read the endpoint of the run in `{}`", file.display()))?;
            connect.extend(text.lines().next().map(on_this_machine));
        }
        Ok(connect)
    }

    /// Returns the endpoints to dial: those named, or the default.
    ///
    /// # Errors
    /// As [`Self::named_endpoints`].
    pub fn endpoints(&self) -> anyhow::Result<Vec<String>> {
        let mut connect = self.named_endpoints()?;
        if connect.is_empty() && !self.network.discover {
            connect.push(self.network.loopback(DEFAULT_PORT));
        }
        Ok(connect)
    }

    /// Returns the options of the bus. Called before any thread starts, see [`NetworkArgs::options`].
    ///
    /// # Errors
    /// If endpoint, name or certificates are refused.
    pub fn options(&self, role: Role) -> anyhow::Result<BusOptions> {
        let connect = self.endpoints()?;
        check_run(self.run.as_deref())?;
        match self.network.options(role, Vec::new(), connect.clone()) {
            // An operator has the rights of an observer.
            Err(_) if role == Role::Observer => {
                self.network.options(Role::Operator, Vec::new(), connect.clone()).or_else(|_| {
                    // The first error is the useful one.
                    self.network.options(role, Vec::new(), connect)
                })
            }
            options => options,
        }
    }
}

/// Returns the endpoint at which a listener of this machine is dialled: one on all interfaces is also on loopback.
#[must_use]
pub fn on_this_machine(endpoint: &str) -> String {
    endpoint.replace("/0.0.0.0:", "/127.0.0.1:").replace("/[::]:", "/[::1]:")
}

/// Session with the bus where a learner should be.
pub struct LearnerLink {
    /// The session.
    pub bus: Bus,
    /// Name of the wanted run, if given.
    pub run: Option<String>,
    /// Process that trains the wanted run, if its folder was given.
    pub holder: Option<Holder>,
    options: BusOptions,
}

impl LearnerLink {
    /// Returns the error that the run does not answer, with the reason.
    pub async fn silence(&self) -> anyhow::Error {
        Silence::of_run(&self.bus, &self.options, self.run.as_deref()).await.into()
    }
}

/// Returns whether a status is of this process; of any, where the process is not known. Several learners may be on one
/// bus, and the endpoint in a folder that machines share may be one of another machine.
pub fn is_of(holder: Option<&Holder>, status: &RunStatus) -> bool {
    let Some(Holder { pid: Some(pid), host, .. }) = holder else { return true };
    (*pid, host) == (status.pid, &status.host)
}

/// Joins the bus as an observer or operator, and runs `work` with the session.
///
/// # Errors
/// If the bus cannot be joined, or the work fails.
pub fn connect(
    reach: &ReachArgs,
    role: Role,
    work: impl AsyncFnOnce(&LearnerLink) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    if let Some(idleness) = reach.idleness() {
        anyhow::bail!(idleness.join("; "));
    }
    let reach = match &reach.live_folders()[..] {
        [] => reach.clone(),
        [run] => ReachArgs { folder: Some(run.clone()), ..reach.clone() },
        runs => return Err(Usage(format!("several runs are trained here; name one: {}", runs.join(", "))).into()),
    };
    let options = reach.options(role)?;
    async_runtime::run(async {
        let step = SlowStepNotice::begin(format!("dialling {}", options.connect.join(", ")));
        let bus = dial(&options, reach.run.as_deref()).await?;
        let link = LearnerLink { bus, run: reach.run.clone(), holder: reach.holder(), options };
        drop(step);
        let outcome = work(&link).await;
        link.bus.close();
        outcome
    })
}

/// Opens a session on the bus.
///
/// # Errors
/// If no peer answers in time; the error says why.
pub async fn dial(options: &BusOptions, run: Option<&str>) -> anyhow::Result<Bus> {
    let opened = tokio::task::spawn_blocking({
        let options = options.clone();
        move || Bus::open_client(&options)
    });
    tokio::pin!(opened);
    if let Ok(bus) = tokio::time::timeout(DIAGNOSE_AFTER, &mut opened).await {
        return Ok(bus??);
    }
    let asked = (options.clone(), run.map(str::to_string));
    let hindrance = tokio::task::spawn_blocking({
        let (options, run) = asked.clone();
        move || Silence::of_route(&options, run.as_deref())
    });
    if let Some(silence) = hindrance.await? {
        return Err(silence.into());
    }
    if let Ok(bus) = tokio::time::timeout(DIAL_TIMEOUT, opened).await {
        return Ok(bus??);
    }
    let (options, run) = asked;
    Err(tokio::task::spawn_blocking(move || Silence::of_endpoints(&options, run.as_deref())).await?.into())
}

/// Repeats a request for a moment until it is answered: a router may not know the learner yet.
///
/// # Errors
/// If the request fails.
pub async fn retry_until_answered(
    mut ask: impl AsyncFnMut() -> Result<Vec<ControlReply>, BusError>,
) -> anyhow::Result<Vec<ControlReply>> {
    let begun = std::time::Instant::now();
    loop {
        let replies = ask().await?;
        if !replies.is_empty() || begun.elapsed() >= ROUTES_SETTLE_TIMEOUT {
            return Ok(replies);
        }
        tokio::time::sleep(RETRY).await;
    }
}
