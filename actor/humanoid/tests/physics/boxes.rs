//! A box on the floor: basic checks of the contact solver.

use nalgebra::{UnitQuaternion, Vector3};
use treadmill_humanoid::Physics;

use crate::{advance, simulation};

const GRAVITY_MPS2: f64 = 9.81;
const MASS_KG: f64 = 3.0;

/// A flat box, 0.4 m × 0.6 m × 0.2 m; the required hinge and motor are negligible.
fn flat_box(friction: f64) -> Physics {
    simulation(&format!(
        r#"<mujoco><worldbody><geom type="plane" size="1 1 1" friction="{friction}"/><body pos="0 0 0.1"><freejoint/>
           <geom type="box" size="0.2 0.3 0.1" mass="3" friction="{friction}"/>
           <body><joint name="j" damping="0.01"/>
           <inertial pos="0 0 0" mass="1e-6" diaginertia="1e-9 1e-9 1e-9"/></body>
           </body></worldbody><actuator><motor joint="j"/></actuator></mujoco>"#
    ))
}

#[test]
fn a_box_at_rest_stays_and_the_floor_carries_its_weight() {
    let mut body = flat_box(1.0);
    advance(&mut body, 100, &[0.0]);
    let place = body.position().to_vec();
    for _ in 0..100 {
        advance(&mut body, 1, &[0.0]);
        let (force_n, moment_nm) = body.contact_wrench(0);
        let wanted = Vector3::new(0.0, 0.0, MASS_KG * GRAVITY_MPS2);
        assert!((force_n - wanted).norm() < 0.01 * wanted.z, "{force_n} N");
        assert!(moment_nm.norm() < 0.05, "{moment_nm} N·m");
    }
    let moved = place.iter().zip(body.position()).take(7).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // The solver's tolerance leaves a creep of 0.016 mm/s.
    assert!(moved < 5e-5, "it crept by {moved} m or rad in 1.5 s");
}

#[test]
fn a_sliding_box_stops_where_friction_stops_it() {
    // Friction µ stops it after v² / (2 µ g); MuJoCo 4.0 with 3.75 ms: 1.0157 m, 0.4043 m and 0.2515 m.
    for (friction, mujoco_m) in [(0.2, 1.0157), (0.5, 0.4043), (0.8, 0.2515)] {
        let mut body = flat_box(friction);
        let mut position = body.model().nominal_position();
        // Start at the depth of rest, so that the box neither lands nor jumps.
        advance(&mut body, 60, &[0.0]);
        position[2] = body.torso_height_m();
        let speed_mps: f64 = 2.0;
        body.set_state(&position, &[0.0, speed_mps, 0.0, 0.0, 0.0, 0.0, 0.0]);
        advance(&mut body, 140, &[0.0]);
        let slid_m = body.centre_of_mass().y;
        let wanted_m = speed_mps.powi(2) / (2.0 * friction * GRAVITY_MPS2);
        assert!((slid_m / wanted_m - 1.0).abs() < 0.02, "{slid_m} m instead of {wanted_m} m at friction {friction}");
        assert!((slid_m / mujoco_m - 1.0).abs() < 0.02, "{slid_m} m instead of {mujoco_m} m at friction {friction}");
        let left_mps = body.centre_of_mass_velocity().norm();
        // At little friction MuJoCo's pyramids are so stiff that the solver's tolerance lifts the box off now and then.
        let (most_mps, most_creep_mps) = if friction < 0.3 { (0.05, 5e-4) } else { (1e-4, 1e-4) };
        assert!(left_mps < most_mps, "{left_mps} m/s left at friction {friction}");
        advance(&mut body, 100, &[0.0]);
        let crept_mps = (body.centre_of_mass().y - slid_m).abs() / 1.5;
        assert!(crept_mps < most_creep_mps, "it creeps at {crept_mps} m/s at friction {friction}");
        // It slides straight on, without turning.
        assert!(body.centre_of_mass().x.abs() < 1e-3 && body.body_motion(0).pose.rotation.angle() < 1e-3);
    }
}

fn energy_j(body: &Physics) -> f64 {
    let (part, motion) = (&body.model().bodies[0], body.body_motion(0));
    let local = motion.pose.rotation.inverse() * motion.angular_radps;
    let kinetic = part.mass_kg * motion.linear_mps.norm_squared() + local.dot(&(part.inertia_kgm2 * local));
    kinetic / 2.0 + part.mass_kg * GRAVITY_MPS2 * motion.pose.translation.z
}

#[test]
fn no_impact_adds_energy() {
    for (index, tilt) in [(0.3, 0.2, 0.0), (0.8, 0.1, 0.5), (1.2, 0.7, 0.0), (0.0, 0.0, 0.0)].into_iter().enumerate() {
        let mut body = flat_box(0.7);
        let rotation = UnitQuaternion::from_euler_angles(tilt.0, tilt.1, tilt.2);
        let mut position = body.model().nominal_position();
        position[2] = 0.8;
        position[3..7].copy_from_slice(&[rotation.w, rotation.i, rotation.j, rotation.k]);
        body.set_state(&position, &[1.0, -0.5, -1.0, 2.0, 1.0, -3.0, 0.0]);
        let start = energy_j(&body);
        let (mut last, mut gained, mut at_once) = (start, 0.0f64, 0.0f64);
        for _ in 0..200 {
            advance(&mut body, 1, &[0.0]);
            let now = energy_j(&body);
            at_once = at_once.max(now - last);
            gained = gained.max(now - start);
            last = now;
        }
        assert!(gained <= 1e-3 * start, "drop {index}: {gained} J more than the {start} J at the start");
        // A soft floor returns the energy that it has absorbed.
        assert!(at_once < 0.02 * start, "drop {index}: {at_once} J within one step");
        // It comes to rest.
        assert!(last < 0.7 * start, "drop {index}: {last} J left of {start} J");
    }
}
