//! Limits under load, dry friction, tendons, and friction of the free joint.

use crate::{CONTROL_STEP_S, SPARE_HINGE, SPARE_MOTOR, advance, lift_n, simulation};

/// Trunk on two fixed balls and a leg that its weight pushes against the end of its range; no contact has friction.
const LOCKED_KNEE: &str = r#"<mujoco><default><geom condim="1"/></default><worldbody><geom type="plane" size="5 5 1"/>
    <body name="trunk" pos="0 0 0.38"><freejoint/>
    <geom type="box" size="0.3 0.2 0.05" mass="8" contype="0" conaffinity="0"/>
    <geom type="sphere" size="0.03" pos="-0.25 0.18 -0.35" mass="0.2"/>
    <geom type="sphere" size="0.03" pos="-0.25 -0.18 -0.35" mass="0.2"/>
    <body name="leg" pos="0.25 0 0"><joint name="knee" axis="0 1 0" range="0 80" damping="0.5" armature="0.01"/>
    <geom type="capsule" fromto="0.12 -0.1 -0.35 0.12 0.1 -0.35" size="0.03" mass="0.5"/></body></body></worldbody>
    <actuator><motor joint="knee" gear="1" ctrlrange="-5 5"/></actuator></mujoco>"#;

#[test]
fn a_loaded_limit_holds_and_lets_go() {
    let mut table = simulation(LOCKED_KNEE);
    let standing = |table: &treadmill_humanoid::Physics| {
        // MuJoCo 4.0 stands like this with any step and integrator.
        assert!((table.torso_height_m() - 0.379_653).abs() < 2e-5, "{} m", table.torso_height_m());
        assert!((table.joint_angles()[0] + 0.001_240).abs() < 5e-5, "{} rad", table.joint_angles()[0]);
        assert!(table.joint_rates()[0].abs() < 1e-3, "{} rad/s", table.joint_rates()[0]);
        assert!((lift_n(table) / (8.9 * 9.81) - 1.0).abs() < 1e-3, "{} N", lift_n(table));
    };
    advance(&mut table, 50, &[0.0]);
    standing(&table);
    // In the air the motor bends the knee freely.
    let (position, mut velocity) = (table.position().to_vec(), table.velocity().to_vec());
    velocity[2] += 1.5;
    table.set_state(&position, &velocity);
    advance(&mut table, 10, &[1.0]);
    assert_eq!(lift_n(&table), 0.0);
    // MuJoCo 4.0 with steps of 0.5 ms; its fourth-order integrator with 3.75 ms differs by 0.0002 rad and 0.0014 rad/s.
    assert!((table.torso_height_m() - 0.494_457).abs() < 1e-3, "{} m", table.torso_height_m());
    assert!((table.joint_angles()[0] - 0.125_024).abs() < 2e-3, "{} rad", table.joint_angles()[0]);
    assert!((table.joint_rates()[0] - 1.393_518).abs() < 2e-2, "{} rad/s", table.joint_rates()[0]);
    // After the landing the weight pushes it against the limit again.
    advance(&mut table, 150, &[0.0]);
    standing(&table);
}

const REDUCED_KGM2: f64 = 0.3 * 0.02 / 0.32;
const LOSS_NM: f64 = 2.0;

/// Two weightless bodies on a hinge with dry friction and a rotor of 1 kg·m².
fn rubbing() -> treadmill_humanoid::Physics {
    simulation(
        r#"<mujoco><option gravity="0 0 0"/><worldbody><geom type="plane" size="1 1 1"/><body pos="0 0 5"><freejoint/>
           <inertial pos="0 0 0" mass="2" diaginertia="0.3 0.3 0.3"/>
           <body><joint name="j" axis="0 1 0" frictionloss="2" armature="1"/>
           <inertial pos="0 0 0" mass="1" diaginertia="0.02 0.02 0.02"/></body>
           </body></worldbody><actuator><motor joint="j" ctrlrange="-10 10"/></actuator></mujoco>"#,
    )
}

#[test]
fn dry_friction_holds_below_its_torque_and_slips_above() {
    let inertia_kgm2 = REDUCED_KGM2 + 1.0;
    let mut body = rubbing();
    let (torque_nm, steps) = (1.5, 60);
    advance(&mut body, steps, &[torque_nm as f32]);
    // MuJoCo's dry friction is soft: with impedance d it creeps at (1 − d) / d × torque / inertia / damping.
    let creep_radps = (1.0 - 0.9) / 0.9 * torque_nm / inertia_kgm2 / (2.0 / (0.95 * 0.02));
    assert!((creep_radps - 0.001_554_192).abs() < 1e-9, "MuJoCo 4.0's rate");
    assert!((body.joint_rates()[0] / creep_radps - 1.0).abs() < 1e-3, "{} rad/s", body.joint_rates()[0]);
    assert!(body.joint_angles()[0].abs() < 0.002, "{} rad", body.joint_angles()[0]);

    let mut body = rubbing();
    let (torque_nm, steps) = (3.0, 20);
    advance(&mut body, steps, &[torque_nm as f32]);
    let wanted = (torque_nm - LOSS_NM) / inertia_kgm2 * f64::from(steps) * CONTROL_STEP_S;
    assert!((body.joint_rates()[0] / wanted - 1.0).abs() < 1e-3, "{} rad/s, not {wanted} rad/s", body.joint_rates()[0]);

    // It slows down at the same rate in both directions, then stops.
    for sign in [1.0, -1.0] {
        let mut body = rubbing();
        let position = body.model().nominal_position();
        body.set_state(&position, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 3.0 * sign]);
        advance(&mut body, 40, &[0.0]);
        let wanted = sign * (3.0 - LOSS_NM / inertia_kgm2 * 40.0 * CONTROL_STEP_S);
        assert!((body.joint_rates()[0] - wanted).abs() < 4e-5, "{} rad/s, not {wanted} rad/s", body.joint_rates()[0]);
        advance(&mut body, 100, &[0.0]);
        assert!(body.joint_rates()[0].abs() < 1e-6, "{} rad/s", body.joint_rates()[0]);
        // MuJoCo 4.0: 2.2915 rad; without softness 3² × inertia / (2 × torque) = 2.2922 rad.
        assert!((body.joint_angles()[0] * sign - 2.2922).abs() < 0.002, "{} rad", body.joint_angles()[0]);
    }
}

#[test]
fn a_tendon_stops_the_sum_of_two_hinges() {
    let mut body = simulation(
        r#"<mujoco><compiler angle="radian"/><option gravity="0 0 0"/><worldbody><geom type="plane" size="1 1 1"/>
           <body pos="0 0 5"><freejoint/><inertial pos="0 0 0" mass="2" diaginertia="0.3 0.3 0.3"/>
           <body><joint name="a" axis="0 1 0" damping="0.5" armature="0.05"/>
           <inertial pos="0 0 -0.1" mass="1" diaginertia="0.02 0.02 0.02"/>
           <body pos="0 0 -0.2"><joint name="b" axis="0 1 0" damping="0.5" armature="0.05"/>
           <inertial pos="0 0 -0.1" mass="1" diaginertia="0.02 0.02 0.02"/></body></body></body></worldbody>
           <tendon><fixed name="both" range="-1 0.5"><joint joint="a" coef="1"/><joint joint="b" coef="2"/></fixed></tendon>
           <actuator><motor joint="a" ctrlrange="-10 10"/><motor joint="b" ctrlrange="-10 10"/></actuator></mujoco>"#,
    );
    let length = |body: &treadmill_humanoid::Physics| body.model().tendons[0].sum_over(body.joint_angles());
    let mut greatest = 0.0f64;
    for _ in 0..200 {
        advance(&mut body, 1, &[1.0, 2.0]);
        greatest = greatest.max(length(&body));
    }
    // MuJoCo 4.0, whose two integrators agree to 3e-5 rad; torques as the weights leave the hinges free otherwise.
    assert!((length(&body) - 0.501_094).abs() < 2e-5, "{}", length(&body));
    assert!((greatest - 0.5394).abs() < 0.005, "{greatest}");
    for (angle, wanted) in body.joint_angles().iter().zip([0.10025, 0.20042]) {
        assert!((angle - wanted).abs() < 5e-4, "{:?}", body.joint_angles());
    }
    advance(&mut body, 200, &[-1.0, -2.0]);
    assert!((length(&body) + 1.001_094).abs() < 2e-5, "{}", length(&body));
    for (angle, wanted) in body.joint_angles().iter().zip([-0.20073, -0.40018]) {
        assert!((angle - wanted).abs() < 5e-4, "{:?}", body.joint_angles());
    }
}

#[test]
fn friction_of_the_free_joint_slows_a_fall() {
    let falling = |damping: f64| {
        simulation(&format!(
            r#"<mujoco><worldbody><geom type="plane" size="1 1 1"/><body pos="0 0 50"><joint type="free" damping="{damping}"/>
               <inertial pos="0 0 0" mass="2" diaginertia="0.3 0.3 0.3"/>{SPARE_HINGE}</body></worldbody>{SPARE_MOTOR}</mujoco>"#
        ))
    };
    let mut body = falling(3.0);
    let position = body.model().nominal_position();
    body.set_state(&position, &[1.0, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0]);
    advance(&mut body, 60, &[0.0]);
    let (time_s, mass_kg) = (60.0 * CONTROL_STEP_S, 2.000_001);
    let left = (-3.0 / mass_kg * time_s).exp();
    let velocity = body.velocity();
    assert!((velocity[0] - left).abs() < 1e-5, "{} m/s along x", velocity[0]);
    let fall_mps = -9.81 * mass_kg / 3.0 * (1.0 - left);
    assert!((velocity[2] - fall_mps).abs() < 1e-4, "{} m/s, not {fall_mps} m/s", velocity[2]);
    // Rotations have the same coefficient in N·m·s.
    let spin_radps = 4.0 * (-3.0 / 0.3 * time_s).exp();
    assert!((velocity[5] - spin_radps).abs() < 1e-5, "{} rad/s, not {spin_radps} rad/s", velocity[5]);
    let mut free = falling(0.0);
    advance(&mut free, 60, &[0.0]);
    // 240 additions to up to 9 m/s in single precision.
    assert!((free.velocity()[2] + 9.81 * time_s).abs() < 4e-5);
}

#[test]
fn a_saturated_servo_of_any_stiffness_pushes_against_a_limit() {
    // A light arm whose servo would turn it far beyond its range.
    for kp in [10.0, 500.0, 50_000.0] {
        let mut body = simulation(&format!(
            r#"<mujoco><compiler angle="radian"/><worldbody><geom type="plane" size="5 5 1"/>
            <body pos="0 0 0.1"><freejoint/><geom type="box" size="0.5 0.5 0.1" mass="40"/>
            <body pos="0.6 0 0"><joint axis="0 1 0" range="-0.5 0.5" name="j"/>
            <inertial pos="0 0 0" mass="0.05" diaginertia="0.001 0.001 0.001"/></body></body></worldbody>
            <actuator><position joint="j" kp="{kp}" kv="2" ctrlrange="-9 9" forcerange="-3 3"/></actuator></mujoco>"#
        ));
        advance(&mut body, 100, &[9.0]);
        assert!((body.joint_torques_nm()[0] - 3.0).abs() < 1e-6, "kp {kp}: {} N·m", body.joint_torques_nm()[0]);
        // MuJoCo 4.0 stands like this.
        assert!((body.joint_angles()[0] - 0.560_017).abs() < 1e-5, "kp {kp}: {} rad", body.joint_angles()[0]);
        assert!(body.joint_rates()[0].abs() < 1e-4, "kp {kp}: {} rad/s", body.joint_rates()[0]);
    }
}
