//! Exported policy: one safetensors file with everything needed to play it.
//!
//! | tensor | number type, shape | holds |
//! |---|---|---|
//! | `actor.N.weight`, `actor.N.bias` | F32, `[output, input]`, `[output]` | the actor's layers; the last outputs action means |
//! | `critic.N.weight`, `critic.N.bias` | F32, the same | the critic's layers |
//! | `log_std` | F32, `[action]` | logarithms of the standard deviations of actions |
//! | `observation.mean`, `observation.variance` | F64, `[observation]` | moments of the raw observations |
//!
//! The metadata key `treadmill` holds everything else as one JSON object with keys in a fixed order. The file holds no time,
//! path or name of the run, so equal policies give equal bytes. Its entry `settings` holds the environment's settings
//! as TOML.
//!
//! To act: `x = clip((observation − mean) / √(variance + variance_epsilon), ± clip)`; the actor's layers with ELU between
//! them; `action = clip(mean, ± 1)`, scaled from [−1, 1] to [low, high].

use safetensors::tensor::SafeTensors;
use serde::{Deserialize, Serialize};
use treadmill_proto::limits::{BUNDLE_BYTES_MAX, HIDDEN_LAYERS_MAX, WIDTH_MAX};

use crate::{
    NetworkShape, ParameterError, check_parameters, column, from_safetensors,
    normaliser::{Normaliser, RunningMoments, VARIANCE_EPSILON},
    to_safetensors_with,
};

/// Version of the file's layout; raised if an old reader would misunderstand a new file.
pub const FORMAT: u32 = 1;
const METADATA_KEY: &str = "treadmill";
const MEAN: &str = "observation.mean";
const VARIANCE: &str = "observation.variance";
const ACTIVATION: &str = "elu";

/// Error of reading or writing an exported policy.
#[derive(Debug, thiserror::Error)]
pub enum ExportedError {
    /// The file is larger than any exported policy.
    #[error("it has {bytes} bytes, more than the {limit} that an exported policy can have")]
    TooLarge {
        /// Size of the file.
        bytes: usize,
        /// Largest size.
        limit: usize,
    },
    /// The file is damaged or not a safetensors file.
    #[error("it is damaged or truncated, or not a safetensors file ({why}); export the policy again")]
    Damaged {
        /// The reader's error.
        why: String,
    },
    /// The file is a safetensors file of another program.
    #[error("it is a safetensors file, but has no metadata `{METADATA_KEY}`: `treadmill export` did not write it")]
    Foreign,
    /// The metadata cannot be read.
    #[error("its metadata `{METADATA_KEY}` cannot be read ({why}); export the policy again")]
    Metadata {
        /// The reader's error.
        why: String,
    },
    /// Another version of this program wrote the file.
    #[error("it has format {found}; this program reads format {FORMAT}: export it again with this version")]
    Format {
        /// Format of the file.
        found: u32,
    },
    /// An entry of the metadata is invalid.
    #[error("its metadata entry `{entry}` is {value}; expected {expected}")]
    Entry {
        /// Path in the metadata.
        entry: &'static str,
        /// The value.
        value: String,
        /// Accepted values.
        expected: String,
    },
    /// A tensor is missing, misshapen or not finite.
    #[error("its tensors cannot be used")]
    Parameters(#[from] ParameterError),
}

/// Policy and the task it was trained for.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportedPolicy {
    /// Shape of the networks.
    pub shape: NetworkShape,
    /// Actor, log standard deviations and critic, in [`NetworkShape`]'s order.
    pub parameters: Vec<f32>,
    /// Observation and its normalisation.
    pub observation: ObservationFacts,
    /// Mean of each entry of the raw observation.
    pub mean: Vec<f64>,
    /// Variance of each entry of the raw observation.
    pub variance: Vec<f64>,
    /// Meaning of actions.
    pub action: ActionFacts,
    /// Scale of the critic's values; none in files of older versions.
    pub returns: Option<ReturnFacts>,
    /// Duration of one control step (s); 0 if it is unknown, for an external task.
    pub control_step_s: f64,
    /// Settings of the environment as TOML, which only the environment interprets.
    pub settings: String,
    /// Humanoid as MJCF; empty for an external task.
    pub model_xml: String,
}

/// Observation of a policy and its normalisation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObservationFacts {
    /// Kind of observation.
    pub kind: String,
    /// Width of an observation.
    pub size: usize,
    /// Observations in the statistics; with none, mean and variance mean no normalisation.
    pub count: f64,
    /// Added to a variance before its root is taken.
    pub variance_epsilon: f64,
    /// Limit to which normalised observations are clipped, in both directions.
    pub clip: f32,
}

/// Meaning of actions: −1 is `low`, 1 is `high`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ActionFacts {
    /// Motors, in the order of the action.
    pub names: Vec<String>,
    /// Smallest control of each motor.
    pub low: Vec<f32>,
    /// Largest control of each motor.
    pub high: Vec<f32>,
}

/// Statistics of the scaled returns: a value of the critic times their standard deviation, plus their mean, is a return.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReturnFacts {
    /// Returns in the statistics; with none, there is no scale.
    pub count: f64,
    /// Their mean.
    pub mean: f64,
    /// Their variance.
    pub variance: f64,
}

impl ReturnFacts {
    /// Returns what a file says of these moments, which have one column.
    pub fn from_moments(moments: &RunningMoments) -> Self {
        Self { count: moments.count, mean: moments.mean[0], variance: moments.variance()[0] }
    }

    /// Returns the moments.
    pub fn moments(&self) -> RunningMoments {
        RunningMoments { count: self.count, mean: vec![self.mean], m2: vec![self.variance * self.count] }
    }
}

/// Metadata; its fields are in the order in which they are written.
#[derive(Serialize, Deserialize)]
struct Metadata {
    format: u32,
    network: Network,
    observation: ObservationFacts,
    action: ActionFacts,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    returns: Option<ReturnFacts>,
    control_step_s: f64,
    settings: String,
    model_xml: String,
}

#[derive(Serialize, Deserialize)]
struct Network {
    observation: usize,
    hidden: Vec<usize>,
    action: usize,
    /// Last entries of an observation that only the critic sees.
    #[serde(default, skip_serializing_if = "is_zero")]
    privileged: usize,
    activation: String,
}

/// The format alone, which is read first because another format may have other fields.
#[derive(Deserialize)]
struct FormatOnly {
    format: u32,
}

impl ObservationFacts {
    /// Returns the statistics for the file: the facts, the means and the variances.
    pub fn from_moments(kind: &str, moments: &RunningMoments, clip: f32) -> (Self, Vec<f64>, Vec<f64>) {
        let size = moments.mean.len();
        let facts =
            Self { kind: kind.to_string(), size, count: moments.count, variance_epsilon: VARIANCE_EPSILON, clip };
        // Before the first observation nothing is scaled; this variance says so without a special case for readers.
        let unseen = moments.count == 0.0;
        let variance = if unseen { vec![1.0 - VARIANCE_EPSILON; size] } else { moments.variance() };
        (facts, moments.mean.clone(), variance)
    }
}

impl ExportedPolicy {
    /// Returns the bytes of the file.
    ///
    /// # Errors
    /// If the parts are inconsistent or not finite, so that the file could not be read again.
    pub fn to_bytes(&self) -> Result<Vec<u8>, ExportedError> {
        self.check()?;
        let metadata = Metadata {
            format: FORMAT,
            network: Network {
                observation: self.shape.observation,
                hidden: self.shape.hidden.clone(),
                action: self.shape.action,
                privileged: self.shape.privileged,
                activation: ACTIVATION.to_string(),
            },
            observation: self.observation.clone(),
            action: self.action.clone(),
            returns: self.returns.clone(),
            control_step_s: self.control_step_s,
            settings: self.settings.clone(),
            model_xml: self.model_xml.clone(),
        };
        let text =
            serde_json::to_string(&metadata).map_err(|error| ExportedError::Metadata { why: error.to_string() })?;
        let columns = [(MEAN, &self.mean[..]), (VARIANCE, &self.variance[..])];
        Ok(to_safetensors_with(&self.shape, &self.parameters, &columns, Some((METADATA_KEY, text))))
    }

    /// Reads and checks the bytes of a file.
    ///
    /// # Errors
    /// [`ExportedError`] names the first fault.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ExportedError> {
        if bytes.len() > BUNDLE_BYTES_MAX {
            return Err(ExportedError::TooLarge { bytes: bytes.len(), limit: BUNDLE_BYTES_MAX });
        }
        let damaged = |why: String| ExportedError::Damaged { why };
        let (_, header) = SafeTensors::read_metadata(bytes).map_err(|error| damaged(error.to_string()))?;
        let file = SafeTensors::deserialize(bytes).map_err(|error| damaged(error.to_string()))?;
        let text = header.metadata().as_ref().and_then(|entries| entries.get(METADATA_KEY));
        let metadata = read_metadata(text.ok_or(ExportedError::Foreign)?)?;
        let network = &metadata.network;
        if network.activation != ACTIVATION {
            return Err(entry("network.activation", &network.activation, format!("\"{ACTIVATION}\"")));
        }
        let shape = NetworkShape {
            observation: network.observation,
            action: network.action,
            hidden: network.hidden.clone(),
            privileged: network.privileged,
        };
        check_widths(&shape)?;
        let policy = Self {
            parameters: from_safetensors(bytes, &shape)?,
            mean: column(&file, MEAN, shape.observation)?,
            variance: column(&file, VARIANCE, shape.observation)?,
            shape,
            observation: metadata.observation,
            action: metadata.action,
            returns: metadata.returns,
            control_step_s: metadata.control_step_s,
            settings: metadata.settings,
            model_xml: metadata.model_xml,
        };
        policy.check()?;
        Ok(policy)
    }

    /// Returns the normalisation of observations.
    pub fn normaliser(&self) -> Normaliser {
        let epsilon = self.observation.variance_epsilon;
        Normaliser {
            mean: self.mean.iter().map(|mean| *mean as f32).collect(),
            inverse_std: self.variance.iter().map(|variance| (1.0 / (variance + epsilon).sqrt()) as f32).collect(),
            clip: self.observation.clip,
        }
    }

    /// Checks that the parts are consistent and the numbers usable.
    fn check(&self) -> Result<(), ExportedError> {
        check_widths(&self.shape)?;
        check_parameters(&self.shape, &self.parameters)?;
        let (inputs, outputs) = (self.shape.observation, self.shape.action);
        if self.observation.size != inputs {
            return Err(entry("observation.size", &self.observation.size, format!("{inputs}, as the network takes")));
        }
        let action = &self.action;
        for (name, length) in
            [("action.names", action.names.len()), ("action.low", action.low.len()), ("action.high", action.high.len())]
        {
            if length != outputs {
                return Err(entry(name, &format!("{length} long"), format!("{outputs}, as the network gives")));
            }
        }
        for (low, high) in action.low.iter().zip(&action.high) {
            if !(low.is_finite() && high.is_finite() && low < high) {
                return Err(entry("action.low", &low, format!("finite and below action.high, which is {high}")));
            }
        }
        if !(self.control_step_s.is_finite() && self.control_step_s >= 0.0) {
            return Err(entry("control_step_s", &self.control_step_s, "a number of at least 0".into()));
        }
        if let Some(ReturnFacts { count, mean, variance }) = &self.returns
            && !(mean.is_finite() && [count, variance].into_iter().all(|number| number.is_finite() && *number >= 0.0))
        {
            let expected = "a finite mean, and a count and a variance of at least 0".into();
            return Err(entry("returns", &format!("{:?}", self.returns), expected));
        }
        if !self.normaliser().is_valid(inputs) {
            let expected = "means, variances and a clip that give finite numbers".into();
            return Err(entry("observation", &format!("{:?}", self.observation), expected));
        }
        Ok(())
    }
}

fn read_metadata(text: &str) -> Result<Metadata, ExportedError> {
    let unreadable = |error: serde_json::Error| ExportedError::Metadata { why: error.to_string() };
    let FormatOnly { format: found } = serde_json::from_str(text).map_err(unreadable)?;
    if found != FORMAT {
        return Err(ExportedError::Format { found });
    }
    serde_json::from_str(text).map_err(unreadable)
}

/// Returns whether an entry can be left out.
fn is_zero(number: &usize) -> bool {
    *number == 0
}

/// Checks the widths before anything is allocated for them.
fn check_widths(shape: &NetworkShape) -> Result<(), ExportedError> {
    let layers = shape.hidden.len();
    if layers > HIDDEN_LAYERS_MAX {
        return Err(entry("network.hidden", &format!("{layers} layers"), format!("at most {HIDDEN_LAYERS_MAX}")));
    }
    let widths = [shape.observation, shape.action].into_iter().chain(shape.hidden.iter().copied());
    for width in widths {
        if !(1..=WIDTH_MAX as usize).contains(&width) {
            return Err(entry("network", &format!("a width of {width}"), format!("1 to {WIDTH_MAX}")));
        }
    }
    if shape.privileged >= shape.observation {
        let expected = format!("less than network.observation, which is {}", shape.observation);
        return Err(entry("network.privileged", &shape.privileged, expected));
    }
    if shape.parameter_count() > BUNDLE_BYTES_MAX / size_of::<f32>() {
        let count = format!("{} parameters", shape.parameter_count());
        return Err(entry("network", &count, format!("what fits into {BUNDLE_BYTES_MAX} bytes")));
    }
    Ok(())
}

fn entry(entry: &'static str, value: &impl ToString, expected: String) -> ExportedError {
    ExportedError::Entry { entry, value: value.to_string(), expected }
}

#[cfg(test)]
#[path = "exported_tests.rs"]
mod tests;
