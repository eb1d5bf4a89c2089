//! Where episodes begin: at the start of a motion, anywhere in the motions, or shortly before a failure.
//!
//! A robot that stands askew at the first frame falls seconds later, where an episode that begins there does not. So some
//! episodes begin at the first frame, as evaluations do.
//!
//! mjlab draws from bins of a second, by the counts of failures of all environments. Here each environment goes back to
//! its own last failure until it has come past it; a new one begins with that of another. The starts of many environments
//! are then distributed as their failures are, and an environment that is saved and continued needs nothing of the others.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rand::{Rng, RngExt};

use super::MotionTask;
use crate::randomisation::{stream, uniform};
use crate::task::EpisodeStart;

impl MotionTask {
    /// Returns whether the robot has come past a failure in this episode: by as long as an episode may begin before one, or
    /// to the end of its motion.
    pub(super) fn has_passed(&self, failed: usize) -> bool {
        let motion = self.reference.motion_of(failed);
        let has_met = motion.contains(&self.began) && self.began <= failed;
        has_met && self.step >= (failed + self.lead_steps()).min(motion.end - 1)
    }

    fn lead_steps(&self) -> usize {
        (self.config.lead_s / self.reference.step_s()).round().max(1.0) as usize
    }

    /// Chooses where the next episode begins, and places the robot there, with an offset.
    pub(super) fn begin_motion(&mut self, seed: u64, start: EpisodeStart<'_>) {
        let mut random = stream(seed, "start");
        let first = self.first_step(&mut random);
        (self.began, self.step) = (first, first + 1);
        let EpisodeStart { position, velocity } = start;
        position.copy_from_slice(&self.reference.positions[first]);
        velocity.copy_from_slice(&self.reference.velocities[first]);
        let config = &self.config;
        let mut around = |half: f64| uniform(&mut random, [-half, half]);
        let offsets_m = [config.start_xy_m, config.start_xy_m, config.start_z_m].map(&mut around);
        let [roll, pitch, yaw] = [config.start_tilt_rad, config.start_tilt_rad, config.start_yaw_rad].map(&mut around);
        let linear_mps = [config.start_xy_mps, config.start_xy_mps, config.start_z_mps].map(&mut around);
        let angular = [config.start_tilt_radps, config.start_tilt_radps, config.start_yaw_radps].map(&mut around);
        let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        let base = UnitQuaternion::from_quaternion(Quaternion::new(position[3], position[4], position[5], position[6]));
        let turned = turn * base;
        position[3..7].copy_from_slice(&[turned.w, turned.i, turned.j, turned.k]);
        // The rate keeps its direction in the world.
        let rate = base * Vector3::from_column_slice(&velocity[3..6]) + Vector3::from(angular);
        velocity[3..6].copy_from_slice(turned.inverse_transform_vector(&rate).as_slice());
        position.iter_mut().zip(offsets_m).for_each(|(place, offset)| *place += offset);
        velocity.iter_mut().zip(linear_mps).for_each(|(rate, offset)| *rate += offset);
        for angle in &mut position[7..] {
            *angle += around(config.start_hinge_rad);
        }
        self.reference.clamp_to_ranges(&mut position[7..]);
    }

    /// Returns the control step at which an episode begins: outside of training the first of the chosen motion.
    fn first_step(&self, random: &mut impl Rng) -> usize {
        let motions = &self.reference.motions;
        if !self.in_training {
            return motions[self.chosen].start;
        }
        let kind = random.random::<f64>();
        if kind >= 1.0 - self.config.first_share {
            return motions[random.random_range(0..motions.len())].start;
        }
        if let Some(failed) = self.failed.filter(|_| kind >= self.config.uniform_share) {
            let begin = self.reference.motion_of(failed).start;
            return random.random_range(failed.saturating_sub(self.lead_steps()).max(begin)..failed.max(begin + 1));
        }
        // Each control step of all motions is as likely, but for the last ones, which nothing follows.
        let step = random.random_range(0..self.reference.positions.len());
        step.min(self.reference.motion_of(step).end - 2)
    }
}
