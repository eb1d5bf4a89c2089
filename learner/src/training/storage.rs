//! Where the states of a run are saved: in its folder, or in a store.

use std::time::Duration;

use bytes::Bytes;
use treadmill_config::{Config, LearnerConfig};
use treadmill_runtime::{error_chain, run_folder::RunFolder};

use super::TrainingError;
use crate::{
    checkpoint::{CheckpointError, CheckpointWriter, TrainingState, encoding},
    leadership::{Leadership, Status},
    waiting::Retry,
};

/// Longest time for writing into the store why a leadership ended. A supervisor kills after a minute at the earliest.
const END_WITHIN: Duration = Duration::from_secs(20);

/// Saves the states of a run. Waits while the disk is full or the store fails.
pub(super) struct Storage {
    checkpoints: CheckpointWriter,
    /// Right to write the state, of a run in a store.
    leadership: Option<Leadership>,
    retry: Retry,
    /// Newest checkpoint, encoded.
    pub(super) saved: Bytes,
}

impl Storage {
    /// Saves a first state.
    pub(super) fn open(
        state: &TrainingState,
        config: &Config,
        leadership: Option<Leadership>,
        folder: &RunFolder,
        retry: Retry,
    ) -> Result<Self, TrainingError> {
        let (every_updates, keep) = retention(&config.learner);
        let checkpoints = match &leadership {
            Some(leadership) => CheckpointWriter::in_store(leadership.store(), every_updates, keep),
            None => CheckpointWriter::new(folder, every_updates, keep),
        };
        let mut storage = Self { checkpoints, leadership, retry, saved: Bytes::new() };
        storage.save(state)?;
        Ok(storage)
    }

    /// Adopts a changed configuration.
    pub(super) fn set_config(&mut self, config: &Config) {
        let (every_updates, keep) = retention(&config.learner);
        self.checkpoints.set_retention(every_updates, keep);
    }

    /// Makes a state the newest of the run.
    pub(super) fn save(&mut self, state: &TrainingState) -> Result<(), TrainingError> {
        let Self { checkpoints, leadership, retry, saved } = self;
        let encoded = match leadership {
            None => retry.until_written(|| checkpoints.save(state))?,
            Some(leadership) => {
                let encoded = encoding::encode(state)?;
                retry.until_written(|| leadership.save(&state.run, &state.counters, &encoded))?;
                encoded
            }
        };
        *saved = encoded.into();
        Ok(())
    }

    /// Saves an encoded state as the best one.
    pub(super) fn save_best(&self, state: &[u8]) -> Result<(), TrainingError> {
        Ok(self.retry.until_written(|| self.checkpoints.save_best(state))?)
    }

    /// Saves the newest checkpoint under the number of updates, as an operator asked. Returns its place.
    pub(super) fn save_kept(&self, updates: u64) -> Result<String, CheckpointError> {
        self.checkpoints.save_kept(updates, &self.saved)
    }

    /// Returns the job that keeps the newest checkpoint, if a numbered one is due after this number of updates.
    pub(super) fn numbered(&self, updates: u64) -> Option<impl FnOnce() -> Result<(), TrainingError> + Send + 'static> {
        let Self { checkpoints, retry, saved, .. } = self;
        let (checkpoints, retry, saved) = (checkpoints.clone(), retry.clone(), saved.clone());
        let is_due = checkpoints.is_due(updates);
        is_due.then_some(move || Ok(retry.until_written(|| checkpoints.save_numbered(updates, &saved))?))
    }

    /// Returns an error if another learner is known to have taken the run over.
    pub(super) fn check_leadership(&self) -> Result<(), TrainingError> {
        self.leadership.as_ref().map_or(Ok(()), |leadership| Ok(leadership.check()?))
    }

    /// Reads in the store that this learner still leads. One that was frozen may have been overtaken without knowing.
    pub(super) fn confirm_leadership(&self) -> Result<(), TrainingError> {
        let Some(leadership) = &self.leadership else { return Ok(()) };
        Ok(self.retry.until_written(|| leadership.confirm())?)
    }

    /// Writes into the store why this learner leads no longer, so that a standby need not wait.
    pub(super) fn end_leadership(&mut self, status: Status) {
        let Some(leadership) = &mut self.leadership else { return };
        // A standby finds out by itself that a learner is gone, but not that the run is to end.
        let within = if status == Status::Released { Duration::ZERO } else { END_WITHIN };
        match (leadership.end(status, within), status) {
            (Ok(()), _) => {}
            (Err(why), Status::Stopped) => {
                let error = error_chain(&why);
                tracing::warn!(%error, "the store does not know that the run was stopped: stop standbys, too");
            }
            (Err(why), _) => tracing::debug!(error = %error_chain(&why), "end of the leadership not written"),
        }
    }
}

/// Returns every how many updates a numbered checkpoint is written, and how many are kept.
fn retention(config: &LearnerConfig) -> (u64, usize) {
    (config.checkpoint_every_updates.into(), config.keep_checkpoints as usize)
}
