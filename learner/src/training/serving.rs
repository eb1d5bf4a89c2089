//! Collects batches, saves and publishes policies, and takes evaluation results.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use treadmill_bus::{
    Bus,
    learner::{Admission, Alive, PolicyServer, PublishedPolicy, RolloutCopies, RolloutIntake, StatsFeed},
};
use treadmill_config::{Config, LearnerMode, RunConfig};
use treadmill_experience::lineage::Lineage;
use treadmill_ppo::{AcceptedFragment, BatchSize, Implausible, TrainedPolicy};
use treadmill_proto::{Fragment, PoolDemand};
use treadmill_runtime::{error_chain, shutdown::Shutdown};

use super::{
    TrainingError, TrainingOptions,
    control::ControlChannel,
    evaluation::{EvaluationResult, EvaluationScheduler},
    status,
    storage::Storage,
};
use crate::{
    checkpoint::{self, TrainingState, encoding},
    intake::{BusFragmentSource, Collected, ExpectedFragment, FleetPlan, FragmentValidator, HorizonRule, Intake},
    pool::{Pool, PoolWish},
    waiting::PendingWrites,
};

/// Serving part of a trainer: actors, evaluators and operators.
pub(super) struct Serving {
    pub(super) intake: Intake<BusFragmentSource>,
    policies: PolicyServer,
    /// Evaluation during training, if it is configured.
    evaluation: Option<EvaluationScheduler>,
    pub(super) control: ControlChannel,
    pub(super) storage: Storage,
    /// Part in the pool of actors; a deterministic run and an external task have none.
    pool: Option<Pool>,
    /// When the pool last heard of the run's own environments.
    envs_reported: Instant,
    /// Time that the learner waited for the current batch. Time in a pause does not count.
    pub(super) waited: Duration,
}

impl Serving {
    /// Opens the flows on the bus and publishes the policy of a state that `storage` has saved. Also returns the
    /// statistics of actors.
    pub(super) fn open(
        bus: &Bus,
        state: &TrainingState,
        config: &Config,
        options: &TrainingOptions,
        storage: Storage,
        pending: PendingWrites,
    ) -> Result<(Self, StatsFeed), TrainingError> {
        let config_hash = state.config_hash(config);
        let rule = HorizonRule::new(config, state.shape().observation, state.shape().action);
        let fleet = FleetPlan::new(rule, config.rollout.envs as usize);
        let policy = published(state, &state.ppo.trained_policy(), config, config_hash, fleet.nominal(), true)?;

        let capacity = config.learner.intake_fragments as usize;
        let admission = Arc::new(Admission::new(config.learner.quarantine_after, capacity));
        let expected = ExpectedFragment {
            run: state.run.clone(),
            config_hash,
            observation_size: state.shape().observation as u32,
            action_size: state.shape().action as u32,
            max_policy_lag: config.policy_lag_allowed().into(),
            physics_version: state.physics_version,
        };
        let validator =
            FragmentValidator::new(expected, admission.clone(), state.ledger.clone(), state.fragment_counts);
        let copies = RolloutCopies::open(bus, &state.run)?;
        let queue = RolloutIntake::open(bus, &state.run, capacity, admission, &copies)?;
        let alive = Alive::watch(bus, &state.run)?;
        let view = alive.view();
        let source = BusFragmentSource::new(queue, alive, copies, options.heartbeat.clone());
        let intake = Intake::new(source, config.learner.mode, validator, fleet);

        let (status, actor_command) = (status::first(state, config), options.report.console.actor_command.clone());
        let control = ControlChannel::open(bus, status, view.clone(), actor_command, pending)?;
        let stats = StatsFeed::open(bus, &state.run, view.clone())?;
        let (every_steps, env_steps) = (config.eval.every_steps, state.counters.env_steps);
        let scheduler = config.evaluates().then(|| EvaluationScheduler::open(bus, &state.run, every_steps, env_steps));
        let evaluation = scheduler.transpose()?;
        let policies = PolicyServer::open(bus, policy)?;
        let demand = PoolDemand {
            run: state.run.clone(),
            physics_version: state.physics_version,
            epoch: options.epoch,
            ..PoolDemand::default()
        };
        let takes_part = !config.run.deterministic && !config.is_external();
        let pool = takes_part.then(|| Pool::open(bus, demand, PoolWish::of(&config.run), view)).transpose()?;
        let (envs_reported, waited) = (Instant::now(), Duration::ZERO);
        Ok((Self { intake, policies, evaluation, control, storage, pool, envs_reported, waited }, stats))
    }

    /// Adopts a changed configuration.
    pub(super) fn set_config(&mut self, state: &TrainingState, config: &Config) {
        self.set_rule(state, config);
        self.storage.set_config(config);
        let RunConfig { share, envs_min, envs_max, .. } = config.run;
        self.set_wish(|wish| *wish = PoolWish { share, envs_min, envs_max, ..wish.clone() });
        if let Some(evaluation) = &mut self.evaluation {
            evaluation.set_every(config.eval.every_steps, state.counters.env_steps);
        }
    }

    /// Fits fragments to another size of batches.
    pub(super) fn set_rule(&mut self, state: &TrainingState, config: &Config) {
        self.intake.fleet.set_rule(HorizonRule::new(config, state.shape().observation, state.shape().action));
    }

    /// Sets whether the run takes actors of the pool.
    pub(super) fn set_open(&self, is_open: bool) {
        self.set_wish(|wish| wish.is_open = is_open);
    }

    /// Passes the environments of its actors to the pool, now and then.
    pub(super) fn report_envs(&mut self) {
        if self.envs_reported.elapsed() >= status::EVERY {
            self.envs_reported = Instant::now();
            self.set_wish(|wish| wish.envs = Arc::new(self.intake.fleet.envs()));
        }
    }

    fn set_wish(&self, change: impl FnOnce(&mut PoolWish)) {
        if let Some(pool) = &self.pool {
            pool.set(change);
        }
    }

    /// Returns the part of the run in the pool.
    pub(super) fn pool(&self) -> Option<PoolDemand> {
        self.pool.as_ref().map(Pool::demand)
    }

    /// Lets the actors of the pool go to other runs.
    pub(super) fn leave_pool(&mut self) {
        self.pool = None;
    }

    /// Whether evaluators can get policies.
    pub(super) fn evaluates(&self) -> bool {
        self.evaluation.is_some()
    }

    /// Collects a batch until it is complete, a command is queued, the status is due, or shutdown is requested.
    pub(super) fn collect(&mut self, size: BatchSize, lineage: &Lineage, shutdown: &Shutdown) -> Collected {
        let begun = Instant::now();
        let Self { intake, control, .. } = self;
        let interrupt = || control.has_command() || control.since_status() >= status::EVERY;
        let collected = intake.collect(size, lineage, shutdown, interrupt);
        self.waited += begun.elapsed();
        collected
    }

    /// Records which fragments of a batch were learnt from. The others were removed from it.
    pub(super) fn report_learnt(&mut self, rejected: &[(Fragment, Implausible)], learnt: &[AcceptedFragment]) {
        let validator = &mut self.intake.validator;
        for (fragment, why) in rejected {
            validator.report_implausible(fragment, why, Instant::now());
        }
        learnt.iter().for_each(|accepted| validator.report_learnt(&accepted.fragment));
    }

    /// Takes the next evaluation result; a policy that is the best so far is saved as `best`.
    pub(super) fn take_evaluation(
        &mut self,
        state: &mut TrainingState,
    ) -> Result<Option<EvaluationResult>, TrainingError> {
        let Some(result) = self.evaluation.as_mut().and_then(EvaluationScheduler::next_result) else {
            return Ok(None);
        };
        let return_mean = result.report.return_mean;
        if !state.best_is_evaluated || state.best_return.is_none_or(|best| return_mean > best) {
            (state.best_return, state.best_is_evaluated) = (Some(return_mean), true);
            // The checkpoint is older than its result. A run that goes on from it must not forget how good it is.
            let mut best = checkpoint::decode("the evaluated checkpoint", &result.checkpoint)?;
            (best.best_return, best.best_is_evaluated) = (state.best_return, true);
            let best = encoding::encode(&best)?;
            // If another learner leads, the best policy is its own.
            self.storage.confirm_leadership()?;
            self.storage.save_best(&best)?;
        }
        Ok(Some(result))
    }

    /// Writes the checkpoint. Actors wait for it, so that no version is announced that a crash could undo.
    pub(super) fn save(&mut self, state: &mut TrainingState) -> Result<(), TrainingError> {
        let validator = &mut self.intake.validator;
        validator.count_unread();
        state.fragment_counts = validator.counts;
        state.ledger = validator.ledger.clone();
        // Once this state is written, everything accepted so far is durable.
        state.ledger.mark_durable();
        let is_best = state.adopt_best_in_training();
        self.storage.save(state)?;
        if is_best {
            self.storage.save_best(&self.storage.saved)?;
        }
        self.intake.validator.ledger.mark_durable();
        Ok(())
    }

    /// Publishes a policy whose state is saved, releases the receipts, and submits it for evaluation if one is due.
    /// `has_actor` is whether a restarted actor may go on from the state's.
    pub(super) fn publish(
        &mut self,
        policy: &TrainedPolicy,
        state: &TrainingState,
        config: &Config,
        has_actor: bool,
    ) -> Result<(), TrainingError> {
        let config_hash = self.intake.validator.config_hash();
        let published = published(state, policy, config, config_hash, self.intake.fleet.nominal(), has_actor)?;
        let encoded = published.bundle();
        self.policies.publish(published);
        if config.learner.mode == LearnerMode::Sync {
            self.intake.begin_round(&state.lineage);
        }
        let env_steps = state.counters.env_steps;
        if let Some(evaluation) = &mut self.evaluation
            && evaluation.is_due(env_steps)
        {
            evaluation.submit(state.lineage.newest(), encoded, env_steps, self.storage.saved.clone());
        }
        Ok(())
    }
}

/// Encodes a policy of a state, with the state of a deterministic run's only actor where no steps after it have been
/// delivered: the actor that goes on from there must not repeat any.
fn published(
    state: &TrainingState,
    policy: &TrainedPolicy,
    config: &Config,
    config_hash: u64,
    fragment_steps: u32,
    has_actor: bool,
) -> Result<PublishedPolicy, TrainingError> {
    let invalid = |why| TrainingError::State { why };
    let mut bundle = state.bundle(policy, config, config_hash).map_err(invalid)?;
    bundle.actor_state = state.actor_state.clone().filter(|_| has_actor);
    bundle.fragment_steps = fragment_steps;
    PublishedPolicy::new(&bundle, &state.for_actors(policy, &bundle)).map_err(|why| invalid(error_chain(&why)))
}
