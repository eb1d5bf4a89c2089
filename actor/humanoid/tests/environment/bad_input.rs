//! Invalid actions and states are refused by name and change nothing.

use treadmill_humanoid::{EnvironmentConfig, HUMANOID_XML, InputError, StateError};

use crate::support::{environment, physics, reset};

#[test]
fn an_action_that_is_not_finite_is_refused_and_the_episode_continues() {
    let [mut tried, mut plain] = [(); 2].map(|()| environment(&EnvironmentConfig::default()));
    let (mut seen, mut wanted) = (reset(&mut tried, 1), reset(&mut plain, 1));
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut action = [0.1; 17];
        action[11] = bad;
        let refusal = tried.try_step(&action, &mut seen).expect_err("not finite");
        assert!(matches!(refusal, InputError::NotFinite { what: "action", index: 11, value } if !value.is_finite()));
        assert_eq!(refusal.to_string(), format!("action[11] is {bad}, but every entry must be a finite number"));
        assert_eq!(seen, wanted, "a refused action must change nothing");
    }
    let step = tried.try_step(&[0.1; 17], &mut seen).expect("finite");
    assert!(!step.fault);
    plain.step(&[0.1; 17], &mut wanted);
    assert_eq!(seen, wanted);
}

#[test]
fn wrong_lengths_are_refused_with_the_expected_length() {
    let mut environment = environment(&EnvironmentConfig::default());
    let size = environment.observation_size();
    let mut seen = vec![0.0; size];
    let action = environment.try_step(&[0.0; 18], &mut seen).expect_err("one too many");
    assert_eq!(action, InputError::Length { what: "action", found: 18, expected: 17 });
    assert_eq!(action.to_string(), "action has the wrong length: 18 instead of 17");
    let buffer = InputError::Length { what: "observation buffer", found: 44, expected: size };
    assert_eq!(environment.try_step(&[0.0; 17], &mut seen[1..]).err(), Some(buffer));
    assert_eq!(environment.observe(&mut seen[1..]).err(), Some(buffer));
    assert_eq!(buffer.to_string(), "observation buffer has the wrong length: 44 instead of 45");
    assert!(seen.iter().all(|number| *number == 0.0), "a refusal writes nothing");
}

#[test]
fn impossible_states_are_refused_by_name_and_change_nothing() {
    let mut physics = physics(HUMANOID_XML);
    let nominal = physics.model().nominal_position();
    physics.step_only(&[0.1; 17]).expect("finite");
    let before = [physics.position(), physics.velocity()].concat();
    let still = [0.0; 23];
    let spoilt = |index: usize, value: f64| {
        let mut position = nominal.clone();
        position[index] = value;
        position
    };
    let mut fast = still;
    fast[9] = f64::NEG_INFINITY;
    let cases: [(&[f64], &[f64], &str); 8] = [
        (&nominal[1..], &still, "position vector has the wrong length: 23 instead of 24"),
        (&nominal, &still[..22], "velocity vector has the wrong length: 22 instead of 23"),
        (&spoilt(2, f64::NAN), &still, "position[2], the root z, is NaN, but must be a finite number"),
        (&spoilt(13, f64::INFINITY), &still, "position[13], the angle of hinge `right_knee`, is inf"),
        (&nominal, &fast, "velocity[9], the rate of hinge `right_hip_x`, is -inf"),
        (&spoilt(3, 0.0), &still, "the root quaternion position[3..7] is [0.0, 0.0, 0.0, 0.0], which is not"),
        (&spoilt(3, 1e300), &still, "which is not a rotation: give w, x, y, z of length 1"),
        (
            &spoilt(8, 0.7),
            &still,
            "position[8], the angle of hinge `abdomen_y`, is 0.7 rad, but must lie between -1.30",
        ),
    ];
    for (position, velocity, wanted) in cases {
        let refusal = physics.try_set_state(position, velocity).expect_err(wanted);
        assert!(refusal.to_string().contains(wanted), "{refusal}");
        assert_eq!(before, [physics.position(), physics.velocity()].concat(), "{wanted}");
    }
    let angle = physics.try_set_state(&spoilt(8, 0.7), &still).expect_err("out of range");
    assert!(matches!(angle, StateError::Hinge { index: 8, value_rad: 0.7, .. }), "{angle:?}");
}

#[test]
fn states_within_the_tolerance_are_set_as_by_set_state() {
    let (mut tried, mut plain) = (physics(HUMANOID_XML), physics(HUMANOID_XML));
    // In the nominal pose the straight knees are outside their range.
    let mut position = tried.model().nominal_position();
    assert!(tried.limit_overshoot_rad() > 0.03);
    tried.try_set_state(&position, &[0.0; 23]).expect("the nominal pose");
    let hinges = tried.model().hinges.clone();
    for (angle, hinge) in position[7..].iter_mut().zip(&hinges) {
        *angle = hinge.max_rad + 0.099;
    }
    // A quaternion that is not a unit one.
    position[3..7].copy_from_slice(&[0.0, 3.0, 0.0, 4.0]);
    tried.try_set_state(&position, &[0.5; 23]).expect("just within the tolerance");
    plain.set_state(&position, &[0.5; 23]);
    assert_eq!(tried.position()[3..7], [0.0, 0.6, 0.0, 0.8]);
    assert_eq!((tried.position(), tried.velocity()), (plain.position(), plain.velocity()));
    position[7] = hinges[0].max_rad + 0.101;
    assert!(tried.try_set_state(&position, &[0.5; 23]).is_err());
    // `set_state` itself checks no range.
    plain.set_state(&position, &[0.5; 23]);
    assert_eq!(plain.position()[7], position[7]);
}
