//! Process of many played actors. Each has its own session and connection.

use std::{
    io::BufRead,
    sync::{Arc, Mutex},
    time::{Duration, Instant},
};

use anyhow::Context;
use clap::Args;
use serde_json::{Value, json};
use tokio::{runtime::Runtime, sync::watch};
use treadmill_bus::{Bus, BusOptions, Role, actor::fetch_policy};
use treadmill_rl::{
    launch::{memory, output::say},
    shared::network_args::NetworkArgs,
};

use super::{
    RUN,
    actor::{FleetShared, Order, PlayedActor},
    counts::Tally,
    policy::PlayedPolicies,
};
use crate::usage;

const FETCH_TIMEOUT: Duration = Duration::from_secs(10);
/// Pause before the policy is asked for again.
const RETRY: Duration = Duration::from_millis(100);
/// Sessions that open at the same time.
const JOINERS: usize = 8;
/// Longest wait for the receipts of fragments in flight after the actors have stopped.
const DRAIN_TIMEOUT: Duration = Duration::from_secs(10);
/// Interval at which fragments in flight are counted.
const DRAIN_POLL: Duration = Duration::from_millis(20);

/// Flags of `bench fleet-actors`.
#[derive(Args)]
pub struct PlayedActorsArgs {
    /// Endpoint of the learner or a router; actors take turns if it is repeated.
    #[arg(long, value_name = "ENDPOINT", required = true)]
    connect: Vec<String>,
    /// Number of the first actor.
    #[arg(long)]
    first: usize,
    /// Number of actors.
    #[arg(long)]
    actors: usize,
    /// Environments of each actor.
    #[arg(long)]
    envs: u32,
    #[command(flatten)]
    network: NetworkArgs,
}

/// Joins, then plays until standard input ends. Every command is answered with the counts: `rates R,R,…` in environment
/// steps per second, or `inf`; `mark`; `stop`, once no fragment is in flight. `forget` also drops the measured times,
/// and `times` returns them.
pub fn run(args: &PlayedActorsArgs) -> anyhow::Result<()> {
    memory::keep_freed();
    usage::allow_many_connections();
    let options: Vec<BusOptions> = args
        .connect
        .iter()
        .map(|endpoint| args.network.options(Role::Actor, Vec::new(), vec![endpoint.clone()]))
        .collect::<anyhow::Result<_>>()?;
    let runtime =
        tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build().context("no runtime")?;
    let begun = Instant::now();
    let (order, received) = watch::channel(Order::default());
    let bundle = first_bundle(&options[args.first % options.len()], &runtime)?;
    let failure = Arc::new(Mutex::new(None));
    let shared = FleetShared {
        policies: Arc::new(PlayedPolicies::new(&bundle)?),
        order: received,
        failure: failure.clone(),
        envs: args.envs,
    };
    let actors = join(args, &options, &runtime, &shared)?;
    let joined_s = begun.elapsed().as_secs_f64();
    say(&json!({"joined": actors.len(), "joined_s": joined_s, "bundle_bytes": bundle.encode()?.len()}).to_string());
    for line in std::io::stdin().lock().lines() {
        let answer = execute(&line.context("standard input cannot be read")?, &actors, &order)?;
        if let Some(why) = failure.lock().ok().and_then(|failure| failure.clone()) {
            anyhow::bail!(why);
        }
        say(&answer.to_string());
    }
    runtime.shutdown_background();
    // Exits without closing hundreds of sessions one by one.
    std::process::exit(0);
}

/// Opens every session and joins the run with it.
fn join(
    args: &PlayedActorsArgs,
    options: &[BusOptions],
    runtime: &Runtime,
    shared: &FleetShared,
) -> anyhow::Result<Vec<Arc<PlayedActor>>> {
    let join_one = |index: usize| {
        let number = args.first + index;
        let bus = Bus::open_client(&options[number % options.len()])?;
        runtime.block_on(PlayedActor::join(shared.clone(), bus, index, format!("actor-{number}")))
    };
    let join_some = |joiner: usize| -> anyhow::Result<Vec<Arc<PlayedActor>>> {
        (joiner..args.actors).step_by(JOINERS).map(join_one).collect()
    };
    let joined: Vec<anyhow::Result<Vec<_>>> = std::thread::scope(|scope| {
        let joiners: Vec<_> = (0..JOINERS).map(|joiner| scope.spawn(move || join_some(joiner))).collect();
        let joined = joiners.into_iter().map(|joiner| joiner.join().map_err(|_| anyhow::anyhow!("it panicked")));
        joined.map(Result::flatten).collect()
    });
    let joined: Vec<Vec<_>> = joined.into_iter().collect::<anyhow::Result<_>>().context("an actor cannot join")?;
    Ok(joined.concat())
}

/// Fetches the policy over a session of its own, for the settings of the run.
fn first_bundle(options: &BusOptions, runtime: &Runtime) -> anyhow::Result<treadmill_proto::PolicyBundle> {
    let bus = Bus::open_client(options)?;
    let bundle = loop {
        if let Some(bundle) = runtime.block_on(fetch_policy(&bus, Some(RUN), FETCH_TIMEOUT))? {
            break bundle;
        }
        std::thread::sleep(RETRY);
    };
    bus.close();
    Ok(bundle)
}

/// Executes the command of one line and returns its answer.
fn execute(line: &str, actors: &[Arc<PlayedActor>], order: &watch::Sender<Order>) -> anyhow::Result<Value> {
    match line.split_once(' ') {
        Some(("rates", rates)) => {
            let rates: Vec<f64> = rates.split(',').map(str::parse).collect::<Result<_, _>>().context("bad rates")?;
            anyhow::ensure!(rates.len() == actors.len(), "{} rates for {} actors", rates.len(), actors.len());
            order.send_replace(Order::Simulate(rates.into()));
            actors.iter().for_each(|actor| actor.counts().change_rates());
        }
        None if line == "mark" => {}
        None if line == "forget" => actors.iter().for_each(|actor| drop(std::mem::take(&mut actor.counts().times))),
        None if line == "times" => return Ok(times(actors)),
        None if line == "stop" => {
            order.send_replace(Order::Stop);
            let begun = Instant::now();
            let mut empty = 0;
            // Twice, because a fragment may be on its way from the simulation to its delivery.
            while empty < 2 && begun.elapsed() < DRAIN_TIMEOUT {
                std::thread::sleep(DRAIN_POLL);
                empty = if tally(actors).in_flight == 0 { empty + 1 } else { 0 };
            }
        }
        _ => anyhow::bail!("unknown command `{line}`"),
    }
    let mut answer = tally(actors).to_json();
    answer.insert("cpu_s".to_string(), usage::cpu_s().into());
    Ok(answer.into())
}

fn tally(actors: &[Arc<PlayedActor>]) -> Tally {
    let mut sum = Tally::default();
    actors.iter().for_each(|actor| sum.add(actor.counts().tally()));
    sum
}

fn times(actors: &[Arc<PlayedActor>]) -> Value {
    let (mut receipts_ms, mut fetches_ms, mut late_ms) = (Vec::new(), Vec::new(), Vec::new());
    for actor in actors {
        let counts = actor.counts();
        receipts_ms.extend_from_slice(&counts.times.receipts_ms);
        fetches_ms.extend_from_slice(&counts.times.fetches_ms);
        late_ms.extend_from_slice(&counts.times.late_ms);
    }
    json!({"receipts_ms": receipts_ms, "fetches_ms": fetches_ms, "late_ms": late_ms})
}
