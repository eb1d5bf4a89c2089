//! Collects batches, saves checkpoints, publishes policies, and takes evaluation results.

use std::time::{Duration, Instant};

use bytes::Bytes;
use treadmill_bus::learner::{PolicyServer, PublishedPolicy};
use treadmill_config::LearnerMode;
use treadmill_runtime::error_chain;

use super::{
    Trainer, TrainingError, commands,
    control::ControlChannel,
    evaluation::{EvaluationResult, EvaluationScheduler},
    heartbeat::Heartbeat,
    waiting::Retry,
};
use crate::{
    checkpoint::{self, CheckpointWriter, TrainingState, encoding},
    intake::{BusFragmentSource, Collected, CollectedBatch, Intake},
    leadership::Leadership,
};

/// Serving part of a [`Trainer`]: actors, evaluators and operators.
pub(super) struct Serving {
    pub(super) intake: Intake<BusFragmentSource>,
    pub(super) policies: PolicyServer,
    /// Evaluation during training, if it is configured.
    pub(super) evaluation: Option<EvaluationScheduler>,
    pub(super) control: ControlChannel,
    /// Whether an operator has paused the run.
    pub(super) paused: bool,
    pub(super) checkpoints: CheckpointWriter,
    /// Right to write the state, of a run in a store.
    pub(super) leadership: Option<Leadership>,
    /// Newest checkpoint, encoded.
    pub(super) saved: Bytes,
    pub(super) heartbeat: Heartbeat,
    /// Time that the learner waited for the current batch.
    pub(super) waited: Duration,
}

impl Trainer {
    /// Collects a batch and applies commands meanwhile. Returns `None` if shutdown is requested.
    pub(super) fn collect(&mut self) -> Result<Option<CollectedBatch>, TrainingError> {
        self.serving.waited = Duration::ZERO;
        loop {
            self.apply_commands()?;
            let begun = Instant::now();
            let Serving { intake, control, .. } = &mut self.serving;
            let interrupt = || control.has_command() || control.since_status() >= commands::STATUS_EVERY;
            let size = self.learning.load.batch_size();
            let collected = intake.collect(size, &self.state.lineage, &self.shutdown, interrupt);
            // Time in a pause does not count.
            self.serving.waited += begun.elapsed();
            match collected {
                Collected::Batch(batch) => return Ok(Some(batch)),
                Collected::Interrupted => {
                    self.check_leadership()?;
                    self.publish_status_if_due();
                    let (waited, actors) = (self.serving.waited, self.serving.intake.alive().len());
                    self.reporting.background.submit(move |report| {
                        report.show_wait(waited, actors);
                        Ok(())
                    });
                }
                Collected::Stopped => return Ok(None),
            }
        }
    }

    /// Takes the next evaluation result; a policy that is the best so far is saved as `best`.
    pub(super) fn take_evaluation(&mut self) -> Result<Option<EvaluationResult>, TrainingError> {
        let Some(result) = self.serving.evaluation.as_mut().and_then(EvaluationScheduler::next_result) else {
            return Ok(None);
        };
        let return_mean = result.report.return_mean;
        let state = &mut self.state;
        if !state.best_is_evaluated || state.best_return.is_none_or(|best| return_mean > best) {
            (state.best_return, state.best_is_evaluated) = (Some(return_mean), true);
            // The checkpoint is older than its result. A run that goes on from it must not forget how good it is.
            let mut best = checkpoint::decode("the evaluated checkpoint", &result.checkpoint)?;
            (best.best_return, best.best_is_evaluated) = (state.best_return, true);
            let best = encoding::encode(&best)?;
            let Serving { checkpoints, leadership, .. } = &self.serving;
            if let Some(leadership) = leadership {
                // A learner that was frozen may have been overtaken without knowing: the best policy is the successor's
                // then.
                self.retry.until_written(|| leadership.confirm())?;
            }
            self.retry.until_written(|| checkpoints.save_best(&best))?;
        }
        Ok(Some(result))
    }

    /// Writes the checkpoint and returns its bytes. Actors wait for it, so that no version is announced that a crash
    /// could undo.
    pub(super) fn save(&mut self) -> Result<Bytes, TrainingError> {
        let validator = &mut self.serving.intake.validator;
        validator.count_unread();
        self.state.fragment_counts = validator.counts;
        self.state.ledger = validator.ledger.clone();
        // Once this state is written, everything accepted so far is durable.
        self.state.ledger.mark_durable();
        let best = self.best_in_training();
        self.state.best_return = best.or(self.state.best_return);
        let Serving { checkpoints, leadership, .. } = &mut self.serving;
        let saved = save_newest(&self.state, leadership.as_mut(), checkpoints, &self.retry)?;
        if best.is_some() {
            self.retry.until_written(|| checkpoints.save_best(&saved))?;
        }
        self.serving.saved = saved.clone();
        self.serving.intake.validator.ledger.mark_durable();
        self.serving.heartbeat.beat();
        Ok(saved)
    }

    /// Keeps the checkpoint if a numbered one is due.
    pub(super) fn keep(&self, saved: Bytes) {
        let (checkpoints, retry) = (self.serving.checkpoints.clone(), self.retry.clone());
        let updates = self.state.counters.updates;
        if checkpoints.is_due(updates) {
            self.reporting
                .background
                .submit(move |_| Ok(retry.until_written(|| checkpoints.save_numbered(updates, &saved))?));
        }
    }

    /// Returns an error if another learner has taken the run over.
    pub(super) fn check_leadership(&self) -> Result<(), TrainingError> {
        self.serving.leadership.as_ref().map_or(Ok(()), |leadership| Ok(leadership.check()?))
    }

    /// Returns the return in training, if it is the best so far and no policy was evaluated yet. A few absurd returns
    /// must not make a policy the best for ever.
    fn best_in_training(&self) -> Option<f64> {
        let TrainingState { episodes, best_is_evaluated, best_return, .. } = &self.state;
        if *best_is_evaluated {
            return None;
        }
        let return_mean = episodes.middle_return_mean()?;
        best_return.is_none_or(|best| return_mean > best).then_some(return_mean)
    }

    /// Publishes the new policy and submits it for evaluation if one is due. `saved` is its checkpoint.
    pub(super) fn publish(&mut self, saved: &Bytes) -> Result<(), TrainingError> {
        let invalid = |why| TrainingError::State { why };
        let mut bundle =
            self.state.bundle(&self.config, self.serving.intake.validator.config_hash()).map_err(invalid)?;
        bundle.fragment_steps = self.serving.intake.fleet.nominal();
        let policy = PublishedPolicy::new(&bundle, &self.state.for_actors(&bundle));
        let policy = policy.map_err(|why| invalid(error_chain(&why)))?;
        let encoded = policy.bundle();
        self.serving.policies.publish(policy);
        if self.config.learner.mode == LearnerMode::Sync {
            self.serving.intake.begin_round(&self.state.lineage);
        }
        let env_steps = self.state.counters.env_steps;
        if let Some(evaluation) = &mut self.serving.evaluation
            && evaluation.is_due(env_steps)
        {
            evaluation.submit(bundle.version, encoded, env_steps, saved.clone());
        }
        Ok(())
    }
}

/// Makes a state the newest of the run. Returns its bytes.
pub(super) fn save_newest(
    state: &TrainingState,
    leadership: Option<&mut Leadership>,
    checkpoints: &CheckpointWriter,
    retry: &Retry,
) -> Result<Bytes, TrainingError> {
    let Some(leadership) = leadership else {
        return Ok(retry.until_written(|| checkpoints.save(state))?.into());
    };
    let encoded = encoding::encode(state)?;
    retry.until_written(|| leadership.save(&state.run, &state.counters, &encoded))?;
    Ok(encoded.into())
}
