//! Played actors: each sends real messages in real order, with its own session, and does not simulate.
//!
//! - Here: a process of many. [`actor`]: one of them. [`transitions`]: what they send. [`counts`]: what became of it.
//! - [`fleet`]: starts these processes and exchanges lines with them.

mod actor;
pub mod counts;
pub mod fleet;
mod transitions;

use std::{
    io::BufRead,
    sync::{Arc, Mutex},
    time::{Duration, Instant},
};

use anyhow::Context;
use clap::Args;
use serde_json::{Value, json};
use tokio::{runtime::Runtime, sync::watch};
use treadmill_actor::settings::RunSettings;
use treadmill_bus::{Bus, BusOptions, Role};
use treadmill_rl::{
    launch::{memory, output::say},
    shared::network_args::NetworkArgs,
};
use treadmill_runtime::seeds;

use self::{
    actor::{Order, PlayedActor, PlayedRun, first_bundle},
    counts::{Tally, Times},
    transitions::Transitions,
};

/// Most actors of a process that send at the same time.
const THREADS_MAX: usize = 64;
/// Sessions that open at the same time.
const JOINERS: usize = 8;
/// Longest wait for the receipts of fragments in flight after the actors have stopped, and for a policy.
const WAIT_MAX: Duration = Duration::from_secs(60);
/// Interval at which fragments in flight are counted.
const DRAIN_POLL: Duration = Duration::from_millis(20);
/// Interval at which arrivals of policies are counted.
const ARRIVAL_POLL: Duration = Duration::from_millis(1);

/// Flags of `played`.
#[derive(Args)]
pub struct PlayedArgs {
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

/// Joins, then plays until standard input ends. Commands: `rates R,R,…` in environment steps per second, or `inf`;
/// `mark`; `stop`, answered once no fragment is in flight. Each is answered with the counts. `forget` also drops the
/// measured times, `times` returns them, and `arrived N` the Unix times at which the actors got policy N, once all have it.
pub fn run(args: &PlayedArgs) -> anyhow::Result<()> {
    memory::keep_freed();
    // Hundreds of connections. A lower limit shows as an error of the connection.
    let _ = rlimit::increase_nofile_limit(u64::MAX);
    let options: Vec<BusOptions> = args
        .connect
        .iter()
        .map(|endpoint| args.network.options(Role::Actor, Vec::new(), vec![endpoint.clone()]))
        .collect::<anyhow::Result<_>>()?;
    // A send waits in its thread for space on the link.
    let threads = args.actors.clamp(2, THREADS_MAX);
    let mut runtime = tokio::runtime::Builder::new_multi_thread();
    let runtime = runtime.worker_threads(threads).enable_all().build().context("no runtime")?;
    let (begun, (order, received)) = (Instant::now(), watch::channel(Order::default()));
    let bus = Bus::open_client(&options[args.first % options.len()])?;
    let bundle = runtime.block_on(first_bundle(&bus))?;
    bus.close();
    let (settings, incarnation) = (RunSettings::shown(&bundle)?, seeds::unique());
    let run = Arc::new(PlayedRun {
        transitions: Transitions::new(&bundle, settings.precision(), incarnation, args.envs),
        settings,
        incarnation,
        envs: args.envs,
        order: received,
        failure: Mutex::default(),
    });
    let actors = join(args, &options, &runtime, &run)?;
    let joined_s = begun.elapsed().as_secs_f64();
    say(&json!({"joined_s": joined_s, "bundle_bytes": bundle.encode()?.len()}).to_string());
    for line in std::io::stdin().lock().lines() {
        let answer = execute(&line.context("standard input cannot be read")?, &actors, &order)?;
        if let Some(why) = run.failure.lock().ok().and_then(|failure| failure.clone()) {
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
    args: &PlayedArgs,
    options: &[BusOptions],
    runtime: &Runtime,
    run: &Arc<PlayedRun>,
) -> anyhow::Result<Vec<Arc<PlayedActor>>> {
    let join_one = |index: usize| {
        let number = args.first + index;
        let bus = Bus::open_client(&options[number % options.len()])?;
        runtime.block_on(PlayedActor::join(run.clone(), bus, index, format!("actor-{number}")))
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

/// Executes the command of one line and returns its answer.
fn execute(line: &str, actors: &[Arc<PlayedActor>], order: &watch::Sender<Order>) -> anyhow::Result<Value> {
    match line.split_once(' ') {
        Some(("rates", rates)) => {
            let rates: Vec<f64> = rates.split(',').map(str::parse).collect::<Result<_, _>>().context("bad rates")?;
            anyhow::ensure!(rates.len() == actors.len(), "{} rates for {} actors", rates.len(), actors.len());
            order.send_replace(Order::Simulate(rates.into()));
        }
        Some(("arrived", number)) => return arrived(actors, number.parse().context("a policy has a number")?),
        None if line == "mark" => {}
        None if line == "forget" => actors.iter().for_each(|actor| *actor.times() = Times::default()),
        None if line == "times" => {
            let mut times = Times::default();
            actors.iter().for_each(|actor| times.add(&actor.times()));
            return Ok(serde_json::to_value(times)?);
        }
        None if line == "stop" => {
            order.send_replace(Order::Stop);
            let begun = Instant::now();
            let mut empty = 0;
            // Twice, because a fragment may be on its way from the simulation to its delivery.
            while empty < 2 && begun.elapsed() < WAIT_MAX {
                std::thread::sleep(DRAIN_POLL);
                empty = if tally(actors).in_flight() == 0 { empty + 1 } else { 0 };
            }
        }
        _ => anyhow::bail!("unknown command `{line}`"),
    }
    Ok(serde_json::to_value(tally(actors))?)
}

fn tally(actors: &[Arc<PlayedActor>]) -> Tally {
    let mut sum = Tally::default();
    actors.iter().for_each(|actor| sum.add(actor.tally()));
    sum
}

fn arrived(actors: &[Arc<PlayedActor>], number: u64) -> anyhow::Result<Value> {
    let begun = Instant::now();
    loop {
        let times: Vec<f64> = actors.iter().filter_map(|actor| actor.times().arrivals.get(&number).copied()).collect();
        if times.len() == actors.len() || begun.elapsed() > WAIT_MAX {
            return Ok(json!({"times_unix_s": times}));
        }
        std::thread::sleep(ARRIVAL_POLL);
    }
}
