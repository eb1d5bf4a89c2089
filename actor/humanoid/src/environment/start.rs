//! State at which episodes start, without noise.

use crate::error::ModelError;
use crate::model::Model;

/// Returns the state at which episodes start: that of a keyframe, or the nominal pose at rest for an empty name.
pub(super) fn start(model: &Model, keyframe: &str) -> Result<(Vec<f64>, Vec<f64>), ModelError> {
    if keyframe.is_empty() {
        let of_card = model.robot.as_ref().map(|robot| robot.default_position.clone());
        return Ok((of_card.unwrap_or_else(|| model.nominal_position()), vec![0.0; model.velocity_size()]));
    }
    match model.keyframes.iter().find(|known| known.name == keyframe) {
        Some(found) => Ok((found.position.clone(), found.velocity.clone())),
        None => {
            let known: Vec<&str> = model.keyframes.iter().map(|known| known.name.as_str()).collect();
            Err(ModelError::Keyframe { name: keyframe.to_owned(), known: known.join(", ") })
        }
    }
}
