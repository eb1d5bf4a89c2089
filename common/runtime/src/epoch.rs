//! Epochs: the terms of a run's learners, which only grow.

use std::{
    sync::Mutex,
    time::{SystemTime, UNIX_EPOCH},
};

/// Returns the epoch after `last`: at least the time in seconds since 1970, so that a run which begins again under the same
/// name gets a higher one than before. Whatever the clock shows, it is higher than `last`.
#[must_use]
pub fn next(last: u64) -> u64 {
    let now_s = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |now| now.as_secs());
    now_s.max(last + 1)
}

/// Highest epoch of a run that a process has seen: a learner of a lower one was overtaken.
#[derive(Debug, Default)]
pub struct SeenEpoch {
    /// Name of the run, and its epoch.
    highest: Mutex<(String, u64)>,
}

impl SeenEpoch {
    /// Notes an epoch of `run`. Returns false if a higher one was seen before: what came with it must not be used. An
    /// epoch of 0 is unknown, and always admitted.
    pub fn admits(&self, run: &str, epoch: u64) -> bool {
        let mut highest = self.highest.lock().expect("no holder of this lock panics");
        if highest.0 != run {
            *highest = (run.to_string(), 0);
        }
        if epoch != 0 && epoch < highest.1 {
            return false;
        }
        highest.1 = highest.1.max(epoch);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn epochs_grow_whatever_the_clock_shows() {
        let first = next(0);
        assert!(first > 1_700_000_000);
        assert_eq!(next(first + 3600), first + 3601);
    }

    #[test]
    fn only_lower_epochs_of_the_same_run_are_refused() {
        let seen = SeenEpoch::default();
        assert!(seen.admits("walk", 5) && seen.admits("walk", 5) && seen.admits("walk", 6));
        assert!(!seen.admits("walk", 5), "overtaken");
        assert!(seen.admits("walk", 0) && seen.admits("walk", 6), "0 is unknown, and changes nothing");
        assert!(seen.admits("run", 2), "another run counts by itself");
        assert!(!seen.admits("run", 1));
    }
}
