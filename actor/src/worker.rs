//! One actor process: joins, collects, delivers, tells about itself, and outlives the learner.

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
        mpsc,
    },
    time::{Duration, Instant},
};

use bytes::Bytes;
use tokio::sync::mpsc as tokio_mpsc;
use treadmill_bus::{Bus, PosePublisher, keys, publish_dropping, token, watch_announcements};
use treadmill_config::{Config, ConfigSource};
use treadmill_proto::{ActorStats, EndCause, Episode, Fragment, PolicyBundle, Precision, json::EpisodeReport};
use treadmill_runtime::{machine, seeds, shutdown::Shutdown};

use crate::{
    ActorError,
    courier::{Counts, Courier},
    environments::{Environments, SeedSource},
    policies::{Policies, Refreshed, join},
    poses::{self, Camera},
    rollout::{Collector, Sender},
    settings,
};

/// Fragments between the physics thread and the courier; credit keeps them at no more than `max_in_flight`, which is 2 at
/// most.
const OUTBOX_FRAGMENTS: usize = 2;

/// How this process was started.
#[derive(Clone, Debug)]
pub struct WorkerOptions {
    /// The run to join; the only one there is if none is named.
    pub run: Option<String>,
    /// The actor's name.
    pub name: String,
    /// Its environments.
    pub envs: u32,
    /// Threads that step them; the run's `rollout.threads` where nothing is said. 0 means one per core.
    pub threads: Option<u32>,
    /// Number of this start, from which its random streams are derived.
    pub start: u64,
    /// Where the learner is, for messages.
    pub where_to: String,
}

/// What became of all that one stay in a run produced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Account {
    /// Under which its fragments are known.
    pub incarnation: u64,
    /// Fragments by what became of them.
    pub fragments: Counts,
    /// Fragments up to this number are neither in flight nor kept.
    pub settled_through: u64,
    /// Environment steps in all of them.
    pub env_steps: u64,
}

/// Why one stay in a run ended.
enum Ended {
    Asked,
    OtherRun,
}

/// Runs until somebody asks to stop; the account of the last stay, if it ever joined.
pub async fn run(bus: Bus, options: WorkerOptions, shutdown: Shutdown) -> Result<Option<Account>, ActorError> {
    let mut last = None;
    loop {
        let Some(bundle) = join(&bus, options.run.as_deref(), &options.where_to, &shutdown).await? else {
            return Ok(last);
        };
        tracing::info!("{} joined run `{}` at version {}", options.name, bundle.run, bundle.version.number);
        let (ended, account) = stay(&bus, &options, &bundle, &shutdown).await?;
        tracing::info!("{} leaves run `{}`: {account:?}", options.name, bundle.run);
        last = Some(account);
        match ended {
            Ended::Asked => return Ok(last),
            Ended::OtherRun => tracing::warn!(
                "run `{}` is no longer there as it was; joining again, without the {} fragments that nobody answered for",
                bundle.run,
                account.fragments.in_flight
            ),
        }
    }
}

/// What the physics thread counts.
#[derive(Default)]
struct Progress {
    env_steps: AtomicU64,
    episodes: AtomicU64,
    faults: AtomicU64,
}

/// A fragment on its way from the physics thread to the courier.
struct Produced {
    sequence: u64,
    bytes: Bytes,
    episodes: Vec<Episode>,
}

async fn stay(
    bus: &Bus,
    options: &WorkerOptions,
    bundle: &PolicyBundle,
    shutdown: &Shutdown,
) -> Result<(Ended, Account), ActorError> {
    let mut source = ConfigSource::default();
    source.text(&bundle.config_toml, "the configuration of the run")?;
    let config = source.build()?;
    settings::check_ours(&bundle.run, &config)?;
    let incarnation = seeds::unique();
    tracing::info!("{} counts its fragments as process {incarnation}", options.name);
    let policies = Arc::new(Policies::new(bus.clone(), options.run.clone(), bundle)?);
    let receipt_timeout = Duration::from_millis(config.bus.receipt_timeout_ms);
    let courier = Arc::new(Courier::new(bus.clone(), &bundle.run, &options.name, receipt_timeout, policies.clone()));
    let publisher = PosePublisher::open(bus, &bundle.run, &options.name)?;
    let sender =
        Sender { run: bundle.run.clone(), actor: options.name.clone(), incarnation, config_hash: bundle.config_hash };
    let (camera, tape) = Camera::new(publisher.watched(), sender.clone());
    let collector = collector(options, bundle, &config, sender)?.with_camera(camera);
    let progress = Arc::new(Progress::default());

    // Credit: the physics thread takes one for each fragment; the courier gives it back with the receipt.
    let (give_credit, credit) = mpsc::channel();
    (0..config.fragments_in_flight()).for_each(|_| give_credit.send(()).unwrap_or_default());
    let (outbox, mut produced) = tokio_mpsc::channel::<Result<Produced, ActorError>>(OUTBOX_FRAGMENTS);
    let physics = std::thread::Builder::new()
        .name("physics".to_string())
        .spawn({
            let (policies, courier, progress) = (policies.clone(), courier.clone(), progress.clone());
            move || simulate(collector, &policies, &courier, &credit, &outbox, &progress)
        })
        .map_err(|why| ActorError::Physics { why: why.to_string() })?;

    let _token = token(bus, &bundle.run, &options.name)?;
    let announcements = watch_announcements(bus, &bundle.run)?;
    let tell_episode = publish_dropping(bus, keys::episodes(&bundle.run, &options.name))?;
    let tell_stats = publish_dropping(bus, keys::stats(&bundle.run, &options.name))?;
    let mut stats_due = tokio::time::interval(Duration::from_millis(config.bus.stats_every_ms));
    // Actors that joined together do not ask together.
    let jitter = 0.8 + 0.4 * (incarnation % 1000) as f64 / 1000.0;
    let mut poll_due = tokio::time::interval(Duration::from_secs_f64(config.bus.policy_poll_ms as f64 / 1e3 * jitter));
    // Beside the loop, and no longer than it.
    let mut telling = tokio::task::JoinSet::new();
    telling.spawn(poses::tell(tape, publisher));
    let mut deliveries = tokio::task::JoinSet::new();
    // Beside the loop: whoever asks for a policy may wait for the answer, and credit and Ctrl-C must not.
    let mut lookups = tokio::task::JoinSet::new();
    let look = |version, lookups: &mut tokio::task::JoinSet<Refreshed>| {
        if lookups.is_empty() {
            let policies = policies.clone();
            lookups.spawn(async move { policies.refresh(version).await });
        }
    };
    let mut rate = Rate { since: Instant::now(), env_steps: 0 };
    let ended = loop {
        tokio::select! {
            () = shutdown.wait() => break Ended::Asked,
            next = produced.recv() => {
                let Some(next) = next else { return Err(ActorError::Physics { why: "it ended".to_string() }) };
                let Produced { sequence, bytes, episodes } = next?;
                let courier = courier.clone();
                deliveries.spawn(async move { courier.deliver(sequence, bytes).await });
                for episode in &episodes {
                    let report = EpisodeReport::new(&bundle.run, &options.name, episode);
                    tell_episode(report.to_json());
                }
            }
            Some(delivered) = deliveries.join_next() => {
                let refreshed = delivered.map_err(|why| ActorError::Physics { why: why.to_string() })??;
                if refreshed == Refreshed::OtherRun { break Ended::OtherRun }
                let _ = give_credit.send(());
            }
            Some(announced) = announcements.next() => look(Some(announced.version), &mut lookups),
            _ = poll_due.tick() => look(None, &mut lookups),
            Some(found) = lookups.join_next() => {
                if found.is_ok_and(|found| found == Refreshed::OtherRun) { break Ended::OtherRun }
            }
            _ = stats_due.tick() => {
                tell_stats(stats(options, incarnation, &policies, &courier, &progress, &mut rate).to_bytes());
            }
        }
    };
    // Without credit and outbox the physics thread ends after the fragment it is at.
    drop((give_credit, produced));
    deliveries.abort_all();
    lookups.abort_all();
    tokio::task::spawn_blocking(move || physics.join())
        .await
        .ok()
        .and_then(Result::ok)
        .ok_or_else(|| ActorError::Physics { why: "it panicked".to_string() })?;
    let account = Account {
        incarnation,
        fragments: courier.counts(),
        settled_through: courier.settled_through(),
        env_steps: progress.env_steps.load(Ordering::Relaxed),
    };
    Ok((ended, account))
}

fn collector(
    options: &WorkerOptions,
    bundle: &PolicyBundle,
    config: &Config,
    sender: Sender,
) -> Result<Collector, ActorError> {
    let seeds = SeedSource { run_seed: config.run.seed, actor: options.name.clone(), start: options.start };
    let noise = seeds.noise();
    let envs = options.envs as usize;
    let threads = options.threads.unwrap_or(config.rollout.threads) as usize;
    let environments = Environments::new(envs, &settings::training(config), &bundle.model_xml, seeds)?;
    let environments = environments.with_threads(threads)?.with_precision(settings::precision(config));
    let wanted = (bundle.observation_size as usize, bundle.action_size as usize);
    let found = (environments.observation_size(), environments.action_size());
    if wanted != found {
        let why = format!("its observation and action sizes are {wanted:?}, the model's are {found:?}");
        return Err(ActorError::Bundle { number: bundle.version.number, why });
    }
    let mut collector = Collector::new(environments, noise, config.rollout.fragment_steps, sender);
    if config.run.deterministic {
        collector.attach_state();
    }
    if let Some(state) = &bundle.actor_state {
        match collector.go_on(state) {
            Ok(()) => tracing::info!("{} goes on where the checkpoint left it", options.name),
            Err(why) => tracing::warn!(
                "{} begins new episodes, and the run is not bit for bit what it would have been: the actor's state in the \
                 checkpoint cannot be gone on with, because {why}",
                options.name
            ),
        }
    }
    Ok(collector)
}

/// The physics thread: one fragment for each credit, with the newest policy at its beginning.
fn simulate(
    mut collector: Collector,
    policies: &Policies,
    courier: &Courier,
    credit: &mpsc::Receiver<()>,
    outbox: &tokio_mpsc::Sender<Result<Produced, ActorError>>,
    progress: &Progress,
) {
    while credit.recv().is_ok() {
        let policy = policies.current();
        let produced = collector.collect(&policy, courier.settled_through()).and_then(|fragment| {
            courier.produced(fragment.sequence);
            encode(fragment, collector.precision(), progress)
        });
        let failed = produced.is_err();
        if outbox.blocking_send(produced).is_err() || failed {
            return;
        }
    }
}

fn encode(fragment: Fragment, precision: Precision, progress: &Progress) -> Result<Produced, ActorError> {
    let bytes = fragment.encode_as(precision).map_err(|why| ActorError::Physics { why: why.to_string() })?;
    progress.env_steps.fetch_add(fragment.transitions() as u64, Ordering::Relaxed);
    progress.episodes.fetch_add(fragment.episodes.len() as u64, Ordering::Relaxed);
    let faults = fragment.episodes.iter().filter(|episode| episode.cause == EndCause::NonFinite).count();
    progress.faults.fetch_add(faults as u64, Ordering::Relaxed);
    Ok(Produced { sequence: fragment.sequence, bytes: bytes.into(), episodes: fragment.episodes })
}

struct Rate {
    since: Instant,
    env_steps: u64,
}

fn stats(
    options: &WorkerOptions,
    incarnation: u64,
    policies: &Policies,
    courier: &Courier,
    progress: &Progress,
    rate: &mut Rate,
) -> ActorStats {
    let env_steps = progress.env_steps.load(Ordering::Relaxed);
    let elapsed_s = rate.since.elapsed().as_secs_f64().max(1e-9);
    let env_steps_per_s = (env_steps - rate.env_steps) as f64 / elapsed_s;
    let counts = courier.counts();
    *rate = Rate { since: Instant::now(), env_steps };
    ActorStats {
        actor: options.name.clone(),
        incarnation,
        host: machine::host_name(),
        pid: std::process::id(),
        version: Some(policies.current().version.into()),
        envs: options.envs,
        env_steps_per_s,
        env_steps,
        episodes: progress.episodes.load(Ordering::Relaxed),
        faults: progress.faults.load(Ordering::Relaxed),
        produced: counts.produced,
        accepted: counts.accepted,
        dropped_by_rule: counts.dropped_by_rule,
        in_flight: counts.in_flight,
        resent: counts.resent,
        awaiting_durability: counts.awaiting_durability,
        resident_bytes: machine::resident_bytes(),
        program_version: env!("CARGO_PKG_VERSION").to_string(),
    }
}
