//! States that come from outside.

use super::Physics;
use crate::articulation::{ROOT_DOFS, ROOT_POSITIONS};
use crate::config::HINGE_TOLERANCE_RAD;
use crate::dynamics::{self, World};
use crate::error::StateError;

/// Accepted norms of the root's quaternion, which is then normalised.
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
    /// Checks a state from outside and passes it to [`Self::set_state`].
    ///
    /// Hinges may be up to [`HINGE_TOLERANCE_RAD`] outside their ranges. The quaternion need not be normalised.
    ///
    /// # Errors
    /// [`StateError`] names the first invalid entry, its value and what is accepted; the state is then unchanged.
    pub fn try_set_state(&mut self, position: &[f64], velocity: &[f64]) -> Result<(), StateError> {
        self.check_numbers(position, velocity)?;
        for (offset, (hinge, &value_rad)) in self.model.hinges.iter().zip(&position[ROOT_POSITIONS..]).enumerate() {
            if hinge.overshoot_rad(value_rad) > HINGE_TOLERANCE_RAD {
                return Err(StateError::Hinge {
                    index: ROOT_POSITIONS + offset,
                    hinge: hinge.name.clone(),
                    value_rad,
                    min_rad: hinge.min_rad,
                    max_rad: hinge.max_rad,
                    tolerance_rad: HINGE_TOLERANCE_RAD,
                });
            }
        }
        self.set_state(position, velocity);
        Ok(())
    }

    /// Restarts from exactly this state: unlike [`Self::set_state`], it does not normalise the quaternion.
    pub(crate) fn resume_from(&mut self, position: &[f64], velocity: &[f64]) {
        self.world.position.copy_from_slice(position);
        self.world.velocity.copy_from_slice(velocity);
        self.restart();
    }

    /// Moves `world`, a copy of this simulation's world, to a position and a velocity vector, with the present controls and
    /// parameters. Allocates nothing.
    pub(crate) fn pose(&self, world: &mut World, position: &[f64], velocity: &[f64]) {
        world.parameters.copy_from(&self.world.parameters);
        world.drives.copy_from_slice(&self.world.drives);
        world.position.copy_from_slice(position);
        world.velocity.copy_from_slice(velocity);
        dynamics::refresh(&self.structure, &self.collision, world);
        world.update_torques();
    }

    /// Checks lengths, finiteness, and the quaternion's norm. Hinges may have any angle, because the limits are soft.
    pub(crate) fn check_numbers(&self, position: &[f64], velocity: &[f64]) -> Result<(), StateError> {
        let model = &self.model;
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
}
