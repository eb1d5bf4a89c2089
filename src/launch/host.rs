//! Hosts a learner in this process; for `train`, also starts actor processes.

use std::{
    sync::{Arc, atomic::AtomicU64},
    time::Duration,
};

use anyhow::Context;
use serde_json::json;
use tokio::sync::oneshot;
use treadmill_bus::{Bus, BusOptions, TaskServer};
use treadmill_learner::{
    checkpoint::TrainingState,
    metrics::{ConsoleOptions, PrometheusMetrics, episodes::EpisodeMeans},
    training::{self, Heartbeat, TrainingError, TrainingOptions, TrainingSummary},
};
use treadmill_runtime::{atomic_file, run_folder::RunFolder, run_lock::RunLock, shutdown::Shutdown};

use super::{
    async_runtime, banner, external_task, memory,
    metrics_page::MetricsListener,
    model,
    output::say,
    run_args::AnyRunArgs,
    signals,
    slow_step::SlowStepNotice,
    startup::{self, Prepared, Start},
    supervisor::{FleetOptions, Supervisor},
};

/// Interval of heartbeats while a learner waits for its first actor.
const HEARTBEAT_EVERY: Duration = Duration::from_secs(1);

/// Options of a hosted learner.
pub struct HostOptions<'a> {
    /// Flags of new and resumed runs.
    pub any: &'a AnyRunArgs,
    /// Options of the bus.
    pub bus: &'a BusOptions,
    /// Number of actor processes to start; `None` for `learner`, whose actors join by themselves.
    pub actors: Option<u32>,
    /// Socket of the metrics page.
    pub metrics: Option<MetricsListener>,
}

impl HostOptions<'_> {
    /// Returns the command that this process runs.
    fn command(&self) -> &'static str {
        self.actors.map_or("learner", |_| "train")
    }
}

/// Hosts a learner until its run is complete or stopped. A finished run is only reported.
pub fn run(start: Start, options: HostOptions) -> anyhow::Result<()> {
    let (prepared, mut lock) = match start {
        Start::Ready(prepared, lock) => (*prepared, lock),
        Start::Finished(folder, state) => {
            banner::print_finished(&folder, &state, options.command());
            if options.any.json {
                say(&as_json(&TrainingSummary::finished(*state)));
            }
            return Ok(());
        }
    };
    memory::keep_freed();
    let folder = prepared.folder.clone();
    let outcome = async_runtime::run(run_until_done(prepared, &mut lock, options));
    if outcome.is_err() {
        folder.discard();
    }
    outcome
}

async fn run_until_done(mut prepared: Prepared, lock: &mut RunLock, options: HostOptions<'_>) -> anyhow::Result<()> {
    let command = options.command();
    let HostOptions { any, bus: bus_options, actors, metrics } = options;
    let shutdown = Shutdown::default();
    signals::listen(shutdown.clone(), "stopping after this update; press Ctrl-C again to stop at once")?;
    let (bus, endpoints) = open_bus(bus_options, &prepared.folder).await?;
    lock.set_endpoint(&endpoints.join(", ")).context("the lock of the run folder cannot be written")?;
    let (prometheus, heartbeat) = (PrometheusMetrics::default(), Heartbeat::default());
    let page =
        metrics.map(|page| page.serve(prepared.run.clone(), prometheus.clone(), heartbeat.clone())).transpose()?;
    banner::print_start(&prepared, &endpoints, bus_options.credentials.as_ref(), actors, page);
    // Stays open during training, because actors that join later register their task too.
    let Some(task_server) = wait_for_task(&bus, &mut prepared, &shutdown, &heartbeat).await? else {
        bus.close();
        say("stopped before any actor registered its task; nothing was trained");
        return Ok(());
    };

    let restarts = Arc::new(AtomicU64::new(0));
    let fleet = actors.map(|actors| fleet_options(&prepared, bus_options, &endpoints[0], actors)).transpose()?;
    let folder = prepared.folder.clone();
    let console = ConsoleOptions {
        show_progress: !any.no_progress,
        log_metrics: any.log_metrics,
        actor_command: actors
            .is_none()
            .then(|| banner::actor_command(&prepared, &endpoints[0], bus_options.credentials.as_ref())),
    };
    let (state, training_options) = training_options(prepared, console, restarts.clone(), prometheus, heartbeat)?;
    let trained = spawn_training(&bus, state, training_options, &shutdown)?;
    let supervisor = fleet.map(|fleet| Supervisor::start(&fleet, restarts, shutdown));
    let outcome = trained.await.context("the training thread panicked");
    if let Some(supervisor) = supervisor {
        let _step = SlowStepNotice::begin("waiting for the actors to end");
        supervisor.stop().await?;
    }
    drop(task_server);
    bus.close();
    let summary = outcome??;
    banner::print_end(&folder, &summary, command);
    if any.json {
        say(&as_json(&summary));
    }
    Ok(())
}

/// Opens the bus and writes its endpoints into the run folder.
async fn open_bus(options: &BusOptions, folder: &RunFolder) -> anyhow::Result<(Bus, Vec<String>)> {
    let options = options.clone();
    let (bus, endpoints) = tokio::task::spawn_blocking(move || Bus::open_router(&options)).await??;
    let text = endpoints.join("\n") + "\n";
    atomic_file::write(&folder.endpoint(), text.as_bytes()).context("the endpoint cannot be written")?;
    Ok((bus, endpoints))
}

/// Waits until the run's task is known, with heartbeats, because a learner that waits for its first actor is healthy. Returns
/// `None` after a request to stop.
async fn wait_for_task(
    bus: &Bus,
    prepared: &mut Prepared,
    shutdown: &Shutdown,
    heartbeat: &Heartbeat,
) -> anyhow::Result<Option<TaskServer>> {
    let opening = external_task::open_server(bus, prepared, shutdown);
    tokio::pin!(opening);
    let mut beat = tokio::time::interval(HEARTBEAT_EVERY);
    loop {
        tokio::select! {
            task_server = &mut opening => return task_server,
            _ = beat.tick() => heartbeat.beat(),
        }
    }
}

/// Returns the state to train from and the options of the training.
fn training_options(
    prepared: Prepared,
    console: ConsoleOptions,
    restarts: Arc<AtomicU64>,
    prometheus: PrometheusMetrics,
    heartbeat: Heartbeat,
) -> anyhow::Result<(TrainingState, TrainingOptions)> {
    let Prepared { config, folder, device, mirror, state, .. } = prepared;
    let state = state.context(NO_STATE)?;
    let options = TrainingOptions {
        folder,
        steps: config.run.steps,
        device,
        mirror,
        console,
        restarts,
        prometheus,
        heartbeat,
        command: startup::command_line(),
        versions: startup::versions(&config),
        action_names: model::action_names(&state.model_xml),
    };
    Ok((state, options))
}

/// Returns the options of the actor processes.
fn fleet_options(
    prepared: &Prepared,
    bus_options: &BusOptions,
    endpoint: &str,
    actors: u32,
) -> anyhow::Result<FleetOptions> {
    let state = prepared.state.as_ref().context(NO_STATE)?;
    Ok(FleetOptions {
        endpoint: endpoint.to_string(),
        tls: bus_options.credentials.as_ref().map(|credentials| credentials.folder.clone()),
        shared_memory: bus_options.shared_memory,
        run: state.run.clone(),
        actors,
        envs: prepared.config.rollout.envs,
        evaluates: prepared.config.evaluates(),
        starts_before: state.counters.resumes,
    })
}

const NO_STATE: &str = "the task is known, but the run has no state";

/// Starts the training thread. Its result arrives in the channel, which closes early if the thread panics.
fn spawn_training(
    bus: &Bus,
    state: TrainingState,
    options: TrainingOptions,
    shutdown: &Shutdown,
) -> std::io::Result<oneshot::Receiver<Result<TrainingSummary, TrainingError>>> {
    let (sender, receiver) = oneshot::channel();
    let (bus, shutdown) = (bus.clone(), shutdown.clone());
    std::thread::Builder::new().name("training".to_string()).spawn(move || {
        let _ = sender.send(training::train(&bus, state, &options, &shutdown));
    })?;
    Ok(receiver)
}

fn as_json(summary: &TrainingSummary) -> String {
    let state = &summary.state;
    let means = state.episodes.means();
    let number = |of: fn(&EpisodeMeans) -> f64| means.as_ref().map(of);
    json!({
        "run": state.run,
        "env_steps": state.counters.env_steps,
        "updates": state.counters.updates,
        "wall_s": summary.wall_s,
        "env_steps_per_s": summary.env_steps as f64 / summary.wall_s.max(1e-9),
        "return_mean": number(|means| means.return_mean),
        "length_mean": number(|means| means.length_mean),
        "distance_mean_m": number(|means| means.distance_mean_m),
        "velocity_mean_mps": number(|means| means.velocity_mean_mps),
        "restarts": state.counters.restarts,
        "used_share": state.counters.used_share(),
        "stopped": summary.stopped,
    })
    .to_string()
}
