//! The simulated robot at another state than the simulated one.

use super::{Physics, ROOT_DOFS, ROOT_POSITIONS};
use crate::dynamics::{self, World};

impl Physics {
    /// Moves `world`, a copy of this simulation's world, to a position and a velocity vector, with the present controls and
    /// parameters. Allocates nothing.
    pub(crate) fn pose(&self, world: &mut World, position: &[f64], velocity: &[f64]) {
        world.parameters.copy_from(&self.world.parameters);
        world.position.copy_from_slice(position);
        world.velocity.copy_from_slice(velocity);
        dynamics::refresh(&self.structure, &self.collision, world);
        for (hinge, (torque_nm, drive)) in world.torques_nm.iter_mut().zip(&self.world.drives).enumerate() {
            *torque_nm = drive.torque_at(position[ROOT_POSITIONS + hinge], velocity[ROOT_DOFS + hinge]);
        }
    }
}
