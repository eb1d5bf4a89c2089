//! Keyframes: named states with controls.

use nalgebra::Vector3;

use super::element::{Element, numbers};
use crate::error::ModelError;
use crate::model::{Keyframe, Model};

/// Most keyframes.
const KEYFRAMES_MAX: usize = 1024;

/// Reads the keyframes of a model, whose root is at `origin_m` where its position in the text is 0.
pub(super) fn read(model: &Model, keys: &[Element], origin_m: Vector3<f64>) -> Result<Vec<Keyframe>, ModelError> {
    if keys.len() > KEYFRAMES_MAX {
        let problem = format!("there are {} keyframes, but at most {KEYFRAMES_MAX} are supported", keys.len());
        return Err(ModelError::unsupported("keyframe", problem));
    }
    keys.iter().map(|key| read_key(model, key, origin_m)).collect()
}

fn read_key(model: &Model, key: &Element, origin_m: Vector3<f64>) -> Result<Keyframe, ModelError> {
    let list = |attribute: &str, default: Vec<f64>| {
        let Some(text) = key.get(attribute) else { return Ok(default) };
        let mut list = numbers(text).ok_or_else(|| key.wrong(attribute, "finite numbers"))?;
        if list.len() > default.len() {
            let problem = format!("`{attribute}` has {} numbers, but the model has {}", list.len(), default.len());
            return Err(key.refused(problem));
        }
        // As in MuJoCo, a list may end early.
        list.extend(&default[list.len()..]);
        Ok(list)
    };
    let mut nominal = model.nominal_position();
    nominal.iter_mut().zip(&origin_m).for_each(|(entry, origin_m)| *entry -= origin_m);
    let mut position = list("qpos", nominal)?;
    position.iter_mut().zip(&origin_m).for_each(|(entry, origin_m)| *entry += origin_m);
    let length = position[3..7].iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    if !(length.is_finite() && length > 1e-6) {
        return Err(key.refused("the quaternion in `qpos`, its entries 4 to 7, must not be zero"));
    }
    position[3..7].iter_mut().for_each(|entry| *entry /= length);
    Ok(Keyframe {
        name: key.label.clone(),
        position,
        velocity: list("qvel", vec![0.0; model.velocity_size()])?,
        controls: list("ctrl", vec![0.0; model.motors.len()])?,
    })
}
