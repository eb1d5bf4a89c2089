//! Terms of the reward by hand.

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
        yaw_tracking_variance: 0.5,
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
        rests: false,
        base,
        feet: &feet,
        hinges,
        time_s: 0.8,
        step_s: 0.02,
        has_fallen: false,
    };
    let expected = [
        ("track_linear_velocity", (-0.25_f64 / 0.25).exp()),
        ("track_yaw_rate", (-0.5_f64).exp()),
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
        ("stand_still", 0.0),
        ("action_rate", 0.25 + 4.0),
        ("joint_torque", 25.0),
        ("joint_acceleration", 2500.0 + 10_000.0),
        ("joint_limits", 0.05),
    ];
    for ((found, name), (expected_name, expected)) in step.values().into_iter().zip(RewardsConfig::NAMES).zip(expected)
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
    let config = VelocityConfig { gait_rests: true, ..config.clone() };
    let awake = RobotStep { config: &config, ..standing };
    assert_eq!((awake.gait(), awake.stand_still()), (1.0, 2.0), "a gait that goes on is rewarded as ever");
    let resting = RobotStep { rests: true, ..awake };
    let velocity_mps = Vector3::new(0.1, 0.1, 0.3);
    let slow = BaseMotion { velocity_mps, gravity: Vector3::new(0.06, 0.0, -0.998), ..base };
    for rests in [resting, RobotStep { base: slow, ..standing }] {
        let terms = (rests.gait(), rests.feet_clearance(), rests.feet_air_time());
        assert_eq!(terms, (0.0, 0.0, 0.0), "both feet must stand");
    }
    let leaning = RobotStep { base: BaseMotion { velocity_mps, ..base }, ..standing };
    assert_eq!((leaning.gait(), leaning.stand_still(), resting.stand_still()), (1.0, 0.0, 2.0));
}
