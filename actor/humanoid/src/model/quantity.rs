//! Checks of quantities.

use crate::error::ModelError;

/// Longest length that collision detection computes without a fault, with a wide margin (m).
const LENGTH_MAX_M: f64 = 1e6;

/// Returns a length (m) that must be above 0.
pub(crate) fn length(element: &str, what: &'static str, metres: f64) -> Result<f64, ModelError> {
    match metres > 0.0 && metres <= LENGTH_MAX_M {
        true => Ok(metres),
        false => Err(ModelError::quantity(element, what, metres, "above 0 and at most 1000 km")),
    }
}

/// Returns a number that must be finite and not negative.
pub(crate) fn not_negative(element: &str, what: &'static str, value: f64) -> Result<f64, ModelError> {
    match value.is_finite() && value >= 0.0 {
        true => Ok(value),
        false => Err(ModelError::quantity(element, what, value, "finite and not negative")),
    }
}
