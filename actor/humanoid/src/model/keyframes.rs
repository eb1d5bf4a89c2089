//! Keyframes: named states with controls.

use super::Model;
use super::defaults::{Attribute, get};
use super::vocabulary::numbers;
use crate::error::ModelError;

/// Most keyframes.
pub const KEYFRAMES_MAX: usize = 1024;

/// State and controls under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframe {
    /// Name in the text.
    pub name: String,
    /// Position vector; the root's quaternion has length 1. Without `qpos` that of the text's pose.
    pub position: Vec<f64>,
    /// Velocity vector; without `qvel` 0.
    pub velocity: Vec<f64>,
    /// One control per motor, as in the text; without `ctrl` 0.
    pub controls: Vec<f64>,
}

/// Reads the keyframes of a model, each as label and attributes.
pub(super) fn read(model: &Model, keys: &[(String, Vec<Attribute>)]) -> Result<Vec<Keyframe>, ModelError> {
    if keys.len() > KEYFRAMES_MAX {
        let problem = format!("there are {} keyframes, but at most {KEYFRAMES_MAX} are supported", keys.len());
        return Err(ModelError::unsupported("keyframe", problem));
    }
    keys.iter().map(|(name, attributes)| read_key(model, name, attributes)).collect()
}

fn read_key(model: &Model, name: &str, attributes: &[Attribute]) -> Result<Keyframe, ModelError> {
    let list = |attribute: &str, default: Vec<f64>| {
        let Some(text) = get(attributes, attribute) else { return Ok(default) };
        match numbers(text) {
            Some(list) if list.len() == default.len() => Ok(list),
            Some(list) => {
                let problem =
                    format!("`{attribute}` has {} numbers, but the model needs {}", list.len(), default.len());
                Err(ModelError::unsupported(name, problem))
            }
            None => Err(ModelError::attribute(name, attribute, text, "finite numbers")),
        }
    };
    let mut position = list("qpos", model.nominal_position())?;
    let length = position[3..7].iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    if !(length.is_finite() && length > 1e-6) {
        return Err(ModelError::unsupported(name, "the quaternion in `qpos`, its entries 4 to 7, must not be zero"));
    }
    position[3..7].iter_mut().for_each(|entry| *entry /= length);
    Ok(Keyframe {
        name: name.to_owned(),
        position,
        velocity: list("qvel", vec![0.0; model.velocity_size()])?,
        controls: list("ctrl", vec![0.0; model.motors.len()])?,
    })
}
