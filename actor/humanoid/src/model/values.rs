//! Numbers of attributes that [`super::vocabulary`] has checked.

use super::defaults::{Attribute, get};
use super::vocabulary::numbers;
use crate::error::ModelError;

/// Returns the first number of an attribute.
pub(super) fn number(attributes: &[Attribute], name: &str) -> Option<f64> {
    get(attributes, name).and_then(numbers)?.first().copied()
}

/// Returns a list whose first entries are those of the attribute, and whose other ones are the defaults.
pub(super) fn list_over<const N: usize>(attributes: &[Attribute], name: &str, mut defaults: [f64; N]) -> [f64; N] {
    let given = get(attributes, name).and_then(numbers).unwrap_or_default();
    for (entry, number) in defaults.iter_mut().zip(given) {
        *entry = number;
    }
    defaults
}

/// Returns a number that must be finite and not negative; 0 without the attribute.
pub(super) fn amount(label: &str, attributes: &[Attribute], name: &str, what: &'static str) -> Result<f64, ModelError> {
    not_negative(label, what, number(attributes, name).unwrap_or(0.0))
}

/// Longest length that collision detection computes without a fault, with a wide margin (m).
const LENGTH_MAX_M: f64 = 1e6;

pub(super) fn length(element: &str, what: &'static str, metres: f64) -> Result<f64, ModelError> {
    match metres > 0.0 && metres <= LENGTH_MAX_M {
        true => Ok(metres),
        false => Err(ModelError::quantity(element, what, metres, "above 0 and at most 1000 km")),
    }
}

pub(super) fn not_negative(element: &str, what: &'static str, value: f64) -> Result<f64, ModelError> {
    if value.is_finite() && value >= 0.0 {
        Ok(value)
    } else {
        Err(ModelError::quantity(element, what, value, "finite and not negative"))
    }
}

/// Returns a range if its flag, or its presence, limits the element.
pub(super) fn range(
    label: &str,
    attributes: &[Attribute],
    name: &str,
    flag: &str,
    autolimits: bool,
) -> Result<Option<[f64; 2]>, ModelError> {
    let limited = match get(attributes, flag).unwrap_or("auto") {
        "false" => return Ok(None),
        "true" => true,
        "auto" => false,
        other => return Err(ModelError::attribute(label, flag, other, "true, false or auto")),
    };
    match get(attributes, name) {
        None if limited => Err(ModelError::unsupported(label, format!("it is limited, but has no `{name}`"))),
        None => Ok(None),
        Some(_) if !limited && !autolimits => {
            Err(ModelError::unsupported(label, format!("without autolimits `{name}` needs `{flag}`")))
        }
        Some(text) => match numbers(text).as_deref() {
            Some([low, high]) if low < high => Ok(Some([*low, *high])),
            _ => Err(ModelError::attribute(label, name, text, "a lower and an upper limit")),
        },
    }
}
