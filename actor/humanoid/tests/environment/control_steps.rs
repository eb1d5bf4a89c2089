//! The duration of a control step: motion, speeds, pushes and contact forces follow it.

use treadmill_humanoid::{EnvConfig, Environment, EnvironmentConfig, HUMANOID_XML, ModelError, RandomisationConfig};

use crate::support::{environment, reset};

const GRAVITY_MPS2: f64 = 9.81;

/// Settings without start noise, end or control cost.
fn settings(control_step_s: f64) -> EnvironmentConfig {
    EnvironmentConfig::from(EnvConfig {
        control_step_s,
        reset_noise_scale: 0.0,
        terminate_when_unhealthy: false,
        ..EnvConfig::default()
    })
}

/// Environment in which the humanoid is high above the floor and at rest.
fn falling(control_step_s: f64) -> Environment {
    let mut environment = environment(&settings(control_step_s));
    reset(&mut environment, 1);
    let mut position = environment.physics().model().nominal_position();
    position[2] = 20.0;
    environment.physics_mut().set_state(&position, &[0.0; 23]);
    environment
}

#[test]
fn a_body_falls_by_half_of_g_t_squared() {
    for (control_step_s, steps_per_s) in [(0.001, 1000), (0.015, 67), (0.02, 50), (0.1, 10)] {
        let mut environment = falling(control_step_s);
        assert_eq!(environment.control_step_s(), control_step_s);
        let start_m = environment.physics().centre_of_mass().z;
        let mut observation = vec![0.0; environment.observation_size()];
        for _ in 0..steps_per_s {
            assert!(!environment.step(&[0.0; 17], &mut observation).fault);
        }
        let time_s = f64::from(steps_per_s) * control_step_s;
        let fallen_m = start_m - environment.physics().centre_of_mass().z;
        let wanted_m = 0.5 * GRAVITY_MPS2 * time_s * time_s;
        assert!((fallen_m - wanted_m).abs() < 1e-3 * wanted_m, "{control_step_s} s: {fallen_m} m, not {wanted_m} m");
        let rate_mps = -environment.physics().centre_of_mass_velocity().z;
        assert!((rate_mps - GRAVITY_MPS2 * time_s).abs() < 1e-3 * rate_mps, "{control_step_s} s: {rate_mps} m/s");
    }
}

#[test]
fn speeds_are_per_second() {
    for control_step_s in [0.005, 0.015, 0.02, 0.05] {
        let mut environment = falling(control_step_s);
        let position = environment.physics().position().to_vec();
        let mut velocity = [0.0; 23];
        velocity[..2].copy_from_slice(&[3.0, -2.0]);
        environment.physics_mut().set_state(&position, &velocity);
        let mut observation = vec![0.0; environment.observation_size()];
        environment.step(&[0.0; 17], &mut observation);
        let info = environment.info().unwrap();
        assert!((info.x_velocity_mps - 3.0).abs() < 4e-6, "{control_step_s} s: {info:?}");
        assert!((info.y_velocity_mps + 2.0).abs() < 4e-6, "{control_step_s} s: {info:?}");
        assert!((info.reward_forward - 3.75).abs() < 5e-6);
    }
}

#[test]
fn contact_forces_carry_the_weight_with_any_control_step() {
    for control_step_s in [0.01, 0.015, 0.03] {
        let mut environment = environment(&settings(control_step_s));
        let mut observation = reset(&mut environment, 1);
        let steps = |time_s: f64| (time_s / control_step_s).round() as u32;
        for _ in 0..steps(3.0) {
            environment.step(&[0.0; 17], &mut observation);
        }
        // The mean over a second of lying on the floor.
        let (mut force_n, links) = (0.0, environment.physics().model().links.len());
        for _ in 0..steps(1.0) {
            environment.step(&[0.0; 17], &mut observation);
            force_n += (0..links).map(|link| environment.physics().contact_wrench(link).0.z).sum::<f64>();
        }
        let mass_kg: f64 = environment.physics().model().bodies.iter().map(|body| body.mass_kg).sum();
        let ratio = force_n / f64::from(steps(1.0)) / (mass_kg * GRAVITY_MPS2);
        assert!((ratio - 1.0).abs() < 0.1, "{control_step_s} s: {ratio} of the weight");
    }
}

#[test]
fn pushes_come_at_the_same_time_with_any_control_step() {
    for (control_step_s, steps) in [(0.01, 30), (0.015, 20), (0.03, 10), (0.1, 3)] {
        let randomisation =
            RandomisationConfig { push_interval_s: [0.3, 0.3], push_mps: [0.8, 0.8], ..RandomisationConfig::default() };
        let mut environment = environment(&EnvironmentConfig { randomisation, ..settings(control_step_s) });
        let mut observation = reset(&mut environment, 1);
        let mut position = environment.physics().position().to_vec();
        position[2] = 20.0;
        environment.physics_mut().set_state(&position, &[0.0; 23]);
        let pushed = (0..40).find(|_| {
            environment.step(&[0.0; 17], &mut observation);
            let velocity = environment.physics().centre_of_mass_velocity();
            velocity.x.hypot(velocity.y) > 0.5
        });
        assert_eq!(pushed, Some(steps), "{control_step_s} s");
    }
}

#[test]
fn durations_out_of_range_are_refused() {
    for bad in [0.0, 0.0009, 0.101, -0.015, f64::NAN, f64::INFINITY] {
        let error = Environment::new(&settings(bad), HUMANOID_XML).err().expect("refused").to_string();
        assert!(error.contains("`env.control_step_s`") && error.contains("0.001 to 0.1"), "{error}");
    }
}

#[test]
fn a_keyframe_that_the_model_lacks_is_refused_by_name() {
    let config = EnvironmentConfig::from(EnvConfig { keyframe: "squat".into(), ..EnvConfig::default() });
    let error = Environment::new(&config, HUMANOID_XML).err().expect("refused");
    assert!(matches!(&error, ModelError::Keyframe { name, .. } if name == "squat"));
    assert_eq!(error.to_string(), "env.keyframe: the model has no keyframe `squat`; it has: none");
}
