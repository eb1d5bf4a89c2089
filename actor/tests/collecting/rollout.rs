//! Fragments from real environments: shapes, ends of episodes, faults.

use treadmill_actor::{environments::StepResults, rollout::Collector};
use treadmill_humanoid::{EnvironmentConfig, worlds_per_pass};
use treadmill_policy::gaussian;
use treadmill_proto::{
    EndCause, Fragment, PolicyVersion, Precision,
    fragment::{TERMINATED, TRUNCATED},
};
use treadmill_runtime::seeds;

use crate::{environments, identity, limited, policy};

fn collector(envs: usize, config: &EnvironmentConfig) -> Collector {
    Collector::new(environments(envs, config, "a", 0), seeds::stream(1, "noise", &[]), identity("a"))
}

/// Returns row `[t][n]` of a plane.
fn row(plane: &[f32], t: usize, n: usize, envs: usize, width: usize) -> &[f32] {
    &plane[(t * envs + n) * width..][..width]
}

#[test]
fn the_learner_receives_exactly_the_numbers_that_the_policy_saw() {
    let (envs, steps) = (3, 8);
    for precision in [Precision::F32, Precision::F16] {
        let environments = environments(envs, &limited(5), "a", 0).with_precision(precision);
        let mut collector = Collector::new(environments, seeds::stream(1, "noise", &[]), identity("a"));
        let (policy, mut normalised, mut means) = (policy(45), Vec::new(), vec![0.0; envs * 17]);
        for _ in 0..2 {
            let fragment = collector.collect(&policy, steps, 0).unwrap();
            assert!(fragment.flags.contains(&TRUNCATED));
            let received = Fragment::decode(fragment.encode_as(precision).unwrap()).unwrap();
            assert!(received == fragment);
            for t in 0..steps as usize {
                let observations = &received.observations[t * envs * 45..][..envs * 45];
                policy.means(observations, envs, &mut normalised, &mut means);
                for (n, mean) in means.chunks_exact(17).enumerate() {
                    let acted =
                        gaussian::log_probability(row(&received.actions, t, n, envs, 17), mean, policy.log_std());
                    assert_eq!(acted.to_bits(), received.log_probs[t * envs + n].to_bits());
                }
            }
        }
    }
}

#[test]
fn the_next_fragment_continues_where_the_last_one_ended() {
    let mut collector = collector(3, &EnvironmentConfig::default());
    let policy = policy(45);
    let first = collector.collect(&policy, 4, 0).unwrap();
    let second = collector.collect(&policy, 6, 1).unwrap();
    first.check().unwrap();
    second.check().unwrap();
    assert_eq!((first.sequence, second.sequence, second.settled_through), (1, 2, 1));
    assert_eq!((first.steps, second.steps), (4, 6), "each fragment has the length that was asked for");
    assert_eq!((first.env_steps, second.env_steps), (12, 30));
    assert_eq!(first.version, PolicyVersion::new(3, 4));
    // No episode ends within ten steps, so the second fragment begins with the last observation of the first.
    assert!(first.flags.iter().chain(&second.flags).all(|flags| *flags == 0));
    assert_eq!(first.last_observations, second.observations[..3 * 45]);
}

#[test]
fn a_time_limit_is_truncation_with_the_true_last_observation() {
    let fragment = collector(2, &limited(3)).collect(&policy(45), 7, 0).unwrap();
    fragment.check().unwrap();
    let flags: Vec<u8> = fragment.flags.iter().step_by(2).copied().collect();
    assert_eq!(flags, [0, 0, TRUNCATED, 0, 0, TRUNCATED, 0]);
    assert_eq!(fragment.episodes.len(), 4);
    assert!(fragment.episodes.iter().all(|episode| episode.cause == EndCause::TimeLimit && episode.length == 3));
    // Two truncations of two environments each, and both environments at the end.
    assert_eq!(fragment.last_observations.len(), 6 * 45);
    let (true_last, next_start) = (&fragment.last_observations[..45], row(&fragment.observations, 3, 0, 2, 45));
    assert_ne!(true_last, next_start, "the last observation is not the first of the next episode");
    // The torso's height changes little within one step.
    let before = row(&fragment.observations, 2, 0, 2, 45);
    assert!((true_last[0] - before[0]).abs() < 0.05);
}

#[test]
fn falls_are_terminations_and_their_returns_add_up() {
    let mut collector = collector(4, &EnvironmentConfig::default());
    let fragment = collector.collect(&policy(45), 64, 0).unwrap();
    fragment.check().unwrap();
    let ends = fragment.flags.iter().filter(|flags| **flags == TERMINATED).count();
    assert!(ends > 0, "random actions fall within 64 steps");
    assert_eq!(fragment.episodes.len(), ends);
    assert!(fragment.episodes.iter().all(|episode| episode.cause == EndCause::Fell));
    let first = fragment.flags.iter().step_by(4).position(|flags| *flags == TERMINATED).unwrap();
    let sum: f64 = (0..=first).map(|t| f64::from(row(&fragment.rewards, t, 0, 4, 1)[0])).sum();
    let episode = fragment.episodes.iter().find(|episode| episode.length as usize == first + 1).unwrap();
    assert!((episode.return_sum - sum).abs() < 1e-6);
    let velocity = episode.distance_m / (f64::from(episode.length) * 0.015);
    assert!((episode.velocity_mean_mps - velocity).abs() < 1e-12);
}

#[test]
fn threads_change_no_more_than_the_rounding_of_actions() {
    let envs = 2 * worlds_per_pass() + 3;
    let policy = policy(45);
    let collect = |threads: usize| {
        let mut collector = collector(envs, &limited(2)).with_threads(threads).unwrap();
        collector.attach_state();
        let fragment = collector.collect(&policy, 5, 0).unwrap();
        fragment.check().unwrap();
        fragment
    };
    let one = collect(1);
    assert_eq!((one.episodes.len(), one.last_observations.len()), (2 * envs, 3 * envs * 45));
    for threads in [2, 3, 100] {
        let several = collect(threads);
        assert_eq!(several.flags, one.flags);
        for (plane, other) in [
            (&several.observations, &one.observations),
            (&several.actions, &one.actions),
            (&several.log_probs, &one.log_probs),
            (&several.rewards, &one.rewards),
            (&several.last_observations, &one.last_observations),
        ] {
            assert_eq!(plane.len(), other.len());
            let difference = plane.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f32::max);
            assert!(difference < 1e-3, "{difference} on {threads} threads");
        }
        let distances = |fragment: &Fragment| fragment.episodes.iter().map(|end| end.distance_m).collect::<Vec<_>>();
        for (one, other) in distances(&one).into_iter().zip(distances(&several)) {
            assert!((one - other).abs() < 1e-4, "episodes keep their order");
        }
        assert_eq!(several.actor_state.unwrap().episodes, one.actor_state.as_ref().unwrap().episodes);
    }
}

#[test]
fn the_terms_of_the_reward_add_up_to_its_mean_also_over_threads() {
    let envs = worlds_per_pass() + 3;
    for threads in [1, 2] {
        let mut collector = collector(envs, &EnvironmentConfig::default()).with_threads(threads).unwrap();
        for steps in [30, 50] {
            let fragment = collector.collect(&policy(45), steps, 0).unwrap();
            let names: Vec<&str> = fragment.reward_terms.iter().map(|term| &*term.name).collect();
            assert_eq!(names, ["survive", "forward", "ctrl", "contact"]);
            let mean =
                fragment.rewards.iter().map(|reward| f64::from(*reward)).sum::<f64>() / (envs * steps as usize) as f64;
            let sum: f64 = fragment.reward_terms.iter().map(|term| term.mean).sum();
            assert!((sum - mean).abs() < 1e-5, "{sum} instead of {mean} on {threads} threads");
        }
    }
}

#[test]
fn failed_physics_ends_the_episode_with_finite_numbers() {
    let mut environments = environments(2, &EnvironmentConfig::default(), "a", 0);
    let mut results = StepResults::default();
    environments.step(&[0.0; 34], &mut results);
    let mut actions = [0.0; 34];
    actions[17] = f32::NAN;
    environments.step(&actions, &mut results);
    assert_eq!(results.flags, [0, TERMINATED]);
    assert_eq!(results.rewards[1], 0.0);
    assert_eq!((results.episodes.len(), results.episodes[0].cause), (1, EndCause::NonFinite));
    assert!(results.episodes[0].return_sum.is_finite());
    assert!(environments.observations().iter().all(|number| number.is_finite()));
    environments.step(&[0.0; 34], &mut results);
    assert_eq!(results.flags, [0, 0], "the next episode runs normally");
}
