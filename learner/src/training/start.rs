//! Prepares a trainer for its first batch.

use std::{sync::Arc, time::Duration};

use treadmill_bus::{
    Bus, BusError,
    learner::{Admission, Alive, AliveView, PolicyServer, PublishedPolicy, RolloutCopies, RolloutIntake, StatsFeed},
};
use treadmill_config::Config;
use treadmill_runtime::{error_chain, shutdown::Shutdown};

use super::{
    Trainer, TrainingError, TrainingOptions, commands,
    control::ControlChannel,
    evaluation::EvaluationScheduler,
    learning::Learning,
    pending_writes::PendingWrites,
    reporting::Reporting,
    serving::{Serving, save_newest},
    waiting::Retry,
};
use crate::{
    checkpoint::{CheckpointWriter, TrainingState},
    intake::{BusFragmentSource, ExpectedFragment, FleetPlan, FragmentValidator, HorizonRule, Intake},
    leadership::Leadership,
    metrics::{History, MetricsReport},
};

impl Trainer {
    /// Saves the state, then opens the logs and the flows on the bus.
    pub(super) fn start(
        bus: &Bus,
        mut state: TrainingState,
        mut leadership: Option<Leadership>,
        options: &TrainingOptions,
        shutdown: &Shutdown,
    ) -> Result<Self, TrainingError> {
        let invalid = |why| TrainingError::State { why };
        state.lineage.set_epoch(options.epoch);
        let mut config = state.config().map_err(invalid)?;
        config.run.steps = options.steps;
        let config_hash = state.config_hash(&config);
        let mut bundle = state.bundle(&config, config_hash).map_err(invalid)?;
        // Only in this version: an actor that joins later must not repeat steps that were learnt from.
        bundle.actor_state = state.actor_state.clone();
        let rule = HorizonRule::new(&config, state.shape.observation, state.shape.action);
        let fleet = FleetPlan::new(rule, config.rollout.envs as usize);
        bundle.fragment_steps = fleet.nominal();
        let expected = ExpectedFragment {
            run: state.run.clone(),
            config_hash,
            observation_size: bundle.observation_size,
            action_size: bundle.action_size,
            max_policy_lag: config.policy_lag_allowed().into(),
            physics_version: bundle.physics_version,
        };
        let learning = Learning::new(&state, &config, options)?;
        let every_updates = config.learner.checkpoint_every_updates.into();
        let keep = config.learner.keep_checkpoints as usize;
        let checkpoints = match &leadership {
            Some(leadership) => CheckpointWriter::in_store(leadership.store(), every_updates, keep),
            None => CheckpointWriter::new(&options.folder, every_updates, keep),
        };
        // Save this version before any actor can get it, so that a learner that dies now resumes from it.
        let (heartbeat, pending) = (options.heartbeat.clone(), PendingWrites::default());
        let successor = leadership.as_ref().map(Leadership::successor).unwrap_or_default();
        let retry = Retry { shutdown: shutdown.clone(), heartbeat, pending: pending.clone(), successor };
        let saved = save_newest(&state, leadership.as_mut(), &checkpoints, &retry)?;
        let policy = PublishedPolicy::new(&bundle, &state.for_actors(&bundle));
        let policy = policy.map_err(|why| invalid(error_chain(&why)))?;
        let report = MetricsReport::open(bus, &state, &config, options)?;
        // `MetricsReport::open` has removed lines newer than the checkpoint.
        let history = History::read(&options.folder.metrics())?;
        let (intake, alive) = open_intake(bus, &state, &config, options, expected, fleet)?;
        let status = commands::first_status(&state, config.run.steps);
        let control = ControlChannel::open(bus, status, alive.clone(), options.console.actor_command.clone(), pending)?;
        let stats = StatsFeed::open(bus, &state.run, alive)?;
        let (every_steps, env_steps) = (config.eval.every_steps, state.counters.env_steps);
        let scheduler = config.evaluates().then(|| EvaluationScheduler::open(bus, &state.run, every_steps, env_steps));
        let evaluation = scheduler.transpose()?;
        let policies = PolicyServer::open(bus, policy)?;
        let serving = Serving {
            intake,
            policies,
            evaluation,
            control,
            paused: false,
            checkpoints,
            leadership,
            saved,
            heartbeat: options.heartbeat.clone(),
            waited: Duration::ZERO,
        };
        let reporting = Reporting::new(report, history, stats, &state, options)?;
        Ok(Self { state, config, shutdown: shutdown.clone(), retry, is_stopped: false, learning, serving, reporting })
    }
}

/// Opens the intake of fragments on the bus. Also returns the view of living actors.
fn open_intake(
    bus: &Bus,
    state: &TrainingState,
    config: &Config,
    options: &TrainingOptions,
    expected: ExpectedFragment,
    fleet: FleetPlan,
) -> Result<(Intake<BusFragmentSource>, AliveView), BusError> {
    let capacity = config.learner.intake_fragments as usize;
    let admission = Arc::new(Admission::new(config.learner.quarantine_after, capacity));
    let validator = FragmentValidator::new(expected, admission.clone(), state.ledger.clone(), state.fragment_counts);
    let copies = RolloutCopies::open(bus, &state.run)?;
    let queue = RolloutIntake::open(bus, &state.run, capacity, admission, &copies)?;
    let alive = Alive::watch(bus, &state.run)?;
    let view = alive.view();
    let source = BusFragmentSource::new(queue, alive, copies, options.heartbeat.clone());
    Ok((Intake::new(source, config.learner.mode, validator, fleet), view))
}
