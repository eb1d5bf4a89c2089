//! Adapts batch size and passes over each batch to the load.
//!
//! If fragments queue although the learner never waits, it first takes larger batches, then makes fewer passes over
//! each. Actors wait for their receipts only after that.

use treadmill_config::{LearnerMode, PpoConfig};

use crate::settings::BatchSize;

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
    pub fn new(config: &PpoConfig, mode: LearnerMode) -> Self {
        let (size, epochs) = (BatchSize::of(config), config.epochs);
        let (batch_size, epochs_min) = match mode {
            LearnerMode::Sync => (BatchSize { transitions_max: usize::MAX, ..size }, epochs),
            LearnerMode::Async => (size, epochs.min(config.epochs_min)),
        };
        Self { batch_size, epochs, epochs_min, epochs_max: epochs }
    }

    /// Size of the next batch.
    pub fn batch_size(&self) -> BatchSize {
        self.batch_size
    }

    /// Passes over the current batch.
    pub fn epochs(&self) -> u32 {
        self.epochs
    }

    /// Adapts to a batch: one pass less if more fragments wait than it has room for, else one more, within the bounds.
    pub fn adapt(&mut self, has_backlog: bool) {
        let epochs = if has_backlog { self.epochs - 1 } else { self.epochs + 1 };
        self.epochs = epochs.clamp(self.epochs_min, self.epochs_max);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn load(mode: LearnerMode, epochs_min: u32) -> LoadAdaptation {
        let config = PpoConfig { batch: 100, batch_max: 250, epochs: 5, epochs_min, ..PpoConfig::default() };
        LoadAdaptation::new(&config, mode)
    }

    fn adapt(load: &mut LoadAdaptation, has_backlog: bool) -> u32 {
        load.adapt(has_backlog);
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
