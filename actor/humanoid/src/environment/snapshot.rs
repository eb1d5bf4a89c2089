//! An episode put aside, to be gone on with later.

use super::Environment;
use crate::config::EnvironmentConfig;
use crate::error::SnapshotError;
use crate::info::StepInfo;
use crate::physics::PhysicsSnapshot;
use crate::randomisation::Disturber;

/// All that the rest of an episode depends on, as [`Environment::snapshot`] took it.
#[derive(Clone)]
pub struct EnvironmentSnapshot {
    config: EnvironmentConfig,
    physics: PhysicsSnapshot,
    disturber: Disturber,
    seed: Option<u64>,
    last_observation: Vec<f32>,
    last_info: StepInfo,
    episode_steps: u32,
}

impl Environment {
    /// Puts the episode aside as it is now: the body, contacts included; the clock; what was last observed and told; and
    /// of the randomisation the figures drawn, the delayed actions and the state of the random numbers.
    #[must_use]
    pub fn snapshot(&self) -> EnvironmentSnapshot {
        EnvironmentSnapshot {
            config: self.config.clone(),
            physics: self.physics.snapshot(),
            disturber: self.disturber.clone(),
            seed: self.seed,
            last_observation: self.last_observation.clone(),
            last_info: self.last_info,
            episode_steps: self.episode_steps,
        }
    }

    /// Goes back to a snapshot, be it one of this environment or of another one with the same model and settings.
    ///
    /// From there the same actions give the same observations and rewards, bit for bit. Only [`Self::fault_count`] goes
    /// on as it was: it belongs to this environment and not to the episode.
    ///
    /// # Errors
    /// [`SnapshotError`] if the model or a setting is another one; nothing has happened then.
    pub fn restore(&mut self, snapshot: &EnvironmentSnapshot) -> Result<(), SnapshotError> {
        if let Some((setting, taken, found)) = snapshot.config.difference(&self.config) {
            return Err(SnapshotError::Setting { setting, taken, found });
        }
        self.physics.restore(&snapshot.physics)?;
        self.disturber.clone_from(&snapshot.disturber);
        self.seed = snapshot.seed;
        self.last_observation.clone_from(&snapshot.last_observation);
        self.last_info = snapshot.last_info;
        self.episode_steps = snapshot.episode_steps;
        Ok(())
    }
}
