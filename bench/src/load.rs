//! Many simulated actors in one process. Each has its own session and connection, sends prepared fragments and fetches
//! policies.

use std::{
    io::BufRead,
    sync::{
        Arc, Condvar, Mutex,
        atomic::{AtomicU64, Ordering},
        mpsc::{Receiver, Sender, channel},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

use anyhow::Context;
use bytes::Bytes;
use clap::Args;
use serde_json::{Value, json};
use tokio::runtime::{Handle, Runtime};
use treadmill_bus::{
    Bus, BusOptions, Role,
    actor::{Announcements, FetchedPolicy, fetch_newer_policy, fetch_policy, submit, token, watch_announcements},
};
use treadmill_config::BusConfig;
use treadmill_experience::delivery::{Action, Delivery, Event};
use treadmill_proto::{Outcome, PolicyRequest, PolicyVersion, Precision, PreparedFragment};
use treadmill_rl::{
    launch::{memory, output::say},
    shared::network_args::NetworkArgs,
};
use treadmill_runtime::machine;

use crate::{usage, workload};

const FETCH_TIMEOUT: Duration = Duration::from_secs(10);
/// Longest wait for the first accepted fragment of every actor.
const FIRST_FRAGMENTS_TIMEOUT: Duration = Duration::from_secs(60);
/// Longest wait until every actor has fetched a policy.
const ALL_FETCHED_TIMEOUT: Duration = Duration::from_secs(60);
/// Pause before a retry when the learner is busy or silent, as in an actor.
const RETRY: Duration = Duration::from_millis(200);
/// Small, because each actor has several threads, which do little.
const STACK_BYTES: usize = 512 << 10;

/// Flags of `bench bus-load`.
#[derive(Args)]
pub struct LoadArgs {
    /// Endpoint of the learner.
    #[arg(long, value_name = "ENDPOINT")]
    connect: String,
    /// Number of the first actor.
    #[arg(long)]
    first: u32,
    /// Number of actors.
    #[arg(long)]
    actors: u32,
    /// Fragments that each actor keeps in flight.
    #[arg(long)]
    in_flight: u32,
    /// Bytes of a fragment.
    #[arg(long)]
    fragment_bytes: usize,
    /// Pause after each receipt, which stands for simulation.
    #[arg(long)]
    pause_ms: u64,
    /// Precision of observations on the wire.
    #[arg(long, value_parser = ["f32", "f16"])]
    precision: String,
    #[command(flatten)]
    network: NetworkArgs,
}

/// Current activity of the senders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Waiting,
    Sending,
    Measuring,
    Stopped,
}

/// Outcomes of the fragments.
#[derive(Default)]
struct Outcomes {
    receipts_ms: Vec<f64>,
    /// Receipts "busy".
    busy: u64,
    /// Sends without a receipt.
    silent: u64,
    refused: u64,
}

struct Shared {
    prepared: PreparedFragment,
    pause: Duration,
    phase: Mutex<Phase>,
    changed: Condvar,
    outcomes: Mutex<Outcomes>,
    /// Number of the newest policy.
    published: AtomicU64,
}

/// Sends fragments until standard input ends. Commands: `send`, answered once a fragment of every actor was accepted;
/// `measure`; `stop`; and `expect N` before policy N is published.
pub fn run(args: &LoadArgs) -> anyhow::Result<()> {
    memory::keep_freed();
    usage::allow_many_connections();
    let options = args.network.options(Role::Actor, Vec::new(), vec![args.connect.clone()])?;
    let runtime =
        tokio::runtime::Builder::new_multi_thread().worker_threads(2).enable_all().build().context("no runtime")?;
    let precision = if args.precision == "f16" { Precision::F16 } else { Precision::F32 };
    let (prepared, transitions) = workload::fragment(args.fragment_bytes, precision)?;
    let shared = Arc::new(Shared {
        prepared,
        pause: Duration::from_millis(args.pause_ms),
        phase: Mutex::new(Phase::Waiting),
        changed: Condvar::new(),
        outcomes: Mutex::new(Outcomes::default()),
        published: AtomicU64::new(0),
    });
    let ((fetched, fetches), (accepted, first_accepted)) = (channel(), channel());
    let senders = join(args, &options, &runtime, &shared, &fetched, &accepted)?;
    let fragment_bytes = shared.prepared.under("a", 1, 1).len();
    let bytes_per_transition = fragment_bytes as f64 / transitions as f64;
    let ready = json!({"fragment_bytes": fragment_bytes, "bytes_per_transition": bytes_per_transition});
    say(&ready.to_string());
    let mut load = Load { actors: args.actors as usize, shared, senders, fetches, first_accepted, cpu_before_s: 0.0 };
    for line in std::io::stdin().lock().lines() {
        if let Some(answer) = load.execute(&line.context("standard input cannot be read")?)? {
            say(&answer.to_string());
        }
    }
    runtime.shutdown_background();
    // Exits without closing hundreds of sessions one by one.
    std::process::exit(0);
}

/// Actors of this process and their reports.
struct Load {
    actors: usize,
    shared: Arc<Shared>,
    senders: Vec<JoinHandle<()>>,
    /// Number of each policy that an actor fetched, with the Unix time in seconds.
    fetches: Receiver<(u64, f64)>,
    /// One message for the first accepted fragment of each actor.
    first_accepted: Receiver<()>,
    cpu_before_s: f64,
}

impl Load {
    /// Runs the command of one line; returns the answer to commands that have one.
    fn execute(&mut self, line: &str) -> anyhow::Result<Option<Value>> {
        match line {
            "send" => {
                self.shared.enter(Phase::Sending);
                Ok(Some(self.wait_for_first_fragments()))
            }
            "measure" => {
                self.cpu_before_s = usage::cpu_s();
                self.shared.enter(Phase::Measuring);
                Ok(None)
            }
            "stop" => self.stop().map(Some),
            line => {
                let number = line.strip_prefix("expect ").and_then(|number| number.parse().ok());
                let number = number.with_context(|| format!("unknown command `{line}`"))?;
                Ok(Some(self.wait_for_policy(number)))
            }
        }
    }

    /// Waits until a fragment of every actor was accepted: before that an actor is a newcomer, which admission control
    /// limits.
    fn wait_for_first_fragments(&self) -> Value {
        let deadline = Instant::now() + FIRST_FRAGMENTS_TIMEOUT;
        let actors = std::iter::from_fn(|| {
            self.first_accepted.recv_timeout(deadline.saturating_duration_since(Instant::now())).ok()
        })
        .take(self.actors)
        .count();
        json!({"taken_of_actors": actors})
    }

    fn stop(&mut self) -> anyhow::Result<Value> {
        let cpu_s = usage::cpu_s() - self.cpu_before_s;
        self.shared.enter(Phase::Stopped);
        for sender in self.senders.drain(..) {
            sender.join().map_err(|_| anyhow::anyhow!("a sender panicked"))?;
        }
        let Outcomes { receipts_ms, busy, silent, refused } = std::mem::take(&mut *self.shared.outcomes());
        Ok(json!({
            "receipts_ms": receipts_ms, "busy": busy, "silent": silent, "refused": refused, "cpu_s": cpu_s,
        }))
    }

    fn wait_for_policy(&self, number: u64) -> Value {
        self.shared.published.store(number, Ordering::Relaxed);
        let deadline = Instant::now() + ALL_FETCHED_TIMEOUT;
        let mut times = Vec::new();
        while times.len() < self.actors
            && let Ok((of, time_unix_s)) = self.fetches.recv_timeout(deadline.saturating_duration_since(Instant::now()))
        {
            if of == number {
                times.push(time_unix_s);
            }
        }
        json!({"fetched": number, "times_unix_s": times})
    }
}

impl Shared {
    fn enter(&self, phase: Phase) {
        *self.phase.lock().expect("no holder of this lock panics") = phase;
        self.changed.notify_all();
    }

    fn phase(&self) -> Phase {
        *self.phase.lock().expect("no holder of this lock panics")
    }

    fn outcomes(&self) -> std::sync::MutexGuard<'_, Outcomes> {
        self.outcomes.lock().expect("no holder of this lock panics")
    }

    fn wait_to_begin(&self) {
        let mut phase = self.phase.lock().expect("no holder of this lock panics");
        while *phase == Phase::Waiting {
            phase = self.changed.wait(phase).expect("no holder of this lock panics");
        }
    }
}

/// Joins the run with every actor: session, token, announcements, first policy. Starts the senders.
fn join(
    args: &LoadArgs,
    options: &BusOptions,
    runtime: &Runtime,
    shared: &Arc<Shared>,
    fetched: &Sender<(u64, f64)>,
    accepted: &Sender<()>,
) -> anyhow::Result<Vec<JoinHandle<()>>> {
    let mut senders = Vec::new();
    for index in args.first..args.first + args.actors {
        let name = format!("actor-{index}");
        let bus = Bus::open_client(options)?;
        let alive = token(&bus, workload::RUN, &name)?;
        let announcements = watch_announcements(&bus, workload::RUN)?;
        while runtime.block_on(fetch_policy(&bus, Some(workload::RUN), FETCH_TIMEOUT))?.is_none() {
            std::thread::sleep(RETRY);
        }
        let (shared_too, fetched, bus_too) = (shared.clone(), fetched.clone(), bus.clone());
        runtime.spawn(async move {
            follow(&bus_too, &announcements, &shared_too, &fetched).await;
            drop(alive);
        });
        let sequence = Arc::new(AtomicU64::new(1));
        for sender in 0..args.in_flight {
            let (shared, bus, name, sequence) = (shared.clone(), bus.clone(), name.clone(), sequence.clone());
            let (handle, first) = (runtime.handle().clone(), (sender == 0).then(|| accepted.clone()));
            let work = move || deliver(&shared, &bus, &name, &sequence, &handle, first);
            senders.push(std::thread::Builder::new().stack_size(STACK_BYTES).spawn(work)?);
        }
    }
    Ok(senders)
}

/// Sends one fragment after the other, each until it is settled. `first` gets a message at the first accepted one.
fn deliver(
    shared: &Shared,
    bus: &Bus,
    name: &str,
    sequence: &AtomicU64,
    handle: &Handle,
    mut first: Option<Sender<()>>,
) {
    let incarnation = workload::ACTOR_INCARNATION;
    let timeout = Duration::from_millis(BusConfig::default().receipt_timeout_ms);
    let mut own = shared.prepared.under(name, incarnation, 1);
    shared.wait_to_begin();
    while shared.phase() != Phase::Stopped {
        let number = sequence.fetch_add(1, Ordering::Relaxed);
        shared.prepared.rename(&mut own, name, incarnation, number);
        // One for each fragment: the prepared bytes are reused, so none is kept until it is durable.
        let mut delivery = Delivery::new(workload::INCARNATION);
        let begun = Instant::now();
        let mut next = Some(delivery.produce(number, Bytes::from(own)));
        let mut fragment = Bytes::new();
        while let Some(attempt) = next.take() {
            std::thread::sleep(attempt.pause);
            fragment = attempt.bytes;
            let answer = handle.block_on(submit(bus, workload::RUN, name, fragment.clone(), timeout, |_| true));
            let receipt = answer.ok().flatten();
            let outcome = receipt.as_ref().map(|receipt| receipt.outcome);
            if outcome == Some(Outcome::Accepted)
                && let Some(first) = first.take()
            {
                let _ = first.send(());
            }
            if shared.phase() == Phase::Measuring {
                let mut outcomes = shared.outcomes();
                match outcome {
                    Some(Outcome::Accepted) => outcomes.receipts_ms.push(begun.elapsed().as_secs_f64() * 1e3),
                    Some(Outcome::Busy) => outcomes.busy += 1,
                    None => outcomes.silent += 1,
                    Some(_) => outcomes.refused += 1,
                }
            }
            let event = match receipt {
                Some(receipt) => Event::Answered { sequence: number, receipt },
                None => Event::Silent { sequence: number },
            };
            next = delivery.handle(event).into_iter().find_map(|action| match action {
                Action::Send(attempt) if shared.phase() != Phase::Stopped => Some(attempt),
                _ => None,
            });
        }
        drop(delivery);
        // Reuses the memory, unless the bus still holds it.
        own = Vec::from(fragment);
        if !shared.pause.is_zero() {
            std::thread::sleep(shared.pause);
        }
    }
}

/// Fetches each announced policy, and published ones whose announcement was lost. Reports the time of each.
async fn follow(bus: &Bus, announcements: &Announcements, shared: &Shared, fetched: &Sender<(u64, f64)>) {
    let poll_interval = Duration::from_millis(BusConfig::default().policy_poll_ms);
    let mut known = PolicyVersion::new(workload::INCARNATION, 0);
    loop {
        let announced = tokio::time::timeout(poll_interval, announcements.next()).await;
        if announced.is_err() && shared.published.load(Ordering::Relaxed) == known.number {
            continue;
        }
        let announced = announced.ok().flatten().map(|announced| announced.version);
        let request = PolicyRequest { known: Some(known), announced, config_hash: workload::CONFIG_HASH, offset: 0 };
        if let Ok(Some(FetchedPolicy::Newer(bundle))) =
            fetch_newer_policy(bus, workload::RUN, &request, FETCH_TIMEOUT).await
        {
            known = bundle.version;
            if fetched.send((known.number, machine::time_unix_s())).is_err() {
                return;
            }
        }
    }
}
