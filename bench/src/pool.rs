//! Pool with played actors and played learners, which come and go: how far the runs are from their fair shares, how long
//! actors have no run, and what the pool costs the bus. Both sides are the shipped code; nothing simulates or learns.

use std::{
    collections::BTreeMap,
    fs,
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use anyhow::Context;
use clap::Args;
use rand_distr::{Distribution, Uniform};
use serde_json::{Value, json};
use tokio::{runtime::Runtime, task::JoinSet};
use treadmill_actor::pool::PoolPlace;
use treadmill_bus::{
    Bus, BusOptions,
    actor::{PoolCalls, token},
    learner::Alive,
};
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_learner::pool::{Pool, PoolWish};
use treadmill_proto::PoolDemand;
use treadmill_rl::launch::output::say;
use treadmill_runtime::{seeds, shutdown::Shutdown};

use crate::process::Process;

/// Interval of the samples.
const SAMPLE: Duration = Duration::from_millis(250);
/// Time without a run from which an actor counts as idle.
const IDLE: Duration = Duration::from_secs(3);
/// Time of the first division, which the means leave out.
const SETTLE: Duration = Duration::from_secs(10);
/// Time over which the traffic of idle links is measured.
const BASELINE: Duration = Duration::from_secs(10);
/// More environments than a pool has, so that only the shares decide.
const ENVS_MAX: u32 = 1_000_000;

/// Flags of `pool`.
#[derive(Args)]
pub struct PoolArgs {
    /// Played actors, each with a session of its own.
    #[arg(long, default_value_t = 64)]
    actors: usize,
    /// Environments of each actor.
    #[arg(long, default_value_t = 32)]
    envs: u32,
    /// Played learners; their shares are 1, 2, 3 and so on.
    #[arg(long, default_value_t = 8)]
    learners: usize,
    /// Time between two changes: a learner ends, is killed, or begins.
    #[arg(long, default_value_t = 20.0)]
    change_every_s: f64,
    /// Duration.
    #[arg(long, default_value_t = 600.0)]
    seconds: f64,
    /// Seed of the changes.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Where the actors are.
#[derive(Default)]
struct Places {
    /// Run of each actor and since when; those without one have an empty name.
    actors: Vec<(String, Option<Instant>)>,
    /// Durations of moves from one run to another.
    moves_s: Vec<f64>,
}

type Shared = Arc<Mutex<Places>>;

/// Played learner.
struct PlayedLearner {
    bus: Bus,
    /// The pool gives its actors free when it is dropped, and must be the first.
    pool: Option<Pool>,
    alive: Option<Alive>,
}

/// Measures, and prints one JSON object.
pub fn run(args: &PoolArgs) -> anyhow::Result<()> {
    let router_flags = ["--listen", "tcp/127.0.0.1:0"].map(String::from);
    let mut router = Process::of_treadmill("router", &router_flags, 0, None)?;
    let endpoint = loop {
        let line = router.line()?;
        if let Some(endpoint) = line.split_whitespace().find(|word| word.starts_with("tcp/")) {
            break endpoint.to_string();
        }
    };
    let result = Runtime::new()?.block_on(measure(args, &endpoint))?;
    router.stop()?;
    say(&result.to_string());
    Ok(())
}

async fn measure(args: &PoolArgs, endpoint: &str) -> anyhow::Result<Value> {
    let sessions: Vec<Bus> = (0..args.actors + args.learners).map(|_| open(endpoint)).collect::<Result<_, _>>()?;
    let before = loopback_bytes()?;
    tokio::time::sleep(BASELINE).await;
    let idle_bytes_per_s = (loopback_bytes()? - before) as f64 / BASELINE.as_secs_f64();

    let (shutdown, shared) = (Shutdown::default(), Shared::default());
    lock(&shared).actors = vec![(String::new(), Some(Instant::now())); args.actors];
    let mut learners: Vec<Option<PlayedLearner>> = Vec::new();
    let (of_actors, of_learners) = sessions.split_at(args.actors);
    for (number, bus) in of_learners.iter().enumerate() {
        learners.push(Some(begin(bus, number)?));
    }
    let mut actors = JoinSet::new();
    for (number, bus) in of_actors.iter().enumerate() {
        actors.spawn(play(bus.clone(), number, args.envs, shared.clone(), shutdown.clone()));
    }

    let begun = Instant::now();
    let mut random = seeds::stream(args.seed, "played pool", &[]);
    let mut change_due = SETTLE;
    let (mut changes, mut killed) = (0, 0);
    let (mut distances, mut settled, mut idle, mut samples) = (Vec::new(), Vec::new(), 0.0, 0.0);
    let mut bytes = None;
    while begun.elapsed().as_secs_f64() < args.seconds {
        tokio::time::sleep(SAMPLE).await;
        let elapsed = begun.elapsed();
        if elapsed >= change_due {
            bytes.get_or_insert((loopback_bytes()?, elapsed));
            change_due += Duration::from_secs_f64(args.change_every_s);
            let number = Uniform::new(0, args.learners)?.sample(&mut random);
            changes += 1;
            match learners[number].take() {
                None => {
                    // A killed one's session is gone.
                    learners[number] = Some(begin(&open(endpoint)?, number)?);
                }
                Some(learner) if learners.iter().flatten().count() == 0 => learners[number] = Some(learner),
                Some(learner) if changes % 2 == 0 => {
                    killed += 1;
                    // First, so that it cannot give the actors free.
                    learner.bus.close();
                    drop(learner);
                }
                Some(mut learner) => {
                    learner.pool = None;
                    learner.alive = None;
                }
            }
            continue;
        }
        if elapsed < SETTLE {
            continue;
        }
        let distance = distance(&lock(&shared).actors, &learners, args);
        distances.push(distance);
        // Just before the next change.
        if change_due.saturating_sub(elapsed) < 2 * SAMPLE {
            settled.push(distance);
        }
        let places = lock(&shared);
        let without = places.actors.iter().filter(|(_, since)| since.is_some_and(|since| since.elapsed() > IDLE));
        idle += without.count() as f64;
        samples += 1.0;
    }
    let (first_bytes, since) = bytes.context("the measurement is shorter than its first change")?;
    let bytes_per_s = (loopback_bytes()? - first_bytes) as f64 / (begun.elapsed() - since).as_secs_f64();
    shutdown.ask();
    let mut moves_s = std::mem::take(&mut lock(&shared).moves_s);
    moves_s.sort_by(f64::total_cmp);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    Ok(json!({
        "actors": args.actors,
        "learners": args.learners,
        "seconds": args.seconds,
        "changes": changes,
        "killed": killed,
        "distance_mean": mean(&distances),
        "distance_before_change_mean": mean(&settled),
        "idle_actors_mean": idle / samples,
        "moves": moves_s.len(),
        "move_median_s": moves_s.get(moves_s.len() / 2),
        "pool_bytes_per_s": bytes_per_s - idle_bytes_per_s,
        "idle_bytes_per_s": idle_bytes_per_s,
    }))
}

fn open(endpoint: &str) -> anyhow::Result<Bus> {
    Ok(Bus::open_client(&BusOptions { connect: vec![endpoint.to_string()], ..BusOptions::default() })?)
}

fn lock(shared: &Shared) -> std::sync::MutexGuard<'_, Places> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

fn share(number: usize) -> f64 {
    number as f64 + 1.0
}

/// Begins the run of a played learner.
fn begin(bus: &Bus, number: usize) -> anyhow::Result<PlayedLearner> {
    let run = format!("run-{number}");
    let alive = Alive::watch(bus, &run)?;
    let demand = PoolDemand { run, physics_version: PHYSICS_VERSION, epoch: seeds::unique(), ..PoolDemand::default() };
    let wish = PoolWish { share: share(number), envs_min: 0, envs_max: ENVS_MAX, is_open: true, envs: Arc::default() };
    let pool = Some(Pool::open(bus, demand, wish, alive.view())?);
    Ok(PlayedLearner { bus: bus.clone(), pool, alive: Some(alive) })
}

/// Does what an actor of a pool does between runs.
async fn play(bus: Bus, number: usize, envs: u32, shared: Shared, shutdown: Shutdown) -> anyhow::Result<()> {
    let name = format!("played-{number}");
    let place = PoolPlace::enter(&bus, &name, envs)?;
    let mut admitted = None;
    let mut left: Option<Instant> = None;
    loop {
        let run = match admitted.take() {
            Some(run) => run,
            None => match place.find(|_| {}, &shutdown).await? {
                Some(run) => run,
                None => return Ok(()),
            },
        };
        let _token = token(&bus, &run, &name)?;
        {
            let mut places = lock(&shared);
            places.actors[number] = (run.clone(), None);
            places.moves_s.extend(left.map(|left| left.elapsed().as_secs_f64()));
        }
        let calls = PoolCalls::open(&bus, &run, &name)?;
        let mut is_there = true;
        let mut seek_due = tokio::time::interval(Duration::from_secs(1));
        loop {
            let asked = tokio::select! {
                () = shutdown.wait() => return Ok(()),
                () = calls.released() => true,
                there = calls.learner() => {
                    is_there = there;
                    seek_due.reset_after(Duration::from_millis(200));
                    if !there {
                        lock(&shared).actors[number].1.get_or_insert_with(Instant::now);
                    }
                    false
                }
                _ = seek_due.tick(), if !is_there => true,
            };
            if asked {
                let begun = Instant::now();
                admitted = place.seeker().seek(Some(&run)).await?;
                if admitted.is_some() {
                    left = Some(begun);
                    break;
                }
            }
        }
    }
}

/// Returns the sum of what runs have beyond or below their fair share, as a share of the pool.
fn distance(actors: &[(String, Option<Instant>)], learners: &[Option<PlayedLearner>], args: &PoolArgs) -> f64 {
    let mut has = BTreeMap::<&str, f64>::new();
    for (run, _) in actors {
        *has.entry(run).or_default() += 1.0;
    }
    let shares: f64 =
        learners.iter().enumerate().filter(|(_, one)| one.is_some()).map(|(number, _)| share(number)).sum();
    let of = |(number, learner): (usize, &Option<PlayedLearner>)| {
        let fair = if learner.is_some() { share(number) / shares * args.actors as f64 } else { 0.0 };
        (has.get(format!("run-{number}").as_str()).copied().unwrap_or_default() - fair).abs()
    };
    let runs: f64 = learners.iter().enumerate().map(of).sum();
    (runs + has.get("").copied().unwrap_or_default()) / args.actors as f64
}

/// Returns the bytes that the loopback interface has sent.
fn loopback_bytes() -> anyhow::Result<u64> {
    let text =
        fs::read_to_string("/sys/class/net/lo/statistics/tx_bytes").context("the loopback interface is unknown")?;
    Ok(text.trim().parse()?)
}
