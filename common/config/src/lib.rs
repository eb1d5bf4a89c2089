//! Configuration in two stages: a [`ConfigSource`] collects what the user gives, then builds a checked [`Config`].
//!
//! Precedence, lowest first: defaults in code, preset, file, `--set`, the command's own flags.

mod choices;
mod preset;
mod sections;
mod source;
mod task;
mod unknown_key;

use serde::{Deserialize, Serialize};

pub use choices::{LearnerMode, ObservationPrecision, Symmetry};
pub use preset::{PRESETS, preset};
pub use sections::{
    BusConfig, EvaluationConfig, LearnerConfig, PolicyConfig, PpoConfig, RolloutConfig, RunConfig, TaskConfig,
};
pub use source::{ConfigSource, given_value};
pub use treadmill_settings::{
    ChosenTask, ConfigError, EnvConfig, EnvObservation, EnvTask, EnvironmentConfig, GroundConfig, GroundKind, KeyDoc,
    MotionConfig, RandomisationConfig, RewardsConfig, Section, SectionDoc, VelocityConfig,
};
use treadmill_settings::{refuse, show};

/// Whole configuration, checked.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// The run.
    pub run: RunConfig,
    /// Humanoid task.
    pub env: EnvConfig,
    /// Velocity task.
    pub velocity: VelocityConfig,
    /// Rewards of the velocity task.
    pub rewards: RewardsConfig,
    /// Motion task. Omitted from TOML if unset, so that actors of versions without it can read the rest.
    #[serde(skip_serializing_if = "MotionConfig::is_default")]
    pub motion: MotionConfig,
    /// Ground of the velocity task.
    pub ground: GroundConfig,
    /// External task. Omitted from TOML if unset, so that actors of versions without external tasks can read it.
    #[serde(skip_serializing_if = "TaskConfig::is_unset")]
    pub task: TaskConfig,
    /// Randomisation from episode to episode.
    pub randomisation: RandomisationConfig,
    /// Collection of experience.
    pub rollout: RolloutConfig,
    /// Networks.
    pub policy: PolicyConfig,
    /// Algorithm.
    pub ppo: PpoConfig,
    /// Learner.
    pub learner: LearnerConfig,
    /// Evaluation during training.
    pub eval: EvaluationConfig,
    /// Message bus.
    pub bus: BusConfig,
}

impl Config {
    /// Returns every section with its keys, in the order of the documentation.
    pub fn sections() -> Vec<SectionDoc> {
        let [env, velocity, rewards, motion, ground, randomisation] = EnvironmentConfig::sections();
        vec![
            RunConfig::describe(),
            env,
            velocity,
            rewards,
            motion,
            ground,
            TaskConfig::describe(),
            randomisation,
            RolloutConfig::describe(),
            PolicyConfig::describe(),
            PpoConfig::describe(),
            LearnerConfig::describe(),
            EvaluationConfig::describe(),
            BusConfig::describe(),
        ]
    }

    /// Returns every key with documentation, default and allowed values.
    pub fn keys() -> Vec<KeyDoc> {
        Self::sections().into_iter().flat_map(|section| section.keys).collect()
    }

    /// Checks every value by itself, then values that depend on each other.
    ///
    /// # Errors
    /// [`ConfigError::Value`] for the first value out of range.
    pub fn check(&self) -> Result<(), ConfigError> {
        self.run.check()?;
        self.environment().check()?;
        self.task.check()?;
        self.rollout.check()?;
        self.policy.check()?;
        self.ppo.check()?;
        self.learner.check()?;
        self.eval.check()?;
        self.bus.check()?;
        self.check_together()
    }

    /// Returns the factor by which batches have grown after so many environment steps.
    pub fn growth(&self, env_steps: u64) -> u32 {
        self.ppo.growth(env_steps)
    }

    /// Returns this configuration with a batch that has grown.
    pub fn grown(&self, env_steps: u64) -> Self {
        Self { ppo: self.ppo.grown(env_steps), ..self.clone() }
    }

    fn check_together(&self) -> Result<(), ConfigError> {
        if self.ppo.batch > 0 && self.ppo.minibatch > self.ppo.batch {
            return refuse(
                "ppo.minibatch",
                self.ppo.minibatch.to_string(),
                format!("0 to ppo.batch, which is {}", self.ppo.batch),
            );
        }
        if self.ppo.learning_rate_min > self.ppo.learning_rate_max {
            return refuse(
                "ppo.learning_rate_min",
                show(&self.ppo.learning_rate_min),
                format!("at most ppo.learning_rate_max, which is {}", show(&self.ppo.learning_rate_max)),
            );
        }
        if self.run.envs_min > self.run.envs_max {
            let most = format!("at most run.envs_max, which is {}", self.run.envs_max);
            return refuse("run.envs_min", self.run.envs_min.to_string(), most);
        }
        if self.learner.mode == LearnerMode::Sync && self.rollout.max_in_flight == 2 {
            return refuse("rollout.max_in_flight", "2", "0 or 1 where learner.mode is \"sync\"");
        }
        self.check_task()?;
        if self.rollout.actors > self.rollout.envs {
            return refuse(
                "rollout.actors",
                self.rollout.actors.to_string(),
                format!("0 to rollout.envs, which is {}", self.rollout.envs),
            );
        }
        Ok(())
    }

    /// Returns the settings of an environment in training.
    #[must_use]
    pub fn environment(&self) -> EnvironmentConfig {
        EnvironmentConfig {
            has_curricula: true,
            env: self.env.clone(),
            velocity: self.velocity.clone(),
            rewards: self.rewards.clone(),
            motion: self.motion.clone(),
            ground: self.ground.clone(),
            randomisation: self.randomisation.clone(),
        }
    }

    /// Returns how many fragments without a receipt an actor may have.
    pub fn fragments_in_flight(&self) -> u32 {
        match (self.rollout.max_in_flight, self.learner.mode) {
            (0, LearnerMode::Sync) => 1,
            (0, LearnerMode::Async) => 2,
            (chosen, _) => chosen,
        }
    }

    /// Returns whether policies are evaluated during training: the run must last for one evaluation, and the task must
    /// not be external.
    pub fn evaluates(&self) -> bool {
        !self.is_external() && (1..=self.run.steps).contains(&self.eval.every_steps)
    }

    /// Returns how many versions a fragment's policy may lag behind the newest.
    pub fn policy_lag_allowed(&self) -> u32 {
        match self.learner.mode {
            LearnerMode::Sync => 0,
            LearnerMode::Async => self.learner.max_policy_lag,
        }
    }

    /// Returns the value of a key in TOML notation; empty if the key does not exist.
    pub fn value_of(&self, key: &str) -> String {
        let value = key.split_once('.').and_then(|(section, name)| {
            toml::Value::try_from(self).ok()?.get(section)?.get(name).map(ToString::to_string)
        });
        value.unwrap_or_default()
    }

    /// Returns the configuration as TOML with every key; `[task]` only if it is set.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a checked config is plain tables of plain values")
    }

    /// Returns the sections that decide the episodes of a policy as TOML. An exported policy carries them.
    pub fn episodes_toml(&self) -> String {
        let mut table = toml::Table::try_from(self).expect("a checked config is plain tables of plain values");
        let decides = EnvironmentConfig::sections().map(|section| section.name);
        table.retain(|section, _| section == TaskConfig::NAME || decides.contains(&section));
        toml::to_string(&table).expect("a checked config is plain tables of plain values")
    }
}

/// Reads a value in TOML notation.
pub(crate) fn parse_value(text: &str) -> Option<toml::Value> {
    let mut table = format!("v = {text}").parse::<toml::Table>().ok()?;
    // Another line would be another key.
    table.remove("v").filter(|_| table.is_empty())
}
