//! Hosts a learner in this process; for `train`, also starts actor processes.

use std::{
    fs,
    net::SocketAddr,
    sync::{Arc, Mutex, OnceLock, atomic::AtomicU64},
    time::Duration,
};

use anyhow::Context;
use serde_json::json;
use tokio::sync::oneshot;
use treadmill_bus::{Bus, BusOptions, learner::TaskServer};
use treadmill_config::Config;
use treadmill_humanoid::TaskRegistry;
use treadmill_learner::{
    checkpoint::{CheckpointChoice, EpisodeMeans, TrainingState},
    leadership::Leadership,
    metrics::{ConsoleOptions, FilmSlot, PrometheusMetrics, ReportOptions},
    training::{self, TrainingError, TrainingOptions, TrainingSummary},
    waiting::Heartbeat,
};
use treadmill_runtime::{atomic_file, run_folder::RunFolder, run_lock::RunLock, shutdown::Shutdown};

use super::{
    async_runtime, banner, external_task,
    films::Films,
    memory,
    metrics_page::MetricsListener,
    model,
    output::say,
    prepared::{self, FirstState, Prepared, RunCommand, RunSetup, Start},
    restart::restart,
    resume_line, router_session,
    run_args::AnyRunArgs,
    signals,
    slow_step::SlowStepNotice,
    startup,
    supervisor::{FleetOptions, Supervisor},
};

use crate::{
    page::{OpenPage, Served, fleet, show::Show},
    shared::learner_address::on_this_machine,
};

/// Interval of heartbeats while a learner waits for its first actor.
const HEARTBEAT_EVERY: Duration = Duration::from_secs(1);

/// Pause after a restart, so that neighbours forget the first session before the second one takes its index in their trees
/// (`common/bus/src/workarounds/redial_pause.rs`).
const RESTART_PAUSE: Duration = Duration::from_secs(1);

/// Options of a hosted learner.
pub struct HostOptions<'a> {
    /// Flags of new and resumed runs.
    pub any: &'a AnyRunArgs,
    /// Options of the bus.
    pub bus: &'a BusOptions,
    /// Command that this process runs.
    pub command: RunCommand,
    /// Actor processes of `train`, if its flag was given; else the configuration decides.
    pub actors: Option<u32>,
    /// Socket of the metrics page.
    pub metrics: Option<MetricsListener>,
    /// Socket of the page in the browser.
    pub watch: Option<Served>,
    /// Tasks that the page can play.
    pub tasks: &'a TaskRegistry,
}

impl HostOptions<'_> {
    /// Returns how many actor processes this process starts; `None` for `learner`, whose actors join by themselves.
    fn actor_processes(&self, config: &Config) -> Option<u32> {
        if self.command == RunCommand::Learner {
            return None;
        }
        let wanted = self.actors.filter(|_| !config.run.deterministic).unwrap_or(config.rollout.actors);
        Some(prepared::actor_processes(wanted, config.rollout.envs))
    }
}

/// Hosts a learner until its run is complete or stopped. A finished run is only reported.
pub fn run(start: Start, options: HostOptions) -> anyhow::Result<()> {
    let (prepared, mut lock) = match start {
        Start::Ready(prepared, lock) => (*prepared, lock),
        Start::Finished(folder, state) => {
            print_finished(&folder, *state, &options);
            return Ok(());
        }
    };
    memory::keep_freed();
    let folder = prepared.setup.folder.clone();
    let outcome = async_runtime::run(async {
        let host = Host::open(options).await?;
        let outcome = host.lead(prepared, &mut lock, None).await;
        host.bus.close();
        outcome
    });
    if outcome.is_err() {
        folder.discard();
    }
    outcome
}

/// Reports a run that has all its steps.
pub fn print_finished(folder: &RunFolder, state: TrainingState, options: &HostOptions<'_>) {
    let resumed_by = resume_line::of_this_process(options.command.name(), folder, options.any.store.as_deref());
    banner::print_finished(&state, &resumed_by);
    if options.any.json {
        say(&as_json(&TrainingSummary::finished(state)));
    }
}

/// Learner process: its session, signals and metrics page.
pub struct Host<'a> {
    /// Flags and options of this process.
    pub options: HostOptions<'a>,
    /// Session, which listens.
    pub bus: Bus,
    /// Endpoints on which the session listens.
    pub endpoints: Vec<String>,
    /// Requested by a signal.
    pub shutdown: Shutdown,
    prometheus: PrometheusMetrics,
    /// Progress, for the health check.
    pub heartbeat: Heartbeat,
    page: Option<SocketAddr>,
    /// Link of the page in the browser, and its socket.
    watch: Option<(String, SocketAddr)>,
    /// That page until it shows a run.
    serving: Mutex<Option<OpenPage>>,
    /// Name of the run on the metrics page.
    run: Arc<OnceLock<String>>,
    /// Films of the robot for TensorBoard.
    films: FilmSlot,
    filming: OnceLock<Films>,
}

impl<'a> Host<'a> {
    /// Opens the session, listens to signals, and serves the metrics page if it is wanted.
    ///
    /// # Errors
    /// If an endpoint is in use, or the system refuses.
    pub async fn open(mut options: HostOptions<'a>) -> anyhow::Result<Self> {
        let shutdown = Shutdown::default();
        signals::listen(shutdown.clone(), "stopping after this update; press Ctrl-C again to stop at once")?;
        let (bus, endpoints) = router_session::open(options.bus).await?;
        let (prometheus, heartbeat, run) = (PrometheusMetrics::default(), Heartbeat::default(), Arc::default());
        let serve = |listener: MetricsListener| listener.serve(Arc::clone(&run), prometheus.clone(), heartbeat.clone());
        let page = options.metrics.take().map(serve).transpose()?;
        let watch = options.watch.as_ref().map(|served| (served.link.clone(), served.address));
        let serving = options.watch.take().map(|served| served.serve(&shutdown)).transpose()?;
        if let Some(OpenPage { hub, .. }) = &serving {
            hub.notice("no run yet: this process waits to lead one");
        }
        let serving = serving.into();
        let films = FilmSlot::default();
        Ok(Self {
            options,
            bus,
            endpoints,
            shutdown,
            prometheus,
            heartbeat,
            page,
            watch,
            serving,
            run,
            films,
            filming: OnceLock::new(),
        })
    }

    /// Waits for this time, or until this process is to stop.
    pub async fn pause(&self, time: Duration) {
        tokio::select! {
            () = tokio::time::sleep(time) => {}
            () = self.shutdown.wait() => {}
        }
    }

    /// Starts the program anew, for a learner that was overtaken. Its session would keep its queryables, and a link
    /// that another learner gave up, and that this one did not, would carry nothing
    /// ([eclipse-zenoh/zenoh#2806](https://github.com/eclipse-zenoh/zenoh/issues/2806)). A session that is closed can
    /// panic, and then keeps its memory. Returns only if the system refuses.
    pub fn restart(&self) -> std::io::Error {
        let page = self.page.iter().map(SocketAddr::to_string).collect();
        let watch = self.watch.iter().map(|(_, address)| address.to_string()).collect();
        let places = [("--listen", self.endpoints.clone()), ("--prometheus", page), ("--page-listen", watch)];
        restart(&places, RESTART_PAUSE)
    }

    /// Names the run on the metrics page, at the first call.
    pub fn name_run(&self, run: &str) {
        self.run.get_or_init(|| run.to_string());
    }

    /// Returns what the page of a run shows: its newest policy and its curves.
    fn show(&self, setup: &RunSetup) -> Show {
        let RunSetup { folder, run, .. } = setup;
        Show {
            title: run.clone(),
            // No policy of an external task can be played here.
            runs: if setup.config.is_external() { Vec::new() } else { vec![folder.root().display().to_string()] },
            which: Some(CheckpointChoice::Latest),
            seed: setup.config.run.seed,
            visuals: None,
            logs: vec![(folder.clone(), run.clone())],
            tasks: self.options.tasks.clone(),
        }
    }

    /// Leads a run until it is complete or stopped, or another learner leads.
    ///
    /// # Errors
    /// If training fails; [`TrainingError::Leadership`] if another learner leads.
    pub async fn lead(
        &self,
        prepared: Prepared,
        lock: &mut RunLock,
        leadership: Option<Leadership>,
    ) -> anyhow::Result<()> {
        let command = self.options.command.name();
        let folder = prepared.setup.folder.clone();
        let before = fs::read_to_string(folder.endpoint()).unwrap_or_default();
        let text = self.endpoints.join("\n") + "\n";
        atomic_file::write(&folder.endpoint(), text.as_bytes()).context("the endpoint cannot be written")?;
        lock.set_endpoint(&self.endpoints.join(", ")).context("the lock of the run folder cannot be written")?;
        self.name_run(&prepared.setup.run);
        let (credentials, actors) =
            (self.options.bus.credentials.as_ref(), self.options.actor_processes(&prepared.setup.config));
        // One that leads again after it was overtaken shows the page already.
        let serving = self.serving.lock().expect("no holder of this lock panics").take();
        if let Some(serving) = serving {
            serving.hub.notice("");
            let run = Some(prepared.setup.run.clone());
            tokio::spawn(fleet::follow(self.bus.clone(), run, serving.hub.clone(), self.shutdown.clone(), |_| true));
            serving.play(self.show(&prepared.setup), &self.shutdown)?;
        }
        let pages = banner::Pages { metrics: self.page, watch: self.watch.as_ref().map(|(link, _)| link.clone()) };
        // Films go with evaluations: they are for runs that last. One that leads again has its thread already.
        if prepared.setup.config.evaluates() && self.filming.get().is_none() {
            let _ = self.filming.set(Films::begin(folder.clone(), self.films.clone())?);
        }
        banner::print_start(&prepared, &self.endpoints, credentials, actors, &pages);
        banner::print_lost_endpoints(&before, &self.endpoints, actors.is_none());
        // Stays open during training, because actors that join later register their task too.
        let Prepared { mut setup, state } = prepared;
        let known = wait_for_task(&self.bus, &mut setup, state, &self.shutdown, &self.heartbeat).await?;
        let Some((task_server, state)) = known else {
            say("stopped before any actor registered its task; nothing was trained");
            return Ok(());
        };
        let restarts = Arc::new(AtomicU64::new(0));
        let endpoint = &self.endpoints[0];
        let fleet = actors.map(|actors| fleet_options(&setup, &state, self.options.bus, endpoint, actors));
        let console = ConsoleOptions {
            show_progress: !self.options.any.no_progress,
            log_metrics: self.options.any.log_metrics,
            actor_command: actors.is_none().then(|| banner::actor_command(&setup, endpoint, credentials)),
        };
        let epoch = leadership.as_ref().map_or(lock.epoch(), Leadership::epoch);
        let (resumed_by, store) = (setup.resume_command(command), setup.store.clone());
        let action_names = model::action_names(&state.model_xml);
        let training_options = self.training_options(setup, action_names, console, restarts.clone(), epoch);
        let trained = spawn_training(&self.bus, state, leadership, training_options, &self.shutdown)?;
        let supervisor = fleet.map(|fleet| Supervisor::start(&fleet, restarts, self.shutdown.clone()));
        let outcome = trained.await.context("the training thread panicked");
        if let Some(supervisor) = supervisor {
            let _step = SlowStepNotice::begin("waiting for the actors to end");
            supervisor.stop().await?;
        }
        drop(task_server);
        let summary = outcome??;
        banner::print_end(&folder, store.as_deref(), &summary, &resumed_by);
        if self.options.any.json {
            say(&as_json(&summary));
        }
        Ok(())
    }

    /// Returns the options of the training.
    fn training_options(
        &self,
        setup: RunSetup,
        action_names: Vec<String>,
        console: ConsoleOptions,
        restarts: Arc<AtomicU64>,
        epoch: u64,
    ) -> TrainingOptions {
        let RunSetup { config, folder, device, .. } = setup;
        TrainingOptions {
            folder,
            epoch,
            steps: config.run.steps,
            device,
            report: ReportOptions {
                console,
                prometheus: self.prometheus.clone(),
                command: startup::command_line(),
                versions: startup::versions(&config),
                films: self.films.clone(),
            },
            restarts,
            heartbeat: self.heartbeat.clone(),
            action_names,
        }
    }
}

/// Waits until the run's task is known, with heartbeats, because a learner that waits for its first actor is healthy.
/// Returns `None` after a request to stop.
async fn wait_for_task(
    bus: &Bus,
    setup: &mut RunSetup,
    state: FirstState,
    shutdown: &Shutdown,
    heartbeat: &Heartbeat,
) -> anyhow::Result<Option<(TaskServer, TrainingState)>> {
    let opening = external_task::open_server(bus, setup, state, shutdown);
    tokio::pin!(opening);
    let mut beat = tokio::time::interval(HEARTBEAT_EVERY);
    loop {
        tokio::select! {
            known = &mut opening => return known,
            _ = beat.tick() => heartbeat.beat(),
        }
    }
}

/// Returns the options of the actor processes.
fn fleet_options(
    setup: &RunSetup,
    state: &TrainingState,
    bus_options: &BusOptions,
    endpoint: &str,
    actors: u32,
) -> FleetOptions {
    FleetOptions {
        endpoint: on_this_machine(endpoint),
        tls: bus_options.credentials.as_ref().map(|credentials| credentials.folder.clone()),
        shared_memory: bus_options.shared_memory,
        run: state.run.clone(),
        actors,
        envs: setup.config.rollout.envs,
        evaluates: setup.config.evaluates(),
        starts_before: state.counters.resumes,
    }
}

/// Starts the training thread. Its result arrives in the channel, which closes early if the thread panics.
fn spawn_training(
    bus: &Bus,
    state: TrainingState,
    leadership: Option<Leadership>,
    options: TrainingOptions,
    shutdown: &Shutdown,
) -> std::io::Result<oneshot::Receiver<Result<TrainingSummary, TrainingError>>> {
    let (sender, receiver) = oneshot::channel();
    let (bus, shutdown) = (bus.clone(), shutdown.clone());
    std::thread::Builder::new().name("training".to_string()).spawn(move || {
        let _ = sender.send(training::train(&bus, state, leadership, &options, &shutdown));
    })?;
    Ok(receiver)
}

fn as_json(summary: &TrainingSummary) -> String {
    let (state, parts) = (&summary.state, &summary.parts);
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
        "efficiency": parts.efficiency(),
        "limit": parts.limit().map(|part| part.name),
        "limit_help": parts.limit().map(|part| part.help),
    })
    .to_string()
}
