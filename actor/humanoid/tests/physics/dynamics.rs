//! Accuracy of the articulated body without contacts: symmetry, conservation laws, limits, springs.

use nalgebra::{UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use treadmill_humanoid::{EnvConfig, EnvObservation, HUMANOID_XML, Mirror, Model, Observation, Physics};

use crate::{CONTROL_STEP_S, IDLE, STILL, WEIGHTLESS, advance, humanoid_text as changed, with_settings};

const GRAVITY_MPS2: f64 = 9.81;

const WITHOUT_LIMITS: (&str, &str) = ("limited=\"true\" damping", "limited=\"false\" damping");
const WITHOUT_FRICTION: [(&str, &str); 2] = [("damping=\"5\"", "damping=\"0\""), ("damping=\"1\"", "damping=\"0\"")];

/// Physics without self-collision, for states far above the floor.
fn flying(xml: &str, substeps: u32) -> Physics {
    with_settings(xml, &EnvConfig { substeps, self_collision: false, ..EnvConfig::default() })
}

/// Random state 100 m up with any orientation, hinges in the inner part of their ranges, and rates up to `rate`.
fn random_state(model: &Model, random: &mut Xoshiro256PlusPlus, rate: f64) -> (Vec<f64>, Vec<f64>) {
    let mut position = vec![random.random_range(-5.0..5.0), random.random_range(-5.0..5.0), 100.0];
    let turn = Vector3::from_fn(|_, _| random.random_range(-3.0..3.0));
    let quaternion = UnitQuaternion::from_scaled_axis(turn);
    position.extend([quaternion.w, quaternion.i, quaternion.j, quaternion.k]);
    for hinge in &model.hinges {
        let share = random.random_range(0.2..0.8);
        position.push(hinge.min_rad + share * (hinge.max_rad - hinge.min_rad));
    }
    // Hinges without limits get any angle.
    for angle in &mut position[7..] {
        if !angle.is_finite() {
            *angle = random.random_range(-1.0..1.0);
        }
    }
    let velocity = (0..model.velocity_size()).map(|_| random.random_range(-rate..rate)).collect();
    (position, velocity)
}

/// Applies a signed permutation.
fn permuted(numbers: &[f64], permutation: &[(usize, f32)]) -> Vec<f64> {
    permutation.iter().map(|(at, sign)| numbers[*at] * f64::from(*sign)).collect()
}

fn mirrored(state: &(Vec<f64>, Vec<f64>), mirror: &Mirror) -> (Vec<f64>, Vec<f64>) {
    (permuted(&state.0, &mirror.position), permuted(&state.1, &mirror.velocity))
}

fn largest_difference(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}

/// Body and its mirror image. Two values that differ between left and right in Humanoid-v5 are made equal here.
struct Twins {
    body: Physics,
    image: Physics,
    model: Model,
    mirror: Mirror,
}

impl Twins {
    fn new(changes: &[(&str, &str)]) -> Self {
        let equal =
            [("stiffness=\"1\" armature=\"0.006\"", "armature=\"0.006\""), ("armature=\"0.008\"", "armature=\"0.01\"")];
        let xml = changed(&[&equal[..], changes].concat());
        let body = flying(&xml, 2);
        let model = body.model().clone();
        let mirror = Mirror::of(&model).expect("left and right are symmetric");
        let own: Vec<usize> = (0..17).filter(|motor| mirror.action[*motor].0 == *motor).collect();
        assert_eq!(own.len(), 3, "only the abdomen's motors are their own image");
        assert!(mirror.action.iter().any(|(_, sign)| *sign < 0.0) && mirror.action.iter().any(|(_, sign)| *sign > 0.0));
        Self { body, image: flying(&xml, 2), model, mirror }
    }

    fn set_state(&mut self, state: &(Vec<f64>, Vec<f64>)) {
        let (position, velocity) = mirrored(state, &self.mirror);
        self.body.set_state(&state.0, &state.1);
        self.image.set_state(&position, &velocity);
    }

    /// Steps both and returns their largest difference in any coordinate or rate.
    fn step(&mut self, controls: &[f32; 17]) -> f64 {
        let others: Vec<f32> = self.mirror.action.iter().map(|(at, sign)| controls[*at] * sign).collect();
        self.body.step_only(controls).expect("finite");
        self.image.step_only(&others).expect("finite");
        let state = (self.body.position().to_vec(), self.body.velocity().to_vec());
        let ((position, velocity), image) = (mirrored(&state, &self.mirror), self.image.position());
        // q and −q are the same rotation.
        let same: f64 = position[3..7].iter().zip(&image[3..7]).map(|(a, b)| a * b).sum();
        (1.0 - same.abs())
            .max(largest_difference(&position[..3], &image[..3]))
            .max(largest_difference(&position[7..], &image[7..]))
            .max(largest_difference(&velocity, self.image.velocity()))
    }

    fn exceeded_limits(&self) -> usize {
        let pairs = self.model.hinges.iter().zip(self.body.joint_angles());
        pairs.filter(|(hinge, angle)| hinge.overshoot_rad(**angle) > 0.0).count()
    }
}

#[test]
fn a_mirrored_body_has_the_mirrored_motion() {
    let mut twins = Twins::new(&[WITHOUT_LIMITS]);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(5);
    for _ in 0..8 {
        let state = random_state(&twins.model, &mut random, 3.0);
        twins.set_state(&state);
        for step in 0..20 {
            let off = twins.step(&std::array::from_fn(|_| random.random_range(-0.4..0.4)));
            // Hinges turn by up to 33 rad/s.
            assert!(off < 5e-4, "off by {off} after step {step}");
        }
    }
}

#[test]
fn a_mirrored_observation_is_that_of_the_mirrored_body() {
    let mut twins = Twins::new(&[]);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
    let mut state = random_state(&twins.model, &mut random, 3.0);
    // Low enough to touch the ground.
    state.0[2] = 0.4;
    twins.set_state(&state);
    twins.step(&std::array::from_fn(|_| random.random_range(-0.4..0.4)));
    let with_position = EnvConfig { exclude_current_positions_from_observation: false, ..EnvConfig::default() };
    let kind = |observation| EnvConfig { observation, ..EnvConfig::default() };
    let configs = [with_position, kind(EnvObservation::GymnasiumV5), kind(EnvObservation::GymnasiumV4)];
    for (config, size) in configs.iter().zip([47, 348, 376]) {
        let layout = Observation::new(config, &twins.model);
        let [body, image] = [&twins.body, &twins.image].map(|physics| {
            let mut observation = vec![0.0; size];
            layout.write(physics, &mut observation);
            observation
        });
        let touches = |contacts: &[f32]| contacts.iter().any(|part| part.abs() > 1.0);
        assert!(size == 47 || touches(&body[size - 78..]), "it touches the ground");
        for (entry, (at, sign)) in layout.mirrored(&twins.mirror).iter().enumerate() {
            let (found, expected) = (image[entry], sign * body[*at]);
            assert!((found - expected).abs() < 1e-3 * expected.abs().max(1.0), "{entry}: {found} {expected}");
        }
    }
}

#[test]
fn hinges_and_motors_without_a_mirror_image_are_named() {
    let limping = changed(&[("joint=\"left_hip_x\" gear=\"100\"", "joint=\"left_hip_x\" gear=\"90\"")]);
    let why = Mirror::of(flying(&limping, 2).model()).expect_err("one motor is weaker");
    assert!(why.contains("motor `right_hip_x`"), "{why}");
    let twisted =
        changed(&[("<joint name=\"left_hip_z\" axis=\"0 0 -1\"", "<joint name=\"left_hip_z\" axis=\"0 0.6 -0.8\"")]);
    let why = Mirror::of(flying(&twisted, 2).model()).expect_err("one axis is another");
    assert!(why.contains("of `right_hip_z`"), "{why}");
}

#[test]
fn limits_act_symmetrically() {
    let mut twins = Twins::new(&[]);
    let model = twins.model.clone();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(6);
    // One limit at a time: each hinge swings into either end.
    let (mut reached, mut worst) = (0, 0.0f64);
    for (hinge, limits) in model.hinges.iter().enumerate() {
        for (end, outwards) in [(limits.min_rad, -1.0), (limits.max_rad, 1.0)] {
            let mut state = random_state(&model, &mut random, 0.5);
            state.0[7 + hinge] = end - 0.03 * outwards;
            state.1[6 + hinge] = 4.0 * outwards;
            twins.set_state(&state);
            for _ in 0..4 {
                let off = twins.step(&IDLE);
                match twins.exceeded_limits() {
                    0 => {}
                    1 => reached += 1,
                    _ => break,
                }
                worst = worst.max(off);
            }
        }
    }
    assert!(reached > 50, "{reached}");
    assert!(worst < 1e-4, "off by {worst}");

    // Several limits at once affect each other. The solver sweeps over them without converging, which leaves a difference.
    let mut several = 0;
    let mut worst = 0.0f64;
    for _ in 0..40 {
        let mut state = random_state(&model, &mut random, 3.0);
        for _ in 0..20 {
            twins.set_state(&state);
            worst = worst.max(twins.step(&std::array::from_fn(|_| random.random_range(-0.4..0.4))));
            several += u32::from(twins.exceeded_limits() > 1);
            state = (twins.body.position().to_vec(), twins.body.velocity().to_vec());
        }
    }
    assert!(several > 50, "{several}");
    assert!(worst < 0.03, "off by {worst} rad/s");
}

#[test]
fn a_chain_of_hinges_composes_in_order() {
    let mut body = flying(HUMANOID_XML, 2);
    let model = body.model().clone();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(9);
    for _ in 0..20 {
        let (position, velocity) = random_state(&model, &mut random, 5.0);
        body.set_state(&position, &velocity);
        for (index, part) in model.bodies.iter().enumerate() {
            let Some(parent) = part.parent else { continue };
            let (own, above) = (body.body_motion(index), body.body_motion(parent));
            let (mut rotation, mut spin) = (above.pose.rotation * part.pose.rotation, above.angular_radps);
            for hinge in part.hinges.clone() {
                let axis = model.hinges[hinge].axis;
                spin += rotation * axis.into_inner() * velocity[6 + hinge];
                rotation *= UnitQuaternion::from_axis_angle(&axis, position[7 + hinge]);
            }
            assert!(own.pose.rotation.angle_to(&rotation) < 1e-6, "{}", part.name);
            assert!((own.angular_radps - spin).norm() < 5e-6, "{}", part.name);
            // Both sides of the joint have the same anchor.
            let anchor_m = model.hinges[part.hinges.start].anchor_m;
            let apart = own.pose * anchor_m - above.pose * (part.pose * anchor_m);
            assert!(apart.norm() < 5e-7, "{}", part.name);
        }
    }
}

#[test]
fn hinges_at_two_points_of_a_body_turn_it_one_after_the_other() {
    let text = r#"<mujoco><compiler angle="radian"/><option gravity="0 0 0"/><worldbody><geom type="plane" size="1 1 1"/>
        <body pos="0 0 5"><freejoint/><geom size="0.3"/>
        <body pos="0.1 0.2 0.3" quat="0.8 0.6 0 0">
        <joint name="one" pos="0 0 0.1" axis="0 1 0"/><joint name="two" pos="0.05 0 -0.2" axis="1 0 0"/>
        <geom type="box" size="0.1 0.05 0.2" pos="0 0 -0.1"/></body></body></worldbody>
        <actuator><motor joint="one"/></actuator></mujoco>"#;
    let mut body = crate::simulation(text);
    let (angles, rates) = ([0.7, -0.4], [1.5, -2.0]);
    let (mut position, mut velocity) = (body.position().to_vec(), body.velocity().to_vec());
    position[7..].copy_from_slice(&angles);
    velocity[6..].copy_from_slice(&rates);
    body.set_state(&position, &velocity);
    // Each hinge turns the body about its own point: T(a) R T(−a), the first one outermost.
    let about = |anchor_m: [f64; 3], axis: nalgebra::UnitVector3<f64>, angle: f64| {
        let there = nalgebra::Translation3::from(anchor_m);
        there * UnitQuaternion::from_axis_angle(&axis, angle) * there.inverse()
    };
    let at = |angles: [f64; 2]| {
        let one = about([0.0, 0.0, 0.1], Vector3::y_axis(), angles[0]);
        let two = about([0.05, 0.0, -0.2], Vector3::x_axis(), angles[1]);
        body.model().bodies[0].pose * body.model().bodies[1].pose * one * two
    };
    let motion = body.body_motion(1);
    assert!((motion.pose.translation.vector - at(angles).translation.vector).norm() < 1e-7);
    assert!(motion.pose.rotation.angle_to(&at(angles).rotation) < 1e-7);
    let late = at([angles[0] + 1e-6 * rates[0], angles[1] + 1e-6 * rates[1]]);
    let centre_m = body.model().bodies[1].centre_of_mass_m;
    let mean_mps = (late * centre_m - at(angles) * centre_m) / 1e-6;
    assert!((motion.linear_mps - mean_mps).norm() < 1e-5);
}

/// Kinetic energy of bodies and rotors, spring energy and potential energy (J).
pub fn energy_j(body: &Physics) -> f64 {
    let model = body.model();
    let mut sum = 0.0;
    for (part, motion) in model.bodies.iter().zip(body.body_motions()) {
        let local = motion.pose.rotation.inverse() * motion.angular_radps;
        sum += part.mass_kg * motion.linear_mps.norm_squared() / 2.0 + local.dot(&(part.inertia_kgm2 * local)) / 2.0;
        sum -= part.mass_kg * model.gravity_mps2.dot(&(motion.pose * part.centre_of_mass_m).coords);
    }
    for ((hinge, angle), rate) in model.hinges.iter().zip(body.joint_angles()).zip(body.joint_rates()) {
        sum +=
            hinge.armature_kgm2 * rate * rate / 2.0 + hinge.stiffness_nmprad * (angle - hinge.rest_rad).powi(2) / 2.0;
    }
    sum
}

/// Largest energy change (J) of a passive body without friction and limits in 1 s of fall.
fn energy_drift_j(substeps: u32) -> f64 {
    let mut body = flying(&changed(&[&WITHOUT_FRICTION[..], &[WITHOUT_LIMITS]].concat()), substeps);
    let model = body.model().clone();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(3);
    let mut worst = 0.0f64;
    for _ in 0..4 {
        let (position, velocity) = random_state(&model, &mut random, 1.5);
        body.set_state(&position, &velocity);
        let start = energy_j(&body);
        for _ in 0..(1.0 / CONTROL_STEP_S) as u32 {
            body.step_only(&IDLE).expect("finite");
            worst = worst.max((energy_j(&body) - start).abs());
        }
    }
    worst
}

#[test]
fn a_passive_body_conserves_energy_to_second_order() {
    let (coarse, fine) = (energy_drift_j(4), energy_drift_j(16));
    // Kinetic energies are up to 250 J.
    assert!(coarse < 0.6, "{coarse} J");
    assert!(fine < coarse / 10.0, "not of second order: {fine} J of {coarse} J");
}

/// Momentum (N·s) and angular momentum about the centre of mass (N·m·s), from the bodies' motion.
pub fn momentum(body: &Physics) -> (Vector3<f64>, Vector3<f64>) {
    let centre = body.centre_of_mass();
    let (mut linear, mut angular) = (Vector3::zeros(), Vector3::zeros());
    for (part, motion) in body.model().bodies.iter().zip(body.body_motions()) {
        let impulse = motion.linear_mps * part.mass_kg;
        let local = motion.pose.rotation.inverse() * motion.angular_radps;
        linear += impulse;
        angular += (motion.pose * part.centre_of_mass_m - centre).cross(&impulse);
        angular += motion.pose.rotation * (part.inertia_kgm2 * local);
    }
    (linear, angular)
}

#[test]
fn only_gravity_changes_the_momentum_of_a_flying_body() {
    let mut body = flying(HUMANOID_XML, 2);
    let model = body.model().clone();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(17);
    let (mut reached, mut worst) = (0, 0.0f64);
    for _ in 0..5 {
        let (position, velocity) = random_state(&model, &mut random, 3.0);
        body.set_state(&position, &velocity);
        let (linear, angular) = momentum(&body);
        let start = body.centre_of_mass();
        for step in 1..=60 {
            let controls: [f32; 17] = std::array::from_fn(|_| random.random_range(-0.4..0.4));
            body.step_only(&controls).expect("finite");
            reached += u32::from(body.limit_overshoot_rad() > 0.0);
            let time_s = f64::from(step) * CONTROL_STEP_S;
            let fallen = Vector3::new(0.0, 0.0, -GRAVITY_MPS2 * time_s);
            let (linear_now, angular_now) = momentum(&body);
            let wanted = linear + fallen * model.mass_kg();
            worst = worst.max((linear_now - wanted).norm() / linear.norm());
            worst = worst.max((angular_now - angular).norm() / angular.norm());
            // The centre of mass follows its parabola.
            let place = start + linear / model.mass_kg() * time_s + fallen * (time_s / 2.0);
            worst = worst.max((body.centre_of_mass() - place).norm());
        }
    }
    assert!(reached > 100, "too few steps with exceeded limits");
    // 60 corrections of the momentum in single precision.
    assert!(worst < 1e-4, "off by {worst}");
}

/// How far each motor drives its hinge beyond the upper end of its range, at control 0.4, and beyond the lower end, at
/// −0.4 (rad): measured with MuJoCo 4.0 and steps of 0.5 ms, without gravity and contacts.
const MUJOCO_ABOVE_RAD: [f64; 17] = [
    0.0480, 0.0357, 0.0345, 0.0294, 0.0608, 0.1255, 0.2956, 0.0295, 0.0623, 0.1276, 0.2967, 0.0472, 0.0431, 0.0694,
    0.0469, 0.0495, 0.0680,
];
const MUJOCO_BELOW_RAD: [f64; 17] = [
    0.0339, 0.0347, 0.0345, 0.0323, 0.0529, 0.0861, 0.1981, 0.0315, 0.0529, 0.0818, 0.1919, 0.0470, 0.0517, 0.0725,
    0.0481, 0.0440, 0.0728,
];

#[test]
fn a_hinge_driven_against_an_end_yields_like_mujocos_and_comes_back() {
    let mut body = flying(&changed(&[WEIGHTLESS]), 4);
    let model = body.model().clone();
    let mut position = model.nominal_position();
    position[2] = 100.0;
    for (angle, hinge) in position[7..].iter_mut().zip(&model.hinges) {
        *angle = hinge.centre_rad();
    }
    for (motor, (above_rad, below_rad)) in MUJOCO_ABOVE_RAD.into_iter().zip(MUJOCO_BELOW_RAD).enumerate() {
        let hinge = model.motors[motor].hinge;
        let limits = &model.hinges[hinge];
        for (wanted_rad, control, end_rad) in [(above_rad, 0.4, limits.max_rad), (below_rad, -0.4, limits.min_rad)] {
            body.set_state(&position, &STILL);
            let mut controls = [0.0; 17];
            controls[motor] = control;
            let mut beyond = f64::NEG_INFINITY;
            for _ in 0..100 {
                body.step_only(&controls).expect("finite");
                beyond = beyond.max((body.joint_angles()[hinge] - end_rad) * f64::from(control).signum());
            }
            // The furthest moment lies between two control steps.
            assert!((beyond / wanted_rad - 1.0).abs() < 0.2, "{}: {beyond} rad, not {wanted_rad} rad", limits.name);
            advance(&mut body, 100, &IDLE);
            let left = limits.overshoot_rad(body.joint_angles()[hinge]);
            assert!(left < 1e-4, "{} stays {left} rad beyond {end_rad} rad", limits.name);
        }
    }
}
