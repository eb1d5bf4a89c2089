//! Process with the learner's real intake and policy server. It checks, counts and drops fragments.

use std::{
    io::BufRead,
    sync::{
        Arc, Mutex,
        atomic::{AtomicU64, Ordering},
    },
};

use anyhow::Context;
use clap::Args;
use serde_json::json;
use treadmill_bus::{
    Bus, Role,
    learner::{Admission, Alive, PolicyServer, PublishedPolicy, RolloutCopies, RolloutIntake},
};
use treadmill_config::{Config, ConfigSource, LearnerMode};
use treadmill_experience::{ledger::Ledger, lineage::Lineage};
use treadmill_learner::{
    intake::{
        BatchSize, BusFragmentSource, Collected, ExpectedFragment, FleetPlan, FragmentCounts, FragmentValidator,
        HorizonRule, Intake,
    },
    waiting::Heartbeat,
};
use treadmill_policy::{NetworkShape, Networks, actor_to_safetensors, to_safetensors};
use treadmill_ppo::AcceptedFragment;
use treadmill_proto::{Fragment, PolicyBundle, PolicyVersion};
use treadmill_rl::{
    launch::{memory, output::say},
    shared::network_args::NetworkArgs,
};
use treadmill_runtime::{machine, seeds, shutdown::Shutdown};

use crate::RUN;

/// Sizes of an observation and an action of the compact humanoid.
const WIDTHS: (u32, u32) = (45, 17);
/// Hidden layers of networks whose bundle takes one megabyte.
const HIDDEN: [usize; 2] = [448, 224];
/// Control steps of a fragment, the default.
const STEPS: usize = 128;
/// Incarnation of the learner in every policy version.
const INCARNATION: u64 = 1;
/// Hash in place of that of a configuration, which does not matter here.
const CONFIG_HASH: u64 = 1;

/// Flags of `host`.
#[derive(Args)]
pub struct HostArgs {
    /// Endpoint to listen on.
    #[arg(long, value_name = "ENDPOINT")]
    listen: String,
    /// Precision of observations on the wire.
    #[arg(long, value_parser = ["f32", "f16"])]
    precision: String,
    #[command(flatten)]
    network: NetworkArgs,
}

/// Returns the environments of a fragment of about `bytes` bytes.
pub fn envs(bytes: usize, precision: &str) -> u32 {
    // Of one transition, and of the last observation of each environment.
    let (transition, last) = if precision == "f16" { (167, 90) } else { (257, 180) };
    (bytes / (STEPS * transition + last)).max(1) as u32
}

/// Checksum of the first accepted fragment.
type Checksum = Mutex<String>;

/// Accepts fragments until standard input ends. Commands: `mark` returns what no other process sees, `publish N`
/// publishes policy N.
pub fn run(args: &HostArgs) -> anyhow::Result<()> {
    memory::keep_freed();
    let options = args.network.options(Role::Learner, vec![args.listen.clone()], Vec::new())?;
    let (bus, endpoints) = Bus::open_router(&options)?;
    let text = format!(
        "[rollout]\nfragment_steps = {STEPS}\nmax_in_flight = 1\nobservation_precision = \"{}\"\n",
        args.precision
    );
    let mut source = ConfigSource::default();
    source.text(&text, "the benchmark")?;
    let config = source.build()?;
    let mut bundles = bundles(&text);
    let policies = PolicyServer::open(&bus, PublishedPolicy::new(&bundles[0], &bundles[1])?)?;
    let (checksum, shutdown) = (Arc::<Checksum>::default(), Shutdown::default());
    let (intake, shared) = intake(&bus, &config)?;
    let training = std::thread::Builder::new().name("training".to_string()).spawn({
        let (checksum, shutdown) = (checksum.clone(), shutdown.clone());
        move || accept_fragments(intake, &checksum, &shutdown)
    })?;
    say(&json!({"endpoint": endpoints[0]}).to_string());
    for line in std::io::stdin().lock().lines() {
        let line = line.context("standard input cannot be read")?;
        let answer = match line.split_once(' ') {
            None if line == "mark" => {
                let checksum = checksum.lock().expect("no holder of this lock panics").clone();
                json!({"in_place": shared.load(Ordering::Relaxed), "checksum": checksum})
            }
            Some(("publish", number)) => {
                let number = number.parse().context("a policy has a number")?;
                bundles.iter_mut().for_each(|bundle| bundle.version.number = number);
                let policy = PublishedPolicy::new(&bundles[0], &bundles[1])?;
                let time_unix_s = machine::time_unix_s();
                policies.publish(policy);
                json!({"time_unix_s": time_unix_s})
            }
            _ => anyhow::bail!("unknown command `{line}`"),
        };
        say(&answer.to_string());
    }
    shutdown.ask();
    let _ = training.join();
    bus.close();
    Ok(())
}

/// Returns the intake, and the counter of fragments that came through shared memory.
fn intake(bus: &Bus, config: &Config) -> anyhow::Result<(Intake<BusFragmentSource>, Arc<AtomicU64>)> {
    let capacity = config.learner.intake_fragments as usize;
    let admission = Arc::new(Admission::new(config.learner.quarantine_after, capacity));
    let (alive, copies) = (Alive::watch(bus, RUN)?, RolloutCopies::open(bus, RUN)?);
    let queue = RolloutIntake::open(bus, RUN, capacity, admission.clone(), &copies)?;
    let shared = queue.shared();
    let source = BusFragmentSource::new(queue, alive, copies, Heartbeat::default());
    let expected = ExpectedFragment {
        run: RUN.to_string(),
        config_hash: CONFIG_HASH,
        observation_size: WIDTHS.0,
        action_size: WIDTHS.1,
        max_policy_lag: 0,
        physics_version: 0,
    };
    let validator = FragmentValidator::new(expected, admission, Ledger::default(), FragmentCounts::default());
    let fleet = FleetPlan::new(HorizonRule::new(config, WIDTHS.0 as usize, WIDTHS.1 as usize), 1);
    Ok((Intake::new(source, LearnerMode::Async, validator, fleet), shared))
}

/// Body of the training thread without training: answers each fragment as soon as it is accepted.
fn accept_fragments(mut intake: Intake<BusFragmentSource>, checksum: &Checksum, shutdown: &Shutdown) {
    let lineage = Lineage::new(INCARNATION);
    let any = BatchSize { transitions: 1, transitions_max: usize::MAX };
    while let Collected::Batch(batch) = intake.collect(any, &lineage, shutdown, || false) {
        // Stands for a checkpoint, so that actors keep few fragments.
        intake.validator.ledger.mark_durable();
        let mut checksum = checksum.lock().expect("no holder of this lock panics");
        if checksum.is_empty() {
            *checksum = batch.fragments.first().map(checksum_of).unwrap_or_default();
        }
    }
    intake.stop(&lineage);
}

fn checksum_of(AcceptedFragment { fragment, .. }: &AcceptedFragment) -> String {
    let Fragment { observations, actions, log_probs, rewards, last_observations, .. } = fragment;
    let numbers = [&observations[..], actions, log_probs, rewards, last_observations].concat();
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    format!("{:016x}", seeds::checksum(&[&bytes]))
}

/// Returns the first policy, whole and as actors get it; others differ only in their number.
fn bundles(config_toml: &str) -> [PolicyBundle; 2] {
    let (observation, action) = (WIDTHS.0 as usize, WIDTHS.1 as usize);
    let shape = NetworkShape { observation, action, hidden: HIDDEN.to_vec(), privileged: 0 };
    let parameters = Networks::from(shape.clone()).initial_parameters(-0.5, &mut seeds::stream(1, "bench-policy", &[]));
    let weights = [to_safetensors(&shape, &parameters), actor_to_safetensors(&shape, &parameters)];
    weights.map(|weights| PolicyBundle {
        run: RUN.to_string(),
        version: PolicyVersion::new(INCARNATION, 0),
        observation_size: WIDTHS.0,
        action_size: WIDTHS.1,
        hidden: HIDDEN.map(|width| width as u32).to_vec(),
        checksum: seeds::checksum(&[&weights]),
        weights: weights.into(),
        observation_mean: vec![0.0; observation],
        observation_inverse_std: vec![1.0; observation],
        observation_clip: 10.0,
        config_hash: CONFIG_HASH,
        config_toml: config_toml.to_string(),
        model_xml: treadmill_humanoid::HUMANOID_XML.to_string(),
        fragment_steps: STEPS as u32,
        ..PolicyBundle::default()
    })
}
