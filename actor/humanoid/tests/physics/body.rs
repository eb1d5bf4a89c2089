//! Physics of the humanoid: mass, fall, contacts, motors.

use nalgebra::Vector3;
use treadmill_humanoid::{EnvConfig, EnvironmentConfig, HUMANOID_XML, Model, Physics};

use crate::CONTROL_STEP_S;

const IDLE: [f32; 17] = [0.0; 17];

fn physics(xml: &str, config: &EnvironmentConfig) -> Physics {
    Physics::new(Model::from_mjcf(xml).expect("the model is valid"), config).expect("the settings are valid")
}

fn weightless_xml() -> String {
    let xml = HUMANOID_XML.replace("<option ", "<option gravity=\"0 0 0\" ");
    assert_ne!(xml, HUMANOID_XML);
    xml
}

#[test]
fn the_mass_is_that_of_humanoid_v5() {
    let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    // MuJoCo's sum of body masses for Humanoid-v5.
    assert!((model.mass_kg() - 42.116_030_492).abs() < 1e-6, "{}", model.mass_kg());
    assert_eq!(model.bodies.len(), 11);
    assert_eq!(model.hinges.len(), 17);
    assert_eq!(model.motors.len(), 17);
    let shapes = model.bodies.iter().flat_map(|body| &body.shapes);
    assert!(shapes.map(|shape| shape.margin_m).chain([model.ground.margin_m]).all(|margin_m| margin_m == 0.001));
    let foot_and_shin = model.bodies.iter().find(|body| body.name == "right_shin").expect("has a right shin");
    assert_eq!(foot_and_shin.shapes.len(), 2);
}

#[test]
fn left_is_the_mirror_image_of_right() {
    let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    for right in model.bodies.iter().filter(|body| body.name.starts_with("right_")) {
        let name = right.name.replace("right_", "left_");
        let left = model.bodies.iter().find(|body| body.name == name).expect("each right part has a left one");
        let mirrored = Vector3::new(1.0, -1.0, 1.0);
        let centre = left.centre_of_mass_m.coords.component_mul(&mirrored);
        assert!((left.mass_kg - right.mass_kg).abs() < 1e-12);
        assert!((centre - right.centre_of_mass_m.coords).norm() < 1e-12, "{name}");
        let place = left.pose.translation.vector.component_mul(&mirrored);
        assert!((place - right.pose.translation.vector).norm() < 1e-12, "{name}");
    }
}

#[test]
fn the_centre_of_mass_falls_freely_before_it_lands() {
    let mut physics = physics(HUMANOID_XML, &EnvironmentConfig::default());
    let mut position = physics.model().nominal_position();
    position[2] = 3.0;
    physics.set_state(&position, &[0.0; 23]);
    let start = physics.centre_of_mass();
    let steps = 20;
    for _ in 0..steps {
        physics.step_only(&IDLE).expect("finite");
    }
    let time_s = f64::from(steps) * CONTROL_STEP_S;
    let fallen = start - physics.centre_of_mass();
    let expected_m = 9.81 * time_s * time_s / 2.0;
    assert!((fallen.z - expected_m).abs() < 0.005, "fell {} m instead of {expected_m} m", fallen.z);
    assert!(fallen.x.abs() < 1e-3 && fallen.y.abs() < 1e-3);
    assert!((physics.centre_of_mass_velocity().z + 9.81 * time_s).abs() < 1e-2);
}

#[test]
fn a_passive_body_falls_and_the_floor_carries_its_weight() {
    let mut physics = physics(HUMANOID_XML, &EnvironmentConfig::default());
    for _ in 0..400 {
        physics.step_only(&IDLE).expect("finite");
    }
    assert!(physics.torso_height_m() < 0.6, "torso still at {} m", physics.torso_height_m());
    assert!(physics.torso_height_m() > 0.0, "torso sank through the floor");
    let weight_n = physics.model().mass_kg() * 9.81;
    let samples = 200;
    let mut mean = Vector3::zeros();
    for _ in 0..samples {
        physics.step_only(&IDLE).expect("finite");
        for link in 0..physics.model().links.len() {
            mean += physics.contact_wrench(link).0 / f64::from(samples);
        }
    }
    assert!((mean.z / weight_n - 1.0).abs() < 0.02, "the floor carries {} N of {weight_n} N", mean.z);
    assert!(physics.squared_contact_wrenches() > 0.0);
}

#[test]
fn contact_forces_explain_the_change_of_vertical_momentum() {
    let mut physics = physics(HUMANOID_XML, &EnvironmentConfig::default());
    let mass_kg = physics.model().mass_kg();
    let mut touched = 0;
    for _ in 0..60 {
        let before = physics.centre_of_mass_velocity().z;
        physics.step_only(&IDLE).expect("finite");
        let change = (physics.centre_of_mass_velocity().z - before) / CONTROL_STEP_S;
        let expected_n = mass_kg * (change + 9.81);
        let found_n: f64 = (0..physics.model().links.len()).map(|link| physics.contact_wrench(link).0.z).sum();
        assert!((found_n - expected_n).abs() < 2.0 + 0.03 * expected_n.abs(), "{found_n} N instead of {expected_n} N");
        touched += u32::from(found_n > 1.0);
    }
    assert!(touched > 5, "it never landed");
}

#[test]
fn nothing_touches_at_the_start() {
    let mut physics = physics(&weightless_xml(), &EnvironmentConfig::default());
    physics.step_only(&IDLE).expect("finite");
    assert_eq!(physics.squared_contact_wrenches(), 0.0);
}

/// A posture away from all limits, and the rate (rad/s) that each motor at control 0.2 adds to its hinge in one control
/// step: measured with MuJoCo 3 on Humanoid-v5 without gravity and contacts.
const POSTURE: [f64; 17] =
    [0.1, -0.2, 0.1, -0.1, -0.2, -0.5, -0.6, -0.1, -0.2, -0.5, -0.6, 0.1, -0.2, -0.3, 0.1, -0.2, -0.3];
const MUJOCO_RATE_CHANGE: [f64; 17] = [
    1.648, 1.873, 1.298, 1.164, 3.224, 4.378, 5.921, 1.168, 3.227, 4.476, 5.918, 0.541, 0.869, 1.572, 0.831, 0.881,
    1.574,
];

/// Rate that each motor at control 0.2 adds to its hinge in one control step (rad/s).
fn rate_changes(config: &EnvironmentConfig) -> Vec<f64> {
    let mut physics = physics(&weightless_xml(), config);
    let mut position = physics.model().nominal_position();
    position[2] = 3.0;
    position[7..].copy_from_slice(&POSTURE);
    let mut rates_after = |action: &[f32; 17]| {
        physics.set_state(&position, &[0.0; 23]);
        physics.step_only(action).expect("finite");
        physics.joint_rates().to_vec()
    };
    let idle = rates_after(&IDLE);
    let driven: Vec<Vec<f64>> = (0..17)
        .map(|motor| {
            let mut action = IDLE;
            action[motor] = 0.2;
            rates_after(&action)
        })
        .collect();
    let motors = &physics.model().motors;
    driven.iter().zip(motors).map(|(rates, motor)| rates[motor.hinge] - idle[motor.hinge]).collect()
}

#[test]
fn every_motor_turns_its_hinge_in_the_right_direction() {
    let changes = rate_changes(&EnvironmentConfig::default());
    for (motor, (change, reference)) in changes.iter().zip(MUJOCO_RATE_CHANGE).enumerate() {
        let ratio = change / reference;
        // With two coarse steps the waist, a light body between heavy ones, lags behind.
        assert!((0.5..1.15).contains(&ratio), "motor {motor}: {change} rad/s, {ratio} of MuJoCo's");
    }
}

#[test]
fn with_fine_steps_the_dynamics_match_mujoco() {
    let config = EnvironmentConfig::from(EnvConfig { substeps: 15, ..EnvConfig::default() });
    for (motor, (change, reference)) in rate_changes(&config).iter().zip(MUJOCO_RATE_CHANGE).enumerate() {
        let ratio = change / reference;
        assert!((0.87..1.1).contains(&ratio), "motor {motor}: {change} rad/s, {ratio} of MuJoCo's");
    }
}

#[test]
fn motors_do_not_accelerate_the_centre_of_mass() {
    let mut physics = physics(&weightless_xml(), &EnvironmentConfig::default());
    let mut position = physics.model().nominal_position();
    position[2] = 5.0;
    physics.set_state(&position, &[0.0; 23]);
    let action: [f32; 17] = std::array::from_fn(|motor| if motor % 2 == 0 { 0.4 } else { -0.4 });
    for _ in 0..5 {
        physics.step_only(&action).expect("finite");
    }
    assert!(physics.joint_rates().iter().any(|rate| rate.abs() > 1.0));
    let drift_mps = physics.centre_of_mass_velocity().norm();
    assert!(drift_mps < 0.01, "motors moved the centre of mass at {drift_mps} m/s");
}

#[test]
fn controls_beyond_the_limit_act_like_the_limit() {
    let mut physics = physics(HUMANOID_XML, &EnvironmentConfig::default());
    let position = physics.model().nominal_position();
    let mut state_after = |control: f32| {
        physics.set_state(&position, &[0.0; 23]);
        physics.step_only(&[control; 17]).expect("finite");
        physics.velocity().to_vec()
    };
    assert_eq!(state_after(5.0), state_after(0.4));
    assert_ne!(state_after(0.4), state_after(0.3));
}

#[test]
fn self_collision_can_be_switched_off() {
    // Right thigh turned inwards through the left one.
    let mut position = Model::from_mjcf(HUMANOID_XML).expect("valid").nominal_position();
    position[2] = 5.0;
    position[10] = 0.5;
    let squared_force = |self_collision| {
        let config = EnvironmentConfig::from(EnvConfig { self_collision, ..EnvConfig::default() });
        let mut physics = physics(&weightless_xml(), &config);
        physics.set_state(&position, &[0.0; 23]);
        physics.step_only(&IDLE).expect("finite");
        physics.squared_contact_wrenches()
    };
    assert!(squared_force(true) > 0.0);
    assert_eq!(squared_force(false), 0.0);
}
