//! Process with the learner's real intake and policy server. It checks, counts and drops fragments.

use std::{
    io::BufRead,
    sync::{Arc, Mutex, atomic::Ordering},
    time::Instant,
};

use anyhow::Context;
use clap::Args;
use serde_json::{Value, json};
use treadmill_bus::{
    Bus, Role,
    learner::{Admission, Alive, PolicyServer, PublishedPolicy, RolloutCopies, RolloutIntake, ServedPolicies},
};
use treadmill_config::{Config, LearnerMode};
use treadmill_experience::{ledger::Ledger, lineage::Lineage};
use treadmill_learner::intake::{
    BatchSize, BusFragmentSource, Collected, ExpectedFragment, FleetPlan, FragmentCounts, FragmentValidator,
    HorizonRule, Intake,
};
use treadmill_learner::training::Heartbeat;
use treadmill_ppo::AcceptedFragment;
use treadmill_proto::{Fragment, PolicyBundle};
use treadmill_rl::{
    launch::{memory, output::say},
    shared::network_args::NetworkArgs,
};
use treadmill_runtime::{machine, shutdown::Shutdown};

use crate::{usage, workload};

/// Accepted fragments between two marks of durability, which stand for checkpoints.
const DURABLE_EVERY: u64 = 64;

/// Flags of `bench bus-host`.
#[derive(Args)]
pub struct HostArgs {
    /// Endpoint to listen on.
    #[arg(long, value_name = "ENDPOINT")]
    listen: String,
    #[command(flatten)]
    network: NetworkArgs,
}

/// Counts of fragments, and the checksum of the first accepted one.
#[derive(Default)]
struct Progress {
    counts: FragmentCounts,
    checksum: String,
}

/// Accepts fragments until standard input ends. Commands: `mark` returns the counts, `publish N` publishes policy N.
pub fn run(args: &HostArgs) -> anyhow::Result<()> {
    memory::keep_freed();
    usage::allow_many_connections();
    let options = args.network.options(Role::Learner, vec![args.listen.clone()], Vec::new())?;
    let (bus, endpoints) = Bus::open_router(&options)?;
    let mut bundles = workload::bundles();
    let first = PublishedPolicy::new(&bundles[0], &bundles[1])?;
    let bundle_bytes = first.bundle().len();
    let policies = PolicyServer::open(&bus, first)?;
    let defaults = Config::default();
    let capacity = defaults.learner.intake_fragments as usize;
    let admission = Arc::new(Admission::new(defaults.learner.quarantine_after, capacity));
    let (alive, copies) = (Alive::watch(&bus, workload::RUN)?, RolloutCopies::open(&bus, workload::RUN)?);
    let queue = RolloutIntake::open(&bus, workload::RUN, capacity, admission.clone(), &copies)?;
    let shared = queue.shared();
    let source = BusFragmentSource::new(queue, alive, copies, Heartbeat::default());
    let validator = FragmentValidator::new(expected(), admission, Ledger::default(), FragmentCounts::default());
    let (observation, action) = workload::WIDTHS;
    let fleet = FleetPlan::new(HorizonRule::new(&defaults, observation as usize, action as usize), 1);
    let (progress, shutdown) = (Arc::new(Mutex::new(Progress::default())), Shutdown::default());
    let intake = std::thread::Builder::new().name("training".to_string()).spawn({
        let (progress, shutdown) = (progress.clone(), shutdown.clone());
        move || accept_fragments(Intake::new(source, LearnerMode::Async, validator, fleet), &progress, &shutdown)
    })?;
    say(&json!({"endpoint": endpoints[0], "bundle_bytes": bundle_bytes}).to_string());
    let begun = Instant::now();
    for line in std::io::stdin().lock().lines() {
        let line = line.context("standard input cannot be read")?;
        let answer = match line.split_once(' ') {
            None if line == "mark" => {
                let progress = progress.lock().expect("no holder of this lock panics");
                mark(&progress, begun, shared.load(Ordering::Relaxed), policies.served())
            }
            Some(("publish", number)) => {
                let number = number.parse().context("a policy has a number")?;
                bundles.iter_mut().for_each(|bundle| bundle.version.number = number);
                publish(&policies, &bundles)?
            }
            _ => anyhow::bail!("unknown command `{line}`"),
        };
        say(&answer.to_string());
    }
    shutdown.ask();
    let _ = intake.join();
    bus.close();
    Ok(())
}

fn expected() -> ExpectedFragment {
    ExpectedFragment {
        run: workload::RUN.to_string(),
        config_hash: workload::CONFIG_HASH,
        observation_size: workload::WIDTHS.0,
        action_size: workload::WIDTHS.1,
        max_policy_lag: 0,
        physics_version: 0,
    }
}

/// Body of the training thread without training: answers each fragment as soon as it is accepted.
fn accept_fragments(mut intake: Intake<BusFragmentSource>, progress: &Mutex<Progress>, shutdown: &Shutdown) {
    let lineage = Lineage::new(workload::INCARNATION);
    let any = BatchSize { transitions: 1, transitions_max: usize::MAX };
    let mut durable = 0;
    while let Collected::Batch(batch) = intake.collect(any, &lineage, shutdown, || false) {
        let counts = intake.validator.counts;
        if counts.accepted >= durable + DURABLE_EVERY {
            intake.validator.ledger.mark_durable();
            durable = counts.accepted;
        }
        let mut progress = progress.lock().expect("no holder of this lock panics");
        progress.counts = counts;
        if progress.checksum.is_empty() {
            progress.checksum = batch.fragments.first().map(checksum).unwrap_or_default();
        }
    }
    intake.stop(&lineage);
}

fn checksum(AcceptedFragment { fragment, .. }: &AcceptedFragment) -> String {
    let Fragment { observations, actions, log_probs, rewards, last_observations, .. } = fragment;
    workload::checksum(&[&observations[..], actions, log_probs, rewards, last_observations].concat())
}

fn mark(progress: &Progress, begun: Instant, shared: u64, served: ServedPolicies) -> Value {
    let FragmentCounts { accepted, duplicate, too_old, vanished, malformed, quarantined, implausible } =
        progress.counts;
    json!({
        "at_s": begun.elapsed().as_secs_f64(),
        "accepted": accepted,
        "not_accepted": duplicate + too_old + vanished + malformed + quarantined + implausible,
        "in_place": shared,
        "policies_served": served.policies,
        "policy_bytes": served.bytes,
        "cpu_s": usage::cpu_s(),
        "resident_mb": machine::resident_bytes() as f64 / 1e6,
        "resident_max_mb": usage::resident_max_mb(),
        "shared_mb": usage::shared_mb(),
        "checksum": progress.checksum,
    })
}

fn publish(policies: &PolicyServer, [bundle, for_actors]: &[PolicyBundle; 2]) -> anyhow::Result<Value> {
    let policy = PublishedPolicy::new(bundle, for_actors)?;
    let time_unix_s = machine::time_unix_s();
    policies.publish(policy);
    Ok(json!({"published": bundle.version.number, "time_unix_s": time_unix_s}))
}
