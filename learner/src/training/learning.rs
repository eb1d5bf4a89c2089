//! Updates the policy from a batch.

use std::time::{Duration, Instant};

use treadmill_config::Config;
use treadmill_policy::CHUNK_ROWS;
use treadmill_ppo::{
    Implausible, Improvement, LoadAdaptation, Ppo, PpoOptions, PpoState, TrainedPolicy, UpdateError, UpdateStats,
};
use treadmill_proto::Fragment;
use treadmill_runtime::{error_chain, machine};

use super::{TrainingError, TrainingOptions};
use crate::{checkpoint::TrainingState, intake::CollectedBatch};

/// Learning part of a trainer: called with a batch, it returns a policy.
pub(super) struct Learning {
    pub(super) ppo: Ppo,
    pub(super) load: LoadAdaptation,
    undone_in_a_row: u32,
}

/// Result of an update.
pub(super) struct Update {
    /// Policy after the update.
    pub(super) policy: TrainedPolicy,
    /// Statistics, or why the update was undone.
    pub(super) result: Result<UpdateStats, UpdateError>,
    /// Implausible fragments, which were removed from the batch.
    pub(super) rejected: Vec<(Fragment, Implausible)>,
    /// Passes over the batch.
    pub(super) epochs: u32,
    /// Duration of the gradient steps.
    pub(super) learn: Duration,
}

impl Update {
    /// Returns the statistics; `None` if the update was undone.
    pub(super) fn stats(&self) -> Option<&UpdateStats> {
        self.result.as_ref().ok()
    }
}

impl Learning {
    /// Starts the threads of the update.
    pub(super) fn new(
        state: &TrainingState,
        config: &Config,
        options: &TrainingOptions,
    ) -> Result<Self, TrainingError> {
        let invalid = |why: &dyn std::error::Error| TrainingError::State { why: error_chain(why) };
        let threads = machine::threads(config.learner.threads as usize);
        let ppo_options = PpoOptions {
            device: options.device.clone(),
            chunk_rows: match config.learner.chunk_rows {
                0 => CHUNK_ROWS,
                rows => rows as usize,
            },
            observation_clip: config.policy.observation_clip as f32,
            ..PpoOptions::on_cpu(threads).map_err(|why| invalid(&why))?
        };
        let ppo = Ppo::new(ppo_options, &config.ppo);
        ppo.policy(&state.ppo).map_err(|why| invalid(&why))?;
        if let Some((gpu, bytes)) = ppo.reserve(state.ppo.networks())? {
            tracing::info!(gpu, memory_mb = bytes.div_ceil(1_000_000), "updates are computed on a GPU");
        }
        Ok(Self { ppo, load: LoadAdaptation::new(&config.ppo, config.learner.mode), undone_in_a_row: 0 })
    }

    /// Adopts a changed configuration.
    pub(super) fn set_config(&mut self, config: &Config) {
        self.ppo.set_config(&config.ppo);
        self.load = LoadAdaptation::new(&config.ppo, config.learner.mode);
    }

    /// Updates the policy from the fragments of a batch, without those that are implausible.
    pub(super) fn update(&mut self, state: &mut PpoState, batch: &mut CollectedBatch) -> Result<Update, TrainingError> {
        let epochs = self.load.epochs();
        let prepared = self.ppo.prepare(state, &mut batch.fragments).map_err(TrainingError::Inference)?;
        let begun = Instant::now();
        let Improvement { policy, result, rejected } = self.ppo.improve(state, epochs, &mut batch.fragments, prepared);
        let learn = begun.elapsed();
        self.load.adapt(batch.has_backlog);
        Ok(Update { policy, result, rejected, epochs, learn })
    }

    /// Counts the updates in a row that were undone by a fault of the learner, and logs why.
    pub(super) fn check_undone(&mut self, update: Update, undone_max: u32) -> Result<Update, TrainingError> {
        match update.result {
            Ok(_) => self.undone_in_a_row = 0,
            // The senders are at fault, so this does not end the run.
            Err(UpdateError::Empty) => {
                let rejected = update.rejected.len();
                tracing::warn!(rejected, "update undone: no fragment of the batch is plausible");
            }
            // It does not recover. The last checkpoint is that of the update before.
            Err(UpdateError::Gpu(why)) => return Err(why.into()),
            Err(source) => {
                tracing::warn!(error = %error_chain(&source), "update undone");
                self.undone_in_a_row += 1;
                if self.undone_in_a_row >= undone_max {
                    return Err(TrainingError::Undone { updates: self.undone_in_a_row, source });
                }
                return Ok(Update { result: Err(source), ..update });
            }
        }
        Ok(update)
    }
}
