//! Round bodies that roll on the floor.

use treadmill_humanoid::Physics;

use crate::dynamics::energy_j;
use crate::{SPARE_HINGE, SPARE_MOTOR, advance, simulation};

const RADIUS_M: f64 = 0.1;

fn round(shape: &str) -> Physics {
    simulation(&format!(
        r#"<mujoco><worldbody><geom type="plane" size="9 9 1"/><body pos="0 0 {RADIUS_M}"><freejoint/>
           <geom {shape} size="{RADIUS_M}" mass="2"/>{SPARE_HINGE}</body></worldbody>{SPARE_MOTOR}</mujoco>"#
    ))
}

/// Bodies that roll along x.
fn bodies() -> [Physics; 2] {
    [round("type=\"sphere\""), round("type=\"capsule\" fromto=\"0 -0.15 0 0 0.15 0\"")]
}

/// Lets a body settle, then gives it a velocity along x (m/s) and a spin about y (rad/s).
fn start(body: &mut Physics, speed_mps: f64, spin_radps: f64) {
    advance(body, 100, &[0.0]);
    let position = body.position().to_vec();
    body.set_state(&position, &[speed_mps, 0.0, 0.0, 0.0, spin_radps, 0.0, 0.0]);
}

#[test]
fn a_rolling_body_keeps_its_speed_and_direction() {
    for mut body in bodies() {
        // The lowest point touches at the depth of rest.
        advance(&mut body, 100, &[0.0]);
        let speed_mps = 1.0;
        let height_m = body.torso_height_m();
        start(&mut body, speed_mps, speed_mps / f64::midpoint(height_m, RADIUS_M));
        let mut drift = [0.0f64; 2];
        let (energy, from_m) = (energy_j(&body), body.centre_of_mass().x);
        for _ in 0..200 {
            advance(&mut body, 1, &[0.0]);
            let (motion, centre) = (body.body_motion(0), body.centre_of_mass());
            // Contact points lie in the middle of the overlap.
            let slip_mps = motion.linear_mps.x - motion.angular_radps.y * f64::midpoint(height_m, RADIUS_M);
            assert!(slip_mps.abs() < 1e-3, "it slips at {slip_mps} m/s");
            let aside_radps = motion.angular_radps.x.hypot(motion.angular_radps.z);
            drift = [drift[0].max(centre.y.abs()), drift[1].max(aside_radps)];
            assert!(energy_j(&body) < energy * (1.0 + 1e-6), "{} J, first {energy} J", energy_j(&body));
            let mut points = 0;
            for point in body.contact_points() {
                points += 1;
                // It is where the body was in the middle of the last physics step, 3.75 ms long.
                let behind_m = centre.x - point.at_m.x;
                assert!((behind_m - speed_mps * 0.001_875).abs() < 2e-5, "{behind_m} m behind the centre");
                assert!(point.at_m.z.abs() < 1e-3);
            }
            assert!(points == 1 || points == 2, "{points} contacts");
        }
        // The solver stops at a small residual, which turns a rolling body aside a little.
        assert!(drift[0] < 1e-3 && drift[1] < 0.1, "it drifts sideways by {drift:?} m and rad/s");
        let rolled_m = body.centre_of_mass().x - from_m;
        assert!((rolled_m - 3.0 * speed_mps).abs() < 0.01, "{rolled_m} m in 3 s");
        assert!(energy_j(&body) > energy * 0.98, "{} J left of {energy} J", energy_j(&body));
    }
}

#[test]
fn a_sliding_ball_ends_up_rolling() {
    // A solid sphere that starts without spin rolls at 5/7 of its speed.
    let [mut ball, _] = bodies();
    start(&mut ball, 1.0, 0.0);
    let energy = energy_j(&ball);
    for _ in 0..100 {
        advance(&mut ball, 1, &[0.0]);
        assert!(energy_j(&ball) < energy * (1.0 + 1e-3));
    }
    let (motion, wanted) = (ball.body_motion(0), 5.0 / 7.0);
    assert!((motion.linear_mps.x / wanted - 1.0).abs() < 0.01, "{} m/s", motion.linear_mps.x);
    assert!((motion.angular_radps.y * RADIUS_M / wanted - 1.0).abs() < 0.01, "{} rad/s", motion.angular_radps.y);
}
