//! Positions and velocities are read back as they were set.

use nalgebra::Vector3;
use proptest::prelude::*;
use treadmill_humanoid::{HUMANOID_XML, Physics};

use crate::{STILL, simulation};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_state_is_read_back_as_it_was_set(
        place in prop::array::uniform3(-5.0..5.0f64),
        turn in prop::array::uniform4(-1.0..1.0f64).prop_filter("a rotation", |q| q.iter().map(|x| x * x).sum::<f64>() > 0.1),
        fractions in prop::collection::vec(0.0..1.0f64, 17),
        velocity in prop::collection::vec(-10.0..10.0f64, 23),
    ) {
        let mut physics = simulation(HUMANOID_XML);
        let norm = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut position: Vec<f64> = place.to_vec();
        position.extend(turn.iter().map(|x| x / norm));
        for (hinge, fraction) in physics.model().hinges.iter().zip(&fractions) {
            position.push(hinge.min_rad + fraction * (hinge.max_rad - hinge.min_rad));
        }
        physics.try_set_state(&position, &velocity).expect("within all ranges");
        // Only the quaternion may change, by normalisation.
        for (index, (found, set)) in physics.position().iter().zip(&position).enumerate() {
            prop_assert!((found - set).abs() < 1e-12, "position {index}: {found} instead of {set}");
        }
        for (index, (found, set)) in physics.velocity().iter().zip(&velocity).enumerate() {
            prop_assert!((found - set).abs() < 1e-12, "velocity {index}: {found} instead of {set}");
        }
        // The root's body has the same motion; its angular velocity is set in the root's axes.
        let root = physics.body_motion(0);
        let spin = root.pose.rotation * Vector3::new(velocity[3], velocity[4], velocity[5]);
        // Bodies have single precision: up to 17 rad/s.
        prop_assert!((root.angular_radps - spin).norm() < 1e-5);
        prop_assert!((root.pose.translation.vector - Vector3::from(place)).norm() < 1e-12);
        prop_assert!(physics.limit_overshoot_rad() < 1e-12);
    }
}

#[test]
fn the_root_velocity_is_that_of_its_frame_not_its_centre_of_mass() {
    let mut physics = simulation(HUMANOID_XML);
    let mut position = physics.model().nominal_position();
    position[2] = 3.0;
    let mut velocity = [0.0; 23];
    velocity[..6].copy_from_slice(&[1.0, 0.0, 0.0, 0.0, 2.0, 0.0]);
    physics.set_state(&position, &velocity);
    let (torso, motion) = (&physics.model().bodies[0], &physics.body_motion(0));
    // At 2 rad/s forward, a centre of mass d above the frame moves forward at 2d.
    let expected = 1.0 + 2.0 * torso.centre_of_mass_m.z;
    assert!(torso.centre_of_mass_m.z.abs() > 0.01);
    assert!((motion.linear_mps.x - expected).abs() < 2e-7);
}

#[test]
fn bending_the_knee_moves_the_foot_up_and_back() {
    let mut physics = simulation(HUMANOID_XML);
    let mut position = physics.model().nominal_position();
    let knee = physics.model().hinges.iter().position(|hinge| hinge.name == "right_knee").expect("has a knee");
    let shin = physics.model().bodies.iter().position(|body| body.name == "right_shin").expect("has a shin");
    let foot =
        |physics: &Physics| physics.body_motion(shin).pose * physics.model().bodies[shin].shapes[1].geometry.centre_m();
    let straight = foot(&physics);
    position[7 + knee] = -1.5;
    physics.set_state(&position, &STILL);
    let bent = foot(&physics);
    assert!(bent.x < straight.x - 0.2 && bent.z > straight.z + 0.2, "from {straight} to {bent}");
}
