//! State as noisy sensors report it, and everything that an observer computes from it.

use nalgebra::Vector3;

use crate::dynamics::World;
use crate::physics::Physics;

/// State with sensor noise.
pub(crate) struct Sensed {
    pub(super) position: Vec<f64>,
    pub(super) velocity: Vec<f64>,
    /// The robot at that state.
    pub(super) world: World,
}

impl Sensed {
    pub(crate) fn new(physics: &Physics) -> Self {
        Self {
            position: physics.position().to_vec(),
            velocity: physics.velocity().to_vec(),
            world: physics.world().clone(),
        }
    }

    /// Computes everything from `position` and `velocity`. Allocates nothing.
    pub(super) fn update(&mut self, physics: &Physics) {
        // The quaternion with noise does not have length 1.
        let norm = self.position[3..7].iter().map(|part| part * part).sum::<f64>().sqrt();
        if norm > 0.0 {
            self.position[3..7].iter_mut().for_each(|part| *part /= norm);
        }
        physics.pose(&mut self.world, &self.position, &self.velocity);
    }

    /// Returns the contact force (N) on a link and its moment about the sensed centre of mass (N·m), in the world frame.
    ///
    /// Force and moment are measured exactly in the link's own frame, which the observer sees at its sensed pose.
    pub(super) fn contact_wrench(&self, physics: &Physics, link: usize) -> (Vector3<f64>, Vector3<f64>) {
        let body = physics.model().links[link].body;
        let (exact, sensed) = (physics.body_motion(body).pose, self.world.body_motion(body).pose);
        let (force_n, moment_nm) = physics.contact_wrench(link);
        let arm_m = exact.translation.vector - physics.centre_of_mass().coords;
        let own_moment_nm = moment_nm - arm_m.cross(&force_n);
        let turn = sensed.rotation * exact.rotation.inverse();
        let arm_m = sensed.translation.vector - self.world.centre_of_mass().coords;
        let force_n = turn * force_n;
        (force_n, turn * own_moment_nm + arm_m.cross(&force_n))
    }
}
