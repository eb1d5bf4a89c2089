//! Randomised bodies and pushes.

use nalgebra::Vector3;
use treadmill_humanoid::{HUMANOID_XML, Physics, Variation};

use crate::{CONTROL_STEP_S, IDLE, STILL, WEIGHTLESS, advance, humanoid_text, lift_n, simulation};

fn weightless() -> Physics {
    simulation(&humanoid_text(&[WEIGHTLESS]))
}

/// Position far above the floor, with all hinges in the middle of their ranges.
fn in_the_air(physics: &Physics) -> Vec<f64> {
    let mut position = physics.model().nominal_position();
    position[2] = 3.0;
    for (angle, hinge) in position[7..].iter_mut().zip(&physics.model().hinges) {
        *angle = hinge.centre_rad();
    }
    position
}

/// Sets a variation that differs from none by a change.
pub fn varied(physics: &mut Physics, change: impl FnOnce(&mut Variation)) {
    let mut variation = Variation::none(physics.model());
    change(&mut variation);
    physics.set_variation(&variation);
}

/// Position and velocity after 40 driven steps from the nominal pose.
fn outcome(physics: &mut Physics) -> Vec<f64> {
    let position = physics.model().nominal_position();
    physics.set_state(&position, &STILL);
    for step in 0..40 {
        let action: [f32; 17] = std::array::from_fn(|motor| ((step * motor) as f32).sin() * 0.4);
        physics.step_only(&action).expect("finite");
    }
    [physics.position(), physics.velocity()].concat()
}

#[test]
fn resetting_the_variation_restores_the_model_bit_for_bit() {
    let plain = outcome(&mut simulation(HUMANOID_XML));
    let mut body = simulation(HUMANOID_XML);
    varied(&mut body, |_| {});
    assert_eq!(plain, outcome(&mut body));
    for _ in 0..2 {
        varied(&mut body, |variation| {
            variation.mass_scale.fill(1.3);
            variation.damping_scale.fill(0.5);
            variation.armature_scale.fill(2.0);
            variation.motor_scale.fill(0.7);
            variation.floor_friction_scale = 0.4;
            variation.gravity_scale = 0.9;
        });
    }
    let other = outcome(&mut body);
    assert_ne!(plain, other);
    assert_eq!(other, outcome(&mut body), "a variation stays until the next");
    varied(&mut body, |_| {});
    assert_eq!(plain, outcome(&mut body));
}

#[test]
fn the_floor_carries_the_varied_mass() {
    let mut body = simulation(HUMANOID_XML);
    let nominal_kg: Vec<f64> = body.model().bodies.iter().map(|body| body.mass_kg).collect();
    let scale = |index: usize| 0.6 + 0.1 * index as f64;
    varied(&mut body, |variation| {
        variation.mass_scale.iter_mut().enumerate().for_each(|(index, factor)| *factor = scale(index));
    });
    let position = body.model().nominal_position();
    body.set_state(&position, &STILL);
    let expected_kg: f64 = nominal_kg.iter().enumerate().map(|(index, mass_kg)| mass_kg * scale(index)).sum();
    assert!((body.model().mass_kg() - expected_kg).abs() < 1e-9);
    assert!((expected_kg / nominal_kg.iter().sum::<f64>() - 1.0).abs() > 0.03, "the total mass must differ");
    for (index, part) in body.model().bodies.iter().enumerate() {
        let links = || body.model().links.iter().filter(|link| link.body == index);
        let mass_kg: f64 = links().map(|link| link.mass_kg).sum();
        assert!((mass_kg - part.mass_kg).abs() < 1e-9, "the links of {} must vary with it", part.name);
    }
    advance(&mut body, 400, &IDLE);
    assert!((0.0..0.6).contains(&body.torso_height_m()), "the torso is at {} m", body.torso_height_m());
    let samples = 200;
    let mut force_n = 0.0;
    for _ in 0..samples {
        advance(&mut body, 1, &IDLE);
        force_n += lift_n(&body) / f64::from(samples);
    }
    let weight_n = 9.81 * expected_kg;
    assert!((force_n / weight_n - 1.0).abs() < 0.02, "the floor carries {force_n} N of {weight_n} N");
}

#[test]
fn the_centre_of_mass_moves_with_that_of_the_root() {
    let mut body = simulation(HUMANOID_XML);
    let position = body.model().nominal_position();
    let (share, offset_m) = (body.model().bodies[0].mass_kg / body.model().mass_kg(), Vector3::new(0.05, -0.02, 0.03));
    body.set_state(&position, &STILL);
    let before = body.centre_of_mass();
    varied(&mut body, |variation| variation.root_centre_offset_m = offset_m);
    body.set_state(&position, &STILL);
    // The root is not turned.
    let moved = body.centre_of_mass() - before;
    assert!((moved - offset_m * share).norm() < 1e-7 && share > 0.1, "{moved} of {share}");
}

#[test]
fn servos_push_by_their_varied_stiffness_and_damping() {
    let xml = include_str!("../../assets/g1-like-servos.xml");
    let mut body = simulation(xml);
    let hinges = body.model().hinges.len();
    let (mut position, mut velocity) = (body.model().nominal_position(), vec![0.0; 6 + hinges]);
    position[2] = 3.0;
    let control = vec![0.02; body.model().motors.len()];
    let mut torques = |kp_scale: f64, kd_scale: f64, rate_radps: f64| {
        varied(&mut body, |variation| {
            variation.kp_scale.fill(kp_scale);
            variation.kd_scale.fill(kd_scale);
        });
        velocity[6..].fill(rate_radps);
        body.set_state(&position, &velocity);
        body.set_controls(&control).expect("finite");
        body.joint_torques_nm().to_vec()
    };
    let (plain, stiff) = (torques(1.0, 1.0, 0.0), torques(1.5, 1.0, 0.0));
    assert!(plain.iter().zip(&stiff).all(|(one, other)| (other - 1.5 * one).abs() < 1e-9), "{plain:?}, {stiff:?}");
    let (moving, damped) = (torques(1.0, 1.0, 0.01), torques(1.0, 3.0, 0.01));
    let tripled = |hinge: usize| plain[hinge] + 3.0 * (moving[hinge] - plain[hinge]);
    assert!((0..hinges).all(|hinge| (damped[hinge] - tripled(hinge)).abs() < 1e-9), "{moving:?}, {damped:?}");
    assert!(plain.iter().any(|torque_nm| *torque_nm > 0.1) && moving[0] != plain[0]);
}

#[test]
fn a_heavier_body_is_harder_to_turn() {
    // The same torque on twice the mass, inertia and armature gives half the acceleration.
    let mut body = weightless();
    let position = in_the_air(&body);
    let mut action = IDLE;
    action[10] = 0.01;
    let mut rate = |scale: f64| {
        varied(&mut body, |variation| {
            variation.mass_scale.fill(scale);
            variation.armature_scale.fill(scale);
            variation.damping_scale.fill(0.0);
        });
        // Subtract the effect of springs, which do not scale.
        let mut after = |action: &[f32]| {
            body.set_state(&position, &STILL);
            body.step_only(action).expect("finite");
            body.joint_rates()[10]
        };
        after(&action) - after(&IDLE)
    };
    let ratio = rate(2.0) / rate(1.0);
    assert!((ratio - 0.5).abs() < 0.01, "{ratio}");
}

#[test]
fn twice_the_motor_strength_equals_twice_the_control() {
    let mut body = weightless();
    let position = in_the_air(&body);
    let mut velocity = |scale: f64, control: f32| {
        varied(&mut body, |variation| variation.motor_scale[6] = scale);
        body.set_state(&position, &STILL);
        let mut action = [0.05; 17];
        action[6] = control;
        body.step_only(&action).expect("finite");
        body.velocity().to_vec()
    };
    assert_eq!(velocity(2.0, 0.1), velocity(1.0, 0.2));
    assert_ne!(velocity(1.0, 0.1), velocity(1.0, 0.2));
    let [weak, nominal, strong] = [0.5, 1.0, 2.0].map(|scale| velocity(scale, 0.1)[6 + 6]);
    // The effect of a knee motor of 200 N·m is proportional to its strength.
    assert!(((strong - nominal) / (nominal - weak) - 2.0).abs() < 0.05, "{weak}, {nominal}, {strong}");
}

#[test]
fn damping_slows_a_swinging_hinge() {
    let mut body = weightless();
    let position = in_the_air(&body);
    let knee = body.model().hinges.iter().position(|hinge| hinge.name == "right_knee").expect("has a knee");
    let mut velocity = STILL;
    velocity[6 + knee] = 3.0;
    let mut rate_after = |scale: f64| {
        varied(&mut body, |variation| variation.damping_scale[knee] = scale);
        body.set_state(&position, &velocity);
        advance(&mut body, 10, &IDLE);
        body.joint_rates()[knee]
    };
    let [free, nominal, damped] = [0.0, 1.0, 4.0].map(&mut rate_after);
    assert!(free > nominal + 0.2 && nominal > damped + 0.2, "{free}, {nominal}, {damped}");
    assert!(damped > 0.0);
}

#[test]
fn gravity_scales_free_fall() {
    let mut body = simulation(HUMANOID_XML);
    let position = in_the_air(&body);
    varied(&mut body, |variation| variation.gravity_scale = 0.5);
    body.set_state(&position, &STILL);
    advance(&mut body, 10, &IDLE);
    let expected = -0.5 * 9.81 * 10.0 * CONTROL_STEP_S;
    assert!((body.centre_of_mass_velocity().z - expected).abs() < 1e-2);
}

#[test]
fn a_push_changes_only_the_velocity_of_the_whole_body() {
    let mut body = simulation(HUMANOID_XML);
    advance(&mut body, 7, &[0.2; 17]);
    let (position, velocity) = (body.position().to_vec(), body.velocity().to_vec());
    let centre = body.centre_of_mass_velocity();
    let push = Vector3::new(0.5, -0.25, 0.125);
    body.push(push);
    assert_eq!(position, body.position());
    assert!((body.centre_of_mass_velocity() - centre - push).norm() < 1e-6);
    for (index, (before, after)) in velocity.iter().zip(body.velocity()).enumerate() {
        let expected = before + push.as_slice().get(index).copied().unwrap_or(0.0);
        assert!((after - expected).abs() < 1e-5, "entry {index}: {after} instead of {expected}");
    }
    assert!(body.body_motions().all(|motion| motion.linear_mps.iter().all(|part| part.is_finite())));
}

#[test]
#[should_panic(expected = "one mass scale per body is needed")]
fn a_variation_of_the_wrong_size_panics() {
    let mut body = simulation(HUMANOID_XML);
    varied(&mut body, |variation| variation.mass_scale.truncate(10));
}
