//! What the policy sees: positions without the horizontal place of the torso, then velocities.

use crate::physics::Physics;

/// Length of the observation of [`crate::HUMANOID_XML`]: 22 position and 23 velocity numbers.
pub const OBSERVATION_SIZE_COMPACT: usize = 45;

/// Numbers of the position vector that are left out: x and y, since walking must not depend on the place.
const HIDDEN: usize = 2;

/// Length of the observation for a body.
#[must_use]
pub fn size(physics: &Physics) -> usize {
    physics.position().len() - HIDDEN + physics.velocity().len()
}

/// Writes the observation: height (m), quaternion w, x, y, z, hinge angles (rad), root velocity in the world
/// frame (m/s), root angular velocity in the torso's frame (rad/s), hinge rates (rad/s).
///
/// # Panics
/// If `observation` does not have the length given by [`size`].
pub fn write(physics: &Physics, observation: &mut [f32]) {
    let numbers = physics.position()[HIDDEN..].iter().chain(physics.velocity());
    assert_eq!(observation.len(), size(physics), "observation buffer has the wrong length");
    for (slot, number) in observation.iter_mut().zip(numbers) {
        *slot = *number as f32;
    }
}
