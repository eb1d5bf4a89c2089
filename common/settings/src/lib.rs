//! Settings, each declared once: type, default, allowed values and documentation in one place.
//!
//! # Layout
//! - `section`: the macro that declares a section, and what it generates.
//! - `value`: types of values, and the macro that declares a choice of names.
//! - [`environment`]: sections that decide the episodes of an environment. The environment itself, the configuration of a
//!   run and the Python package read them here.

pub mod environment;
mod error;
mod section;
mod value;

pub use environment::{
    ChosenTask, EnvConfig, EnvObservation, EnvTask, EnvironmentConfig, GroundConfig, GroundKind, MOTION_TERMS,
    MotionConfig, MotionRewards, REWARD_TERMS, RandomisationConfig, RewardFunctions, RewardsConfig, VelocityConfig,
};
pub use error::ConfigError;
pub use section::{KeyDoc, Section, SectionDoc};
pub use value::{Misfit, Value};

/// Returns the error of a value that is not allowed.
///
/// # Errors
/// Always [`ConfigError::Value`].
pub fn refuse<T>(key: &str, value: impl Into<String>, allowed: impl Into<String>) -> Result<T, ConfigError> {
    Err(ConfigError::Value { key: key.to_string(), value: value.into(), allowed: allowed.into() })
}

/// Returns a value in TOML notation.
pub fn show<T: serde::Serialize>(value: &T) -> String {
    toml::Value::try_from(value).map_or_else(|error| error.to_string(), |value| value.to_string())
}

/// Returns whether `range` is ordered and within `min` to `max`.
pub(crate) fn is_range(range: &[f64; 2], min: f64, max: f64) -> bool {
    min <= range[0] && range[0] <= range[1] && range[1] <= max
}
