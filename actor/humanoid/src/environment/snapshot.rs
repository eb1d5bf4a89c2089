//! Copies of an environment's state, to restore it later.

use super::Environment;
use crate::config::EnvironmentConfig;
use crate::error::SnapshotError;
use crate::info::StepInfo;
use crate::physics::PhysicsSnapshot;
use crate::randomisation::Randomiser;

/// Everything that the rest of an episode depends on; from [`Environment::snapshot`].
#[derive(Clone)]
pub struct EnvironmentSnapshot {
    config: EnvironmentConfig,
    physics: PhysicsSnapshot,
    randomiser: Randomiser,
    task: Vec<f64>,
    seed: Option<u64>,
    last_observation: Vec<f32>,
    last_info: Option<StepInfo>,
    episode_steps: u32,
}

impl Environment {
    /// Copies the episode's state: physics with contacts, step count, last observation and info, and the randomisation's
    /// draws, delayed actions and random streams.
    #[must_use]
    pub fn snapshot(&self) -> EnvironmentSnapshot {
        EnvironmentSnapshot {
            config: self.config.clone(),
            physics: self.physics.snapshot(),
            randomiser: self.randomiser.clone(),
            task: self.task.save(),
            seed: self.seed,
            last_observation: self.last_observation.clone(),
            last_info: self.last_info,
            episode_steps: self.episode_steps,
        }
    }

    /// Restores a snapshot of this environment, or of another one with the same model and settings.
    ///
    /// From there the same actions give the same observations and rewards, bit for bit.
    ///
    /// # Errors
    /// [`SnapshotError`] if the model or a setting differs; the environment is then unchanged.
    pub fn restore(&mut self, snapshot: &EnvironmentSnapshot) -> Result<(), SnapshotError> {
        if let Some((setting, taken, found)) = snapshot.config.difference(&self.config) {
            return Err(SnapshotError::Setting { setting, taken, found });
        }
        self.physics.restore(&snapshot.physics)?;
        if let Some(seed) = snapshot.seed {
            // What a task draws from its episode's seed is not among the numbers that it saves.
            self.task.begin(seed, &self.physics);
        }
        self.task.restore(&snapshot.task).map_err(SnapshotError::Task)?;
        self.randomiser.clone_from(&snapshot.randomiser);
        self.seed = snapshot.seed;
        self.last_observation.clone_from(&snapshot.last_observation);
        self.last_info = snapshot.last_info;
        self.episode_steps = snapshot.episode_steps;
        self.was_pushed = false;
        Ok(())
    }
}
