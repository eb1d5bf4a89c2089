//! Flags that say where a learner is, and a session with it: used by `status`, `control`, `check` and the viewer.

use std::{path::PathBuf, time::Duration};

use anyhow::Context;
use clap::Args;
use treadmill_bus::{Bus, BusError, BusOptions, Role};
use treadmill_proto::{ControlReply, ident::check_ident};
use treadmill_runtime::run_folder::RunFolder;

use crate::{
    launch::{exit_code::Usage, slow_step::SlowStepNotice},
    shared::network_args::NetworkArgs,
};

/// Where a learner listens unless told otherwise.
const DEFAULT_ENDPOINT: &str = "tcp/127.0.0.1:7447";
/// How long nobody may answer a dial.
const DIAL_TIMEOUT: Duration = Duration::from_secs(5);
/// How long an answer may take once a learner was asked.
pub const ANSWER_TIMEOUT: Duration = Duration::from_secs(5);
/// For so long, no answer may mean that the learner is not known yet where we asked.
const INTRODUCTION: Duration = Duration::from_secs(2);
const RETRY: Duration = Duration::from_millis(100);

/// How to reach a learner.
#[derive(Args, Clone, Debug)]
pub struct ReachArgs {
    /// A run's folder, or its name below runs/: its learner runs on this machine, and its endpoint is in there.
    #[arg(value_name = "RUN", conflicts_with = "connect")]
    pub folder: Option<String>,
    /// Where the learner or a router listens; may be repeated. By default tcp/127.0.0.1:7447.
    #[arg(long, value_name = "ENDPOINT")]
    pub connect: Vec<String>,
    /// The run's name on the bus; may be left out where there is only one.
    #[arg(long, value_name = "NAME")]
    pub run: Option<String>,
    /// How links are protected, and how they are found.
    #[command(flatten)]
    pub network: NetworkArgs,
}

impl ReachArgs {
    /// The log of the run whose folder was given.
    #[must_use]
    pub fn log(&self) -> Option<PathBuf> {
        RunFolder::open(self.folder.as_ref()?).ok().map(|folder| folder.metrics())
    }

    /// The endpoints that were named, or that the run's folder names now: a learner that was started anew may listen elsewhere.
    ///
    /// # Errors
    /// If the run's folder is not there or does not say where the run listens.
    pub fn named_endpoints(&self) -> anyhow::Result<Vec<String>> {
        let mut connect = self.connect.clone();
        if let Some(folder) = &self.folder {
            let folder = RunFolder::open(folder)?;
            let file = folder.endpoint();
            let text = std::fs::read_to_string(&file)
                .with_context(|| format!("`{}` cannot be read, which says where the run listens", file.display()))?;
            // A learner that listens everywhere listens here, too.
            let here = |line: &str| line.replace("/0.0.0.0:", "/127.0.0.1:").replace("/[::]:", "/[::1]:");
            connect.extend(text.lines().next().map(here));
        }
        Ok(connect)
    }

    /// Where to dial.
    ///
    /// # Errors
    /// As [`Self::named_endpoints`].
    pub fn endpoints(&self) -> anyhow::Result<Vec<String>> {
        let mut connect = self.named_endpoints()?;
        if connect.is_empty() {
            connect.push(DEFAULT_ENDPOINT.to_string());
        }
        Ok(connect)
    }

    /// How to reach the bus. Called before any thread is started, see [`NetworkArgs::options`].
    ///
    /// # Errors
    /// If endpoint, name or certificates are not acceptable.
    pub fn options(&self, role: Role) -> anyhow::Result<BusOptions> {
        let connect = self.endpoints()?;
        if let Some(run) = &self.run {
            check_ident("run", run).map_err(|why| Usage(why.to_string()))?;
        }
        match self.network.options(role, Vec::new(), connect.clone()) {
            // Whoever may command may also ask.
            Err(_) if role == Role::Observer => {
                self.network.options(Role::Operator, Vec::new(), connect.clone()).or_else(|_| {
                    // The first refusal is the one that helps.
                    self.network.options(role, Vec::new(), connect)
                })
            }
            options => options,
        }
    }
}

/// Joins the bus as an observer or operator and does `work` there, with the run's name where one was given.
///
/// # Errors
/// If the bus cannot be joined, or the work fails.
pub fn connect(
    reach: &ReachArgs,
    role: Role,
    work: impl AsyncFnOnce(Bus, Option<String>) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    connect_with(reach.options(role)?, async |bus| work(bus, reach.run.clone()).await)
}

/// Joins the bus and does `work` there.
///
/// # Errors
/// If the bus cannot be joined, or the work fails.
pub fn connect_with(options: BusOptions, work: impl AsyncFnOnce(Bus) -> anyhow::Result<()>) -> anyhow::Result<()> {
    let runtime =
        tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build().context("no runtime")?;
    let outcome = runtime.block_on(async {
        let step = SlowStepNotice::begin(format!("dialling {}", options.connect.join(", ")));
        let bus = dial(options).await?;
        drop(step);
        let outcome = work(bus.clone()).await;
        bus.close();
        outcome
    });
    // A dial that goes on must not keep the process.
    runtime.shutdown_background();
    outcome
}

/// A session on the bus.
///
/// # Errors
/// If nobody answers soon.
pub async fn dial(options: BusOptions) -> anyhow::Result<Bus> {
    let where_to = options.connect.join(", ");
    let opened = tokio::task::spawn_blocking(move || Bus::open_client(&options));
    let Ok(bus) = tokio::time::timeout(DIAL_TIMEOUT, opened).await else {
        anyhow::bail!(
            "nobody answers at {where_to}; is the learner up? --connect names another endpoint, and the run's folder has it \
             in endpoint.txt"
        );
    };
    Ok(bus??)
}

/// Asks again for a moment where nobody answers: a router may not know yet who is behind it.
///
/// # Errors
/// If asking fails.
pub async fn retry_until_answered(
    mut ask: impl AsyncFnMut() -> Result<Vec<ControlReply>, BusError>,
) -> anyhow::Result<Vec<ControlReply>> {
    let begun = std::time::Instant::now();
    loop {
        let replies = ask().await?;
        if !replies.is_empty() || begun.elapsed() >= INTRODUCTION {
            return Ok(replies);
        }
        tokio::time::sleep(RETRY).await;
    }
}
