//! Results of an environment do not depend on the number of threads or of other environments.

use treadmill_actor::environments::{Environments, SeedSource, StepResults};
use treadmill_humanoid::{HUMANOID_XML, Randomisation};
use treadmill_proto::{Episode, fragment::TRUNCATED};

use crate::randomised;

const STEPS: u64 = 60;

fn environments(count: usize, threads: usize) -> Environments {
    let seeds = SeedSource { run_seed: 5, actor: "a".into(), start: 2 };
    let config = randomised(Randomisation::default().motor_scale);
    Environments::new(count, &config, HUMANOID_XML, seeds).unwrap().with_threads(threads).unwrap()
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

fn play(count: usize, threads: usize) -> Vec<Trajectory> {
    let mut all = environments(count, threads);
    let width = all.observation_size();
    let mut trajectories = vec![Trajectory::default(); count];
    let mut results = StepResults::default();
    for step in 0..STEPS {
        let actions: Vec<f32> = (0..count).flat_map(|env| action(env, step)).collect();
        all.step(&actions, &mut results);
        let mut last_observations = results.truncated_observations.chunks_exact(width);
        let mut episodes = results.episodes.iter();
        for (env, trajectory) in trajectories.iter_mut().enumerate() {
            trajectory.observations.extend(bits(&all.observations()[env * width..][..width]));
            trajectory.rewards.extend(bits(&results.rewards[env..=env]));
            trajectory.flags.push(results.flags[env]);
            if results.flags[env] & TRUNCATED != 0 {
                let last = last_observations.next().expect("one for each truncated environment");
                trajectory.last_observations.extend(bits(last));
            }
            if results.flags[env] != 0 {
                trajectory.episodes.push(*episodes.next().expect("one for each end"));
            }
        }
        assert!(last_observations.next().is_none() && episodes.next().is_none());
    }
    trajectories
}

#[test]
fn threads_and_other_environments_do_not_change_a_bit() {
    let reference = play(16, 1);
    let ends: usize = reference.iter().map(|trajectory| trajectory.episodes.len()).sum();
    let truncated =
        reference.iter().flat_map(|trajectory| &trajectory.flags).filter(|flags| *flags & TRUNCATED != 0).count();
    assert!(truncated > 0 && ends > truncated, "{truncated} of {ends} episodes ended by the time limit");
    for (count, threads) in [(1, 1), (1, 3), (5, 1), (5, 2), (5, 3), (16, 2), (16, 3)] {
        let trajectories = play(count, threads);
        for (env, (trajectory, reference)) in trajectories.iter().zip(&reference).enumerate() {
            assert!(trajectory == reference, "environment {env} of {count} on {threads} threads");
        }
    }
    assert!(reference[0] != reference[2], "environments differ from each other");
}

#[test]
fn threads_are_at_most_as_many_as_environments() {
    assert_eq!(environments(2, 3).threads(), 2);
    assert_eq!(environments(1, 0).threads(), 1);
    assert_eq!(environments(3, 3).threads(), 3);
    let mut none = environments(0, 4);
    assert!(none.is_empty() && none.threads() == 1);
    let mut results = StepResults::default();
    none.step(&[], &mut results);
    assert!(results.rewards.is_empty());
}

#[test]
#[should_panic(expected = "one action for each environment is needed")]
fn too_few_actions_panic() {
    environments(2, 1).step(&[0.0; 17], &mut StepResults::default());
}
