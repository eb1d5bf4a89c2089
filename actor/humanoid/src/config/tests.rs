//! Tests of the settings' checks.

use super::*;

#[test]
fn check_accepts_the_defaults_and_names_each_bad_setting() {
    assert!(EnvironmentConfig::default().check().is_ok());
    type Spoil = fn(&mut EnvironmentConfig);
    let broken: [(&str, Spoil); 14] = [
        ("substeps", |c| c.substeps = 0),
        ("control_step_s", |c| c.control_step_s = 0.000_9),
        ("control_step_s", |c| c.control_step_s = 0.11),
        ("control_step_s", |c| c.control_step_s = f64::NAN),
        ("push_interval_s", |c| (c.control_step_s, c.randomisation.push_interval_s) = (0.05, [0.04, 1.0])),
        ("healthy_reward", |c| c.healthy_reward = f64::NAN),
        ("healthy_z_range", |c| c.healthy_z_range = [2.0, 2.0]),
        ("healthy_z_range", |c| c.healthy_z_range = [f64::NAN, 2.0]),
        ("contact_cost_range", |c| c.contact_cost_range = [1.0, 0.5]),
        ("contact_cost_range", |c| c.contact_cost_range = [0.0, f64::NAN]),
        ("contact_cost_range", |c| c.contact_cost_range = [f64::NEG_INFINITY; 2]),
        ("contact_cost_range", |c| c.contact_cost_range = [f64::INFINITY; 2]),
        ("reset_noise_scale", |c| c.reset_noise_scale = -0.01),
        ("include_cvel_in_observation", |c| {
            c.observation = ObservationKind::GymnasiumV4;
            c.include_cvel_in_observation = false;
        }),
    ];
    for (name, spoil) in broken {
        let mut config = EnvironmentConfig::default();
        spoil(&mut config);
        let error = config.check().expect_err(name).to_string();
        assert!(error.contains(name), "{error}");
    }
}

#[test]
fn control_steps_reach_from_1_to_100_ms() {
    for control_step_s in [0.001, 0.02, 0.1] {
        assert!(EnvironmentConfig { control_step_s, ..EnvironmentConfig::default() }.check().is_ok());
    }
    let error =
        EnvironmentConfig { control_step_s: 0.2, ..EnvironmentConfig::default() }.check().expect_err("too long");
    let wanted = "environment setting `control_step_s` is 0.2, but must be between 0.001 and 0.1 s";
    assert_eq!(error.to_string(), wanted);
}

#[test]
fn ranges_may_be_infinite() {
    let open = [f64::NEG_INFINITY, f64::INFINITY];
    let config = EnvironmentConfig { contact_cost_range: open, healthy_z_range: open, ..EnvironmentConfig::default() };
    assert!(config.check().is_ok());
}

#[test]
fn randomisation_is_off_by_default_and_each_setting_switches_it_on() {
    assert!(!Randomisation::default().is_on());
    assert!(Randomisation::default().check(0.015).is_ok());
    assert!(!Randomisation { push_interval_s: [1.0, 1.0], ..Randomisation::default() }.is_on());
    type Change = fn(&mut Randomisation);
    let changes: [Change; 11] = [
        |r| r.mass_scale = [0.9, 1.1],
        |r| r.floor_friction_scale = [0.0, 1.0],
        |r| r.motor_scale = [1.0, 1.2],
        |r| r.damping_scale = [2.0, 2.0],
        |r| r.armature_scale = [0.5, 1.0],
        |r| r.gravity_scale = [0.9, 1.0],
        |r| r.sensor_noise_position = 0.01,
        |r| r.sensor_noise_velocity = 0.01,
        |r| r.control_noise = 0.1,
        |r| r.action_delay_steps = [0, 3],
        |r| r.push_mps = [0.0, 0.5],
    ];
    for (index, change) in changes.into_iter().enumerate() {
        let mut settings = Randomisation::default();
        change(&mut settings);
        assert!(settings.is_on() && settings.check(0.015).is_ok(), "change {index}");
    }
}

#[test]
fn bad_randomisation_ranges_are_rejected_by_name() {
    type Spoil = fn(&mut Randomisation);
    let broken: [(&str, Spoil); 9] = [
        ("mass_scale", |r| r.mass_scale = [0.0, 1.0]),
        ("floor_friction_scale", |r| r.floor_friction_scale = [1.5, 0.5]),
        ("motor_scale", |r| r.motor_scale = [1.0, f64::NAN]),
        ("gravity_scale", |r| r.gravity_scale = [f64::NEG_INFINITY, 1.0]),
        ("sensor_noise_velocity", |r| r.sensor_noise_velocity = -0.1),
        ("control_noise", |r| r.control_noise = f64::NAN),
        ("action_delay_steps", |r| r.action_delay_steps = [0, Randomisation::DELAY_MAX_STEPS + 1]),
        ("push_interval_s", |r| r.push_interval_s = [0.0, 1.0]),
        ("push_mps", |r| r.push_mps = [0.0, 11.0]),
    ];
    for (name, spoil) in broken {
        let mut settings = Randomisation::default();
        spoil(&mut settings);
        let error = settings.check(0.015).expect_err(name).to_string();
        assert!(error.contains(name), "{error}");
    }
}
