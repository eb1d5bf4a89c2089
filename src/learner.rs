//! `treadmill learner`: only the learner.

use std::sync::{Arc, atomic::AtomicU64};

use anyhow::Context;
use clap::Args;
use serde_json::json;
use treadmill_bus::{Bus, Role};
use treadmill_runtime::{atomic_file, shutdown::Shutdown};
use treadmill_learner::{
    logging::Exposition,
    pulse::Pulse,
    training::{self, Summary, TrainingOptions},
};

use crate::{
    greeting, memory,
    metrics_page::{Listening, MetricsArgs},
    model,
    output::say,
    patience::Step,
    signals,
    startup::{self, AnyRunArgs, Command, NetworkArgs, NewRunArgs, Prepared},
    supervisor::{Fleet, Supervisor},
    task,
};

/// How often a learner that waits for its first actor shows a sign of life.
const BEAT_EVERY: std::time::Duration = std::time::Duration::from_secs(1);

/// Flags of `learner`.
#[derive(Args)]
pub struct LearnerArgs {
    #[command(flatten)]
    new: NewRunArgs,
    #[command(flatten)]
    any: AnyRunArgs,
    #[command(flatten)]
    network: NetworkArgs,
    #[command(flatten)]
    metrics: MetricsArgs,
    /// The run's name on the bus; by default the name of its folder.
    #[arg(long, value_name = "NAME", conflicts_with = "resume")]
    run: Option<String>,
    /// Where to listen; may be repeated.
    #[arg(long, value_name = "ENDPOINT", default_value = "tcp/127.0.0.1:7447")]
    listen: Vec<String>,
    /// Other routers to join; may be repeated.
    #[arg(long, value_name = "ENDPOINT")]
    connect: Vec<String>,
}

/// Runs the learner until the run has its steps.
pub fn run(args: LearnerArgs) -> anyhow::Result<()> {
    if let Some(run) = &args.run {
        treadmill_proto::ident::check_ident("run", run).map_err(|why| crate::outcome::Usage(why.to_string()))?;
    }
    let options = args.network.options(Role::Learner, args.listen, args.connect)?;
    let metrics = args.metrics.listen()?;
    let mut prepared = startup::prepare(Command::Learner, &args.new, &args.any, &[])?;
    if let Some(run) = args.run {
        prepared.rename(run);
    }
    host(prepared, &args.any, &options, None, metrics)
}

/// Hosts a learner, with actor processes beside it where `actors` says so.
pub fn host(
    prepared: Prepared,
    any: &AnyRunArgs,
    options: &treadmill_bus::BusOptions,
    actors: Option<u32>,
    metrics: Option<Listening>,
) -> anyhow::Result<()> {
    memory::keep_freed();
    let runtime =
        tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build().context("no runtime")?;
    let outcome = runtime.block_on(host_until_done(prepared, any, options, actors, metrics));
    // A close that hangs must not keep the process.
    runtime.shutdown_background();
    outcome
}

async fn host_until_done(
    mut prepared: Prepared,
    any: &AnyRunArgs,
    options: &treadmill_bus::BusOptions,
    actors: Option<u32>,
    metrics: Option<Listening>,
) -> anyhow::Result<()> {
    let shutdown = Shutdown::default();
    signals::listen(shutdown.clone(), "stopping after this update; press Ctrl-C again to stop at once")?;
    let (bus, endpoints) = {
        let options = options.clone();
        tokio::task::spawn_blocking(move || Bus::open_router(&options)).await??
    };
    let text = endpoints.join("\n") + "\n";
    atomic_file::write(&prepared.folder.endpoint(), text.as_bytes()).context("the endpoint cannot be written")?;
    let (exposition, pulse) = (Exposition::default(), Pulse::default());
    let page = metrics.map(|page| page.serve(prepared.run.clone(), exposition.clone(), pulse.clone())).transpose()?;
    greeting::greet(&prepared, &endpoints, options.credentials.as_ref(), actors, page);
    // For as long as the run goes on: whoever comes later is told by name whether it may join.
    let desk = {
        let settled = task::settle(&bus, &mut prepared, &shutdown);
        tokio::pin!(settled);
        // A learner that waits for its first actor is well.
        let mut beat = tokio::time::interval(BEAT_EVERY);
        loop {
            tokio::select! {
                desk = &mut settled => break desk?,
                _ = beat.tick() => pulse.beat(),
            }
        }
    };
    let Some(desk) = desk else {
        bus.close();
        say("stopped before any actor registered its task; nothing was trained");
        return Ok(());
    };
    let Prepared { config, folder, device, mirror, run: _, state } = prepared;
    let state = state.context("the task is settled, and the state is not there")?;

    let restarts = Arc::new(AtomicU64::new(0));
    let (run, starts_before) = (state.run.clone(), state.counters.resumes);
    let training_options = TrainingOptions {
        folder: folder.clone(),
        device,
        mirror,
        show_progress: !any.no_progress,
        restarts: restarts.clone(),
        exposition,
        pulse,
        command: startup::command_line(),
        versions: startup::versions(&config),
        action_names: model::action_names(&state.model_xml),
    };
    let (tell, told) = tokio::sync::oneshot::channel();
    std::thread::Builder::new().name("training".to_string()).spawn({
        let (bus, shutdown) = (bus.clone(), shutdown.clone());
        move || {
            let _ = tell.send(training::train(&bus, state, &training_options, &shutdown));
        }
    })?;
    let supervisor = actors.map(|actors| {
        let evaluates = config.evaluates();
        let envs = config.rollout.envs;
        let tls = options.credentials.as_ref().map(|credentials| credentials.folder.clone());
        let fleet = Fleet {
            endpoint: endpoints[0].clone(),
            tls,
            shared_memory: options.shared_memory,
            run,
            actors,
            envs,
            evaluates,
            starts_before,
        };
        Supervisor::start(&fleet, restarts, shutdown)
    });
    let outcome = told.await.context("the training thread panicked");
    if let Some(supervisor) = supervisor {
        let _step = Step::begin("waiting for the actors to end");
        supervisor.stop().await?;
    }
    drop(desk);
    bus.close();
    let summary = outcome??;
    greeting::part(&folder, &summary, actors.map_or("learner", |_| "train"));
    if any.json {
        say(&as_json(&summary));
    }
    Ok(())
}

fn as_json(summary: &Summary) -> String {
    let state = &summary.state;
    let means = state.episodes.means();
    let number = |of: fn(&treadmill_learner::episodes::EpisodeMeans) -> f64| means.as_ref().map(of);
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
        "stopped": summary.stopped,
    })
    .to_string()
}
