//! Why an environment could not be built, or does not take what it is given.

use std::path::PathBuf;

/// A model text or a setting that cannot be simulated, with what to change.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// The text is not readable MJCF.
    // Not a `#[source]`: its message repeats its own cause.
    #[error("the model text is not valid MJCF: {0}")]
    Parse(mjcf_rs::ParseError),
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

/// An action or a buffer that an environment cannot take; nothing has happened then.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InputError {
    /// It does not have the environment's size.
    #[error("{what} has the wrong length: {found} instead of {expected}")]
    Length {
        /// The action, or the buffer of the observation.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length it should have.
        expected: usize,
    },
    /// It holds a number that is none.
    #[error("{what}[{index}] is {value}, but every entry must be a finite number")]
    NotFinite {
        /// The action.
        what: &'static str,
        /// Which entry.
        index: usize,
        /// What stands there.
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

/// A position or velocity vector that no body can have, or another vector that fits no episode here; nothing has happened then.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateError {
    /// A vector does not have the model's size.
    #[error("{what} vector has the wrong length: {found} instead of {expected}")]
    Length {
        /// Which vector.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length it should have.
        expected: usize,
    },
    /// A number is infinite or none.
    #[error("{what}[{index}], the {name}, is {value}, but must be a finite number")]
    NotFinite {
        /// Which vector.
        what: &'static str,
        /// Which entry.
        index: usize,
        /// What it means, with the name of its hinge if it belongs to one.
        name: String,
        /// What stands there.
        value: f64,
    },
    /// The root's quaternion is too short or too long to say a rotation.
    #[error("the root quaternion position[3..7] is {value:?}, which is no rotation: give w, x, y, z of length 1")]
    Quaternion {
        /// What stands there: w, x, y, z.
        value: [f64; 4],
    },
    /// A hinge is far outside its range.
    #[error(
        "position[{index}], the angle of hinge `{hinge}`, is {value_rad} rad, but must lie between {min_rad} rad and \
         {max_rad} rad, or at most {tolerance_rad} rad beyond"
    )]
    Hinge {
        /// Which entry.
        index: usize,
        /// Name of the hinge.
        hinge: String,
        /// What stands there (rad).
        value_rad: f64,
        /// Lower end of its range (rad).
        min_rad: f64,
        /// Upper end of its range (rad).
        max_rad: f64,
        /// How far beyond its range it may be (rad).
        tolerance_rad: f64,
    },
}

/// A snapshot was taken of something else than what it is to be laid over; nothing has happened then.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SnapshotError {
    /// It is of another model.
    #[error("the snapshot is of another model: {part} differs; restore it where the same model text was read")]
    Model {
        /// The first part that differs.
        part: String,
    },
    /// It was taken under other settings.
    #[error(
        "the snapshot was taken with `{setting}` = {taken}, but here it is {found}; restore it under the same settings"
    )]
    Setting {
        /// Field of [`crate::EnvironmentConfig`].
        setting: &'static str,
        /// Its value where the snapshot was taken.
        taken: String,
        /// Its value here.
        found: String,
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

    pub(crate) fn figure(element: &str, figure: &'static str, value: f64, expected: &'static str) -> Self {
        Self::Figure { element: element.to_owned(), figure, value, expected }
    }
}
