//! Environments side by side: the same whatever the number of threads and of neighbours.

use treadmill_actor::environments::{Environments, SeedSource, Stepped};
use treadmill_humanoid::{EnvironmentConfig, HUMANOID_XML, Randomisation};
use treadmill_proto::{Episode, fragment::TRUNCATED};

const STEPS: u64 = 60;

/// Episodes that end in all ways within a few steps, with something of everything that is random.
fn config() -> EnvironmentConfig {
    EnvironmentConfig {
        max_episode_steps: 25,
        randomisation: Randomisation {
            mass_scale: [0.8, 1.2],
            sensor_noise_position: 0.01,
            control_noise: 0.1,
            action_delay_steps: [0, 2],
            push_interval_s: [0.1, 0.2],
            push_mps: [0.1, 2.0],
            ..Randomisation::default()
        },
        ..EnvironmentConfig::default()
    }
}

fn environments(count: usize, threads: usize) -> Environments {
    let seeds = SeedSource { run_seed: 5, actor: "a".into(), start: 2 };
    Environments::new(count, &config(), HUMANOID_XML, seeds).unwrap().with_threads(threads).unwrap()
}

/// An action that depends on the environment's number and the step alone. Half of the environments stand still.
fn action(env: usize, step: u64) -> [f32; 17] {
    std::array::from_fn(
        |motor| if env.is_multiple_of(2) { 0.0 } else { ((env * 31 + motor * 7) as f32 + step as f32).sin() },
    )
}

/// Everything that one environment gave, step by step.
#[derive(Clone, Debug, Default, PartialEq)]
struct Told {
    observations: Vec<u32>,
    rewards: Vec<u32>,
    flags: Vec<u8>,
    true_last: Vec<u32>,
    episodes: Vec<Episode>,
}

fn bits(numbers: &[f32]) -> impl Iterator<Item = u32> {
    numbers.iter().map(|number| number.to_bits())
}

fn play(count: usize, threads: usize) -> Vec<Told> {
    let mut all = environments(count, threads);
    let width = all.observation_size();
    let mut told = vec![Told::default(); count];
    let mut stepped = Stepped::default();
    for step in 0..STEPS {
        let actions: Vec<f32> = (0..count).flat_map(|env| action(env, step)).collect();
        all.step(&actions, &mut stepped);
        let mut true_last = stepped.truncated_observations.chunks_exact(width);
        let mut episodes = stepped.episodes.iter();
        for (env, told) in told.iter_mut().enumerate() {
            told.observations.extend(bits(&all.observations()[env * width..][..width]));
            told.rewards.extend(bits(&stepped.rewards[env..=env]));
            told.flags.push(stepped.flags[env]);
            if stepped.flags[env] & TRUNCATED != 0 {
                told.true_last.extend(bits(true_last.next().expect("one for each truncated environment")));
            }
            if stepped.flags[env] != 0 {
                told.episodes.push(*episodes.next().expect("one for each end"));
            }
        }
        assert!(true_last.next().is_none() && episodes.next().is_none());
    }
    told
}

#[test]
fn neither_threads_nor_neighbours_change_a_bit() {
    let reference = play(16, 1);
    let ends: usize = reference.iter().map(|told| told.episodes.len()).sum();
    let truncated = reference.iter().flat_map(|told| &told.flags).filter(|flags| *flags & TRUNCATED != 0).count();
    assert!(truncated > 0 && ends > truncated, "{truncated} of {ends} episodes ended by time");
    for (count, threads) in [(1, 1), (1, 3), (5, 1), (5, 2), (5, 3), (16, 2), (16, 3)] {
        let told = play(count, threads);
        for (env, (told, reference)) in told.iter().zip(&reference).enumerate() {
            assert!(told == reference, "environment {env} of {count} on {threads} threads");
        }
    }
    assert!(reference[0] != reference[2], "environments differ from each other");
}

#[test]
fn there_are_no_more_threads_than_environments() {
    assert_eq!(environments(2, 3).threads(), 2);
    assert_eq!(environments(1, 0).threads(), 1);
    assert_eq!(environments(3, 3).threads(), 3);
    let mut none = environments(0, 4);
    assert!(none.is_empty() && none.threads() == 1);
    let mut stepped = Stepped::default();
    none.step(&[], &mut stepped);
    assert!(stepped.rewards.is_empty());
}

#[test]
#[should_panic(expected = "one action for each environment is needed")]
fn too_few_actions_panic() {
    environments(2, 1).step(&[0.0; 17], &mut Stepped::default());
}
