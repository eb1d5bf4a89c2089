//! What the rest of the learner asks of the settings, so that it does not name them.

use treadmill_config::{PpoConfig, Symmetry};
use treadmill_policy::Networks;

/// Keys of `[ppo]` that cannot change during a run.
pub const FIXED_KEYS: &[&str] = &["ppo.symmetry"];

/// Returns whether a key is one of `[ppo]` that may change during a run.
pub fn is_changeable(key: &str) -> bool {
    key.starts_with("ppo.") && !FIXED_KEYS.contains(&key)
}

/// Returns whether the networks are to be equivariant to a mirror: `None` if wherever there is one.
pub fn wants_mirror(config: &PpoConfig) -> Option<bool> {
    match config.symmetry {
        Symmetry::Auto => None,
        Symmetry::Off => Some(false),
        Symmetry::Equivariant => Some(true),
    }
}

/// Replaces settings that a new run chooses by its networks.
pub fn choose(config: &mut PpoConfig, networks: &Networks) {
    config.choose_batch(networks.mirror().is_some());
}

/// Size of an update.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UpdateSize {
    /// Fewest transitions of its batch.
    pub transitions: usize,
    /// Transitions of a gradient step.
    pub minibatch: u32,
    /// Passes over the batch.
    pub epochs: u32,
}

impl UpdateSize {
    /// Returns the configured size.
    pub fn of(config: &PpoConfig) -> Self {
        let minibatch = config.minibatch_rows() as u32;
        Self { transitions: config.batch as usize, minibatch, epochs: config.epochs }
    }
}

/// Returns the most rows of a chunk with which so many threads of an update find work: each network has a task per chunk.
pub fn chunk_rows(config: &PpoConfig, threads: usize) -> u32 {
    let has_work = |rows: &u32| 2 * config.minibatch_rows().div_ceil(*rows as usize) >= threads;
    [256, 128].into_iter().find(has_work).unwrap_or(64)
}

/// Checks that networks are of the kind that `ppo.symmetry` asks for.
///
/// # Errors
/// What they are, and what was asked for.
pub fn check_symmetry(config: &PpoConfig, networks: &Networks) -> Result<(), String> {
    let is_equivariant = networks.mirror().is_some();
    if wants_mirror(config).is_none_or(|wanted| wanted == is_equivariant) {
        return Ok(());
    }
    let (found, asked) = (if is_equivariant { "equivariant" } else { "dense" }, config.symmetry.name());
    Err(format!("its networks are {found}, but its configuration has ppo.symmetry = \"{asked}\"; begin a new run"))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_are_as_large_as_leaves_every_thread_some() {
        let rows = |minibatch, threads| chunk_rows(&PpoConfig { minibatch, ..PpoConfig::default() }, threads);
        assert_eq!([1, 2, 4, 5, 8, 9, 16, 64].map(|threads| rows(512, threads)), [256, 256, 256, 128, 128, 64, 64, 64]);
        assert_eq!([16, 17, 256].map(|threads| rows(2048, threads)), [256, 128, 64]);
        assert_eq!(rows(0, 4), 256, "0 means 512");
    }
}
