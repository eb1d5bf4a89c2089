//! The motion task, with a robot of 29 hinges and a card.

use std::f64::consts::TAU;

use treadmill_humanoid::config::MotionConfig;
use treadmill_humanoid::mjcf::with_motions;
use treadmill_humanoid::motion::{MotionClip, SampledMotion};
use treadmill_humanoid::task::motion::MotionTask;
use treadmill_humanoid::task::{EpisodeStart, Reached, Step};
use treadmill_humanoid::{
    EnvConfig, EnvTask, Environment, EnvironmentConfig, Mirror, Model, Physics, RandomisationConfig, Task,
};

use crate::physics_version::Scene;
use crate::support::reset;
use crate::velocity::{CARD, with_card};

const STEP_S: f64 = 0.02;
/// Hinges' angles and rates of the motion, anchor position and orientation, linear and angular velocity, 29 × (angle, rate,
/// action).
const OF_POLICY: usize = 58 + 3 + 6 + 3 + 3 + 3 * 29;

fn config(motion: MotionConfig) -> EnvironmentConfig {
    let env = EnvConfig {
        task: EnvTask::Motion,
        control_step_s: STEP_S,
        substeps: 5,
        reset_noise_scale: 0.0,
        ..EnvConfig::default()
    };
    EnvironmentConfig { env, motion, ..EnvironmentConfig::default() }
}

/// Settings with which episodes begin exactly at the motion.
fn exact() -> MotionConfig {
    MotionConfig {
        start_xy_m: 0.0,
        start_z_m: 0.0,
        start_tilt_rad: 0.0,
        start_yaw_rad: 0.0,
        start_xy_mps: 0.0,
        start_z_mps: 0.0,
        start_tilt_radps: 0.0,
        start_yaw_radps: 0.0,
        start_hinge_rad: 0.0,
        first_share: 0.0,
        ..MotionConfig::default()
    }
}

/// Motion of 3 s in which the robot turns, shifts and swings every hinge a little about its default pose.
fn motion() -> MotionClip {
    let model = Model::from_mjcf(&with_card(CARD)).unwrap();
    let default = model.robot.as_ref().unwrap().default_position.clone();
    let hinges: Vec<String> = model.hinges.iter().map(|hinge| hinge.name.clone()).collect();
    let frame = |number: usize| -> Vec<f32> {
        let time_s = number as f64 / 50.0;
        let (sin, cos) = (0.1 * time_s).sin_cos();
        let root = [0.2 * time_s, 0.05 * time_s, default[2] + 0.02, cos, 0.0, 0.0, sin];
        let angle = |(hinge, middle): (usize, &f64)| middle + 0.05 * (TAU * time_s + hinge as f64).sin();
        root.into_iter().chain(default[7..].iter().enumerate().map(angle)).map(|number| number as f32).collect()
    };
    MotionClip::new("swing", 50.0, hinges, (0..151).flat_map(frame).collect()).unwrap()
}

fn model_with(motions: &[MotionClip]) -> String {
    with_motions(&with_card(CARD), motions).unwrap()
}

fn environment(config: &EnvironmentConfig) -> Environment {
    Environment::new(config, &model_with(&[motion()])).unwrap()
}

/// Returns settings, seed and model of a robot that imitates the motion.
pub(crate) fn scene() -> Scene {
    (config(MotionConfig { future_steps: 1, first_share: 0.0, ..MotionConfig::default() }), 3, model_with(&[motion()]))
}

/// Task and simulation, with the motion control step by control step.
fn task(config: &EnvironmentConfig) -> (MotionTask, Physics, SampledMotion) {
    let model = Model::from_mjcf(&model_with(&[motion()])).unwrap();
    let default = model.robot.as_ref().unwrap().default_position.clone();
    let mut physics = Physics::new(model, config).unwrap();
    physics.set_state(&default, &vec![0.0; physics.model().velocity_size()]);
    (MotionTask::new(config, &physics).unwrap(), physics, SampledMotion::new(&motion(), STEP_S))
}

#[test]
fn the_terms_have_mjlabs_names_and_those_of_the_critic_come_last() {
    let names = |motion: MotionConfig| {
        let environment = environment(&config(motion));
        let terms = environment.terms().iter();
        let of_policy: Vec<_> = terms.clone().filter(|term| !term.is_privileged).map(|term| &*term.name).collect();
        let size = environment.observation_size() - environment.privileged_size();
        (of_policy.join(" "), size)
    };
    let (known, size) = names(MotionConfig::default());
    let expected =
        "command motion_anchor_pos_b motion_anchor_ori_b base_lin_vel base_ang_vel joint_pos joint_vel actions";
    assert_eq!((&*known, size), (expected, OF_POLICY));
    let (blind, size) = names(MotionConfig { state_estimation: false, future_steps: 2, ..MotionConfig::default() });
    let expected = "command command_future motion_anchor_ori_b base_ang_vel joint_pos joint_vel actions";
    assert_eq!((&*blind, size), (expected, OF_POLICY - 6 + 58));
}

/// Returns reward terms and end of a robot at the motion's second control step, moved by `change`.
fn evaluated(change: impl Fn(&mut Vec<f64>, &mut Vec<f64>)) -> (Vec<(&'static str, f64)>, bool, f32) {
    let config = config(exact());
    let (mut task, mut physics, sampled) = task(&config);
    task.begin(1, &physics);
    let (mut position, mut velocity) = (sampled.positions[1].clone(), sampled.velocities[1].clone());
    change(&mut position, &mut velocity);
    physics.set_state(&position, &velocity);
    let default = &physics.model().robot.as_ref().unwrap().default_position[7..];
    let action: Vec<f32> = default.iter().map(|angle| *angle as f32).collect();
    let step = Step { physics: &physics, action: &action, centre_before_m: physics.centre_of_mass() };
    let evaluation = task.evaluate(&step);
    let mut terms = Vec::new();
    task.reward_terms(&mut |name, value| terms.push((name, value)));
    (terms, evaluation.terminated, evaluation.reward)
}

#[test]
fn terms_of_the_reward_are_those_computed_by_hand() {
    let weights = [0.5, 0.5, 1.0, 1.0, 1.0, 1.0];
    let check = |change: &dyn Fn(&mut Vec<f64>, &mut Vec<f64>), shares: [f64; 6]| {
        let (terms, terminated, reward) = evaluated(change);
        assert!(!terminated);
        for (((name, value), share), weight) in terms.iter().zip(shares).zip(weights) {
            assert!((value - weight * share).abs() < 2e-4, "{name}: {value}, expected {weight} × {share}");
        }
        let sum: f64 = terms.iter().map(|(_, value)| value).sum();
        assert!((sum - f64::from(reward)).abs() < 1e-5);
    };
    let near = (-1.0_f64).exp();
    check(&|_, _| (), [1.0; 6]);
    // The motion moves with the robot for all terms but the anchor's.
    check(&|position, _| position[0] += 0.3, [near, 1.0, 1.0, 1.0, 1.0, 1.0]);
    // Higher by 10 cm: all bodies are, by 0.01 m² of a width of 0.3 m.
    let higher = (-0.01_f64 / 0.09).exp();
    check(&|position, _| position[2] += 0.1, [higher, 1.0, higher, 1.0, 1.0, 1.0]);
    // Faster by 1 m/s, and turning faster by 3.14 rad/s about the vertical, which also moves what is beside the base.
    check(&|_, velocity| velocity[0] += 1.0, [1.0, 1.0, 1.0, 1.0, near, 1.0]);
    let (terms, ..) = evaluated(|_, velocity| velocity[5] += std::f64::consts::PI);
    assert!((terms[5].1 - near).abs() < 2e-4, "{terms:?}");
    // Turned by 0.4 rad about the vertical through the anchor: its angle alone.
    let (terms, ..) = evaluated(|position, _| {
        let (sin, cos) = 0.2_f64.sin_cos();
        let [w, x, y, z] = [position[3], position[4], position[5], position[6]];
        position[3..7].copy_from_slice(&[cos * w - sin * z, cos * x - sin * y, cos * y + sin * x, cos * z + sin * w]);
    });
    assert!((terms[1].1 - 0.5 * near).abs() < 2e-4 && (terms[3].1 - 1.0).abs() < 2e-4, "{terms:?}");
}

#[test]
fn an_episode_ends_where_anchor_or_ends_leave_the_motion() {
    assert!(!evaluated(|position, _| position[2] += 0.24).1);
    assert!(evaluated(|position, _| position[2] += 0.26).1);
    // Lying: the vertical part of gravity in the anchor's frame is 0 instead of -1.
    assert!(evaluated(|position, _| position[3..7].copy_from_slice(&[0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt(), 0.0])).1);
    let hinges = motion().hinges;
    let knees: Vec<usize> = (0..hinges.len()).filter(|hinge| hinges[*hinge].contains("knee")).collect();
    assert_eq!(knees.len(), 2);
    assert!(evaluated(|position, _| position[7 + knees[0]] += 1.6).1);
}

#[test]
fn the_end_of_a_motion_is_a_truncation_and_episodes_without_training_begin_with_it() {
    let config = EnvironmentConfig { has_curricula: false, ..config(exact()) };
    let (mut task, mut physics, sampled) = task(&config);
    let (mut position, mut velocity) = (sampled.positions[0].clone(), sampled.velocities[0].clone());
    for seed in [0, 1, 2] {
        task.start(seed, &physics, EpisodeStart { position: &mut position, velocity: &mut velocity });
        assert_eq!(position, sampled.positions[0]);
    }
    task.begin(1, &physics);
    let action = vec![0.0; physics.model().motors.len()];
    for (number, (position, velocity)) in sampled.positions.iter().zip(&sampled.velocities).enumerate().skip(1) {
        physics.set_state(position, velocity);
        let step = Step { physics: &physics, action: &action, centre_before_m: physics.centre_of_mass() };
        let evaluation = task.evaluate(&step);
        assert!(task.errors().body_m < 1e-3 && task.errors().hinge_rad < 1e-9, "{number}: {:?}", task.errors());
        assert_eq!((evaluation.terminated, evaluation.truncated), (false, number + 1 == sampled.positions.len()));
    }
}

#[test]
fn evaluations_begin_with_each_motion_in_turn() {
    let longer =
        MotionClip::new("other", 25.0, motion().hinges, motion().frames().flatten().copied().collect()).unwrap();
    let config = EnvironmentConfig { has_curricula: false, ..config(exact()) };
    let mut environment = Environment::new(&config, &model_with(&[motion(), longer])).unwrap();
    let mut durations = Vec::new();
    for number in 0..3 {
        environment.choose_start(number);
        reset(&mut environment, number);
        let task: &dyn std::any::Any = environment.task();
        let task: &MotionTask = task.downcast_ref().unwrap();
        let (name, time_s, duration_s) = task.place(environment.physics());
        assert!((time_s - STEP_S).abs() < 1e-9, "{name}: {time_s}");
        durations.push((name, (duration_s * 100.0).round() as u32));
    }
    assert_eq!(durations, [("swing".to_owned(), 300), ("other".to_owned(), 600), ("swing".to_owned(), 300)]);
}

#[test]
fn a_share_of_the_episodes_begins_at_a_first_frame() {
    let other =
        MotionClip::new("other", 50.0, motion().hinges, motion().frames().flatten().copied().collect()).unwrap();
    let config = config(MotionConfig { first_share: 0.5, ..exact() });
    let mut environment = Environment::new(&config, &model_with(&[motion(), other])).unwrap();
    let mut began = [0; 3];
    for seed in 0..400 {
        reset(&mut environment, seed);
        let task: &dyn std::any::Any = environment.task();
        let (name, time_s, _) = task.downcast_ref::<MotionTask>().unwrap().place(environment.physics());
        let is_first = (time_s - STEP_S).abs() < 1e-9;
        let kind = match (is_first, &name[..]) {
            (false, _) => 0,
            (true, "swing") => 1,
            (true, _) => 2,
        };
        began[kind] += 1;
    }
    // A half, and a quarter at each motion.
    assert!((160..240).contains(&began[0]) && began[1..].iter().all(|count| (70..130).contains(count)), "{began:?}");
}

#[test]
fn an_environment_goes_back_to_where_it_failed_until_it_has_come_past() {
    let never_uniform = MotionConfig { uniform_share: 0.0, lead_s: 0.5, ..exact() };
    let (mut task, mut physics, sampled) = task(&config(never_uniform));
    let begins = |task: &mut MotionTask, physics: &Physics, seed: u64| {
        let (mut position, mut velocity) = (sampled.positions[0].clone(), sampled.velocities[0].clone());
        task.start(seed, physics, EpisodeStart { position: &mut position, velocity: &mut velocity });
        task.begin(seed, physics);
        sampled.positions.iter().position(|known| (known[0] - position[0]).abs() < 1e-9).unwrap()
    };
    // Anywhere before the first failure.
    let first: Vec<usize> = (0..100).map(|seed| begins(&mut task, &physics, seed)).collect();
    assert!(first.iter().any(|step| *step < 30) && first.iter().any(|step| *step > 110), "{first:?}");
    let action = vec![0.0; physics.model().motors.len()];
    let play = |task: &mut MotionTask, physics: &mut Physics, step: usize, lift_m: f64| {
        let mut position = sampled.positions[step].clone();
        position[2] += lift_m;
        physics.set_state(&position, &sampled.velocities[step]);
        let step = Step { physics, action: &action, centre_before_m: physics.centre_of_mass() };
        task.evaluate(&step).terminated
    };
    let seed = (0..).find(|seed| begins(&mut task, &physics, *seed) == 80).unwrap();
    assert_eq!(begins(&mut task, &physics, seed), 80);
    assert!(!play(&mut task, &mut physics, 81, 0.0));
    assert_eq!(task.difficulty().failed_step, None);
    assert!(play(&mut task, &mut physics, 82, 1.0));
    assert_eq!(task.difficulty().failed_step, Some(82));
    // Up to 25 control steps before the failure at 82.
    let again: Vec<usize> = (0..200).map(|seed| begins(&mut task, &physics, seed)).collect();
    assert!(again.iter().all(|step| (57..82).contains(step)), "{again:?}");
    assert_eq!(task.difficulty().failed_step, None);
    // An episode that begins behind it does not end that.
    let mut behind = task.save();
    behind[1..5].copy_from_slice(&[120.0, 1.0, 82.0, 119.0]);
    task.restore(&behind).unwrap();
    for step in 120..151 {
        assert!(!play(&mut task, &mut physics, step, 0.0));
    }
    assert!((0..50).all(|seed| (57..82).contains(&begins(&mut task, &physics, seed))));
    // It survives the saving, and ends when the robot has come past by as much.
    let saved = task.save();
    let first = begins(&mut task, &physics, 5);
    for step in first + 1..=107 {
        assert!(!play(&mut task, &mut physics, step, 0.0));
    }
    let after: Vec<usize> = (0..100).map(|seed| begins(&mut task, &physics, seed)).collect();
    assert!(after.iter().any(|step| *step < 30), "{after:?}");
    task.restore(&saved).unwrap();
    assert!((0..50).all(|seed| (57..82).contains(&begins(&mut task, &physics, seed))));
    assert!(task.restore(&saved[1..]).is_err());
    // A new environment begins where others of the run fail; numbers from the bus may be of no motion.
    let failed_steps: &[u32] = &[82, u32::MAX];
    let adopted: Vec<usize> = (0..100)
        .map(|seed| {
            task.adopt_curricula(&Reached { failed_steps, ..Reached::default() }, seed);
            begins(&mut task, &physics, seed)
        })
        .collect();
    for range in [57..82, 125..150] {
        assert!(adopted.iter().filter(|step| range.contains(*step)).count() > 30, "{adopted:?}");
    }
    assert!(adopted.iter().all(|step| (57..82).contains(step) || (125..150).contains(step)), "{adopted:?}");
}

#[test]
fn a_mirrored_robot_with_a_mirrored_motion_observes_the_mirror_image() {
    let motion = motion();
    let model = Model::from_mjcf(&with_card(CARD)).unwrap();
    let mirror = Mirror::of(&model).unwrap();
    let reflect = |from: &[f64], by: &[(usize, f32)]| -> Vec<f64> {
        by.iter().map(|(at, sign)| from[*at] * f64::from(*sign)).collect()
    };
    let frames = motion.frames().flat_map(|frame| {
        let wide: Vec<f64> = frame.iter().map(|number| f64::from(*number)).collect();
        reflect(&wide, &mirror.position).into_iter().map(|number| number as f32).collect::<Vec<_>>()
    });
    let mirrored = MotionClip::new("mirrored", 50.0, motion.hinges.clone(), frames.collect()).unwrap();
    let config = EnvironmentConfig { has_curricula: false, ..config(MotionConfig { future_steps: 1, ..exact() }) };
    let mut one = Environment::new(&config, &model_with(&[motion])).unwrap();
    let mut other = Environment::new(&config, &model_with(&[mirrored])).unwrap();
    let (mut seen, mut image) = (reset(&mut one, 1), reset(&mut other, 1));
    let (mut position, velocity) = (one.physics().position().to_vec(), one.physics().velocity().to_vec());
    // A robot that is not quite at its motion.
    position.iter_mut().enumerate().for_each(|(at, entry)| *entry += 0.01 * ((at * at) as f64).sin());
    one.physics_mut().set_state(&position, &velocity);
    let (position, velocity) = (reflect(&position, &mirror.position), reflect(&velocity, &mirror.velocity));
    other.physics_mut().set_state(&position, &velocity);
    one.observe(&mut seen).unwrap();
    other.observe(&mut image).unwrap();
    let permutation = one.task().mirrored(&mirror).unwrap();
    assert_eq!(permutation.len(), seen.len());
    for term in one.terms() {
        for at in term.range.clone() {
            let (from, sign) = permutation[at];
            let expected = seen[from] * sign;
            assert!((image[at] - expected).abs() < 2e-4, "{} {at}: {} {expected}", term.name, image[at]);
        }
    }
}

#[test]
fn an_episode_continues_bit_for_bit_in_another_environment() {
    let randomisation = RandomisationConfig {
        push_mps: [0.1, 0.5],
        push_interval_s: [0.1, 0.2],
        sensor_noise_position: 0.01,
        sensor_noise_velocity: 0.1,
        encoder_bias_rad: 0.02,
        ..RandomisationConfig::default()
    };
    let config = EnvironmentConfig { randomisation, ..config(MotionConfig::default()) };
    let (mut one, mut other) = (environment(&config), environment(&config));
    let mut row = reset(&mut one, 7);
    let action: Vec<f32> = one.nominal_position()[7..].iter().map(|angle| *angle as f32).collect();
    for _ in 0..3 {
        assert!(!one.step(&action, &mut row).terminated);
    }
    let mut continued = row.clone();
    other.resume_episode(&one.episode_state().unwrap(), &mut continued).unwrap();
    assert_eq!(continued, row);
    for _ in 0..5 {
        let outcomes = (one.step(&action, &mut row), other.step(&action, &mut continued));
        assert_eq!(outcomes.0.reward.to_bits(), outcomes.1.reward.to_bits());
        assert_eq!(row, continued);
    }
}

#[test]
fn what_is_missing_is_named() {
    let refused = |config: &EnvironmentConfig, text: &str| match Environment::new(config, text) {
        Ok(_) => panic!("it is refused"),
        Err(why) => why.to_string(),
    };
    assert!(refused(&config(exact()), &with_card(CARD)).contains("--motion FILE"));
    let plain = include_str!("../../assets/g1-like-servos.xml");
    let motions = with_motions(plain, &[motion()]).unwrap();
    assert!(refused(&config(exact()), &motions).contains("needs a robot card"));
    let long =
        MotionClip::new("long", 1.0, self::motion().hinges, self::motion().frames().flatten().copied().collect())
            .unwrap();
    let why = refused(&config(exact()), &model_with(&vec![long; 60]));
    assert!(why.contains("the motions have 450060 control steps; allowed: 400000"), "{why}");
    for (key, motion) in [
        ("motion.anchor", MotionConfig { anchor: "tail".into(), ..exact() }),
        ("motion.bodies", MotionConfig { bodies: vec!["tail".into()], ..exact() }),
        ("motion.end_effectors", MotionConfig { end_effectors: vec!["tail".into()], ..exact() }),
    ] {
        let why = refused(&config(motion), &model_with(&[self::motion()]));
        assert!(why.contains(key) && why.contains("no link `tail`; it has: "), "{why}");
    }
}
