//! The training loop: collect, update, save, publish, log.
//!
//! # Layout
//! - Here: [`train`] and its loop. `Trainer` has three parts, and passes to each what it needs of the others.
//! - `learning`: updates the policy from a batch.
//! - `serving`: collects batches, saves and publishes policies, takes evaluation results; `storage`: where states are saved.
//! - `reporting`: logs each update; `background`: thread for the work that no actor waits for.
//! - `options`: [`TrainingOptions`] and [`TrainingSummary`]; `error`: [`TrainingError`].
//! - `start`: prepares a `Trainer` for its first batch; `end`: stops it after the last.
//! - `commands`: applies control commands; `status`: publishes the run's status.
//! - `alarms`: conditions that need an operator.
//! - [`control`]: queues commands for the training thread and answers status requests.
//! - [`evaluation`]: schedules evaluations during training.

mod alarms;
mod background;
mod commands;
pub mod control;
mod end;
mod error;
pub mod evaluation;
mod learning;
mod options;
mod reporting;
mod serving;
mod start;
mod status;
mod storage;
mod stuck;

use std::time::{Duration, Instant};

use treadmill_bus::Bus;
use treadmill_config::Config;
use treadmill_runtime::shutdown::Shutdown;

pub use self::commands::is_changeable;
pub use self::error::TrainingError;
pub use self::options::{TrainingOptions, TrainingSummary};
use self::{
    evaluation::EvaluationResult,
    learning::{Learning, Update},
    reporting::{Reporting, Round},
    serving::Serving,
};
use crate::{
    checkpoint::TrainingState,
    intake::{Collected, CollectedBatch},
    leadership::Leadership,
    metrics::scalars::PhaseDurations,
    waiting::Heartbeat,
};

/// Trains until the run has all its steps or shutdown is requested. Blocks, so it needs its own thread. With
/// `leadership`, the state is in a store; without, in the run's folder.
///
/// # Errors
/// If the bus, the state's disk or store, or a log fails; if another learner has taken the run over; or if too many
/// updates in a row were undone.
pub fn train(
    bus: &Bus,
    state: TrainingState,
    leadership: Option<Leadership>,
    options: &TrainingOptions,
    shutdown: &Shutdown,
) -> Result<TrainingSummary, TrainingError> {
    let (begun, steps_before) = (Instant::now(), state.counters.env_steps);
    let mut trainer = Trainer::start(bus, state, leadership, options, shutdown)?;
    // A successor ends every wait, so whatever failed then is not the cause.
    let outcome = run(&mut trainer).map_err(|why| trainer.serving.storage.check_leadership().err().unwrap_or(why));
    let parts = trainer.reporting.parts;
    let (state, history, stopped) = trainer.finish(outcome)?;
    Ok(TrainingSummary {
        wall_s: begun.elapsed().as_secs_f64(),
        env_steps: state.counters.env_steps - steps_before,
        stopped,
        history,
        parts,
        state,
    })
}

/// Collects, updates, saves, publishes and logs until the last step. Returns whether shutdown was requested before it.
fn run(trainer: &mut Trainer) -> Result<bool, TrainingError> {
    let mut stopwatch = Stopwatch::start();
    while trainer.state.counters.env_steps < trainer.config.run.steps {
        let (before, log) = (trainer.state.counters.env_steps, stopwatch.lap());
        let Some(mut batch) = trainer.collect()? else { return Ok(true) };
        let collect = stopwatch.lap();
        let update = trainer.update(&mut batch)?;
        let updating = stopwatch.lap();
        let evaluation = trainer.save(&update, &batch)?;
        let checkpoint = stopwatch.lap();
        trainer.publish(&update, &batch)?;
        let publish = stopwatch.lap();
        let validate = collect.saturating_sub(trainer.serving.intake.take_idle());
        let serial = log + validate + checkpoint + publish;
        let learn = update.learn;
        let durations = PhaseDurations { collect, update: updating, learn, checkpoint, publish, serial };
        trainer.log(&Round { batch, update, evaluation, durations })?;
        trainer.grow(before);
        trainer.publish_status(true);
    }
    Ok(false)
}

/// Measures the phases of a round, each from the end of the one before.
struct Stopwatch(Instant);

impl Stopwatch {
    fn start() -> Self {
        Self(Instant::now())
    }

    /// Returns the time since the last lap.
    fn lap(&mut self) -> Duration {
        let begun = std::mem::replace(&mut self.0, Instant::now());
        self.0.duration_since(begun)
    }
}

/// One run in progress.
struct Trainer {
    state: TrainingState,
    config: Config,
    shutdown: Shutdown,
    heartbeat: Heartbeat,
    /// Whether an operator has paused the run.
    is_paused: bool,
    /// Whether an operator has stopped the run.
    is_stopped: bool,
    learning: Learning,
    serving: Serving,
    reporting: Reporting,
}

impl Trainer {
    /// Collects a batch and applies commands meanwhile. Returns `None` if shutdown is requested.
    fn collect(&mut self) -> Result<Option<CollectedBatch>, TrainingError> {
        self.serving.waited = Duration::ZERO;
        loop {
            self.apply_commands()?;
            match self.serving.collect(self.learning.load.batch_size(), &self.state.lineage, &self.shutdown) {
                Collected::Batch(batch) => return Ok(Some(batch)),
                Collected::Interrupted => {
                    self.serving.storage.check_leadership()?;
                    self.publish_status_if_due();
                    self.reporting.show_wait(self.serving.waited, self.serving.intake.alive().len());
                }
                Collected::Stopped => return Ok(None),
            }
        }
    }

    /// Updates the policy from a batch. Implausible fragments are reported and removed from it.
    fn update(&mut self, batch: &mut CollectedBatch) -> Result<Update, TrainingError> {
        let update = self.learning.update(&mut self.state.ppo, batch)?;
        self.serving.report_learnt(&update.rejected, &batch.fragments);
        self.reporting.alarms.record_update(&update.result, Instant::now());
        self.heartbeat.beat();
        self.learning.check_undone(update, self.config.learner.undone_max)
    }

    /// Advances the state and saves it. Returns an evaluation that has ended meanwhile.
    fn save(&mut self, update: &Update, batch: &CollectedBatch) -> Result<Option<EvaluationResult>, TrainingError> {
        let Self { state, serving, reporting, .. } = self;
        state.advance(&batch.fragments, update.stats());
        reporting.advance(&mut state.counters, serving.intake.fleet.effort());
        let evaluation = serving.take_evaluation(state)?;
        serving.save(state)?;
        self.heartbeat.beat();
        Ok(evaluation)
    }

    /// Publishes the policy, which is saved.
    fn publish(&mut self, update: &Update, batch: &CollectedBatch) -> Result<(), TrainingError> {
        // Of a fragment for each batch, none is delivered before the policy that it needs is published.
        let has_actor = batch.fragments.len() == 1;
        self.serving.publish(&update.policy, &self.state, &self.config, has_actor)?;
        if let Some(write) = self.serving.storage.numbered(self.state.counters.updates) {
            self.reporting.background.submit(move |_| write());
        }
        Ok(())
    }

    /// Lets batches grow with the steps of the run, of which there were fewer `before`.
    fn grow(&mut self, before: u64) {
        let steps = self.state.counters.env_steps;
        if self.config.growth(steps) != self.config.growth(before) {
            let grown = self.config.grown(steps);
            self.learning.set_config(&grown);
            self.serving.set_rule(&self.state, &grown);
            tracing::info!(batch = grown.ppo.batch, "batches grow");
        }
    }

    /// Logs a round.
    fn log(&mut self, round: &Round) -> Result<(), TrainingError> {
        self.reporting.log(&self.state, &self.config, &self.learning, &self.serving, round)
    }
}
