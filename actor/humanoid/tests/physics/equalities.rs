//! Equalities, polynomial friction and springs, weightless bodies, narrow ranges and friction that depends on the direction.

use nalgebra::Vector3;
use treadmill_humanoid::{EnvConfig, Physics};

use crate::{CONTROL_STEP_S, advance, hinge, with_settings, with_substeps};

/// A base with two arms whose ends, 0.4 m apart at first, `equality` may join; `solver` is MuJoCo's.
fn arms(solver: &str, equality: &str, settings: &EnvConfig) -> Physics {
    let text = format!(
        r#"<mujoco><option solver="{solver}"/><worldbody><geom type="plane" size="1 1 1"/>
           <body name="base" pos="0 0 5"><freejoint/><geom size="0.1"/>
             <body name="left" pos="0 0.2 0"><joint name="a" axis="1 0 0"/><joint name="twist" axis="0 1 0"/>
               <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.04"/></body>
             <body name="right" pos="0 -0.2 0"><joint name="b" axis="1 0 0"/><joint name="tilt" axis="0 1 0"/>
               <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.04"/>
               <body name="hand" pos="0 0 -0.3"><joint name="wrist" axis="1 0 0"/><joint name="bend" axis="0 1 0"/>
                 <geom type="capsule" fromto="0 0 0 0 0.4 0" size="0.03"/></body></body>
           </body></worldbody><equality>{equality}</equality>
           <actuator><motor joint="a" ctrlrange="-1 1"/><motor joint="tilt" ctrlrange="-1 1"/></actuator></mujoco>"#
    );
    with_settings(&text, settings)
}

const SOLVERS: [&str; 2] = ["Newton", "PGS"];

#[test]
fn the_ends_of_a_loop_stay_together() {
    let rod = r#"<connect body1="hand" body2="left" anchor="0 0.4 0" solref="0.004 1"/>"#;
    for solver in SOLVERS {
        // The humanoid's settings, and finer ones.
        for substeps in [4, 16] {
            let mut robot = arms(solver, rod, &EnvConfig { substeps, self_collision: false, ..EnvConfig::default() });
            let connection = robot.model().connections[0].clone();
            let ends = |robot: &Physics| {
                [0, 1].map(|side| {
                    let body = robot.model().links[connection.links[side]].body;
                    robot.body_motion(body).pose * connection.points_m[side]
                })
            };
            let mut turned = 0.0f64;
            for step in 0..60 {
                let control = if step % 20 < 10 { 1.0 } else { -1.0 };
                advance(&mut robot, 1, &[control, 0.5 * control]);
                let [one, other] = ends(&robot);
                assert!((one - other).norm() < 2e-3, "{solver}, {substeps}: {} m apart", (one - other).norm());
                turned = turned.max(robot.joint_angles()[0].abs());
            }
            assert!(turned > 0.2, "{solver}: the arm turned by {turned} rad only");
        }
    }
}

#[test]
fn a_loop_does_not_move_the_robot_as_a_whole() {
    let rod = r#"<connect body1="hand" body2="left" anchor="0 0.4 0"/>"#;
    for solver in SOLVERS {
        let mut robot = arms(solver, rod, &EnvConfig { self_collision: false, ..EnvConfig::default() });
        let (steps, start) = (20, robot.centre_of_mass());
        advance(&mut robot, steps, &[1.0, -1.0]);
        let time_s = f64::from(steps) * CONTROL_STEP_S;
        let fallen = start - Vector3::z() * (9.81 * time_s * time_s / 2.0);
        assert!((robot.centre_of_mass() - fallen).norm() < 1e-3, "{solver}: {}", robot.centre_of_mass() - fallen);
        assert!((robot.centre_of_mass_velocity() + Vector3::z() * 9.81 * time_s).norm() < 1e-3, "{solver}");
    }
}

#[test]
fn a_loop_holds_after_the_same_robot_without_it() {
    let rod = r#"<connect body1="hand" body2="left" anchor="0 0.4 0"/>"#;
    let settings = EnvConfig { self_collision: false, ..EnvConfig::default() };
    for solver in SOLVERS {
        let moved = |robot: &mut Physics| {
            advance(robot, 10, &[1.0, 0.5]);
            robot.position().to_vec()
        };
        // A thread that has simulated nothing else, and one that has workspaces of as many bodies and hinges.
        let wanted = std::thread::scope(|scope| {
            scope.spawn(|| moved(&mut arms(solver, rod, &settings))).join().expect("no panic")
        });
        moved(&mut arms(solver, "", &settings));
        assert_eq!(moved(&mut arms(solver, rod, &settings)), wanted, "{solver}");
    }
}

#[test]
fn a_hinge_follows_another_in_proportion() {
    let mimic = r#"<joint joint1="b" joint2="a" polycoef="0.1 -0.5"/>"#;
    for solver in SOLVERS {
        let mut robot = arms(solver, mimic, &EnvConfig::default());
        let mut position = robot.model().nominal_position();
        position[7 + 2] = 0.1;
        robot.set_state(&position, &[0.0; 12]);
        let mut turned = 0.0f64;
        for step in 0..40 {
            advance(&mut robot, 1, &[if step < 20 { 1.0 } else { -1.0 }, 0.0]);
            let [a, _, b, ..] = robot.joint_angles() else { panic!("six hinges") };
            assert!((b - (0.1 - 0.5 * a)).abs() < 0.02, "{solver}: {a} and {b}");
            turned = turned.max(a.abs());
        }
        assert!(turned > 0.3, "{solver}: {turned}");
    }
}

#[test]
fn what_is_held_up_does_not_fall() {
    let text = |share: f64| {
        format!(
            r#"<mujoco><worldbody><geom type="plane" size="1 1 1"/><body pos="0 0 3" gravcomp="{share}"><freejoint/>
               <geom size="0.1"/><body gravcomp="{share}" pos="0.3 0 0"><joint name="j" axis="0 1 0"/><geom size="0.1" pos="0.2 0 0"/>
               </body></body></worldbody><actuator><motor joint="j"/></actuator></mujoco>"#
        )
    };
    for (share, acceleration) in [(1.0, 0.0), (0.5, -4.905), (2.0, 9.81)] {
        let mut body = with_substeps(&text(share), 4);
        advance(&mut body, 20, &[0.0]);
        let wanted = acceleration * 20.0 * CONTROL_STEP_S;
        let found = body.centre_of_mass_velocity();
        assert!((found - Vector3::z() * wanted).norm() < 1e-4, "{share}: {found}");
        // Every part falls alike, so that nothing turns.
        assert!(body.joint_rates()[0].abs() < 1e-4, "{share}: {}", body.joint_rates()[0]);
    }
}

/// Angle and rate after a time, by the fourth-order Runge-Kutta method.
fn integrated(mut state: [f64; 2], time_s: f64, torque_nm: impl Fn(f64, f64) -> f64) -> [f64; 2] {
    let steps = 20_000;
    let step_s = time_s / f64::from(steps);
    let slope = |[angle, rate]: [f64; 2]| [rate, torque_nm(angle, rate) / hinge::REDUCED_KGM2];
    let after = |[angle, rate]: [f64; 2], [turn, change]: [f64; 2], part: f64| {
        [angle + turn * part * step_s, rate + change * part * step_s]
    };
    for _ in 0..steps {
        let a = slope(state);
        let b = slope(after(state, a, 0.5));
        let c = slope(after(state, b, 0.5));
        let d = slope(after(state, c, 1.0));
        let mean = [0, 1].map(|entry| (a[entry] + 2.0 * (b[entry] + c[entry]) + d[entry]) / 6.0);
        state = after(state, mean, 1.0);
    }
    state
}

#[test]
fn friction_and_springs_may_have_squares_and_cubes() {
    // The spring rests at 0.1 rad.
    let joint = r#"damping="0.05 0.1 0.02" stiffness="2 1.5 3" springref="5.729577951308232""#;
    let torque = |angle: f64, rate: f64| {
        let bent = angle - 0.1;
        -(0.05 * rate + 0.1 * rate * rate.abs() + 0.02 * rate.powi(3))
            - (2.0 * bent + 1.5 * bent * bent + 3.0 * bent.powi(3))
    };
    let errors = [4, 8].map(|substeps| {
        let mut body = hinge::pair(joint, substeps);
        hinge::start(&mut body, 0.8, -3.0);
        let mut worst = 0.0f64;
        for step in 1..=40 {
            advance(&mut body, 1, &[0.0]);
            let [angle, rate] = integrated([0.8, -3.0], f64::from(step) * CONTROL_STEP_S, torque);
            worst = worst.max((body.joint_angles()[0] - angle).abs()).max(0.1 * (body.joint_rates()[0] - rate).abs());
        }
        worst
    });
    // Second order: half the step leaves a quarter of the error.
    assert!(errors[0] < 2e-3 && errors[1] < 0.3 * errors[0], "{errors:?}");
}

#[test]
fn both_limits_of_a_narrow_range_push() {
    for solver in SOLVERS {
        let joint = r#"range="-0.05 0.05" margin="0.2" solreflimit="0.05 1""#;
        let text = |joint: &str| {
            format!(
                r#"<mujoco><compiler angle="radian"/><option gravity="0 0 0" solver="{solver}"/>
                   <worldbody><geom type="plane" size="1 1 1"/><body pos="0 0 5"><freejoint/><geom size="0.1"/>
                   <body><joint name="j" axis="0 1 0" {joint}/><geom size="0.05" pos="0.2 0 0"/></body></body></worldbody>
                   <actuator><motor joint="j"/></actuator></mujoco>"#
            )
        };
        let mut body = with_substeps(&text(joint), 4);
        hinge::start(&mut body, 0.03, 0.0);
        advance(&mut body, 100, &[0.0]);
        // It rests in the middle instead of shaking between the two.
        let (angle, rate) = (body.joint_angles()[0], body.joint_rates()[0]);
        assert!(angle.abs() < 1e-3 && rate.abs() < 1e-2, "{solver}: {angle} rad, {rate} rad/s");
    }
}

#[test]
fn friction_may_depend_on_the_direction() {
    for solver in SOLVERS {
        let text = format!(
            r#"<mujoco><option solver="{solver}"/><worldbody><geom name="floor" type="plane" size="1 1 1"/>
               <body pos="0 0 0.05"><freejoint/><geom name="box" type="box" size="0.2 0.2 0.05"/>
               <body><joint name="j"/><inertial pos="0 0 0" mass="1e-4" diaginertia="1e-6 1e-6 1e-6"/></body></body></worldbody>
               <contact><pair geom1="floor" geom2="box" friction="0.2 0.5"/></contact>
               <actuator><motor joint="j"/></actuator></mujoco>"#
        );
        // MuJoCo's first direction on a level plane is y.
        for (start, friction) in [(Vector3::y(), 0.2), (Vector3::x(), 0.5)] {
            let mut body = with_substeps(&text, 8);
            let position = body.model().nominal_position();
            let speed_mps = 2.0;
            body.set_state(&position, &[start.x * speed_mps, start.y * speed_mps, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let steps = 16;
            advance(&mut body, steps, &[0.0]);
            let wanted = speed_mps - friction * 9.81 * f64::from(steps) * CONTROL_STEP_S;
            let found = body.centre_of_mass_velocity().dot(&start);
            assert!((found - wanted).abs() < 0.05, "{solver}, {friction}: {found} instead of {wanted} m/s");
        }
    }
}
