//! Adapts batch size and passes over each batch to the load.
//!
//! If fragments queue although the learner never waits, it first takes larger batches, then makes fewer passes over
//! each. Actors wait for their receipts only after that.

use treadmill_config::{Config, LearnerMode};

use crate::intake::{BatchSize, CollectedBatch};

/// Size of the next batch and passes over it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoadAdaptation {
    batch_size: BatchSize,
    epochs: u32,
    epochs_min: u32,
    epochs_max: u32,
}

impl LoadAdaptation {
    /// Adaptation within the configured bounds. In mode `sync`, a batch holds all that the fleet delivers, and the
    /// passes are fixed.
    pub fn new(config: &Config) -> Self {
        let (transitions, epochs) = (config.ppo.batch as usize, config.ppo.epochs);
        let (transitions_max, epochs_min) = match config.learner.mode {
            LearnerMode::Sync => (usize::MAX, epochs),
            LearnerMode::Async => (transitions.max(config.ppo.batch_max as usize), epochs.min(config.ppo.epochs_min)),
        };
        Self { batch_size: BatchSize { transitions, transitions_max }, epochs, epochs_min, epochs_max: epochs }
    }

    /// Size of the next batch.
    pub fn batch_size(&self) -> BatchSize {
        self.batch_size
    }

    /// Passes over the current batch.
    pub fn epochs(&self) -> u32 {
        self.epochs
    }

    /// Adapts to a batch: one pass less if there is a backlog, else one more, within the bounds.
    pub fn adapt(&mut self, batch: &CollectedBatch) {
        let epochs = if batch.has_backlog { self.epochs - 1 } else { self.epochs + 1 };
        self.epochs = epochs.clamp(self.epochs_min, self.epochs_max);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn load(mode: LearnerMode, epochs_min: u32) -> LoadAdaptation {
        let mut config = Config::default();
        config.learner.mode = mode;
        (config.ppo.batch, config.ppo.batch_max) = (100, 250);
        (config.ppo.epochs, config.ppo.epochs_min) = (5, epochs_min);
        LoadAdaptation::new(&config)
    }

    fn adapt(load: &mut LoadAdaptation, has_backlog: bool) -> u32 {
        load.adapt(&CollectedBatch { fragments: Vec::new(), has_backlog });
        load.epochs()
    }

    #[test]
    fn passes_fall_to_their_minimum_and_rise_again() {
        let mut load = load(LearnerMode::Async, 3);
        assert_eq!(load.batch_size(), BatchSize { transitions: 100, transitions_max: 250 });
        assert_eq!(load.epochs(), 5);
        let passes = [true, true, true, false, false, false].map(|more| adapt(&mut load, more));
        assert_eq!(passes, [4, 3, 3, 4, 5, 5]);
    }

    #[test]
    fn a_minimum_above_the_passes_and_mode_sync_fix_the_passes() {
        let mut strict = load(LearnerMode::Async, 9);
        assert_eq!(adapt(&mut strict, true), 5);
        let mut sync = load(LearnerMode::Sync, 1);
        assert_eq!(sync.batch_size(), BatchSize { transitions: 100, transitions_max: usize::MAX });
        assert_eq!(adapt(&mut sync, true), 5);
    }
}
