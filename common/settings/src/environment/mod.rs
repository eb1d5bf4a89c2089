//! Settings that decide the episodes of an environment.
//!
//! A key is declared in its section's file and nowhere else. It travels as TOML text.

mod env;
mod ground;
mod randomisation;
mod rewards;
mod velocity;

use serde::{Deserialize, Serialize};

pub use self::env::{ChosenTask, EnvConfig, EnvObservation, EnvTask, is_task_name};
pub use self::ground::{GroundConfig, GroundKind};
pub use self::randomisation::RandomisationConfig;
pub use self::rewards::{REWARD_TERMS, RewardTerms, RewardsConfig};
pub use self::velocity::VelocityConfig;
use super::{ConfigError, Section, SectionDoc, refuse, show};

/// Settings of one environment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EnvironmentConfig {
    /// Whether the curricula of ground and commands run. Otherwise an episode does not depend on earlier ones: it draws its
    /// level of the ground's difficulty, and commands have their full ranges. Not a key of a configuration.
    pub has_curricula: bool,
    /// Task, body and time.
    pub env: EnvConfig,
    /// Velocity task.
    pub velocity: VelocityConfig,
    /// Rewards of the velocity task.
    pub rewards: RewardsConfig,
    /// Ground.
    pub ground: GroundConfig,
    /// Randomisation.
    pub randomisation: RandomisationConfig,
}

impl Default for EnvironmentConfig {
    fn default() -> Self {
        Self {
            has_curricula: true,
            env: EnvConfig::default(),
            velocity: VelocityConfig::default(),
            rewards: RewardsConfig::default(),
            ground: GroundConfig::default(),
            randomisation: RandomisationConfig::default(),
        }
    }
}

impl From<EnvConfig> for EnvironmentConfig {
    fn from(env: EnvConfig) -> Self {
        Self { env, ..Self::default() }
    }
}

impl From<RandomisationConfig> for EnvironmentConfig {
    fn from(randomisation: RandomisationConfig) -> Self {
        Self { randomisation, ..Self::default() }
    }
}

impl EnvironmentConfig {
    /// Returns the description of each section.
    #[must_use]
    pub fn sections() -> [SectionDoc; 5] {
        [
            EnvConfig::describe(),
            VelocityConfig::describe(),
            RewardsConfig::describe(),
            GroundConfig::describe(),
            RandomisationConfig::describe(),
        ]
    }

    /// Returns these settings without curricula: episodes do not depend on earlier ones.
    #[must_use]
    pub fn without_curricula(self) -> Self {
        Self { has_curricula: false, ..self }
    }

    /// Returns these settings without curricula and randomisation.
    #[must_use]
    pub fn plain(self) -> Self {
        Self { randomisation: RandomisationConfig::default(), ..self.without_curricula() }
    }

    /// Checks every value by itself, then values that depend on each other.
    ///
    /// # Errors
    /// [`ConfigError::Value`] for the first value that is not allowed.
    pub fn check(&self) -> Result<(), ConfigError> {
        self.env.check()?;
        self.velocity.check()?;
        self.rewards.check()?;
        self.ground.check()?;
        self.randomisation.check()?;
        self.check_observation()?;
        let (interval_s, control_step_s) = (&self.randomisation.push_interval_s, self.env.control_step_s);
        if interval_s[0] < control_step_s {
            let shown = show(&control_step_s);
            let allowed = format!("[smallest, largest], env.control_step_s to 1000, and env.control_step_s is {shown}");
            return refuse("randomisation.push_interval_s", show(interval_s), allowed);
        }
        self.check_ground()
    }

    /// Checks that no block is left out of the observation of Humanoid-v4, which has no optional blocks.
    fn check_observation(&self) -> Result<(), ConfigError> {
        let env = &self.env;
        let included = [
            ("env.include_cinert_in_observation", env.include_cinert_in_observation),
            ("env.include_cvel_in_observation", env.include_cvel_in_observation),
            ("env.include_qfrc_actuator_in_observation", env.include_qfrc_actuator_in_observation),
            ("env.include_cfrc_ext_in_observation", env.include_cfrc_ext_in_observation),
        ];
        for (key, included) in included {
            if env.observation == EnvObservation::GymnasiumV4 && !included {
                let allowed = "true where env.observation is \"gymnasium-v4\"; \"gymnasium-v5\" can leave blocks out";
                return refuse(key, "false", allowed);
            }
        }
        Ok(())
    }

    /// Checks that the task starts on the generated ground, and on one of its levels.
    fn check_ground(&self) -> Result<(), ConfigError> {
        let ground = &self.ground;
        if ground.kinds.is_empty() {
            return Ok(());
        }
        if matches!(self.env.chosen_task(), ChosenTask::HumanoidV5 | ChosenTask::HumanoidV4) {
            let allowed =
                "[] where env.task is not \"velocity\", since only the velocity task starts on generated ground";
            return refuse("ground.kinds", show(&ground.kinds), allowed);
        }
        if ground.start_level >= ground.levels {
            let allowed = format!("below ground.levels, which is {}", ground.levels);
            return refuse("ground.start_level", ground.start_level.to_string(), allowed);
        }
        Ok(())
    }

    /// Returns the first setting that differs from another configuration's: key, value here, value there.
    #[must_use]
    pub fn difference(&self, other: &Self) -> Option<(String, String, String)> {
        let [here, there] = [self, other].map(|config| toml::Table::try_from(config).unwrap_or_default());
        here.iter().find_map(|(section, value)| match (value, there.get(section)?) {
            (toml::Value::Table(here), toml::Value::Table(there)) => here.iter().find_map(|(name, value)| {
                let other = there.get(name)?;
                (value != other).then(|| (format!("{section}.{name}"), value.to_string(), other.to_string()))
            }),
            (value, other) => (value != other).then(|| (section.clone(), value.to_string(), other.to_string())),
        })
    }
}
