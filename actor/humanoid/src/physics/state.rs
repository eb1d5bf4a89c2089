//! States from outside: checked before they are taken.

use super::Physics;
use crate::dynamics::{ROOT_DOFS, ROOT_POSITIONS};
use crate::error::StateError;
use crate::model::Model;

/// How far outside its range a hinge may be set (rad). It cannot be nothing: in the nominal pose of Humanoid-v5 itself
/// the knees are straight, 2° beyond the end of their range, and limits are soft.
pub const HINGE_TOLERANCE_RAD: f64 = 0.1;
/// Lengths of a quaternion that still says a rotation; it is made a unit one.
const QUATERNION_NORMS: std::ops::RangeInclusive<f64> = 1e-6..=1e6;

const ROOT_POSITION_NAMES: [&str; ROOT_POSITIONS] =
    ["root x", "root y", "root z", "root quaternion w", "root quaternion x", "root quaternion y", "root quaternion z"];
const ROOT_VELOCITY_NAMES: [&str; ROOT_DOFS] = [
    "root velocity x",
    "root velocity y",
    "root velocity z",
    "root angular velocity x",
    "root angular velocity y",
    "root angular velocity z",
];

impl Physics {
    /// As [`Self::set_state`], for states from outside.
    ///
    /// Hinges may be up to [`HINGE_TOLERANCE_RAD`] outside their ranges. The quaternion need not be a unit one.
    ///
    /// # Errors
    /// [`StateError`] names the first entry that no body can have, what stands there and what would be accepted; nothing
    /// has happened then.
    pub fn try_set_state(&mut self, position: &[f64], velocity: &[f64]) -> Result<(), StateError> {
        check(&self.model, position, velocity)?;
        self.set_state(position, velocity);
        Ok(())
    }

    /// Whether [`Self::go_on_from`] takes a state. Hinges may be anywhere: a simulated body's can be.
    pub(crate) fn check_exact(&self, position: &[f64], velocity: &[f64]) -> Result<(), StateError> {
        check_numbers(&self.model, position, velocity)
    }

    /// As [`Self::set_state`], but to the last bit where a body was: its quaternion is not made a unit one again.
    pub(crate) fn go_on_from(&mut self, position: &[f64], velocity: &[f64]) {
        self.position.copy_from_slice(position);
        self.velocity.copy_from_slice(velocity);
        self.begin();
    }
}

fn check(model: &Model, position: &[f64], velocity: &[f64]) -> Result<(), StateError> {
    check_numbers(model, position, velocity)?;
    for (offset, (hinge, &value_rad)) in model.hinges.iter().zip(&position[ROOT_POSITIONS..]).enumerate() {
        if hinge.overshoot_rad(value_rad) > HINGE_TOLERANCE_RAD {
            return Err(StateError::Hinge {
                index: ROOT_POSITIONS + offset,
                hinge: hinge.name.clone(),
                value_rad,
                min_rad: hinge.min_rad,
                max_rad: hinge.max_rad,
            });
        }
    }
    Ok(())
}

/// Lengths, numbers that are none, and the quaternion.
fn check_numbers(model: &Model, position: &[f64], velocity: &[f64]) -> Result<(), StateError> {
    for (what, numbers, expected, root, kind) in [
        ("position", position, model.position_size(), &ROOT_POSITION_NAMES[..], "angle"),
        ("velocity", velocity, model.velocity_size(), &ROOT_VELOCITY_NAMES[..], "rate"),
    ] {
        if numbers.len() != expected {
            return Err(StateError::Length { what, found: numbers.len(), expected });
        }
        if let Some((index, &value)) = numbers.iter().enumerate().find(|(_, number)| !number.is_finite()) {
            let name = match root.get(index) {
                Some(name) => (*name).to_owned(),
                None => format!("{kind} of hinge `{}`", model.hinges[index - root.len()].name),
            };
            return Err(StateError::NotFinite { what, index, name, value });
        }
    }
    let value = [position[3], position[4], position[5], position[6]];
    let norm = value.iter().map(|part| part * part).sum::<f64>().sqrt();
    if !QUATERNION_NORMS.contains(&norm) {
        return Err(StateError::Quaternion { value });
    }
    Ok(())
}
