//! Settings that decide the episodes of an environment.
//!
//! A key is declared in its section's file and nowhere else. It travels as TOML text.

mod env;
mod ground;
mod motion;
mod randomisation;
mod rewards;
mod velocity;

pub use self::env::{ChosenTask, EnvConfig, EnvObservation, EnvTask, is_task_name};
pub use self::ground::{GroundConfig, GroundKind};
pub use self::motion::{MOTION_TERMS, MotionConfig, MotionRewards};
pub use self::randomisation::RandomisationConfig;
pub use self::rewards::{REWARD_TERMS, RewardFunctions, RewardsConfig};
pub use self::velocity::{HEADING_GAIN, VelocityConfig};
use super::{ConfigError, Section, SectionDoc, refuse, show};

/// Settings of one environment.
#[derive(Clone, Debug, PartialEq)]
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
    /// Motion task.
    pub motion: MotionConfig,
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
            motion: MotionConfig::default(),
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

impl EnvironmentConfig {
    /// Returns the description of each section.
    #[must_use]
    pub fn sections() -> [SectionDoc; 6] {
        [
            EnvConfig::describe(),
            VelocityConfig::describe(),
            RewardsConfig::describe(),
            MotionConfig::describe(),
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
        self.motion.check()?;
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
        let task = self.env.chosen_task();
        if matches!(task, ChosenTask::HumanoidV5 | ChosenTask::HumanoidV4 | ChosenTask::Motion) {
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
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(change: impl FnOnce(&mut EnvironmentConfig)) -> String {
        let mut config = EnvironmentConfig::default();
        change(&mut config);
        config.check().expect_err("refused").to_string()
    }

    #[test]
    fn defaults_are_allowed_and_each_bad_value_is_named() {
        EnvironmentConfig::default().check().unwrap();
        let v4_without_velocities = |config: &mut EnvironmentConfig| {
            config.env.observation = EnvObservation::GymnasiumV4;
            config.env.include_cvel_in_observation = false;
        };
        assert!(refusal(v4_without_velocities).contains("`env.include_cvel_in_observation` is false"));
        assert!(refusal(|config| config.env.substeps = 0).contains("`env.substeps` is 0; allowed: 1 to 1000"));
        assert!(refusal(|config| config.rewards.gait = f64::NAN).contains("`rewards.gait` is nan"));
        assert!(refusal(|config| config.velocity.history = 17).contains("`velocity.history` is 17; allowed: 1 to 16"));
        assert!(refusal(|config| config.randomisation.mass_scale = [0.0, 1.0]).contains("`randomisation.mass_scale`"));
        let pushes = refusal(|config| {
            config.env.control_step_s = 0.05;
            config.randomisation.push_interval_s = [0.04, 1.0];
        });
        assert!(pushes.contains("`randomisation.push_interval_s` is [0.04, 1.0]"), "{pushes}");
    }

    #[test]
    fn ground_needs_a_task_that_starts_on_it_and_a_level_of_its_own() {
        let with_kinds = |task, start_level| {
            let mut config = EnvironmentConfig::from(EnvConfig { task, ..EnvConfig::default() });
            config.ground = GroundConfig { kinds: vec![GroundKind::Stairs], start_level, ..GroundConfig::default() };
            config.check().map_err(|why| why.to_string())
        };
        with_kinds(EnvTask::Velocity, 9).unwrap();
        assert!(with_kinds(EnvTask::Velocity, 10).unwrap_err().contains("below ground.levels, which is 10"));
        assert!(with_kinds(EnvTask::HumanoidV5, 0).unwrap_err().contains("`ground.kinds` is [\"stairs\"]"));
    }

    #[test]
    fn an_own_task_goes_before_the_built_in_one() {
        let env = EnvConfig { own_task: "squat".into(), task: EnvTask::Velocity, ..EnvConfig::default() };
        assert_eq!(env.chosen_task(), ChosenTask::Own("squat"));
        assert!(
            is_task_name("squat-2") && !is_task_name("") && !is_task_name("Squat") && !is_task_name(&"x".repeat(65))
        );
    }
}
