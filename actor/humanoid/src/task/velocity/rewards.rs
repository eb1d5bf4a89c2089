//! Terms of the reward, each a pure function.

use nalgebra::{UnitQuaternion, Vector3};

use super::command::Command;
use super::feet::{FEET, Foot, Stride, stride};
use crate::config::{RewardFunctions, VelocityConfig};
use crate::model::Model;
use crate::physics::Physics;
use crate::task::beyond_soft_limits_rad;

/// Time in the air from which a landing is rewarded (s).
const AIR_TIME_S: f64 = 0.4;
/// Horizontal velocity (m/s), and horizontal part of gravity's direction in the frame of the base, below which a robot whose
/// gait never rests does so.
const SLOW_MPS: f64 = 0.3;
const UPRIGHT: f64 = 0.1;
/// Axes whose part along the base's left exceeds this swing a leg forwards, not sideways.
const LATERAL_AXIS: f64 = 0.8;
/// Weight of hinges that swing the legs forwards in the term `pose`.
const SWING_POSE_WEIGHT: f64 = 0.1;

/// Motion of the base.
#[derive(Clone, Copy, Debug)]
pub struct BaseMotion {
    /// Height above the ground (m).
    pub height_m: f64,
    /// Velocity in the heading frame (m/s): forward, left, up.
    pub velocity_mps: Vector3<f64>,
    /// Angular velocity in the base frame (rad/s).
    pub angular_radps: Vector3<f64>,
    /// Angular velocity about the vertical (rad/s).
    pub yaw_rate_radps: f64,
    /// Heading (rad, world frame).
    pub heading_rad: f64,
    /// Direction of gravity in the base frame.
    pub gravity: Vector3<f64>,
}

impl BaseMotion {
    /// Returns the motion of a base with these position and velocity vectors, see [`crate::Physics::position`], over
    /// ground of this height.
    #[must_use]
    pub fn new(position: &[f64], velocity: &[f64], ground_m: f64) -> Self {
        let rotation = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(
            position[3],
            position[4],
            position[5],
            position[6],
        ));
        let forward = rotation * Vector3::x();
        let heading_rad = forward.y.atan2(forward.x);
        let (sin, cos) = heading_rad.sin_cos();
        let angular_radps = Vector3::new(velocity[3], velocity[4], velocity[5]);
        Self {
            height_m: position[2] - ground_m,
            velocity_mps: Vector3::new(
                cos * velocity[0] + sin * velocity[1],
                cos * velocity[1] - sin * velocity[0],
                velocity[2],
            ),
            angular_radps,
            yaw_rate_radps: (rotation * angular_radps).z,
            heading_rad,
            gravity: rotation.inverse_transform_vector(&-Vector3::z()),
        }
    }

    /// Returns the tilt of the base (rad).
    #[must_use]
    pub fn tilt_rad(&self) -> f64 {
        (-self.gravity.z).clamp(-1.0, 1.0).acos()
    }
}

/// Hinges and their motors at the end of a control step, in the order of [`Model::hinges`] and [`Model::motors`].
#[derive(Clone, Copy, Debug)]
pub struct HingeMotion<'a> {
    /// Angles (rad).
    pub angles_rad: &'a [f64],
    /// Rates (rad/s).
    pub rates_radps: &'a [f64],
    /// Rates before the step (rad/s).
    pub rates_before_radps: &'a [f64],
    /// Torques (N·m).
    pub torques_nm: &'a [f64],
    /// Actions of the step and of the one before, in units of the action.
    pub actions: [&'a [f64]; 2],
}

/// What the terms depend on, beside the motion.
#[derive(Clone, Debug)]
pub struct Stance {
    /// Angles of the default pose (rad).
    pub default_rad: Vec<f64>,
    /// Weight of each hinge in the term `pose`.
    pub pose_weights: Vec<f64>,
    /// Height of the base in the default pose (m).
    pub height_m: f64,
    /// Whether swinging feet may be higher than the gait wants, to reach the next stair.
    pub may_lift_higher: bool,
}

/// A control step of the robot.
#[derive(Clone, Copy, Debug)]
pub struct RobotStep<'a> {
    /// Settings of the task.
    pub config: &'a VelocityConfig,
    /// Robot.
    pub model: &'a Model,
    /// Its default pose.
    pub body: &'a Stance,
    /// Command that it followed.
    pub command: Command,
    /// Whether its gait rested.
    pub rests: bool,
    /// Base at its end.
    pub base: BaseMotion,
    /// Feet at its end.
    pub feet: &'a [Foot; FEET],
    /// Hinges at its end.
    pub hinges: HingeMotion<'a>,
    /// Time since the episode began (s).
    pub time_s: f64,
    /// Duration of the step (s).
    pub step_s: f64,
    /// Whether the robot has fallen.
    pub has_fallen: bool,
}

impl RobotStep<'_> {
    fn numbered_feet(&self) -> impl Iterator<Item = (usize, &Foot)> {
        self.feet.iter().enumerate()
    }

    /// Returns what the gait wants of a foot.
    fn stride(&self, foot: usize) -> Stride {
        match self.must_rest() {
            true => Stride { stands: true, lift_m: 0.0 },
            false => stride(self.config, self.time_s, foot, self.feet[foot].rise_m),
        }
    }

    /// Returns whether the robot must stand on both feet. One whose gait rests must at once: policies that earn nothing
    /// until they are balanced jerk to wake the gait, whose steps pay.
    fn must_rest(&self) -> bool {
        if self.config.gait_rests {
            return self.rests;
        }
        let is_slow = self.base.velocity_mps.xy().norm() < SLOW_MPS && self.base.gravity.xy().norm() < UPRIGHT;
        self.command.stands() && is_slow
    }
}

impl RewardFunctions for RobotStep<'_> {
    fn track_linear_velocity(&self) -> f64 {
        let (velocity_mps, command) = (self.base.velocity_mps, self.command);
        let squared_error =
            (velocity_mps.x - command.lin_vel_x_mps).powi(2) + (velocity_mps.y - command.lin_vel_y_mps).powi(2);
        (-squared_error / self.config.tracking_variance).exp()
    }

    fn track_yaw_rate(&self) -> f64 {
        let squared_error = (self.base.yaw_rate_radps - self.command.ang_vel_z_radps).powi(2);
        (-squared_error / self.config.yaw_tracking_variance).exp()
    }

    fn alive(&self) -> f64 {
        f64::from(u8::from(!self.has_fallen))
    }

    fn upright(&self) -> f64 {
        self.base.gravity.x.powi(2) + self.base.gravity.y.powi(2)
    }

    fn base_height(&self) -> f64 {
        (self.base.height_m - self.body.height_m).powi(2)
    }

    fn vertical_velocity(&self) -> f64 {
        self.base.velocity_mps.z.powi(2)
    }

    fn roll_pitch_rate(&self) -> f64 {
        self.base.angular_radps.x.powi(2) + self.base.angular_radps.y.powi(2)
    }

    fn gait(&self) -> f64 {
        let follows =
            |(foot, sensed): (usize, &Foot)| if sensed.stands == self.stride(foot).stands { 1.0 } else { -1.0 };
        self.numbered_feet().map(follows).sum::<f64>() / FEET as f64
    }

    fn feet_air_time(&self) -> f64 {
        let landed = self.feet.iter().filter(|foot| foot.landed_after_s > 0.0 && !self.command.stands());
        landed.map(|foot| foot.landed_after_s - AIR_TIME_S).sum()
    }

    fn feet_clearance(&self) -> f64 {
        self.numbered_feet()
            .map(|(index, foot)| (foot, self.stride(index)))
            .filter(|(_, wanted)| !wanted.stands)
            .map(|(foot, wanted)| foot.lift_m - wanted.lift_m)
            .filter(|above_m| *above_m < 0.0 || !self.body.may_lift_higher)
            .map(|above_m| above_m.powi(2))
            .sum()
    }

    fn feet_slip(&self) -> f64 {
        self.feet.iter().filter(|foot| foot.stands).map(|foot| foot.velocity_mps.xy().norm_squared()).sum()
    }

    fn landing(&self) -> f64 {
        self.feet.iter().map(|foot| foot.landing_mps.powi(2)).fold(0.0, f64::max)
    }

    fn pose(&self) -> f64 {
        let posture = self.hinges.angles_rad.iter().zip(&self.body.default_rad).zip(&self.body.pose_weights);
        posture.map(|((angle_rad, default_rad), weight)| weight * (angle_rad - default_rad).powi(2)).sum()
    }

    /// At steps, too: without this cost, a robot earns as much by steps on the spot as at rest.
    fn stand_still(&self) -> f64 {
        let counts = self.config.gait_rests && self.command.stands();
        if counts { self.hinges.rates_radps.iter().map(|rate| rate * rate).sum() } else { 0.0 }
    }

    fn action_rate(&self) -> f64 {
        let [now, before] = self.hinges.actions;
        now.iter().zip(before).map(|(now, before)| (now - before).powi(2)).sum()
    }

    fn joint_torque(&self) -> f64 {
        self.hinges.torques_nm.iter().map(|torque_nm| torque_nm * torque_nm).sum()
    }

    fn joint_acceleration(&self) -> f64 {
        let rates_radps = self.hinges.rates_radps.iter().zip(self.hinges.rates_before_radps);
        rates_radps.map(|(now, before)| ((now - before) / self.step_s).powi(2)).sum()
    }

    fn joint_limits(&self) -> f64 {
        beyond_soft_limits_rad(self.model, self.hinges.angles_rad)
    }
}

/// Returns the weight of each hinge in the term `pose`, for a robot in the default pose.
pub(super) fn pose_weights(physics: &Physics) -> Vec<f64> {
    let model = physics.model();
    let base = physics.body_motion(0).pose.rotation;
    let mut weights = vec![1.0; model.hinges.len()];
    for (index, body) in model.bodies.iter().enumerate() {
        let rotation = base.inverse() * physics.body_motion(index).pose.rotation;
        for hinge in body.hinges.clone() {
            if (rotation * model.hinges[hinge].axis).y.abs() > LATERAL_AXIS {
                weights[hinge] = SWING_POSE_WEIGHT;
            }
        }
    }
    weights
}

#[cfg(test)]
#[path = "rewards_tests.rs"]
mod tests;
