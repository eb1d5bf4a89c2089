//! Bodies at rest on the floor, with few and with many contacts and links.

use crate::{advance, lift_n, simulation};

/// Robot of 8.7 kg with three legs of two servos each: a round foot, a box and a lying capsule.
fn three_legged() -> String {
    let feet = [
        (0.2, 0.0, "type=\"sphere\" size=\"0.03\" pos=\"-0.06 0 -0.2\""),
        (-0.15, 0.15, "type=\"box\" size=\"0.04 0.03 0.03\" pos=\"-0.06 0 -0.2\""),
        (-0.15, -0.15, "type=\"capsule\" fromto=\"-0.1 0 -0.2 -0.02 0 -0.2\" size=\"0.03\""),
    ];
    let ghost = "contype=\"0\" conaffinity=\"0\"";
    let (mut legs, mut servos) = (String::new(), String::new());
    for (leg, (x, y, foot)) in feet.into_iter().enumerate() {
        legs += &format!(
            r#"<body pos="{x} {y} 0"><joint name="hip{leg}" axis="0 1 0" range="-60 60"/>
               <geom type="capsule" fromto="0 0 0 0.06 0 -0.2" size="0.02" mass="0.5" {ghost}/>
               <body pos="0.06 0 -0.2"><joint name="knee{leg}" axis="0 1 0" range="-90 90"/>
               <geom type="capsule" fromto="0 0 0 -0.06 0 -0.2" size="0.02" mass="0.3" {ghost}/>
               <geom {foot} mass="0.1"/></body></body>"#
        );
        for joint in ["hip", "knee"] {
            servos += &format!(r#"<position joint="{joint}{leg}" kp="150" kv="4" ctrlrange="-1 1"/>"#);
        }
    }
    format!(
        r#"<mujoco><default><joint damping="1" armature="0.01"/><geom friction="0.8"/></default>
           <worldbody><geom type="plane" size="5 5 1"/>
           <body name="trunk" pos="0 0 0.43"><freejoint/><geom type="box" size="0.2 0.15 0.05" mass="6"/>{legs}</body>
           </worldbody><actuator>{servos}</actuator></mujoco>"#
    )
}

#[test]
fn a_standing_robot_does_not_creep() {
    let mut robot = simulation(&three_legged());
    advance(&mut robot, 333, &[0.0; 6]);
    let place = robot.position().to_vec();
    advance(&mut robot, 334, &[0.0; 6]);
    let moved = robot.position().iter().zip(&place).map(|(now, then)| (now - then).abs()).fold(0.0, f64::max);
    // MuJoCo 4.0 creeps by 0.046 mm/s or mrad/s.
    assert!(moved / 5.0 < 1e-4, "it creeps by {} m/s or rad/s", moved / 5.0);
    // MuJoCo 4.0 stands at this height with these angles.
    assert!((robot.torso_height_m() - 0.429_187).abs() < 1e-4, "{} m", robot.torso_height_m());
    let mujoco_rad = [0.002_401, 0.012_469, -0.004_033, 0.004_236, -0.003_295, 0.004_763];
    for (angle, wanted) in robot.joint_angles().iter().zip(mujoco_rad) {
        assert!((angle - wanted).abs() < 1e-3, "{:?}", robot.joint_angles());
    }
    assert!((lift_n(&robot) / (8.7 * 9.81) - 1.0).abs() < 1e-3, "{} N", lift_n(&robot));
}

/// `TREADMILL_STAND_MINUTES=1440 cargo test --release --test physics stays` lets it stand for a day.
#[test]
fn a_robot_that_stands_for_minutes_stays() {
    let given = std::env::var("TREADMILL_STAND_MINUTES").ok();
    let minutes: u32 = given.and_then(|text| text.parse().ok()).unwrap_or(3);
    let mut robot = simulation(&three_legged());
    let (mut place, velocity) = (robot.position().to_vec(), robot.velocity().to_vec());
    (place[0], place[1]) = (2000.0, -300.0);
    robot.set_state(&place, &velocity);
    advance(&mut robot, 666, &[0.0; 6]);
    let place = robot.position().to_vec();
    advance(&mut robot, 4000 * minutes, &[0.0; 6]);
    let moved = robot.position().iter().zip(&place).map(|(now, then)| (now - then).abs()).fold(0.0, f64::max);
    let rate = robot.velocity().iter().map(|rate| rate.abs()).fold(0.0, f64::max);
    // Soft friction creeps by 35 µm/min, in double precision too; MuJoCo 4.0 by 2.8 mm/min.
    assert!(moved < 5e-5 * f64::from(minutes) && rate < 5e-6, "moved by {moved}, moves by {rate}/s");
}

#[test]
fn eighty_contacts_carry_the_whole_weight() {
    let capsules: String = (0..40)
        .map(|index| {
            let (x, y) = (f64::from(index % 8) * 0.3, f64::from(index / 8) * 0.5);
            format!(r#"<geom type="capsule" fromto="{x} {y} 0 {} {y} 0" size="0.05" mass="0.5"/>"#, x + 0.2)
        })
        .collect();
    let mut raft = simulation(&format!(
        r#"<mujoco><worldbody><geom type="plane" size="9 9 1"/><body pos="0 0 0.06"><freejoint/>{capsules}{}</body>
           </worldbody>{}</mujoco>"#,
        crate::SPARE_HINGE,
        crate::SPARE_MOTOR
    ));
    advance(&mut raft, 100, &[0.0]);
    assert!(raft.contact_points().count() > 64, "{} contacts", raft.contact_points().count());
    for _ in 0..20 {
        advance(&mut raft, 1, &[0.0]);
        assert!((lift_n(&raft) / (20.0 * 9.81) - 1.0).abs() < 0.01, "{} N", lift_n(&raft));
    }
    assert!((raft.torso_height_m() - 0.05).abs() < 1e-3, "{} m", raft.torso_height_m());
    assert!(raft.centre_of_mass_velocity().norm() < 1e-3, "{} m/s", raft.centre_of_mass_velocity());
    assert!(raft.body_motion(0).pose.rotation.angle() < 1e-3);
}

/// Hub with arms of `joints` links each.
fn spider(arms: usize, joints: usize) -> String {
    let (mut bodies, mut motors) = (String::new(), String::new());
    for arm in 0..arms {
        let (sin, cos) = (arm as f64 / arms as f64 * std::f64::consts::TAU).sin_cos();
        for joint in 0..joints {
            let (x, y) = if joint == 0 { (0.2 * cos, 0.2 * sin) } else { (0.1 * cos, 0.1 * sin) };
            bodies += &format!(
                r#"<body pos="{x} {y} 0"><joint name="j{arm}_{joint}" axis="{} {cos} 0" damping="0.2" armature="0.01"/>
                   <geom type="capsule" fromto="0 0 0 {} {} 0" size="0.03" mass="0.1" contype="0"/>"#,
                -sin,
                0.1 * cos,
                0.1 * sin
            );
            motors += &format!(r#"<motor joint="j{arm}_{joint}" ctrlrange="-1 1"/>"#);
        }
        bodies += &"</body>".repeat(joints);
    }
    format!(
        r#"<mujoco><worldbody><geom type="plane" size="9 9 1"/><body pos="0 0 0.5"><freejoint/>
           <geom type="sphere" size="0.2" mass="2"/>{bodies}</body></worldbody><actuator>{motors}</actuator></mujoco>"#
    )
}

#[test]
fn bodies_with_many_links_fall_and_rest() {
    for (arms, joints) in [(40, 1), (8, 5), (1, 40)] {
        let text = spider(arms, joints);
        let mut body = simulation(&text);
        assert_eq!(body.model().bodies.len(), 41);
        let idle = [0.0; 40];
        advance(&mut body, 10, &idle);
        // Nothing touches yet.
        let fallen_mps = 9.81 * 10.0 * crate::CONTROL_STEP_S;
        assert!((body.centre_of_mass_velocity().z + fallen_mps).abs() < 5e-6, "{}", body.centre_of_mass_velocity());
        advance(&mut body, 290, &idle);
        let (samples, mut mean_n) = (100, 0.0);
        for _ in 0..samples {
            advance(&mut body, 1, &idle);
            mean_n += lift_n(&body) / f64::from(samples);
        }
        assert!((mean_n / (6.0 * 9.81) - 1.0).abs() < 0.02, "{arms} arms of {joints}: {mean_n} N");
        assert!((0.19..0.21).contains(&body.torso_height_m()), "{arms} arms of {joints}: {} m", body.torso_height_m());
    }
}

#[test]
fn models_of_the_same_size_take_turns_on_one_thread() {
    // Equal numbers of bodies, hinges, shapes and links, but other trees, tendons and root.
    let (wide, long) = (spider(8, 1), spider(1, 8));
    let tendon = r#"<tendon><fixed name="t" range="-0.1 0.1"><joint joint="j0_0" coef="1"/></fixed></tendon>"#;
    let tied = long.replace("</mujoco>", &format!("{tendon}</mujoco>"));
    let rough = wide.replace("<freejoint/>", "<joint type=\"free\" frictionloss=\"0.5\"/>");
    let texts = [wide, long, tied, rough];
    let run = |mut bodies: Vec<treadmill_humanoid::Physics>| -> Vec<Vec<f64>> {
        for _ in 0..40 {
            for body in &mut bodies {
                advance(body, 1, &[0.1; 8]);
            }
        }
        bodies.iter().map(|body| [body.position(), body.velocity()].concat()).collect()
    };
    let together = run(texts.iter().map(|text| simulation(text)).collect());
    for (text, found) in texts.iter().zip(together) {
        assert_eq!(run(vec![simulation(text)]), [found]);
    }
}
