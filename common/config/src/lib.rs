//! Configuration in two stages: a [`ConfigSource`] collects what the user gives, then builds a checked [`Config`].
//!
//! Precedence, lowest first: defaults in code, preset, file, `--set`, the command's own flags.

mod choices;
mod preset;
mod retired;
mod section;
mod sections;
mod source;
mod task;
mod unknown_key;
mod wire;

use serde::{Deserialize, Serialize};

pub use choices::{EnvObservation, EnvTask, LearnerMode, ObservationPrecision, Symmetry};
pub use preset::{PRESETS, preset};
pub use retired::is_retired;
pub use section::{KeyDoc, Section, SectionDoc};
pub use sections::{
    BusConfig, EnvConfig, EvaluationConfig, GroundConfig, LearnerConfig, PolicyConfig, PpoConfig, RandomisationConfig,
    RewardsConfig, RolloutConfig, RunConfig, TaskConfig, VelocityConfig,
};
pub use source::ConfigSource;
pub use wire::is_key_of_actors;

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

/// Error of a configuration.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum ConfigError {
    /// The key does not exist.
    #[error("unknown config key `{key}`; {hint}")]
    UnknownKey {
        /// The key as given.
        key: String,
        /// Keys that exist instead.
        hint: String,
    },
    /// The value has the wrong type.
    #[error("config key `{key}` is {value}, which is not {notation}; allowed: {allowed}")]
    Type {
        /// The key.
        key: String,
        /// The value as given.
        value: String,
        /// How its values are written.
        notation: &'static str,
        /// Allowed values.
        allowed: String,
    },
    /// The value is out of range.
    #[error("config key `{key}` is {value}; allowed: {allowed}")]
    Value {
        /// The key.
        key: String,
        /// The value as given.
        value: String,
        /// Allowed values.
        allowed: String,
    },
    /// The key no longer exists, and its value is not the old default.
    #[error(
        "config key `{key}` is {value}, but the key no longer exists: {now}, as with the old default {default}; remove the \
         key, or continue a run that needs it with the version that began it"
    )]
    Retired {
        /// The key.
        key: String,
        /// The value as given.
        value: String,
        /// The old default in TOML notation.
        default: &'static str,
        /// What the program does now.
        now: &'static str,
    },
    /// A `--set` argument without `=`.
    #[error("`--set {given}` is not of the form key=value, for instance --set ppo.learning_rate=3e-4")]
    SetSyntax {
        /// The argument as given.
        given: String,
    },
    /// The preset does not exist.
    #[error("unknown preset `{given}`;{hint} allowed: {allowed}")]
    Preset {
        /// The name as given.
        given: String,
        /// The name that it may mean, as a question, or nothing.
        hint: String,
        /// Existing names.
        allowed: String,
    },
    /// The file could not be read.
    #[error("config file `{path}` cannot be read: {why}; give an existing TOML file")]
    File {
        /// Path of the file.
        path: String,
        /// The system's error.
        why: String,
    },
    /// The text is not TOML.
    #[error("{origin} is not valid TOML: {why}")]
    Syntax {
        /// Source of the text.
        origin: String,
        /// The parser's error.
        why: String,
    },
}

impl Config {
    /// Returns every section with its keys, in the order of the documentation.
    pub fn sections() -> Vec<SectionDoc> {
        vec![
            RunConfig::describe(),
            EnvConfig::describe(),
            VelocityConfig::describe(),
            RewardsConfig::describe(),
            GroundConfig::describe(),
            TaskConfig::describe(),
            RandomisationConfig::describe(),
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
        self.env.check()?;
        self.velocity.check()?;
        self.rewards.check()?;
        self.ground.check()?;
        self.task.check()?;
        self.randomisation.check()?;
        self.rollout.check()?;
        self.policy.check()?;
        self.ppo.check()?;
        self.learner.check()?;
        self.eval.check()?;
        self.bus.check()?;
        self.check_together()
    }

    fn check_together(&self) -> Result<(), ConfigError> {
        if self.ppo.minibatch > self.ppo.batch {
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
        if self.learner.mode == LearnerMode::Sync && self.rollout.max_in_flight == 2 {
            return refuse("rollout.max_in_flight", "2", "0 or 1 where learner.mode is \"sync\"");
        }
        self.check_observation()?;
        self.check_push_interval()?;
        self.check_task()?;
        if !self.ground.kinds.is_empty() && self.ground.start_level >= self.ground.levels {
            return refuse(
                "ground.start_level",
                self.ground.start_level.to_string(),
                format!("below ground.levels, which is {}", self.ground.levels),
            );
        }
        if self.rollout.actors > self.rollout.envs {
            return refuse(
                "rollout.actors",
                self.rollout.actors.to_string(),
                format!("0 to rollout.envs, which is {}", self.rollout.envs),
            );
        }
        Ok(())
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

    /// Checks that pushes come at most once in a control step.
    fn check_push_interval(&self) -> Result<(), ConfigError> {
        let (interval_s, control_step_s) = (&self.randomisation.push_interval_s, self.env.control_step_s);
        if interval_s[0] < control_step_s {
            let shown = show(&control_step_s);
            let allowed = format!("[smallest, largest], env.control_step_s to 1000, and env.control_step_s is {shown}");
            return refuse("randomisation.push_interval_s", show(interval_s), allowed);
        }
        Ok(())
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
        const SECTIONS: [&str; 6] = ["env", "velocity", "rewards", "ground", "randomisation", "task"];
        let mut table = toml::Table::try_from(self).expect("a checked config is plain tables of plain values");
        table.retain(|section, _| SECTIONS.contains(&section));
        toml::to_string(&table).expect("a checked config is plain tables of plain values")
    }
}

/// Returns the error of a value that is not allowed.
pub(crate) fn refuse<T>(key: &str, value: impl Into<String>, allowed: impl Into<String>) -> Result<T, ConfigError> {
    Err(ConfigError::Value { key: key.to_string(), value: value.into(), allowed: allowed.into() })
}

/// Reads a value in TOML notation.
pub(crate) fn parse_value(text: &str) -> Option<toml::Value> {
    let mut table = format!("v = {text}").parse::<toml::Table>().ok()?;
    // Another line would be another key.
    table.remove("v").filter(|_| table.is_empty())
}

/// Returns a value in TOML notation.
pub(crate) fn show<T: Serialize>(value: &T) -> String {
    toml::Value::try_from(value).map_or_else(|error| error.to_string(), |value| value.to_string())
}
