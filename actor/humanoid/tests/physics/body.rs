//! Physics of the humanoid: mass, contacts, motors.

use treadmill_humanoid::{EnvConfig, HUMANOID_XML, Model};

use crate::{IDLE, STILL, WEIGHTLESS, humanoid_text, simulation, with_settings, with_substeps};

#[test]
fn the_mass_is_that_of_humanoid_v5() {
    let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    // MuJoCo's sum of body masses for Humanoid-v5.
    assert!((model.mass_kg() - 42.116_030_492).abs() < 1e-6, "{}", model.mass_kg());
    assert_eq!((model.bodies.len(), model.hinges.len(), model.motors.len()), (11, 17, 17));
    let shapes = model.bodies.iter().flat_map(|body| &body.shapes);
    assert!(shapes.map(|shape| shape.margin_m).chain([model.ground.margin_m]).all(|margin_m| margin_m == 0.001));
    let foot_and_shin = model.bodies.iter().find(|body| body.name == "right_shin").expect("has a right shin");
    assert_eq!(foot_and_shin.shapes.len(), 2);
}

#[test]
fn nothing_touches_at_the_start() {
    let mut physics = simulation(&humanoid_text(&[WEIGHTLESS]));
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

#[test]
fn every_motor_turns_its_hinge_as_in_mujoco() {
    // With the default steps the waist, a light body between heavy ones, lags behind.
    for (substeps, accepted) in [(EnvConfig::default().substeps, 0.5..1.15), (15, 0.87..1.1)] {
        let mut physics = with_substeps(&humanoid_text(&[WEIGHTLESS]), substeps);
        let motors = physics.model().motors.clone();
        let mut position = physics.model().nominal_position();
        position[2] = 3.0;
        position[7..].copy_from_slice(&POSTURE);
        let mut rates_after = |action: &[f32; 17]| {
            physics.set_state(&position, &STILL);
            physics.step_only(action).expect("finite");
            physics.joint_rates().to_vec()
        };
        let idle = rates_after(&IDLE);
        for (index, (motor, reference)) in motors.iter().zip(MUJOCO_RATE_CHANGE).enumerate() {
            let mut action = IDLE;
            action[index] = 0.2;
            let change = rates_after(&action)[motor.hinge] - idle[motor.hinge];
            let ratio = change / reference;
            assert!(accepted.contains(&ratio), "{substeps} steps, {}: {ratio} of MuJoCo's {reference}", motor.name);
        }
    }
}

#[test]
fn controls_beyond_the_limit_act_like_the_limit() {
    let mut physics = simulation(HUMANOID_XML);
    let position = physics.model().nominal_position();
    let mut state_after = |control: f32| {
        physics.set_state(&position, &STILL);
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
        let settings = EnvConfig { self_collision, ..EnvConfig::default() };
        let mut physics = with_settings(&humanoid_text(&[WEIGHTLESS]), &settings);
        physics.set_state(&position, &STILL);
        physics.step_only(&IDLE).expect("finite");
        physics.squared_contact_wrenches()
    };
    assert!(squared_force(true) > 0.0);
    assert_eq!(squared_force(false), 0.0);
}
