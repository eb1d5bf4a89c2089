//! What actors read of a run's configuration.

use treadmill_config::{
    BusConfig, Config, ConfigSource, EnvironmentConfig, EvaluationConfig, ObservationPrecision, RolloutConfig,
    RunConfig, Section, TaskConfig,
};
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_proto::{PolicyBundle, Precision, WIRE_VERSION, limits::fragment_envs_max};

use crate::ActorError;

/// Keys of the learner's sections that actors read too.
const LEARNER_KEYS: [&str; 2] = ["ppo.batch", "learner.mode"];
/// Most unknown keys that a message names.
const NAMED_MAX: usize = 8;

/// What actors read of a run's configuration. The learner's own sections are not there: another version of it may have
/// written values that this program does not know.
#[derive(Clone, Debug)]
pub struct RunSettings {
    /// The run.
    pub run: RunConfig,
    /// Environment in training.
    pub environment: EnvironmentConfig,
    /// Collection of experience.
    pub rollout: RolloutConfig,
    /// Evaluation during training.
    pub eval: EvaluationConfig,
    /// Message bus.
    pub bus: BusConfig,
    /// Fragments without a receipt that an actor may have.
    pub fragments_in_flight: u32,
    /// Fewest transitions of one update.
    batch: u32,
    /// Name of the task, if other programs simulate it.
    external_task: Option<String>,
}

impl RunSettings {
    /// Reads what this program needs to simulate the run, whose learner may have another version.
    ///
    /// # Errors
    /// If the run trains another task or another physics, or sets a key that this program does not know.
    pub fn simulated(bundle: &PolicyBundle) -> Result<Self, ActorError> {
        let settings = Self::shown(bundle)?;
        match bundle.physics_version {
            PHYSICS_VERSION => Ok(settings),
            theirs => Err(ActorError::OtherPhysics { run: bundle.run.clone(), theirs }),
        }
    }

    /// Reads what this program needs to show the run's robot.
    ///
    /// # Errors
    /// As [`Self::simulated`], but for the version of the physics.
    pub fn shown(bundle: &PolicyBundle) -> Result<Self, ActorError> {
        let mut source = ConfigSource::default();
        let unknown = source.text_of_run(&bundle.config_toml, "the configuration of the run", is_needed)?;
        if bundle.wire_version_min > WIRE_VERSION {
            let of_actors = unknown.iter().filter(|key| is_needed(key)).take(NAMED_MAX);
            let unknown = of_actors.map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ");
            let needed = bundle.wire_version_min;
            return Err(ActorError::UnknownKeys { run: bundle.run.clone(), unknown, needed });
        }
        if !unknown.is_empty() {
            let keys = unknown[..unknown.len().min(NAMED_MAX)].join(", ");
            let count = unknown.len();
            tracing::info!(run = %bundle.run, %keys, count, "ignored unknown keys of the run's configuration");
        }
        let settings = Self::of(source.build()?);
        match settings.external_task {
            Some(task) => Err(ActorError::OtherTask { run: bundle.run.clone(), task }),
            None => Ok(settings),
        }
    }

    fn of(config: Config) -> Self {
        Self {
            environment: config.environment(),
            fragments_in_flight: config.fragments_in_flight(),
            batch: config.ppo.batch,
            external_task: config.is_external().then(|| config.task_name()),
            run: config.run,
            rollout: config.rollout,
            eval: config.eval,
            bus: config.bus,
        }
    }

    /// Returns the control steps of the first fragment of an actor with `envs` environments. Every receipt says those of
    /// the next.
    ///
    /// # Errors
    /// If such a fragment is too large for the bus.
    pub fn first_fragment_steps(&self, bundle: &PolicyBundle, envs: u32) -> Result<u32, ActorError> {
        let steps = match (bundle.fragment_steps, self.rollout.fragment_steps) {
            (0, 0) => RolloutConfig::STEPS_MAX,
            (0, steps) | (steps, _) => steps,
        };
        let steps = match self.rollout.fragment_steps {
            // The learner does not know this actor yet, whose first fragment alone may fill a batch.
            0 => steps.min((self.batch / envs.max(1)).max(RolloutConfig::STEPS_MIN)),
            _ => steps,
        };
        let envs_max = fragment_envs_max(steps, bundle.observation_size as usize, bundle.action_size as usize);
        if envs as usize > envs_max {
            return Err(ActorError::FragmentSize { envs, steps, envs_max });
        }
        Ok(steps)
    }

    /// Returns the precision of observations on the wire.
    pub fn precision(&self) -> Precision {
        match self.rollout.observation_precision {
            ObservationPrecision::F32 => Precision::F32,
            ObservationPrecision::F16 => Precision::F16,
        }
    }
}

fn is_needed(key: &str) -> bool {
    let section = key.split_once('.').map_or(key, |(section, _)| section);
    let others = [RunConfig::NAME, TaskConfig::NAME, RolloutConfig::NAME, EvaluationConfig::NAME, BusConfig::NAME];
    LEARNER_KEYS.contains(&key)
        || others.contains(&section)
        || EnvironmentConfig::sections().iter().any(|of_environment| of_environment.name == section)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_fragment_holds_at_most_a_batch() {
        let mut config = Config::default();
        config.ppo.batch = 8192;
        let mut config = RunSettings::of(config);
        let sizes = PolicyBundle { observation_size: 45, action_size: 17, ..PolicyBundle::default() };
        let mut bundle = PolicyBundle { fragment_steps: 64, ..sizes };
        let steps =
            |bundle: &PolicyBundle, config: &RunSettings, envs| config.first_fragment_steps(bundle, envs).unwrap();
        assert_eq!(steps(&bundle, &config, 32), 64);
        assert_eq!(steps(&bundle, &config, 512), 16);
        assert_eq!(steps(&bundle, &config, 10_000), 8);
        bundle.fragment_steps = 0;
        assert_eq!(steps(&bundle, &config, 32), 128, "where neither says anything");
        config.rollout.fragment_steps = 24;
        assert_eq!(steps(&bundle, &config, 4096), 24, "as configured");
        config.rollout.fragment_steps = 32;
        let why = config.first_fragment_steps(&bundle, 4096).unwrap_err().to_string();
        // 32 × 257 + 180 bytes of each environment, in 30 MiB less a sixty-fourth.
        assert!(why.contains("4096 environments and 32 steps") && why.contains("--envs 3684; start further"), "{why}");
    }

    #[test]
    fn every_readable_model_fits_into_a_bundle() {
        assert_eq!(treadmill_humanoid::mjcf::MODEL_BYTES_MAX, treadmill_proto::limits::MODEL_BYTES_MAX);
    }
}
