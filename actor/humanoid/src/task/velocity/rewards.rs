//! Terms of the reward, each a pure function.

use nalgebra::{UnitQuaternion, Vector3};

use super::command::Command;
use super::feet::{FEET, Foot, Stride, stride};
use crate::config::{RewardFunctions, VelocityConfig};
use crate::model::Model;
use crate::physics::Physics;

/// Time in the air from which a landing is rewarded (s).
const AIR_TIME_S: f64 = 0.4;
/// Horizontal velocity below which a robot that is commanded to stand puts both feet down (m/s).
const SLOW_MPS: f64 = 0.3;
/// Share of a hinge's range, from its middle, beyond which it is near its limit.
const SOFT_LIMIT_SHARE: f64 = 0.9;
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
    /// Returns exp(−squared error ÷ variance).
    fn tracking(&self, squared_error: f64) -> f64 {
        (-squared_error / self.config.tracking_variance).exp()
    }

    fn numbered_feet(&self) -> impl Iterator<Item = (usize, &Foot)> {
        self.feet.iter().enumerate()
    }

    fn stride(&self, foot: usize) -> Stride {
        stride(self.config, self.time_s, foot, self.feet[foot].rise_m)
    }

    /// Returns whether a foot must stand. A robot that is to stop steps until it is slow: feet that stop at once make it
    /// fall.
    fn must_stand(&self, foot: usize) -> bool {
        self.command.stands() && self.base.velocity_mps.xy().norm() < SLOW_MPS || self.stride(foot).stands
    }
}

impl RewardFunctions for RobotStep<'_> {
    fn track_linear_velocity(&self) -> f64 {
        let (velocity_mps, command) = (self.base.velocity_mps, self.command);
        self.tracking(
            (velocity_mps.x - command.lin_vel_x_mps).powi(2) + (velocity_mps.y - command.lin_vel_y_mps).powi(2),
        )
    }

    fn track_yaw_rate(&self) -> f64 {
        self.tracking((self.base.yaw_rate_radps - self.command.ang_vel_z_radps).powi(2))
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
        let follows = |(foot, sensed): (usize, &Foot)| if sensed.stands == self.must_stand(foot) { 1.0 } else { -1.0 };
        self.numbered_feet().map(follows).sum::<f64>() / FEET as f64
    }

    fn feet_air_time(&self) -> f64 {
        let landed = self.feet.iter().filter(|foot| foot.landed_after_s > 0.0 && !self.command.stands());
        landed.map(|foot| foot.landed_after_s - AIR_TIME_S).sum()
    }

    fn feet_clearance(&self) -> f64 {
        self.numbered_feet()
            .filter(|(foot, _)| !self.must_stand(*foot))
            .map(|(index, foot)| foot.lift_m - self.stride(index).lift_m)
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
        let angles_rad = self.model.hinges.iter().zip(self.hinges.angles_rad);
        angles_rad
            .map(|(hinge, angle_rad)| {
                let half_rad = SOFT_LIMIT_SHARE * (hinge.max_rad - hinge.min_rad) / 2.0;
                ((angle_rad - hinge.centre_rad()).abs() - half_rad).max(0.0)
            })
            .sum()
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
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::config::RewardsConfig;
    use crate::mjcf::HUMANOID_XML;

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-9, "{found} instead of {expected}");
    }

    #[test]
    fn the_motion_of_a_turned_base_is_seen_in_its_heading_frame() {
        // Turned left by 90°, moving along the world's y: forwards.
        let half = FRAC_PI_2 / 2.0;
        let position = [3.0, 4.0, 0.8, half.cos(), 0.0, 0.0, half.sin()];
        let base = BaseMotion::new(&position, &[-0.2, 0.7, 0.1, 0.3, 0.4, 0.5], 0.2);
        close(base.velocity_mps.x, 0.7);
        close(base.velocity_mps.y, 0.2);
        close(base.velocity_mps.z, 0.1);
        close(base.height_m, 0.6);
        close(base.heading_rad, FRAC_PI_2);
        close(base.yaw_rate_radps, 0.5);
        close(base.tilt_rad(), 0.0);
        // Pitched forwards by 30°: gravity points forwards and down in the base frame.
        let half = 30.0_f64.to_radians() / 2.0;
        let base = BaseMotion::new(&[0.0, 0.0, 0.8, half.cos(), 0.0, half.sin(), 0.0], &[0.0; 6], 0.0);
        close(base.gravity.x, 0.5);
        close(base.gravity.z, -(0.75_f64.sqrt()));
        close(base.tilt_rad(), 30.0_f64.to_radians());
    }

    #[test]
    fn each_term_equals_its_value_by_hand() {
        let mut model = Model::from_mjcf(HUMANOID_XML).unwrap();
        model.hinges.truncate(2);
        (model.hinges[0].min_rad, model.hinges[0].max_rad) = (-1.0, 1.0);
        (model.hinges[1].min_rad, model.hinges[1].max_rad) = (f64::NEG_INFINITY, f64::INFINITY);
        let config = VelocityConfig {
            gait_period_s: 1.0,
            stance_share: 0.6,
            tracking_variance: 0.25,
            ..VelocityConfig::default()
        };
        let body =
            Stance { default_rad: vec![0.5, 0.0], pose_weights: vec![1.0, 0.1], height_m: 0.8, may_lift_higher: false };
        let command = Command { lin_vel_x_mps: 0.5, lin_vel_y_mps: 0.0, ang_vel_z_radps: 0.2 };
        let base = BaseMotion {
            height_m: 0.7,
            velocity_mps: Vector3::new(0.2, 0.4, 0.3),
            angular_radps: Vector3::new(1.0, 2.0, 3.0),
            yaw_rate_radps: 0.7,
            heading_rad: 1.0,
            gravity: Vector3::new(0.6, 0.0, -0.8),
        };
        // At 0.8 s the left foot is highest and the right one stands.
        let left = Foot { lift_m: 0.03, ..Foot::default() };
        let right = Foot {
            stands: true,
            velocity_mps: Vector3::new(0.3, 0.4, 9.0),
            landed_after_s: 0.5,
            landing_mps: 0.2,
            ..Foot::default()
        };
        let hinges = HingeMotion {
            angles_rad: &[0.95, 2.0],
            rates_radps: &[1.0, -1.0],
            rates_before_radps: &[0.0, 1.0],
            torques_nm: &[3.0, -4.0],
            actions: [&[1.0, -2.0], &[0.5, 0.0]],
        };
        let feet = [left, right];
        let step = RobotStep {
            config: &config,
            model: &model,
            body: &body,
            command,
            base,
            feet: &feet,
            hinges,
            time_s: 0.8,
            step_s: 0.02,
            has_fallen: false,
        };
        let expected = [
            ("track_linear_velocity", (-0.25_f64 / 0.25).exp()),
            ("track_yaw_rate", (-1.0_f64).exp()),
            ("alive", 1.0),
            ("upright", 0.36),
            ("base_height", 0.01),
            ("vertical_velocity", 0.09),
            ("roll_pitch_rate", 5.0),
            ("gait", 1.0),
            ("feet_air_time", 0.1),
            ("feet_clearance", 0.0025),
            ("feet_slip", 0.25),
            ("landing", 0.04),
            ("pose", 0.2025 + 0.4),
            ("action_rate", 0.25 + 4.0),
            ("joint_torque", 25.0),
            ("joint_acceleration", 2500.0 + 10_000.0),
            ("joint_limits", 0.05),
        ];
        for ((found, name), (expected_name, expected)) in
            step.values().into_iter().zip(RewardsConfig::NAMES).zip(expected)
        {
            assert_eq!(name, expected_name);
            assert!((found - expected).abs() < 1e-9, "{name}: {found} instead of {expected}");
        }
        assert_eq!(RobotStep { has_fallen: true, ..step }.alive(), 0.0);

        let climbing = Stance { may_lift_higher: true, ..body.clone() };
        for (lift_m, flat, of_ground) in [(0.03, 0.0025, 0.0025), (0.13, 0.0025, 0.0)] {
            let feet = [Foot { lift_m, ..left }, right];
            let step = RobotStep { feet: &feet, ..step };
            close(step.feet_clearance(), flat);
            close(RobotStep { body: &climbing, ..step }.feet_clearance(), of_ground);
        }

        let standing = RobotStep { command: Command::default(), ..step };
        assert_eq!((standing.gait(), standing.feet_air_time()), (1.0, 0.0), "at 0.45 m/s the gait goes on");
        close(standing.feet_clearance(), 0.0025);
        let slow = BaseMotion { velocity_mps: Vector3::new(0.1, 0.2, 0.3), ..base };
        let slow = RobotStep { base: slow, ..standing };
        assert_eq!((slow.gait(), slow.feet_clearance(), slow.feet_air_time()), (0.0, 0.0, 0.0), "both feet must stand");
    }
}
