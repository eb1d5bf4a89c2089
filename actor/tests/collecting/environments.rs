//! Results of an environment do not depend on the other environments, nor on the share that it belongs to.

use treadmill_actor::environments::{Environments, StepResults};
use treadmill_humanoid::{EnvironmentConfig, RandomisationConfig, worlds_per_pass};
use treadmill_proto::{Episode, fragment::TRUNCATED};

use crate::randomised;

const STEPS: u64 = 60;

fn environments(count: usize, shares: usize) -> Vec<Environments> {
    let config = randomised(RandomisationConfig::default().motor_scale);
    crate::environments(count, &config, "a", 2).split(shares)
}

/// Returns an action that depends only on the environment's number and the step. Half of the environments stand still.
fn action(env: usize, step: u64) -> [f32; 17] {
    std::array::from_fn(
        |motor| if env.is_multiple_of(2) { 0.0 } else { ((env * 31 + motor * 7) as f32 + step as f32).sin() },
    )
}

/// All outputs of one environment, step by step.
#[derive(Clone, Debug, Default, PartialEq)]
struct Trajectory {
    observations: Vec<u32>,
    rewards: Vec<u32>,
    flags: Vec<u8>,
    last_observations: Vec<u32>,
    episodes: Vec<Episode>,
}

fn bits(numbers: &[f32]) -> impl Iterator<Item = u32> {
    numbers.iter().map(|number| number.to_bits())
}

fn play(count: usize, shares: usize) -> Vec<Trajectory> {
    environments(count, shares).into_iter().flat_map(play_share).collect()
}

fn play_share(mut share: Environments) -> Vec<Trajectory> {
    let (first, width) = (share.first_number(), share.observation_size());
    let mut trajectories = vec![Trajectory::default(); share.len()];
    let mut results = StepResults::default();
    for step in 0..STEPS {
        let actions: Vec<f32> = (first..first + share.len()).flat_map(|env| action(env, step)).collect();
        share.step(&actions, &mut results);
        let mut last_observations = results.truncated_observations.chunks_exact(width);
        let mut episodes = results.episodes.iter();
        for (row, trajectory) in trajectories.iter_mut().enumerate() {
            trajectory.observations.extend(bits(&share.observations()[row * width..][..width]));
            trajectory.rewards.extend(bits(&results.rewards[row..=row]));
            trajectory.flags.push(results.flags[row]);
            if results.flags[row] & TRUNCATED != 0 {
                let last = last_observations.next().expect("one for each truncated environment");
                trajectory.last_observations.extend(bits(last));
            }
            if results.flags[row] != 0 {
                trajectory.episodes.push(*episodes.next().expect("one for each end"));
            }
        }
        assert!(last_observations.next().is_none() && episodes.next().is_none());
    }
    trajectories
}

#[test]
fn shares_and_other_environments_do_not_change_a_bit() {
    let reference = play(40, 1);
    let ends: usize = reference.iter().map(|trajectory| trajectory.episodes.len()).sum();
    let truncated =
        reference.iter().flat_map(|trajectory| &trajectory.flags).filter(|flags| *flags & TRUNCATED != 0).count();
    assert!(truncated > 0 && ends > truncated, "{truncated} of {ends} episodes ended by the time limit");
    for (count, shares) in [(1, 1), (1, 3), (5, 1), (5, 2), (40, 2), (40, 3), (40, 40)] {
        let trajectories = play(count, shares);
        for (env, (trajectory, reference)) in trajectories.iter().zip(&reference).enumerate() {
            assert!(trajectory == reference, "environment {env} of {count} in {shares} shares");
        }
    }
    assert!(reference[0] != reference[2], "environments differ from each other");
}

#[test]
fn shares_are_whole_passes_but_for_the_last() {
    let sizes = |count, shares| environments(count, shares).iter().map(Environments::len).collect::<Vec<_>>();
    let pass = worlds_per_pass();
    assert_eq!(sizes(2, 3), [2], "fewer environments than a pass");
    assert_eq!(sizes(5 * pass, 2), [3 * pass, 2 * pass]);
    assert_eq!(sizes(3 * pass + 1, 100), [pass, pass, pass, 1]);
    assert_eq!(sizes(3, 0), [3]);
    assert!(sizes(0, 4).is_empty());
}

#[test]
fn no_environments_step_without_actions() {
    let mut none = crate::environments(0, &EnvironmentConfig::default(), "a", 2);
    let mut results = StepResults::default();
    none.step(&[], &mut results);
    assert!(none.is_empty() && results.rewards.is_empty());
}

#[test]
#[should_panic(expected = "one action for each environment is needed")]
fn too_few_actions_panic() {
    environments(2, 1)[0].step(&[0.0; 17], &mut StepResults::default());
}
