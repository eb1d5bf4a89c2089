//! The velocity task, with a robot of 29 hinges and a card.

use treadmill_humanoid::config::{GroundConfig, GroundKind, RewardsConfig, VelocityConfig};
use treadmill_humanoid::task::velocity::Foot;
use treadmill_humanoid::{
    EnvConfig, EnvTask, Environment, EnvironmentConfig, EpisodeState, Mirror, RandomisationConfig,
};

use crate::ground::clearance_m;
use crate::support::reset;

const ROBOT_XML: &str = include_str!("../../assets/g1-like-servos.xml");
pub(crate) const CARD: &str = "feet = ['left_foot', 'right_foot']\n[[hinges]]\nnames = '*'\neffort_nm = 60.0\n";
/// Three angular velocities, gravity, command, 29 × (angle, rate, action), phase.
const OF_POLICY: usize = 3 + 3 + 3 + 3 * 29 + 2;
const OF_CRITIC: usize = 3 + 1 + 3 * 2;

fn config(velocity: VelocityConfig) -> EnvironmentConfig {
    let randomisation = RandomisationConfig {
        push_mps: [0.1, 0.5],
        push_interval_s: [0.2, 0.4],
        sensor_noise_position: 0.01,
        encoder_bias_rad: 0.02,
        action_delay_steps: [0, 2],
        kp_scale: [0.9, 1.1],
        kd_scale: [0.8, 1.2],
        com_offset_m: 0.03,
        ..RandomisationConfig::default()
    };
    EnvironmentConfig { env: walking(0.02), velocity, randomisation, ..EnvironmentConfig::default() }
}

/// Settings of the task in which episodes begin with this noise.
pub(crate) fn walking(reset_noise_scale: f64) -> EnvConfig {
    EnvConfig { task: EnvTask::Velocity, control_step_s: 0.02, substeps: 5, reset_noise_scale, ..EnvConfig::default() }
}

pub(crate) fn with_card(card: &str) -> String {
    let card = card.replace('\n', "&#10;");
    let custom = format!("<custom><text name='treadmill_robot_card' data=\"{card}\"/></custom></mujoco>");
    ROBOT_XML.replacen("</mujoco>", &custom, 1)
}

pub(crate) fn environment(config: &EnvironmentConfig) -> Environment {
    Environment::new(config, &with_card(CARD)).unwrap()
}

#[test]
fn the_terms_have_the_fields_names_and_those_of_the_critic_come_last() {
    for history in [1, 4] {
        let environment = environment(&config(VelocityConfig { history, ..VelocityConfig::default() }));
        let terms = environment.terms();
        let names: Vec<&str> = terms[..7].iter().map(|term| &term.name[..]).collect();
        let expected =
            "base_ang_vel projected_gravity velocity_commands joint_pos_rel joint_vel_rel last_action gait_phase";
        assert_eq!(names.join(" "), expected);
        let of_policy = terms.iter().filter(|term| !term.is_privileged).map(|term| term.range.end).max().unwrap();
        assert_eq!(of_policy, OF_POLICY * history as usize);
        assert!(terms.iter().filter(|term| term.is_privileged).all(|term| term.range.start >= of_policy));
        assert_eq!(environment.observation_size(), of_policy + OF_CRITIC);
        assert_eq!(environment.privileged_size(), OF_CRITIC);
    }
}

#[test]
fn noise_neither_lifts_a_robot_nor_sinks_it_into_the_ground() {
    let start = |noise: f64, seed: u64| {
        let env = EnvConfig { reset_noise_scale: noise, ..walking(0.0) };
        let mut environment = environment(&EnvironmentConfig { env, ..config(VelocityConfig::default()) });
        reset(&mut environment, seed);
        (clearance_m(environment.physics()), environment.physics().position()[2])
    };
    let (standing_m, base_m) = start(0.0, 0);
    for seed in 0..30 {
        let (clearance_m, noisy_m) = start(0.1, seed);
        assert!((clearance_m - standing_m).abs() < 1e-9, "seed {seed}: {clearance_m} m, {standing_m} m without noise");
        assert_ne!(noisy_m, base_m);
    }
}

#[test]
fn the_phase_rests_some_time_after_a_command_to_stand() {
    let velocity = VelocityConfig { gait_rests: true, gait_rests_after_s: 0.04, ..VelocityConfig::default() };
    let mut environment = environment(&config(velocity));
    let phase = environment.terms().iter().find(|term| term.name == "gait_phase").unwrap().range.clone();
    let action = middle(&environment);
    environment.steer(Some([0.5, 0.0, 0.0]));
    let mut row = reset(&mut environment, 5);
    let mut shown = Vec::new();
    let [still, slow] = [[0.05, 0.05, 0.06], [0.06, 0.06, 0.06]];
    for command in [still, still, still, still, slow, still] {
        environment.steer(Some(command));
        environment.step(&action, &mut row);
        shown.push(row[phase.clone()].iter().any(|number| *number != 0.0));
        // Another look at the same state is no time.
        environment.observe(&mut row).unwrap();
    }
    assert_eq!(shown, [true, true, false, false, true, true]);
}

#[test]
fn a_history_holds_the_last_observations_and_begins_with_the_first_one() {
    let mut environment = environment(&config(VelocityConfig { history: 3, ..VelocityConfig::default() }));
    let mut row = reset(&mut environment, 5);
    let part = |row: &[f32], index: usize| row[index * OF_POLICY..][..OF_POLICY].to_vec();
    assert!(part(&row, 0) == part(&row, 2) && part(&row, 1) == part(&row, 2));
    let first = part(&row, 2);
    let action = middle(&environment);
    environment.step(&action, &mut row);
    assert!(part(&row, 1) == first && part(&row, 2) != first);
    let second = part(&row, 2);
    let mut again = row.clone();
    environment.observe(&mut again).unwrap();
    environment.step(&action, &mut row);
    assert!(part(&row, 0) == first && part(&row, 1) == second, "an observation in between changes nothing");
}

#[test]
fn an_episode_goes_on_exactly_from_its_saved_state() {
    let config = config(VelocityConfig { history: 2, resampling_s: [0.1, 0.3], ..VelocityConfig::default() });
    let (mut original, mut other) = (environment(&config), environment(&config));
    let (mut left, mut right) = (reset(&mut original, 9), reset(&mut other, 1));
    let action_at = |step: usize, ranges: &[[f32; 2]]| -> Vec<f32> {
        let share = |motor: usize| 0.05 * ((step * 7 + motor * 3) as f32).sin();
        ranges.iter().enumerate().map(|(motor, [low, high])| (low + high) / 2.0 + (high - low) * share(motor)).collect()
    };
    for step in 0..25 {
        original.step(&action_at(step, original.action_ranges().to_vec().as_slice()), &mut left);
    }
    let state: EpisodeState = original.episode_state().unwrap();
    other.resume_episode(&state, &mut right).unwrap();
    assert!(left == right);
    let mut commands = Vec::new();
    for step in 25..70 {
        let action = action_at(step, original.action_ranges());
        let (expected, found) = (original.step(&action, &mut left), other.step(&action, &mut right));
        assert_eq!(expected.reward.to_bits(), found.reward.to_bits(), "step {step}");
        assert!(left.iter().zip(&right).all(|(left, right)| left.to_bits() == right.to_bits()), "step {step}");
        commands.push(original.task().command().unwrap()[0].to_bits());
        if expected.terminated {
            break;
        }
    }
    commands.dedup();
    assert!(commands.len() > 2, "commands change on the way");
}

#[test]
fn the_terms_of_a_reward_add_up_to_it() {
    let rewards = RewardsConfig { landing: -1.0, feet_slip: 0.0, ..RewardsConfig::default() };
    let velocity = EnvironmentConfig { rewards, ..config(VelocityConfig::default()) };
    let humanoid = EnvironmentConfig::default();
    for (mut environment, wanted, missing) in [
        (environment(&velocity), "landing", "feet_slip"),
        (Environment::new(&humanoid, treadmill_humanoid::HUMANOID_XML).unwrap(), "forward", ""),
    ] {
        let mut row = reset(&mut environment, 3);
        let action: Vec<f32> = environment.action_ranges().iter().map(|[low, high]| low + 0.6 * (high - low)).collect();
        for step in 0..20 {
            let reward = f64::from(environment.step(&action, &mut row).reward);
            let mut terms = Vec::new();
            environment.task().reward_terms(&mut |name, term| terms.push((name, term)));
            let sum: f64 = terms.iter().map(|(_, term)| term).sum();
            assert!((sum - reward).abs() < 1e-5 * reward.abs().max(1.0), "step {step}: {terms:?}, {reward}");
            assert!(terms.iter().any(|(name, term)| *name == wanted && term.is_finite()));
            assert!(terms.iter().all(|(name, _)| *name != missing), "terms without weight are no terms");
        }
    }
}

#[test]
fn a_steered_robot_is_told_what_the_user_says_until_that_ends() {
    let mut environment = environment(&config(VelocityConfig::default()));
    assert!(environment.steer(Some([0.4, -0.1, 0.2])));
    assert_eq!(reset(&mut environment, 3)[6..9], [0.4, -0.1, 0.2]);
    assert!(environment.steer(None));
    assert_ne!(reset(&mut environment, 3)[6..9], [0.4, -0.1, 0.2]);
    let mut humanoid = Environment::new(&EnvironmentConfig::default(), treadmill_humanoid::HUMANOID_XML).unwrap();
    assert!(!humanoid.steer(Some([0.0; 3])), "Gymnasium's task has no commands");
}

/// Returns the action in the middle of each range.
fn middle(environment: &Environment) -> Vec<f32> {
    environment.action_ranges().iter().map(|[low, high]| f32::midpoint(*low, *high)).collect()
}

#[test]
fn a_step_is_rewarded_for_the_command_that_the_policy_observed_before_it() {
    let config = config(VelocityConfig { resampling_s: [100.0, 100.0], ..VelocityConfig::default() });
    let (mut steered, mut other) = (environment(&config), environment(&config));
    let action = middle(&other);
    let (mut left, mut right) = (vec![0.0; other.observation_size()], vec![0.0; other.observation_size()]);
    for environment in [&mut steered, &mut other] {
        environment.steer(Some([0.25, 0.0, 0.0]));
        environment.reset(4, &mut left);
    }
    let changes = steered.task().command_changes();
    steered.steer(Some([-1.0, 0.5, 0.0]));
    assert_eq!(steered.task().command(), Some([-1.0, 0.5, 0.0]));
    let mut step = || {
        let rewards = (steered.step(&action, &mut left).reward, other.step(&action, &mut right).reward);
        assert_eq!((&left[6..9], &right[6..9]), (&[-1.0, 0.5, 0.0][..], &[0.25, 0.0, 0.0][..]));
        rewards
    };
    let (first, unsteered) = step();
    assert_eq!(first.to_bits(), unsteered.to_bits());
    let (second, unsteered) = step();
    assert_ne!(second.to_bits(), unsteered.to_bits());
    assert_eq!(steered.task().command_changes(), changes + 1);
    steered.steer(Some([-1.0, 0.5, 0.0]));
    assert_eq!(steered.task().command_changes(), changes + 1, "the same command again is no change");
}

#[test]
fn a_drawn_command_is_a_change_and_a_turning_heading_is_none() {
    let config = config(VelocityConfig {
        resampling_s: [0.1, 0.1],
        heading_share: 1.0,
        standing_share: 0.0,
        ..VelocityConfig::default()
    });
    let mut environment = environment(&config);
    let mut row = reset(&mut environment, 2);
    let action = middle(&environment);
    let begin = environment.task().command_changes();
    let mut yaw_rates = vec![environment.task().command().unwrap()[2]];
    for step in 1..=12 {
        environment.step(&action, &mut row);
        assert_eq!(environment.task().command_changes() - begin, step / 5, "step {step}");
        yaw_rates.push(environment.task().command().unwrap()[2]);
    }
    yaw_rates.dedup();
    assert!(yaw_rates.len() > 3, "{yaw_rates:?}");
}

#[test]
fn the_environment_says_which_steps_a_push_began() {
    let mut environment = environment(&config(VelocityConfig { fall_tilt_rad: 3.2, ..VelocityConfig::default() }));
    let mut row = reset(&mut environment, 2);
    let action = middle(&environment);
    let pushed: Vec<bool> = (0..60)
        .map(|_| {
            let before = environment.physics().velocity()[..2].to_vec();
            environment.begin_step(&action);
            let is_faster = environment.physics().velocity()[..2] != before[..];
            Environment::step_together(&mut std::iter::once(&mut environment));
            environment.finish_step(&mut row);
            assert_eq!(environment.was_pushed(), is_faster);
            is_faster
        })
        .collect();
    let count = pushed.iter().filter(|is_pushed| **is_pushed).count();
    assert!((2..=6).contains(&count), "every 10 to 20 steps: {pushed:?}");
    let last = pushed.iter().rposition(|is_pushed| *is_pushed).unwrap();
    environment.reset(2, &mut row);
    for _ in 0..=last {
        environment.step(&action, &mut row);
    }
    assert!(environment.was_pushed());
    environment.reset(2, &mut row);
    assert!(!environment.was_pushed());
}

#[test]
fn what_the_task_needs_and_lacks_is_named() {
    let refusal = |velocity: VelocityConfig, text: &str| {
        Environment::new(&config(velocity), text).err().expect("a refusal").to_string()
    };
    let why = refusal(VelocityConfig::default(), ROBOT_XML);
    assert!(why.contains("needs a robot card") && why.contains("env.robot"), "{why}");
    let why = refusal(VelocityConfig::default(), &with_card("[[hinges]]\nnames = '*'\neffort_nm = 60.0\n"));
    assert!(why.contains("needs two `feet`") && why.contains("it has 0"), "{why}");
    let why = refusal(VelocityConfig { lin_vel_x_mps: [0.0, 9.0], ..VelocityConfig::default() }, &with_card(CARD));
    assert!(why.contains("velocity.lin_vel_x_mps") && why.contains("[0.0, 9.0]") && why.contains("-5 to 5"), "{why}");
    let why = refusal(VelocityConfig { history: 17, ..VelocityConfig::default() }, &with_card(CARD));
    assert!(why.contains("velocity.history") && why.contains("17") && why.contains("1 to 16"), "{why}");
}

#[test]
fn the_mirror_image_of_an_observation_is_that_of_the_mirrored_robot() {
    let config =
        EnvironmentConfig { randomisation: RandomisationConfig::default(), ..config(VelocityConfig::default()) };
    let (mut original, mut image) = (environment(&config), environment(&config));
    let of_body = Mirror::of(original.physics().model()).unwrap();
    let reflection = original.task().mirrored(&of_body).unwrap();
    let mut row = reset(&mut original, 5);
    let action: Vec<f32> = original.action_ranges().iter().map(|[low, high]| low + 0.52 * (high - low)).collect();
    for _ in 0..10 {
        original.step(&action, &mut row);
    }
    original.steer(Some([0.4, 0.2, -0.3]));
    original.observe(&mut row).unwrap();

    let mut other = row.clone();
    image.reset(5, &mut other);
    image.steer(Some([0.4, -0.2, 0.3]));
    let apply = |numbers: &[f64], by: &[(usize, f32)]| -> Vec<f64> {
        by.iter().map(|(at, sign)| f64::from(*sign) * numbers[*at]).collect()
    };
    let (position, velocity) = (original.physics().position(), original.physics().velocity());
    let (position, velocity) = (apply(position, &of_body.position), apply(velocity, &of_body.velocity));
    image.physics_mut().set_state(&position, &velocity);
    image.observe(&mut other).unwrap();
    let expected: Vec<f32> = reflection.iter().map(|(at, sign)| sign * row[*at]).collect();
    let is_compared = |name: &str| !["last_action", "gait_phase"].contains(&name) && !name.starts_with("feet_");
    for term in original.terms().iter().filter(|term| is_compared(&term.name)) {
        for at in term.range.clone() {
            assert!((expected[at] - other[at]).abs() < 1e-5, "{}: {} {}", term.name, expected[at], other[at]);
        }
    }
    let terms = original.terms();
    let first = |name: &str| terms.iter().find(|term| term.name == name).unwrap().range.start;
    assert_eq!(reflection[first("feet_contact")], (first("feet_contact") + 1, 1.0));
    assert_eq!(reflection[first("gait_phase")], (first("gait_phase"), -1.0));
    assert!((0..reflection.len()).all(|at| reflection[reflection[at].0].0 == at), "twice mirrored is the same");
}

#[test]
fn feet_feel_the_next_stair_within_their_reach() {
    let stairs = vec![GroundKind::Stairs];
    let ground = GroundConfig { kinds: stairs, curriculum: false, start_level: 9, ..GroundConfig::default() };
    let settings = EnvironmentConfig { ground: ground.clone(), ..config(VelocityConfig::default()) };
    let mut environment = environment(&settings);
    let foot = environment.physics().model().robot.as_ref().unwrap().feet[0];
    let mut position = environment.nominal_position().to_vec();
    let still = vec![0.0; environment.physics().velocity().len()];
    // Risers of 0.1 m are 1.1 to 1.2 m and 1.5 to 1.6 m from the middle.
    for (way_m, rise_m) in [(0.6, 0.0), (0.95, 0.05), (1.05, 0.1), (1.15, 0.05), (1.25, 0.0), (1.45, 0.1)] {
        let [x_m, y_m] = ground.tile_centre_m(9, 0);
        // First to find the foot, then to put it there.
        for _ in 0..2 {
            environment.physics_mut().set_state(&position, &still);
            let physics = environment.physics();
            let link = &physics.model().links[foot];
            let origin = physics.body_motion(link.body).pose * nalgebra::Point3::from(link.pose.translation.vector);
            position[0] += x_m + way_m - origin.x;
            position[1] += y_m - origin.y;
        }
        let found_m = Foot::now(environment.physics(), foot, 0.0).rise_m;
        assert!((found_m - rise_m).abs() < 1e-9, "{found_m} m at {way_m} m");
    }
}
