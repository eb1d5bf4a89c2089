//! Why an environment could not be built.

use std::path::PathBuf;

/// A model text or a setting that cannot be simulated, with what to change.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The text is not readable MJCF.
    #[error("the model text is not valid MJCF")]
    Parse(#[source] mjcf_rs::ParseError),
    /// The text is MJCF, but uses something this environment does not simulate.
    #[error("model element `{element}`: {problem}")]
    Unsupported {
        /// Name of the body, joint, shape or motor.
        element: String,
        /// What is wrong with it, and what would be accepted.
        problem: String,
    },
    /// An attribute holds something that cannot be read, or that would change the physics in a way not simulated.
    #[error("model element `{element}`: `{attribute}` is \"{value}\", but must be {expected}")]
    Attribute {
        /// Name of the body, joint, shape or motor.
        element: String,
        /// Name of the attribute.
        attribute: String,
        /// What stands there, with defaults filled in.
        value: String,
        /// What would be accepted.
        expected: String,
    },
    /// The text is longer than any model.
    #[error("the model text has {bytes} bytes, but at most {limit} are read")]
    TooLarge {
        /// Its length.
        bytes: u64,
        /// [`crate::model::MODEL_BYTES_MAX`].
        limit: u64,
    },
    /// A file of the model cannot be read.
    #[error("`{}` cannot be read", path.display())]
    File {
        /// Which file.
        path: PathBuf,
        /// Why.
        #[source]
        source: std::io::Error,
    },
    /// A figure of the model makes no physical sense.
    #[error("model element `{element}`: {figure} is {value}, but must be {expected}")]
    Figure {
        /// Name of the body, joint, shape or motor.
        element: String,
        /// Which figure, with its unit.
        figure: &'static str,
        /// The value found.
        value: f64,
        /// What would be accepted.
        expected: &'static str,
    },
    /// A setting of the environment is out of range.
    #[error("environment setting `{setting}` is {value}, but must be {expected}")]
    Setting {
        /// Field of [`crate::EnvironmentConfig`].
        setting: &'static str,
        /// The value found.
        value: String,
        /// What would be accepted.
        expected: &'static str,
    },
}

/// An action or an observation buffer does not have the environment's size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what} has the wrong length: {found} instead of {expected}")]
pub struct LengthError {
    /// Which of the two.
    pub what: &'static str,
    /// Its length.
    pub found: usize,
    /// The length it should have.
    pub expected: usize,
}

impl LengthError {
    pub(crate) fn check(what: &'static str, found: usize, expected: usize) -> Result<(), Self> {
        if found == expected { Ok(()) } else { Err(Self { what, found, expected }) }
    }
}

impl ModelError {
    pub(crate) fn unsupported(element: &str, problem: impl Into<String>) -> Self {
        Self::Unsupported { element: element.to_owned(), problem: problem.into() }
    }

    pub(crate) fn attribute(element: &str, attribute: &str, value: &str, expected: impl Into<String>) -> Self {
        Self::Attribute {
            element: element.to_owned(),
            attribute: attribute.to_owned(),
            value: value.to_owned(),
            expected: expected.into(),
        }
    }

    pub(crate) fn figure(element: &str, figure: &'static str, value: f64, expected: &'static str) -> Self {
        Self::Figure { element: element.to_owned(), figure, value, expected }
    }
}
