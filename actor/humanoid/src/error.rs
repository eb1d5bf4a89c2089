//! Errors of models, settings, actions and states.

use std::path::PathBuf;

use crate::config::ConfigError;

/// Model or setting that cannot be simulated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The text is not valid MJCF.
    #[error("the model text is not valid MJCF: XML parse error: {0}")]
    Parse(roxmltree::Error),
    /// The MJCF uses a feature that this environment does not simulate.
    #[error("model element `{element}`: {problem}")]
    Unsupported {
        /// Name of the body, joint, geom or motor.
        element: String,
        /// Problem, and the accepted alternative.
        problem: String,
    },
    /// A policy was trained with another body.
    #[error("the policy was trained with another body: {0}; give a model of the same robot")]
    OtherBody(String),
    /// An attribute is unreadable, or asks for physics that is not simulated.
    #[error("model element `{element}`: `{attribute}` is \"{value}\", but must be {expected}")]
    Attribute {
        /// Name of the body, joint, geom or motor.
        element: String,
        /// Name of the attribute.
        attribute: String,
        /// Value, with defaults filled in.
        value: String,
        /// Accepted values.
        expected: String,
    },
    /// The text exceeds [`crate::mjcf::MODEL_BYTES_MAX`].
    #[error("the model text has {bytes} bytes, but the limit is {limit}")]
    TooLarge {
        /// Length of the text.
        bytes: u64,
        /// Longest accepted text.
        limit: u64,
    },
    /// A file of the model cannot be read.
    #[error("`{}` cannot be read", path.display())]
    File {
        /// Path of the file.
        path: PathBuf,
        /// Cause.
        #[source]
        source: std::io::Error,
    },
    /// A quantity of the model is physically impossible.
    #[error("model element `{element}`: {quantity} is {value}, but must be {expected}")]
    Quantity {
        /// Name of the body, joint, geom or motor.
        element: String,
        /// Name of the quantity, with its unit.
        quantity: &'static str,
        /// Value found.
        value: f64,
        /// Accepted values.
        expected: &'static str,
    },
    /// The configuration names a keyframe that the model does not have.
    #[error("env.keyframe: the model has no keyframe `{name}`; it has: {}", if known.is_empty() { "none" } else { known })]
    Keyframe {
        /// Name in [`crate::config::EnvConfig::keyframe`].
        name: String,
        /// The model's keyframes.
        known: String,
    },
    /// This program lacks the task.
    #[error(
        "env.own_task: this program has no task `{name}`; it has: {}. Start the program that defines it",
        if known.is_empty() { "none" } else { known }
    )]
    UnknownTask {
        /// Name in [`crate::config::EnvConfig::own_task`].
        name: String,
        /// This program's own tasks.
        known: String,
    },
    /// A task of the program itself does not fit the robot or its settings.
    #[error("task: {0}")]
    Task(String),
    /// A motion in the model text is damaged, or does not fit the robot.
    #[error("motion: {0}")]
    Motion(String),
    /// A robot card is wrong, or does not fit its model.
    #[error("robot card: {0}")]
    Card(String),
    /// A setting of the environment is out of range.
    #[error(transparent)]
    Setting(#[from] ConfigError),
}

/// Rejected action or buffer; the environment is unchanged.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InputError {
    /// Length differs from the environment's.
    #[error("{what} has the wrong length: {found} instead of {expected}")]
    Length {
        /// "action" or "observation buffer".
        what: &'static str,
        /// Length found.
        found: usize,
        /// Required length.
        expected: usize,
    },
    /// An entry is not a finite number.
    #[error("{what}[{index}] is {value}, but every entry must be a finite number")]
    NotFinite {
        /// Name of the vector.
        what: &'static str,
        /// Index of the entry.
        index: usize,
        /// Value found.
        value: f32,
    },
}

impl InputError {
    pub(crate) fn check_length(what: &'static str, found: usize, expected: usize) -> Result<(), Self> {
        if found == expected { Ok(()) } else { Err(Self::Length { what, found, expected }) }
    }

    pub(crate) fn check_finite(what: &'static str, numbers: &[f32]) -> Result<(), Self> {
        match numbers.iter().enumerate().find(|(_, number)| !number.is_finite()) {
            Some((index, &value)) => Err(Self::NotFinite { what, index, value }),
            None => Ok(()),
        }
    }
}

/// Rejected position, velocity or other vector of an episode's state; the simulation is unchanged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateError {
    /// Length differs from the model's.
    #[error("{what} vector has the wrong length: {found} instead of {expected}")]
    Length {
        /// Name of the vector.
        what: &'static str,
        /// Length found.
        found: usize,
        /// Required length.
        expected: usize,
    },
    /// An entry is not a finite number.
    #[error("{what}[{index}], the {name}, is {value}, but must be a finite number")]
    NotFinite {
        /// Name of the vector.
        what: &'static str,
        /// Index of the entry.
        index: usize,
        /// Meaning of the entry, with the name of its hinge if it belongs to one.
        name: String,
        /// Value found.
        value: f64,
    },
    /// The root's quaternion is too short or too long to normalise.
    #[error("the root quaternion position[3..7] is {value:?}, which is not a rotation: give w, x, y, z of length 1")]
    Quaternion {
        /// Value found: w, x, y, z.
        value: [f64; 4],
    },
    /// A hinge is outside its range by more than the tolerance.
    #[error(
        "position[{index}], the angle of hinge `{hinge}`, is {value_rad} rad, but must lie between {min_rad} rad and \
         {max_rad} rad, or at most {tolerance_rad} rad beyond"
    )]
    Hinge {
        /// Index of the entry.
        index: usize,
        /// Name of the hinge.
        hinge: String,
        /// Value found (rad).
        value_rad: f64,
        /// Lower end of its range (rad).
        min_rad: f64,
        /// Upper end of its range (rad).
        max_rad: f64,
        /// How far beyond its range it may be (rad).
        tolerance_rad: f64,
    },
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

    pub(crate) fn quantity(element: &str, quantity: &'static str, value: f64, expected: &'static str) -> Self {
        Self::Quantity { element: element.to_owned(), quantity, value, expected }
    }
}
