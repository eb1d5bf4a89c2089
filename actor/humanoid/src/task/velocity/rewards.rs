//! Terms of the reward, each a pure function.

use nalgebra::{UnitQuaternion, Vector3};

use super::command::Command;
use super::feet::{FEET, Foot, stride};
use crate::config::{VelocityConfig, VelocityRewards};
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
}

/// Returns the reward's terms after a control step.
#[must_use]
pub fn terms(config: &VelocityConfig, model: &Model, body: &Stance, step: &RobotStep<'_>) -> VelocityRewards {
    let RobotStep { command, base, feet, hinges, time_s, step_s } = *step;
    let tracking = |error: f64| (-error / config.tracking_variance).exp();
    let linear_error =
        (base.velocity_mps.x - command.lin_vel_x_mps).powi(2) + (base.velocity_mps.y - command.lin_vel_y_mps).powi(2);
    let yaw_error = (base.yaw_rate_radps - command.ang_vel_z_radps).powi(2);
    let squares = |numbers: &[f64]| numbers.iter().map(|number| number * number).sum::<f64>();
    let squared_difference = |pair: (&f64, &f64)| (pair.0 - pair.1).powi(2);
    let strides: [_; FEET] = std::array::from_fn(|foot| stride(config, time_s, foot, feet[foot].rise_m));
    // A robot that is to stop steps until it is slow: feet that stop at once make it fall.
    let is_to_stand = command.stands() && base.velocity_mps.xy().norm() < SLOW_MPS;
    let must_stand = |foot: usize| is_to_stand || strides[foot].stands;
    let pairs = || (0..FEET).map(|foot| (foot, &feet[foot]));
    let posture = hinges.angles_rad.iter().zip(&body.default_rad).zip(&body.pose_weights);
    let limits = model.hinges.iter().zip(hinges.angles_rad).map(|(hinge, angle_rad)| {
        let (centre_rad, half_rad) = (hinge.centre_rad(), SOFT_LIMIT_SHARE * (hinge.max_rad - hinge.min_rad) / 2.0);
        ((angle_rad - centre_rad).abs() - half_rad).max(0.0)
    });
    VelocityRewards {
        track_linear_velocity: tracking(linear_error),
        track_yaw_rate: tracking(yaw_error),
        alive: 1.0,
        upright: base.gravity.x.powi(2) + base.gravity.y.powi(2),
        base_height: (base.height_m - body.height_m).powi(2),
        vertical_velocity: base.velocity_mps.z.powi(2),
        roll_pitch_rate: base.angular_radps.x.powi(2) + base.angular_radps.y.powi(2),
        gait: pairs().map(|(foot, sensed)| if sensed.stands == must_stand(foot) { 1.0 } else { -1.0 }).sum::<f64>()
            / FEET as f64,
        feet_air_time: pairs()
            .filter(|(_, foot)| foot.landed_after_s > 0.0 && !command.stands())
            .map(|(_, foot)| foot.landed_after_s - AIR_TIME_S)
            .sum(),
        feet_clearance: pairs()
            .filter(|(foot, _)| !must_stand(*foot))
            .map(|(index, foot)| foot.lift_m - strides[index].lift_m)
            .filter(|above_m| *above_m < 0.0 || !body.may_lift_higher)
            .map(|above_m| above_m.powi(2))
            .sum(),
        feet_slip: pairs().filter(|(_, foot)| foot.stands).map(|(_, foot)| foot.velocity_mps.xy().norm_squared()).sum(),
        landing: pairs().map(|(_, foot)| foot.landing_mps.powi(2)).fold(0.0, f64::max),
        pose: posture.map(|((angle_rad, default_rad), weight)| weight * (angle_rad - default_rad).powi(2)).sum(),
        action_rate: hinges.actions[0].iter().zip(hinges.actions[1]).map(squared_difference).sum(),
        joint_torque: squares(hinges.torques_nm),
        joint_acceleration: hinges
            .rates_radps
            .iter()
            .zip(hinges.rates_before_radps)
            .map(|(now, before)| ((now - before) / step_s).powi(2))
            .sum(),
        joint_limits: limits.sum(),
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
        let step = RobotStep { command, base, feet: &feet, hinges, time_s: 0.8, step_s: 0.02 };
        let found = terms(&config, &model, &body, &step);
        for (name, found, expected) in [
            ("track_linear_velocity", found.track_linear_velocity, (-0.25_f64 / 0.25).exp()),
            ("track_yaw_rate", found.track_yaw_rate, (-1.0_f64).exp()),
            ("alive", found.alive, 1.0),
            ("upright", found.upright, 0.36),
            ("base_height", found.base_height, 0.01),
            ("vertical_velocity", found.vertical_velocity, 0.09),
            ("roll_pitch_rate", found.roll_pitch_rate, 5.0),
            ("gait", found.gait, 1.0),
            ("feet_air_time", found.feet_air_time, 0.1),
            ("feet_clearance", found.feet_clearance, 0.0025),
            ("feet_slip", found.feet_slip, 0.25),
            ("landing", found.landing, 0.04),
            ("pose", found.pose, 0.2025 + 0.4),
            ("action_rate", found.action_rate, 0.25 + 4.0),
            ("joint_torque", found.joint_torque, 25.0),
            ("joint_acceleration", found.joint_acceleration, 2500.0 + 10_000.0),
            ("joint_limits", found.joint_limits, 0.05),
        ] {
            assert!((found - expected).abs() < 1e-9, "{name}: {found} instead of {expected}");
        }
        let weights = VelocityRewards::default();
        let by_hand: f64 =
            weights.entries().iter().zip(found.entries()).map(|((_, weight), (_, term))| weight * term).sum();
        close(weights.total(&found), by_hand);

        let climbing = Stance { may_lift_higher: true, ..body.clone() };
        for (lift_m, flat, of_ground) in [(0.03, 0.0025, 0.0025), (0.13, 0.0025, 0.0)] {
            let feet = [Foot { lift_m, ..left }, right];
            let step = RobotStep { feet: &feet, ..step };
            close(terms(&config, &model, &body, &step).feet_clearance, flat);
            close(terms(&config, &model, &climbing, &step).feet_clearance, of_ground);
        }

        let standing = RobotStep { command: Command::default(), ..step };
        let found = terms(&config, &model, &body, &standing);
        assert_eq!((found.gait, found.feet_air_time), (1.0, 0.0), "at 0.45 m/s the gait goes on");
        close(found.feet_clearance, 0.0025);
        let slow = BaseMotion { velocity_mps: Vector3::new(0.1, 0.2, 0.3), ..base };
        let found = terms(&config, &model, &body, &RobotStep { base: slow, ..standing });
        assert_eq!((found.gait, found.feet_clearance, found.feet_air_time), (0.0, 0.0, 0.0), "both feet must stand");
    }
}
