//! Motion of other models: collision rules, friction, margins, motor ranges, servos.

use treadmill_humanoid::{EnvConfig, Environment, EnvironmentConfig, Physics};

use crate::variation::varied;
use crate::{CONTROL_STEP_S, advance, lift_n, simulation, with_substeps};

const G1_LIKE_XML: &str = include_str!("../../assets/g1-like.xml");

/// Trunk with two arms whose hands overlap; with attributes of each hand and the floor, and more sections.
fn crossed(left: &str, right: &str, floor: &str, more: &str) -> Physics {
    let arm = |name: &str, shape: &str| {
        format!(
            r#"<body name="{name}" pos="0 0 -0.5"><joint name="{name}" axis="0 1 0"/>
               <geom type="box" size="0.05 0.05 0.05" {shape}/></body>"#
        )
    };
    simulation(&format!(
        r#"<mujoco><option gravity="0 0 0"/><worldbody><geom name="floor" type="plane" size="1 1 1" {floor}/>
           <body name="trunk" pos="0 0 0.52"><freejoint/><geom type="cylinder" size="0.1 0.1"/>
           {}{}</body></worldbody>{more}<actuator><motor joint="left" gear="1"/></actuator></mujoco>"#,
        arm("left", left),
        arm("right", right)
    ))
}

/// Whether the hands push each other in the air, and whether the floor lifts the body when they are 3 cm below it.
fn touches(left: &str, right: &str, floor: &str, more: &str) -> (bool, bool) {
    let step_at = |height_m: f64| {
        let mut physics = crossed(left, right, floor, more);
        let mut position = physics.model().nominal_position();
        position[2] = height_m;
        physics.set_state(&position, &[0.0; 8]);
        physics.step_only(&[0.0]).expect("finite");
        physics
    };
    let lift_n: f64 = (0..3).map(|body| step_at(0.52).contact_wrench(body).0.z).sum();
    (step_at(5.0).contact_wrench(1).0.norm() > 0.0, lift_n > 1.0)
}

#[test]
fn contype_conaffinity_and_exclusions_decide_contacts() {
    assert_eq!(touches("", "", "", ""), (true, true));
    let ghost = "contype=\"0\" conaffinity=\"0\"";
    assert_eq!(touches(ghost, "", "", ""), (false, true));
    assert_eq!(touches(ghost, ghost, "", ""), (false, false));
    // The floor has affinity to the hands, but the hands do not have it to each other.
    let hand = "contype=\"1\" conaffinity=\"0\"";
    assert_eq!(touches(hand, hand, "contype=\"0\" conaffinity=\"1\"", ""), (false, true));
    // One side's affinity is enough.
    assert_eq!(touches(hand, "contype=\"4\" conaffinity=\"1\"", "contype=\"2\" conaffinity=\"2\"", ""), (true, false));
    let part = |one: &str, other: &str| format!("<contact><exclude body1=\"{one}\" body2=\"{other}\"/></contact>");
    assert_eq!(touches("", "", "", &part("right", "left")), (false, true));
    assert_eq!(touches("", "", "", &(part("left", "world") + &part("world", "right"))), (true, false));
    assert_eq!(touches("", "", "", &part("left", "world")), (true, true));
    assert_eq!(touches("", "", "", &part("trunk", "right")), (true, true));
}

/// Box of 1 kg on the floor.
fn sliding_box(shape: &str, floor: &str) -> Physics {
    simulation(&format!(
        r#"<mujoco><worldbody><geom type="plane" size="1 1 1" {floor}/><body pos="0 0 0.1"><freejoint/>
           <geom type="box" size="0.3 0.3 0.1" mass="1" {shape}/>
           <body pos="0 0 0"><joint name="j"/><geom size="0.01" mass="0.001" contype="0" conaffinity="0"/></body>
           </body></worldbody><actuator><motor joint="j"/></actuator></mujoco>"#
    ))
}

/// Speed (m/s) of the box after sliding on the floor for 0.15 s from 2 m/s.
fn speed_left(mut physics: Physics) -> f64 {
    let position = physics.model().nominal_position();
    physics.set_state(&position, &[2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    advance(&mut physics, 10, &[0.0]);
    physics.centre_of_mass_velocity().x
}

#[test]
fn the_greater_friction_of_a_pair_counts() {
    // Friction µ decelerates by µ·g: 2 − µ × 9.81 × 0.15.
    for (shape, floor, friction) in [
        ("friction=\"0.2\"", "friction=\"0.6\"", 0.6),
        ("friction=\"0.9\"", "friction=\"0.6\"", 0.9),
        ("friction=\"0.5\" condim=\"1\"", "friction=\"0.5\"", 0.5),
        ("friction=\"0.5\"", "friction=\"0.5\" condim=\"1\"", 0.5),
        ("friction=\"0.5\" condim=\"1\"", "friction=\"0.5\" condim=\"1\"", 0.0),
    ] {
        let (found, wanted) = (speed_left(sliding_box(shape, floor)), 2.0 - friction * 9.81 * 0.15);
        assert!((found - wanted).abs() < 0.05, "{shape} on {floor}: {found} m/s instead of {wanted} m/s");
    }
}

#[test]
fn the_friction_pyramid_of_a_capsule_on_a_plane_has_an_edge_along_its_axis() {
    // Gravity pushes along the diagonal of x and y with 0.85 of the weight.
    let speed = |shape: &str, height_m: f64, turn_deg: f64| {
        let mut physics = simulation(&format!(
            r#"<mujoco><option gravity="6.01 6.01 -10"/><worldbody><geom type="plane" size="1 1 1"/>
               <body pos="0 0 {height_m}" euler="0 0 {turn_deg}"><freejoint/><geom {shape} mass="5"/>
               <body><joint name="j"/><geom size="0.01" mass="0.001" contype="0" conaffinity="0"/></body>
               </body></worldbody><actuator><motor joint="j"/></actuator></mujoco>"#
        ));
        advance(&mut physics, 20, &[0.0]);
        physics.centre_of_mass_velocity().xy().norm()
    };
    let capsule = r#"type="capsule" size="0.05 0.3" euler="0 90 0""#;
    // Friction of 1 holds it along an edge of its pyramid, as in MuJoCo, and 0.71 of the weight between two of them.
    // A soft contact creeps.
    assert!(speed(capsule, 0.05, 45.0) < 0.05, "{}", speed(capsule, 0.05, 45.0));
    let wide = r#"type="box" size="0.3 0.3 0.05""#;
    assert!(speed(wide, 0.05, 45.0) > 0.3, "{}", speed(wide, 0.05, 45.0));
}

/// Distance (m) between a ball at rest and the floor.
fn resting_gap_m(ball: &str, floor: &str) -> f64 {
    let mut physics = simulation(&format!(
        r#"<mujoco><worldbody><geom type="plane" size="1 1 1" {floor}/><body pos="0 0 0.125"><freejoint/>
           <geom type="sphere" size="0.1" {ball}/><body pos="0 0 0.1"><joint name="turn" axis="0 0 1"/>
           <geom type="sphere" size="0.01"/></body></body></worldbody>
           <actuator><motor joint="turn" ctrlrange="-1 1"/></actuator></mujoco>"#
    ));
    advance(&mut physics, 100, &[0.0]);
    physics.torso_height_m() - 0.1
}

#[test]
fn the_margins_of_a_pair_add_up() {
    // MuJoCo 4.0 rests this far inside all margins.
    let give_m = 3.67182e-4;
    for (ball, floor, margin_m) in [
        ("", "", 0.0),
        ("margin=\"0.004\"", "", 0.004),
        ("", "margin=\"0.01\"", 0.01),
        ("margin=\"0.004\"", "margin=\"0.006\"", 0.01),
        ("margin=\"0.01\"", "margin=\"0.01\"", 0.02),
    ] {
        let gap_m = resting_gap_m(ball, floor);
        assert!((gap_m + give_m - margin_m).abs() < 4e-6, "`{ball}` on `{floor}`: {gap_m} m");
    }
}

#[test]
fn solid_shapes_rest_on_their_surfaces() {
    for (shape, height_m) in [
        ("type=\"box\" size=\"0.1 0.2 0.3\"", 0.3),
        ("type=\"box\" size=\"0.1 0.2 0.3\" axisangle=\"1 0 0 90\"", 0.2),
        ("type=\"cylinder\" size=\"0.2 0.1\"", 0.1),
        ("type=\"cylinder\" size=\"0.2 0.15\" axisangle=\"1 0 0 90\"", 0.2),
        ("type=\"cylinder\" fromto=\"-0.2 0 0 0.2 0 0\" size=\"0.15\"", 0.15),
        ("type=\"sphere\" size=\"0.2\"", 0.2),
        ("type=\"ellipsoid\" size=\"0.3 0.3 0.2\"", 0.2),
    ] {
        let mut physics = simulation(&format!(
            r#"<mujoco><worldbody><geom type="plane" size="1 1 1"/><body pos="0 0 {height_m}"><freejoint/>
               <geom {shape}/><body pos="0 0 0"><joint name="j"/><geom size="0.01" contype="0" conaffinity="0"/></body>
               </body></worldbody><actuator><motor joint="j"/></actuator></mujoco>"#
        ));
        advance(&mut physics, 20, &[0.0]);
        let sunk = height_m - physics.torso_height_m();
        assert!(sunk.abs() < 0.005, "{shape} sank by {sunk} m");
    }
}

/// Model of a trunk with one driven hinge; with the motor's element and attributes of the joint.
fn driven_model(motor: &str, joint: &str) -> String {
    format!(
        r#"<mujoco><compiler angle="radian"/><option gravity="0 0 0"/><worldbody><geom type="plane" size="1 1 1"/>
           <body pos="0 0 1.5"><freejoint/><geom size="0.3"/>
           <body pos="0 0 0.5"><joint name="j" axis="0 1 0" {joint}/><geom type="box" size="0.1 0.1 0.1"/></body></body>
           </worldbody><actuator>{motor}</actuator></mujoco>"#
    )
}

fn driven(motor: &str, joint: &str) -> Environment {
    Environment::new(&EnvironmentConfig::default(), &driven_model(motor, joint)).expect("valid")
}

/// Torque (N·m) on the hinge at an angle and rate, for a share of the motor's range; no time passes.
fn torque_nm(environment: &mut Environment, share: f32, angle_rad: f64, rate_radps: f64) -> f64 {
    let mut action = vec![0.0; environment.action_size()];
    environment.action_from_shares(&vec![share; action.len()], &mut action);
    let physics = environment.physics_mut();
    let mut position = physics.model().nominal_position();
    position[7] = angle_rad;
    physics.set_state(&position, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, rate_radps]);
    physics.set_controls(&action).expect("finite");
    physics.joint_torques_nm()[0]
}

#[test]
fn shares_of_an_asymmetric_range_reach_both_ends() {
    let mut one = driven("<motor joint=\"j\" gear=\"10\" ctrlrange=\"-0.25 0.75\"/>", "");
    assert_eq!(one.action_ranges(), [[-0.25, 0.75]]);
    for (share, torque) in [(-1.0, -2.5), (0.0, 2.5), (1.0, 7.5), (0.5, 5.0), (7.0, 7.5), (-7.0, -2.5)] {
        assert_eq!(torque_nm(&mut one, share, 0.0, 0.0), torque);
    }
    // The torques of two motors on one hinge add up to the hinge's limit.
    let both = "<motor joint=\"j\" gear=\"10\" ctrlrange=\"-1 1\"/><motor joint=\"j\" gear=\"5\" ctrlrange=\"-2 1\"/>";
    let mut limited = driven(both, "actuatorfrcrange=\"-12 100\"");
    assert_eq!(torque_nm(&mut limited, 1.0, 0.0, 0.0), 15.0);
    assert_eq!(torque_nm(&mut limited, -1.0, 0.0, 0.0), -12.0);
    let mut weak = driven("<motor joint=\"j\" gear=\"10\" ctrlrange=\"-1 1\" forcerange=\"-0.5 0.5\"/>", "");
    assert_eq!(torque_nm(&mut weak, 1.0, 0.0, 0.0), 5.0);
}

#[test]
fn servo_torques_equal_mujocos() {
    // MuJoCo 4.0: control 0.4, angle 0.1, rate 0.3 and gear 2 give a force of 8.8.
    let heavy = "armature=\"1\"";
    let servo = "<position joint=\"j\" kp=\"50\" kv=\"2\" gear=\"2\" ctrlrange=\"-0.4 0.4\"/>";
    assert!((torque_nm(&mut driven(servo, heavy), 1.0, 0.1, 0.3) - 17.6).abs() < 1e-5);
    let general =
        "<general joint=\"j\" gainprm=\"50\" biastype=\"affine\" biasprm=\"1 -50 -2\" ctrlrange=\"-0.4 0.4\"/>";
    assert!((torque_nm(&mut driven(general, heavy), 1.0, 0.1, 0.3) - (20.0 + 1.0 - 5.0 - 0.6)).abs() < 1e-5);
    let speed = "<velocity joint=\"j\" kv=\"3\" ctrlrange=\"-1 1\"/>";
    assert!((torque_nm(&mut driven(speed, ""), 1.0, 0.1, 0.3) - 3.0 * 0.7).abs() < 1e-5);
    let strong = "<position joint=\"j\" kp=\"500\" ctrlrange=\"-1 1\" forcerange=\"-5 5\"/>";
    assert_eq!(torque_nm(&mut driven(strong, heavy), 1.0, -3.0, 0.0), 5.0);
}

#[test]
fn a_weaker_servo_measures_the_same_length() {
    let servo = "<position joint=\"j\" kp=\"50\" gear=\"2\" ctrlrange=\"-0.4 0.4\"/>";
    let mut physics = simulation(&driven_model(servo, "armature=\"1\""));
    let mut position = physics.model().nominal_position();
    position[7] = 0.1;
    varied(&mut physics, |variation| variation.motor_scale[0] = 0.5);
    physics.set_state(&position, &[0.0; 7]);
    // Before the first step a servo's control is 0: half of 2 × 50 × −0.2.
    assert!((physics.joint_torques_nm()[0] + 10.0).abs() < 1e-9, "{} N·m", physics.joint_torques_nm()[0]);
    let control = 0.2;
    physics.step_only(&[control]).expect("finite");
    // Gear 2 at 0.1 rad is a length of 0.2, the target, so the torque is 0 at any strength.
    assert!(physics.joint_torques_nm()[0].abs() < 1e-4, "{} N·m", physics.joint_torques_nm()[0]);
    position[7] = 0.0;
    physics.set_state(&position, &[0.0; 7]);
    physics.step_only(&[control]).expect("finite");
    // Half of 2 × 50 × 0.2 at first; the hinge has hardly moved by the second physics step.
    assert!((physics.joint_torques_nm()[0] - 10.0).abs() < 0.1, "{} N·m", physics.joint_torques_nm()[0]);
}

#[test]
fn randomised_floor_friction_also_scales_the_shapes() {
    for (scale, friction) in [(0.25, 0.2), (0.0, 0.0)] {
        let mut physics = sliding_box("friction=\"0.8\"", "friction=\"0.8\"");
        varied(&mut physics, |variation| variation.floor_friction_scale = scale);
        let (found, wanted) = (speed_left(physics), 2.0 - friction * 9.81 * 0.15);
        let tolerance = if friction == 0.0 { 0.01 } else { 0.05 };
        assert!((found - wanted).abs() < tolerance, "{found} m/s instead of {wanted} m/s");
    }
}

#[test]
fn motors_without_strength_are_simulated() {
    for motor in ["<motor joint=\"j\" gear=\"5\"/>", "<position joint=\"j\" kp=\"50\" ctrlrange=\"-1 1\"/>"] {
        let mut weak = simulation(&driven_model(motor, ""));
        varied(&mut weak, |variation| variation.motor_scale[0] = 0.0);
        weak.set_state(&weak.model().nominal_position(), &[0.0; 7]);
        weak.step_only(&[1.0]).expect("finite");
        assert_eq!(weak.joint_torques_nm()[0], 0.0, "{motor}");
    }
}

#[test]
fn a_servo_reaches_and_keeps_its_target() {
    let mut environment = driven("<position joint=\"j\" kp=\"30\" kv=\"3\" ctrlrange=\"-1 1\"/>", "");
    let mut observation = vec![0.0; environment.observation_size()];
    environment.reset(1, &mut observation);
    for _ in 0..200 {
        assert!(!environment.step(&[0.6], &mut observation).fault);
    }
    let angle_rad = environment.physics().joint_angles()[0];
    assert!((angle_rad - 0.6).abs() < 0.01, "{angle_rad} rad");
    assert!(environment.physics().joint_rates()[0].abs() < 0.05);
}

#[test]
fn a_very_stiff_servo_holds_its_target_without_oscillation() {
    // A cube of 8 kg and 0.2 m side has 8 × 0.04 / 6 kg·m² about its middle. An explicit step of 7.5 ms would be
    // unstable above this inertia divided by the step; the servo is ten times as stiff.
    let kv = 10.0 * 8.0 * 0.04 / 6.0 / (CONTROL_STEP_S / 2.0);
    let kp = kv / (CONTROL_STEP_S / 2.0);
    let servo = format!("<position joint=\"j\" kp=\"{kp}\" kv=\"{kv}\" ctrlrange=\"-1 1\"/>");
    let text = driven_model(&servo, "armature=\"0.01\"");
    for (substeps, armature_scale) in [(1, 1.0), (2, 1.0), (4, 1.0), (4, 0.01), (4, 0.0)] {
        let mut physics = with_substeps(&text, substeps);
        varied(&mut physics, |variation| variation.armature_scale[0] = armature_scale);
        let (position, target) = (physics.model().nominal_position(), 0.3);
        physics.set_state(&position, &[0.0; 7]);
        for step in 0..100 {
            physics.step_only(&[target as f32]).expect("finite");
            let off = physics.joint_angles()[0] - target;
            // A sampled controller of one step per 15 ms overshoots by a tenth of the way.
            assert!(off < 0.035 && off > -0.3 - 1e-9, "{substeps} steps: off by {off} rad after step {step}");
            if step > 50 {
                assert!(off.abs() < 1e-4, "{substeps} steps: off by {off} rad after step {step}");
                assert!(physics.joint_rates()[0].abs() < 1e-3, "{substeps} steps: {} rad/s", physics.joint_rates()[0]);
            }
        }
    }
}

#[test]
fn another_body_has_its_own_sizes() {
    let mut environment = driven("<motor joint=\"j\" gear=\"2\" ctrlrange=\"-1 1\"/>", "");
    assert_eq!((environment.observation_size(), environment.action_size()), (13, 1));
    let mut observation = [0.0; 13];
    environment.reset(0, &mut observation);
    let before = observation[12];
    assert!(!environment.step(&[1.0], &mut observation).fault);
    // 2 N·m for 15 ms on at most 0.06 kg·m².
    assert!(observation[12] > before + (2.0 * CONTROL_STEP_S / 0.06) as f32);
}

#[test]
fn the_robot_of_29_hinges_stands_and_survives_random_actions() {
    let config = EnvironmentConfig::from(EnvConfig { healthy_z_range: [0.5, 1.1], ..EnvConfig::default() });
    let mut environment = Environment::new(&config, G1_LIKE_XML).expect("valid");
    assert_eq!((environment.observation_size(), environment.action_size()), (69, 29));
    let mut observation = vec![0.0; environment.observation_size()];
    environment.reset(3, &mut observation);
    let mass_kg = environment.physics().model().mass_kg();
    let (start_mps, steps) = (environment.physics().centre_of_mass_velocity().z, 20);
    let mut impulse_ns = 0.0;
    for _ in 0..steps {
        assert!(!environment.step(&[0.0; 29], &mut observation).terminated);
        impulse_ns += lift_n(environment.physics()) * CONTROL_STEP_S;
    }
    // The floor's impulse compensates gravity and changes the momentum.
    let change_mps = environment.physics().centre_of_mass_velocity().z - start_mps;
    let wanted_ns = mass_kg * (change_mps + 9.81 * f64::from(steps) * CONTROL_STEP_S);
    assert!((impulse_ns / wanted_ns - 1.0).abs() < 0.02, "the floor gives {impulse_ns} N·s, not {wanted_ns} N·s");
    assert!(wanted_ns > 0.5 * mass_kg * 9.81 * f64::from(steps) * CONTROL_STEP_S, "it hardly stands");
    // Extreme actions may end episodes, but never cause a fault.
    for step in 0..300u32 {
        let action: Vec<f32> = (0..29).map(|motor| if (step / 7 + motor) % 3 == 0 { 1.0 } else { -1.0 }).collect();
        let result = environment.step(&action, &mut observation);
        assert!(!result.fault, "step {step}");
        if result.terminated {
            environment.reset(u64::from(step), &mut observation);
        }
    }
}
