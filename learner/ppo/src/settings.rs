//! What the rest of the learner asks of the settings, so that it does not name them.

use treadmill_config::{PpoConfig, Symmetry};

/// Keys of `[ppo]` that cannot change during a run.
pub const FIXED_KEYS: &[&str] = &["ppo.symmetry"];

/// Returns whether a key is one of `[ppo]` that may change during a run.
pub fn is_changeable(key: &str) -> bool {
    key.starts_with("ppo.") && !FIXED_KEYS.contains(&key)
}

/// Returns whether the update needs a [`BatchMirror`](crate::BatchMirror).
pub fn needs_mirror(config: &PpoConfig) -> bool {
    config.symmetry != Symmetry::Off
}

/// Size of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BatchSize {
    /// Transitions that the intake waits for.
    pub transitions: usize,
    /// Transitions from which on it takes no further fragment.
    pub transitions_max: usize,
}

impl BatchSize {
    /// Returns the configured size, of learners that do not wait for their actors.
    pub fn of(config: &PpoConfig) -> Self {
        let transitions = config.batch as usize;
        Self { transitions, transitions_max: transitions.max(config.batch_max as usize) }
    }
}
