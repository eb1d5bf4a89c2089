//! Errors of settings.

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
    /// Several entries of a text are wrong.
    #[error("{origin} has {} wrong entries: {}", errors.len(), errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Several {
        /// Source of the text.
        origin: String,
        /// An error for each.
        errors: Vec<ConfigError>,
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
