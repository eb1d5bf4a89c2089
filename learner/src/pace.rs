//! How much of what actors bring is learnt from, and how thoroughly.
//!
//! Where experience waits although the learner works all the time, it first takes larger batches, and where that is not
//! enough, fewer passes over each; only then do actors wait for their receipts.

use treadmill_config::{Config, LearnerMode};

use crate::intake::{Gathered, Wanted};

/// Size of batches and passes over them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pace {
    wanted: Wanted,
    epochs: u32,
    epochs_min: u32,
    epochs_max: u32,
}

impl Pace {
    /// As configured; in mode `sync`, where actors wait by design, nothing ever changes.
    pub fn new(config: &Config) -> Self {
        let (transitions, epochs) = (config.ppo.batch as usize, config.ppo.epochs);
        let (most, fewest) = match config.learner.mode {
            LearnerMode::Sync => (transitions, epochs),
            LearnerMode::Async => (transitions.max(config.ppo.batch_max as usize), epochs.min(config.ppo.epochs_min)),
        };
        Self { wanted: Wanted { transitions, transitions_max: most }, epochs, epochs_min: fewest, epochs_max: epochs }
    }

    /// How large the next batch may be.
    pub fn wanted(&self) -> Wanted {
        self.wanted
    }

    /// Passes over the present batch.
    pub fn epochs(&self) -> u32 {
        self.epochs
    }

    /// Takes note of a batch: one pass less where more waited than the largest batch takes, one more where nothing did.
    pub fn heed(&mut self, gathered: &Gathered) {
        self.epochs = match gathered.more_waited {
            true => self.epochs - 1,
            false => self.epochs + 1,
        }
        .clamp(self.epochs_min, self.epochs_max);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pace(mode: LearnerMode, epochs_min: u32) -> Pace {
        let mut config = Config::default();
        config.learner.mode = mode;
        (config.ppo.batch, config.ppo.batch_max) = (100, 250);
        (config.ppo.epochs, config.ppo.epochs_min) = (5, epochs_min);
        Pace::new(&config)
    }

    fn heed(pace: &mut Pace, more_waited: bool) -> u32 {
        pace.heed(&Gathered { fragments: Vec::new(), more_waited });
        pace.epochs()
    }

    #[test]
    fn passes_go_down_to_their_bound_and_back() {
        let mut pace = pace(LearnerMode::Async, 3);
        assert_eq!(pace.wanted(), Wanted { transitions: 100, transitions_max: 250 });
        assert_eq!(pace.epochs(), 5);
        let told = [true, true, true, false, false, false].map(|more| heed(&mut pace, more));
        assert_eq!(told, [4, 3, 3, 4, 5, 5]);
    }

    #[test]
    fn bounds_that_say_nothing_change_nothing() {
        let mut strict = pace(LearnerMode::Async, 9);
        assert_eq!(heed(&mut strict, true), 5);
        let mut sync = pace(LearnerMode::Sync, 1);
        assert_eq!(sync.wanted(), Wanted { transitions: 100, transitions_max: 100 });
        assert_eq!(heed(&mut sync, true), 5);
    }
}
