//! Laws that hold with contacts: momentum, and independence of the place and of a constant velocity.

use nalgebra::Vector3;
use treadmill_humanoid::Physics;

use crate::dynamics::momentum;
use crate::{CONTROL_STEP_S, STILL, humanoid_text, with_substeps};

const GRAVITY_MPS2: f64 = 9.81;

fn humanoid(changes: &[(&str, &str)], substeps: u32) -> Physics {
    with_substeps(&humanoid_text(changes), substeps)
}

fn controls(step: u32) -> [f32; 17] {
    std::array::from_fn(|motor| 0.3 * ((step * 31 + motor as u32 * 17) as f32).sin())
}

/// Largest difference between the change of momentum (N·s and N·m·s) in a control step and the impulses of gravity and
/// of the reported contacts, and the number of steps with contacts.
fn unexplained(body: &mut Physics, steps: u32) -> ([f64; 2], u32) {
    let (mut worst, mut touched) = ([0.0f64; 2], 0);
    let weight = Vector3::new(0.0, 0.0, -GRAVITY_MPS2 * body.model().mass_kg());
    for step in 0..steps {
        let before = momentum(body);
        body.step_only(&controls(step)).expect("finite");
        let after = momentum(body);
        let (mut force, mut moment) = (weight, Vector3::zeros());
        for link in 0..body.model().links.len() {
            let wrench = body.contact_wrench(link);
            (force, moment) = (force + wrench.0, moment + wrench.1);
        }
        touched += u32::from(body.squared_contact_wrenches() > 0.0);
        worst[0] = worst[0].max((after.0 - before.0 - force * CONTROL_STEP_S).norm());
        worst[1] = worst[1].max((after.1 - before.1 - moment * CONTROL_STEP_S).norm());
    }
    (worst, touched)
}

#[test]
fn contacts_explain_all_changes_of_momentum() {
    let (worst, touched) = unexplained(&mut humanoid(&[], 4), 100);
    assert!(touched > 30, "{touched}");
    // Momenta are up to 200 N·s and 40 N·m·s.
    assert!(worst[0] < 1e-4 && worst[1] < 1e-4, "{worst:?}");
}

#[test]
fn moment_arms_are_right_without_the_correction_of_momentum() {
    // Any friction of the free joint switches the correction off; this much has no other effect.
    let root = (
        "name=\"root\" type=\"free\" limited=\"false\" damping=\"0\"",
        "name=\"root\" type=\"free\" damping=\"1e-12\"",
    );
    let run = |substeps| {
        let mut body = humanoid(&[root], substeps);
        // It runs: the stance foot stays where it is, under a moving root.
        let position = body.model().nominal_position();
        let mut velocity = STILL;
        velocity[0] = 3.0;
        body.set_state(&position, &velocity);
        unexplained(&mut body, 40)
    };
    let ([coarse, fine], touched) = ([run(4).0, run(16).0], run(4).1);
    assert!(touched > 10, "{touched}");
    assert!(coarse[0] < 1.0 && coarse[1] < 0.4, "{coarse:?}");
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(fine < coarse / 6.0, "not of second order: {fine} of {coarse}");
    }
}

#[test]
fn a_constant_velocity_on_ice_changes_nothing_else() {
    let ice = ("condim=\"3\" friction", "condim=\"1\" friction");
    let (mut still, mut moving) = (humanoid(&[ice], 4), humanoid(&[ice], 4));
    let (speed, place) = (Vector3::new(3.0, -2.0, 0.0), Vector3::new(7.0, 11.0, 0.0));
    let mut position = still.model().nominal_position();
    still.set_state(&position, &STILL);
    let mut velocity = STILL;
    for axis in 0..3 {
        position[axis] += place[axis];
        velocity[axis] = speed[axis];
    }
    moving.set_state(&position, &velocity);
    let mut touched = 0;
    // Rounding starts with differences of 1e-6 m/s, which contacts increase.
    for step in 0..60 {
        still.step_only(&controls(step)).expect("finite");
        moving.step_only(&controls(step)).expect("finite");
        touched += u32::from(still.squared_contact_wrenches() > 0.0);
        let time_s = f64::from(step + 1) * CONTROL_STEP_S;
        for (index, (one, other)) in still.position().iter().zip(moving.position()).enumerate() {
            let gone = if index < 3 { place[index] + speed[index] * time_s } else { 0.0 };
            assert!((other - gone - one).abs() < 2e-4, "step {step}, position {index}: {}", other - gone - one);
        }
        for (index, (one, other)) in still.velocity().iter().zip(moving.velocity()).enumerate() {
            let added = if index < 3 { speed[index] } else { 0.0 };
            assert!((other - added - one).abs() < 4e-3, "step {step}, velocity {index}: {}", other - added - one);
        }
    }
    assert!(touched > 10, "{touched}");
}
