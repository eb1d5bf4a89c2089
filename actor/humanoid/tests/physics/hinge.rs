//! One hinge between two bodies, compared with the closed form of its motion.

use treadmill_humanoid::Physics;

use crate::{CONTROL_STEP_S, advance, with_substeps};

const ROOT_INERTIA_KGM2: f64 = 0.3;
const LINK_INERTIA_KGM2: f64 = 0.02;
/// Effective inertia of two bodies that turn about one axis through both centres of mass: 1 / Σ 1/inertia.
pub(crate) const REDUCED_KGM2: f64 = ROOT_INERTIA_KGM2 * LINK_INERTIA_KGM2 / (ROOT_INERTIA_KGM2 + LINK_INERTIA_KGM2);

/// Two bodies without gravity on one hinge about y with the given attributes, and a motor of 1 N·m per unit of control.
pub(crate) fn pair(joint: &str, substeps: u32) -> Physics {
    let text = format!(
        r#"<mujoco><compiler angle="degree"/><option gravity="0 0 0"/>
           <worldbody><geom type="plane" size="1 1 1"/><body pos="0 0 5"><freejoint/>
           <inertial pos="0 0 0" mass="2" diaginertia="0.3 0.3 0.3"/>
           <body><joint name="j" axis="0 1 0" {joint}/><inertial pos="0 0 0" mass="1" diaginertia="0.02 0.02 0.02"/></body>
           </body></worldbody><actuator><motor joint="j" ctrlrange="-10 10"/></actuator></mujoco>"#
    );
    with_substeps(&text, substeps)
}

pub(crate) fn start(body: &mut Physics, angle_rad: f64, rate_radps: f64) {
    let mut position = body.model().nominal_position();
    position[7] = angle_rad;
    body.set_state(&position, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, rate_radps]);
}

const ARMATURE_KGM2: f64 = 0.01;
const DAMPING_NMSPRAD: f64 = 0.15;
const STIFFNESS_NMPRAD: f64 = 4.0;
const TORQUE_NM: f64 = 1.5;
/// 20° in the text.
const REST_RAD: f64 = std::f64::consts::PI / 9.0;

/// Angle (rad) and rate (rad/s) of J θ″ = τ − c θ′ − k (θ − θ₀), under-damped, after a time.
fn oscillation(angle_rad: f64, rate_radps: f64, time_s: f64) -> [f64; 2] {
    let inertia = REDUCED_KGM2 + ARMATURE_KGM2;
    let decay = DAMPING_NMSPRAD / (2.0 * inertia);
    let frequency = (STIFFNESS_NMPRAD / inertia - decay * decay).sqrt();
    let middle = REST_RAD + TORQUE_NM / STIFFNESS_NMPRAD;
    let (a, b) = (angle_rad - middle, (rate_radps + decay * (angle_rad - middle)) / frequency);
    let ((sin, cos), shrunk) = ((frequency * time_s).sin_cos(), (-decay * time_s).exp());
    let swing = a * cos + b * sin;
    [middle + shrunk * swing, shrunk * (frequency * (b * cos - a * sin) - decay * swing)]
}

/// Largest errors of angle (rad) and rate (rad/s) over 0.6 s.
fn errors(substeps: u32) -> [f64; 2] {
    let mut body = pair("armature=\"0.01\" damping=\"0.15\" stiffness=\"4\" springref=\"20\"", substeps);
    let (angle_rad, rate_radps) = (-0.4, 2.0);
    start(&mut body, angle_rad, rate_radps);
    let mut worst = [0.0f64; 2];
    for step in 1..=40 {
        body.step_only(&[TORQUE_NM as f32]).expect("finite");
        let wanted = oscillation(angle_rad, rate_radps, f64::from(step) * CONTROL_STEP_S);
        worst[0] = worst[0].max((body.joint_angles()[0] - wanted[0]).abs());
        worst[1] = worst[1].max((body.joint_rates()[0] - wanted[1]).abs());
    }
    worst
}

#[test]
fn a_driven_damped_spring_hinge_follows_the_closed_form() {
    let all: Vec<[f64; 2]> = [1, 2, 4, 8, 16].into_iter().map(errors).collect();
    for pair in all.windows(2) {
        // Second order: half the step gives a quarter of the error.
        for (coarse, fine) in pair[0].iter().zip(&pair[1]) {
            assert!((3.5..4.5).contains(&(coarse / fine)), "{all:?}");
        }
    }
    // With the default of four physics steps; the hinge swings by 1.5 rad at up to 12 rad/s.
    assert!(all[2][0] < 5e-4 && all[2][1] < 5e-3, "{all:?}");
}

#[test]
fn armature_adds_inertia_to_the_hinge_only() {
    for armature in [0.0, 0.05, 1.0] {
        let mut body = pair(&format!("armature=\"{armature}\""), 2);
        start(&mut body, 0.3, 0.0);
        for step in 1..=10 {
            body.step_only(&[2.0]).expect("finite");
            let rate = 2.0 / (REDUCED_KGM2 + armature) * f64::from(step) * CONTROL_STEP_S;
            assert!((body.joint_rates()[0] / rate - 1.0).abs() < 5e-7, "armature {armature}");
            // The bodies' angular momenta sum to zero for any armature.
            let spin = [0, 1].map(|index| body.body_motion(index).angular_radps.y);
            let sum = ROOT_INERTIA_KGM2 * spin[0] + LINK_INERTIA_KGM2 * spin[1];
            // Each is up to 0.3 N·m·s.
            assert!(sum.abs() < 3e-7 && spin[1] > 0.0 && spin[0] < 0.0, "armature {armature}: {spin:?}");
        }
    }
}

#[test]
fn a_slow_hinge_keeps_its_rate() {
    // At 1 rad a physics step turns it by less than single precision resolves.
    let mut body = pair("", 4);
    start(&mut body, 1.0, 1e-5);
    advance(&mut body, 1000, &[0.0]);
    let turned_rad = body.joint_angles()[0] - 1.0;
    assert!((turned_rad / (1e-5 * 1000.0 * CONTROL_STEP_S) - 1.0).abs() < 1e-4, "it turned by {turned_rad} rad");
}

#[test]
fn a_spring_comes_to_rest_at_its_rest_angle_with_and_without_a_range() {
    for (joint, wanted) in [
        ("stiffness=\"5\" damping=\"0.3\" springref=\"-35\"", -35f64),
        ("stiffness=\"5\" damping=\"0.3\" springref=\"15\" range=\"-10 20\"", 15.0),
        // Not at 40°: the range ends at 20°, where it is soft.
        ("stiffness=\"1\" damping=\"0.3\" springref=\"40\" range=\"-10 20\"", 20.0),
    ] {
        let mut body = pair(joint, 2);
        start(&mut body, 0.0, 1.0);
        advance(&mut body, 400, &[0.0]);
        let off = body.joint_angles()[0] - wanted.to_radians();
        let tolerance = if wanted == 20.0 { 1e-3 } else { 2e-7 };
        assert!(off.abs() < tolerance, "{joint}: off by {off} rad");
        assert!(body.joint_rates()[0].abs() < 1e-6);
    }
}
